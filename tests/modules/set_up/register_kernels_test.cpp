// Are the registers' words of four sets at once those of the form's values and differences, and are words that the
// kernels cannot make left to others?
#include "modules/set_up/register_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rastertlm::set_up::test {
namespace {

using span_unit::kRegisterSets;
using span_unit::StartEdgeRegisters;

class RegisterKernelsTest : public testing::TestWithParam<VectorVariant> {
 protected:
  std::mt19937_64 random_{31};
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  // Integers over a power of two: everything that follows is exact in a double, in whatever order.
  double coarse(double range) { return std::round(uniform(-range, range) * 16.0) / 16.0; }
};

// The value at steps of a pixel and of a line, from which registers are differences; exact for coarse forms.
struct Form {
  double t[6];
  double at(double x, double y) const {
    return t[0] + t[1] * y + t[2] * x + t[3] * y * y + t[4] * x * y + t[5] * x * x;
  }
};

std::uint64_t word(double value, double scale) {
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value * scale + 0.5)));
}

TEST_P(RegisterKernelsTest, AreDifferencesOfTheForm) {
  const RegisterKernels& kernels = register_kernels(GetParam());
  for (int round = 0; round < 2000; ++round) {
    RegisterForms forms{};
    Form plain[kRegisterSets];
    for (std::size_t set = 0; set < kRegisterSets; ++set) {
      const double curved = set == span_unit::kDepthSet ? 0.0 : 2.0;
      plain[set] = {{coarse(200), coarse(30), coarse(30), coarse(curved), coarse(curved), coarse(curved)}};
      forms.t0[set] = plain[set].t[0];
      forms.t1[set] = plain[set].t[1];
      forms.t2[set] = plain[set].t[2];
      forms.t3[set] = plain[set].t[3];
      forms.t4[set] = plain[set].t[4];
      forms.t5[set] = plain[set].t[5];
      forms.added[set] = set == span_unit::kDepthSet ? 0.0 : 0.5;
      // Few fraction bits, so that words are rounded, ties included.
      forms.scale[set] = std::ldexp(1.0, static_cast<int>(set) * 3);
    }
    const double x = coarse(300), y = coarse(300), a = coarse(3);
    StartEdgeRegisters words;
    ASSERT_TRUE(kernels.start(forms, x, y, a, words));
    for (std::size_t set = 0; set < kRegisterSets; ++set) {
      const Form& f = plain[set];
      const double scale = forms.scale[set];
      const double here = f.at(x, y), next = f.at(x + a, y + 1);
      const double pixel = f.at(x + 1, y) - here, line = next - here;
      const double pixel_below = f.at(x + a + 1, y + 1) - next;
      ASSERT_EQ(words.start[set], word(here + forms.added[set], scale));
      ASSERT_EQ(words.pixel_step[set], word(pixel, scale));
      ASSERT_EQ(words.line_step[set], word(line, scale));
      ASSERT_EQ(words.pixel_pixel[set], word(f.at(x + 2, y) - f.at(x + 1, y) - pixel, scale));
      ASSERT_EQ(words.line_pixel[set], word(pixel_below - pixel, scale));
      ASSERT_EQ(words.line_line[set], word(f.at(x + 2 * a, y + 2) - next - line, scale));
    }
  }
}

TEST_P(RegisterKernelsTest, LeaveWordsThatAreTooLargeOrNoNumbers) {
  const RegisterKernels& kernels = register_kernels(GetParam());
  for (std::size_t set = 0; set < kRegisterSets; ++set)
    for (const double value : {0x1p51, -0x1p51, 1e300, static_cast<double>(INFINITY), static_cast<double>(NAN)}) {
      RegisterForms forms{};
      for (double& scale : forms.scale) scale = 1.0;
      StartEdgeRegisters words;
      EXPECT_TRUE(kernels.start(forms, 1.0, 1.0, 0.5, words));
      forms.t0[set] = value;
      EXPECT_FALSE(kernels.start(forms, 1.0, 1.0, 0.5, words)) << value << " in set " << set;
      forms.t0[set] = 0x1p51 - 1.0;
      ASSERT_TRUE(kernels.start(forms, 1.0, 1.0, 0.5, words));
      EXPECT_EQ(words.start[set], (std::uint64_t{1} << 51) - 1);
      forms.t0[set] = 0.0;
      forms.t5[set] = value;
      EXPECT_FALSE(kernels.start(forms, 1.0, 1.0, 0.5, words)) << value << " in set " << set;
    }
}

INSTANTIATE_TEST_SUITE_P(Variants, RegisterKernelsTest, testing::ValuesIn(available_vector_variants()),
                         [](const auto& one) { return name_of(one.param); });

}  // namespace
}  // namespace rastertlm::set_up::test
