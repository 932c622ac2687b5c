// Which step of the deferred shading processor makes a level wrong?
//
// The chain with no step exact is the unit itself, bit for bit, and with all exact the lighting equation, to the last
// bit. In between: every visible normal of a 400 x 400 grid over the unit disc with a random length in [1/2, 1], three
// lights one at a time, viewer at infinity (the set-up of tests/modules/shading/end_to_end_test.cpp), and each step
// the machine's alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "src/analysis/blame_shading.h"
#include "src/analysis/blame_split.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using shading::Arithmetic;
using shading::MaterialArguments;
using shading::ShadingParameters;

// A unit with one light and one material, loaded, and its chain.
class Unit {
 public:
  Unit(const ShadingParameters& parameters, const object_processor::ObjectProcessorParameters& processor,
       const glm::dvec3& towards, const glm::dvec3& intensity, const MaterialArguments& m)
      : processor_(processor), shader_(parameters, processor.normal_bits), prenormaliser_(processor) {
    const glm::dvec3 light = geometry::normalised<double>(towards);
    const glm::dvec3 halfway = geometry::normalised<double>(light + glm::dvec3(0, 0, 1));
    shader_.set_material(0, m);
    shader_.set_light(
        0, {{light.x, light.y, light.z}, {halfway.x, halfway.y, halfway.z}, {intensity.x, intensity.y, intensity.z}});
    shader_.load();
    const glm::dvec3 colour(m.colour[0], m.colour[1], m.colour[2]);
    surfaces_.push_back({m.ambient * colour, m.diffuse * colour, glm::dvec3(m.specular), static_cast<int>(m.exponent)});
    const double mean = (intensity.x + intensity.y + intensity.z) / 3.0;
    lights_.push_back({false, light, intensity, parameters.specular_tables == 1 ? glm::dvec3(mean) : intensity});
    chain_.emplace(shader_, processor_, surfaces_, lights_, glm::dvec3(1.0));
  }

  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;
  const ShadingChain& chain() const { return *chain_; }
  shading::Levels shown(const PixelNormal& normal) const {
    shading::ShadingCounters ignored;
    const object_processor::LinkNormal link = prenormaliser_(normal.words);
    return shader_.shade_pixel(link[0], link[1], link[2], 0, ignored);
  }
  glm::dvec3 exact(const PixelNormal& normal) const {
    const glm::dvec3 light = geometry::illumination<double>(
        surfaces_[0], lights_, {geometry::Model::blinn, false, glm::dvec3(1.0)},
        geometry::normalised<double>(normal.exact), glm::dvec3(0, 0, 1), glm::dvec3(0.0));
    return glm::clamp(255.0 * light, 0.0, 255.0);
  }

 private:
  object_processor::ObjectProcessorParameters processor_;
  shading::DeferredShader shader_;
  object_processor::Prenormaliser prenormaliser_;
  std::vector<geometry::Reflectance> surfaces_;
  std::vector<geometry::LightSource> lights_;
  std::optional<ShadingChain> chain_;
};

StepSet all_steps() {
  StepSet all;
  for (const Step step : ShadingChain::kChain) all = all.with(step);
  return all;
}

PixelNormal pixel_normal(const glm::dvec3& exact, unsigned word_bits = 24) {
  PixelNormal normal;
  normal.exact = exact;
  const double unit = std::ldexp(1.0, static_cast<int>(word_bits) - 2);
  for (std::size_t i = 0; i < 3; ++i)
    normal.words[i] =
        static_cast<std::uint32_t>(wrap_unsigned(round_half_up(exact[static_cast<int>(i)] * unit), word_bits));
  return normal;
}

// The widths and the arithmetic change, and so does everything that is shaded.
void check_ends(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto real = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) / 9007199254740992.0;
  };
  const auto whole = [&](std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
  };
  ShadingParameters p;
  p.arithmetic = whole(0, 1) == 0 ? Arithmetic::literal : Arithmetic::centred;
  p.materials = 1;
  p.normaliser_address_bits = whole(8, 16);
  p.normaliser_output_bits = whole(10, 14);
  p.dot_table_address_bits = whole(9, 12);
  p.dot_table_output_bits = whole(8, p.dot_table_address_bits);
  p.index_bits = whole(6, p.dot_table_output_bits);
  p.level_bits = whole(4, 8);
  p.specular_tables = whole(0, 1) == 0 ? 1 : 3;
  object_processor::ObjectProcessorParameters processor;
  processor.normal_bits = whole(10, 14);
  Diagnostics diagnostics;
  p.check(processor.normal_bits, "", diagnostics);
  if (!diagnostics.empty()) return;
  const auto exponent = p.exponents[static_cast<std::size_t>(whole(0, 13))];
  const Unit unit(p, processor, {real(-1, 1), real(-1, 1), real(0, 1)}, {real(0, 1), real(0, 1), real(0, 1)},
                  {{real(0, 1), real(0, 1), real(0, 1)}, real(0, 1), real(0, 1), real(0, 1), exponent});
  for (int i = 0; i < 50; ++i) {
    glm::dvec3 n(real(-1, 1), real(-1, 1), real(-1, 1));
    if (i % 10 == 0) n = glm::dvec3(0.0);
    if (i % 10 == 1) n *= std::ldexp(1.0, -static_cast<int>(whole(0, 22)));
    const PixelNormal normal = pixel_normal(n / std::sqrt(3.0));
    const shading::Levels shown = unit.shown(normal);
    EXPECT_EQ(unit.chain().levels(normal, 0, StepSet()), glm::dvec3(shown[0], shown[1], shown[2])) << "seed " << seed;
    EXPECT_EQ(unit.chain().levels(normal, 0, all_steps()), unit.exact(normal)) << "seed " << seed;
  }
}

TEST(BlameShading, NoStepExactIsTheUnitAndAllAreTheEquation) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) check_ends(seed);
}

// Words of 15 and 16 bits: whatever step is the machine's alone, next to nothing is lost.
TEST(BlameShading, WideWordsLoseNothing) {
  ShadingParameters p;
  p.normaliser_address_bits = 20;
  p.normaliser_output_bits = 16;
  p.dot_table_address_bits = p.dot_table_output_bits = 15;
  p.index_bits = 15;
  object_processor::ObjectProcessorParameters processor;
  processor.normal_bits = 16;
  const Unit unit(p, processor, {.5, .6, 1}, {1, 1, 1}, {{1, 1, 1}, 0.1, 0.5, 0.4, 2});
  std::mt19937_64 random(7);
  for (int i = 0; i < 1000; ++i) {
    glm::dvec3 n;
    for (int c = 0; c < 3; ++c) n[c] = static_cast<double>(random() >> 11) / 9007199254740992.0 - 0.5;
    const PixelNormal normal = pixel_normal(n);
    for (const Step step : {Step::coefficients, Step::pre_normalisation, Step::normaliser, Step::dot_product})
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(unit.chain().levels(normal, 0, all_steps().without(step))[c], unit.exact(normal)[c], 0.05)
            << traits_of(step).name;
  }
}

struct Errors {
  int max = 0;
  int p999 = 0;
  double mean = 0.0;
};

// Integer differences to the rounded exact level, of the green channel.
class Counts {
 public:
  void add(double level, double exact) {
    const auto off = std::abs(static_cast<int>(std::floor(level + 0.5)) - static_cast<int>(std::floor(exact + 0.5)));
    ++histogram_[static_cast<std::size_t>(off)];
    ++total_;
  }
  Errors errors() const {
    Errors e;
    e.p999 = -1;
    std::uint64_t above = 0;
    for (int level = 255; level >= 0; --level) {
      const std::uint64_t here = histogram_[static_cast<std::size_t>(level)];
      if (here > 0) e.max = std::max(e.max, level);
      above += here;
      if (e.p999 < 0 && static_cast<double>(above) > 0.001 * static_cast<double>(total_)) e.p999 = level;
      e.mean += level * static_cast<double>(here) / static_cast<double>(total_);
    }
    return e;
  }

 private:
  std::array<std::uint64_t, 256> histogram_{};
  std::uint64_t total_ = 0;
};

const std::vector<glm::dvec3>& grid() {
  static const std::vector<glm::dvec3> normals = [] {
    std::mt19937_64 random(1);
    std::vector<glm::dvec3> made;
    for (int j = 0; j < 400; ++j)
      for (int i = 0; i < 400; ++i) {
        const double x = (i + 0.5) / 200.0 - 1.0, y = (j + 0.5) / 200.0 - 1.0;
        const double square = 1.0 - x * x - y * y;
        if (square < 0.0) continue;
        const double length = 0.5 + 0.5 * static_cast<double>(random() >> 11) / 9007199254740992.0;
        made.push_back(glm::dvec3(x, y, std::sqrt(square)) * length);
      }
    return made;
  }();
  return normals;
}

struct Attribution {
  Errors machine;
  std::map<Step, Errors> alone;  // it alone is the machine's
  Step worst = Step::none;       // blamed for the normal that is farthest off
  std::map<Step, int> blamed;    // of the thousandth that is farthest off, how many on each
  int worst_samples = 0;         // that these are
};

// One normal under one light, and how far off its level is.
struct Sample {
  std::size_t light = 0;
  std::size_t normal = 0;
  double off = 0.0;
};

Step blamed_for(const Unit& unit, const PixelNormal& normal) {
  const double exact = unit.exact(normal)[1];
  const double sign = unit.chain().levels(normal, 0, StepSet())[1] > exact ? 1.0 : -1.0;
  const std::vector<double> shares =
      split(ShadingChain::kChain, [&](StepSet set) { return sign * (unit.chain().levels(normal, 0, set)[1] - exact); });
  return ShadingChain::kChain[static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) -
                                                       shares.begin())];
}

Attribution attribute(const ShadingParameters& parameters, const MaterialArguments& material) {
  std::deque<Unit> units;
  for (const glm::dvec3& light : {glm::dvec3{.5, .6, 1}, glm::dvec3{-.8, .3, .5}, glm::dvec3{.05, -.1, 1}})
    units.emplace_back(parameters, object_processor::ObjectProcessorParameters(), light, glm::dvec3(1.0), material);
  Counts machine;
  std::map<Step, Counts> alone;
  std::vector<Sample> samples;
  for (std::size_t l = 0; l < units.size(); ++l)
    for (std::size_t i = 0; i < grid().size(); ++i) {
      const PixelNormal normal = pixel_normal(grid()[i]);
      const double exact = units[l].exact(normal)[1];
      const double level = units[l].chain().levels(normal, 0, StepSet())[1];
      machine.add(level, exact);
      samples.push_back({l, i, std::fabs(level - exact)});
      for (const Step step : ShadingChain::kChain)
        alone[step].add(units[l].chain().levels(normal, 0, all_steps().without(step))[1], exact);
    }
  Attribution result;
  const auto worst = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 1000);
  std::partial_sort(samples.begin(), worst, samples.end(),
                    [](const Sample& a, const Sample& b) { return a.off > b.off; });
  for (auto s = samples.begin(); s != worst; ++s)
    ++result.blamed[blamed_for(units[s->light], pixel_normal(grid()[s->normal]))];
  result.worst = blamed_for(units[samples.front().light], pixel_normal(grid()[samples.front().normal]));
  result.worst_samples = static_cast<int>(samples.size() / 1000);
  result.machine = machine.errors();
  std::printf("exponent %d, a = %d, %s: %d / %d / %.3f, worst: %s\n", static_cast<int>(material.exponent),
              static_cast<int>(parameters.normaliser_address_bits),
              parameters.arithmetic == Arithmetic::literal ? "literal" : "centred", result.machine.max,
              result.machine.p999, result.machine.mean, std::string(traits_of(result.worst).name).c_str());
  for (const Step step : ShadingChain::kChain) {
    const Errors a = result.alone[step] = alone[step].errors();
    std::printf("  %-22s alone %2d / %2d / %.3f, blamed for %d of the worst %d\n",
                std::string(traits_of(step).name).c_str(), a.max, a.p999, a.mean, result.blamed[step],
                result.worst_samples);
  }
  return result;
}

ShadingParameters machine_of(Arithmetic arithmetic, std::int64_t address_bits) {
  ShadingParameters p;
  p.materials = 1;
  p.arithmetic = arithmetic;
  p.normaliser_address_bits = address_bits;
  return p;
}

// What the paper's own arithmetic loses, shading by highlights alone (Ks = 1).
TEST(BlameShading, LiteralDotProductMakesTheLargestErrors) {
  for (const std::int64_t exponent : {5, 10, 50, 200}) {
    SCOPED_TRACE("exponent " + std::to_string(exponent));
    Attribution a = attribute(machine_of(Arithmetic::literal, 12), {{1, 1, 1}, 0, 0, 1, exponent});
    EXPECT_EQ(a.worst, Step::dot_product);
    EXPECT_GT(a.blamed[Step::dot_product], a.worst_samples / 2);
    for (const Step step : ShadingChain::kChain) {
      if (step == Step::dot_product) continue;
      EXPECT_GT(a.alone[Step::dot_product].max, a.alone[step].max) << traits_of(step).name;
      EXPECT_GE(a.alone[Step::dot_product].p999, a.alone[step].p999) << traits_of(step).name;
    }
    EXPECT_LE(a.alone[Step::pre_normalisation].max, 2) << "it never matters";
    EXPECT_LE(a.alone[Step::pre_normalisation].p999, 1);
    // Floored words darken everything: that is most of the mean until highlights are small.
    const bool small = exponent > 20;
    EXPECT_EQ(a.alone[Step::specular_table].mean < a.alone[Step::dot_product].mean, small);
    for (const Step step : ShadingChain::kChain)
      EXPECT_LE(a.alone[step].mean, a.alone[small ? Step::dot_product : Step::specular_table].mean);
  }
}

// With half-LSB readings the order of the steps stays, on smaller errors.
TEST(BlameShading, CentredDotProductMakesTheLargestErrorsToo) {
  for (const std::int64_t exponent : {10, 50, 200}) {
    SCOPED_TRACE("exponent " + std::to_string(exponent));
    Attribution a = attribute(machine_of(Arithmetic::centred, 14), {{1, 1, 1}, 0, 0, 1, exponent});
    EXPECT_EQ(a.worst, Step::dot_product);
    EXPECT_GT(a.blamed[Step::dot_product], a.worst_samples / 2);
    for (const Step step : ShadingChain::kChain) {
      if (step == Step::dot_product) continue;
      EXPECT_GT(a.alone[Step::dot_product].max, a.alone[step].max) << traits_of(step).name;
      EXPECT_GT(a.alone[Step::dot_product].p999, a.alone[step].p999) << traits_of(step).name;
      EXPECT_GT(a.alone[Step::dot_product].mean, a.alone[step].mean) << traits_of(step).name;
    }
  }
}

// The default machine and the default material's shares of light: from exponent 50 on likewise. At 10 no step makes
// more than two levels, the largest error is one of several, and the thousandth that is farthest off has no one to
// blame.
TEST(BlameShading, DefaultMachineAndMaterial) {
  for (const std::int64_t exponent : {10, 50, 200}) {
    SCOPED_TRACE("exponent " + std::to_string(exponent));
    Attribution a = attribute(machine_of(Arithmetic::centred, 14), {{1, 1, 1}, 0.1, 0.5, 0.4, exponent});
    if (exponent == 10) {
      EXPECT_LE(a.machine.max, 3);
      for (const Step step : ShadingChain::kChain) {
        EXPECT_LE(a.alone[step].max, 2) << traits_of(step).name;
        EXPECT_LT(a.blamed[step], a.worst_samples / 2) << traits_of(step).name;
      }
      continue;
    }
    EXPECT_EQ(a.worst, Step::dot_product);
    EXPECT_GT(a.blamed[Step::dot_product], a.worst_samples / 2);
    for (const Step step : ShadingChain::kChain)
      if (step != Step::dot_product) {
        EXPECT_GT(a.alone[Step::dot_product].max, a.alone[step].max) << traits_of(step).name;
        EXPECT_GE(a.alone[Step::dot_product].p999, a.alone[step].p999) << traits_of(step).name;
      }
  }
}

// Each stage alone at exponent 50 beside figures of an independent program: maximum / 99.9th percentile. A table's
// index is cut from the sum that an exact product would have there, 2047 for 1 in literal arithmetic; cut from 2048 the
// literal table's row would be that program's 11 / 9 (here 7 / 5).
TEST(BlameShading, StagesAlone) {
  const auto near = [](const Errors& got, int max, int p999) {
    EXPECT_LE(std::abs(got.max - max), std::max(2.0, 0.15 * max)) << got.max;
    EXPECT_LE(std::abs(got.p999 - p999), 2) << got.p999;
  };
  const MaterialArguments highlight{{1, 1, 1}, 0, 0, 1, 50};
  Attribution literal = attribute(machine_of(Arithmetic::literal, 10), highlight);
  near(literal.alone[Step::pre_normalisation], 2, 1);
  near(literal.alone[Step::normaliser], 41, 22);
  near(literal.alone[Step::dot_product], 22, 14);
  EXPECT_GT(literal.alone[Step::normaliser].max, literal.alone[Step::dot_product].max) << "ten bits are too few";
  Attribution centred = attribute(machine_of(Arithmetic::centred, 12), highlight);
  near(centred.alone[Step::normaliser], 14, 7);
  near(centred.alone[Step::dot_product], 12, 6);
  near(centred.alone[Step::specular_table], 6, 5);
  near(attribute(machine_of(Arithmetic::centred, 16), highlight).alone[Step::normaliser], 7, 4);
}

}  // namespace
}  // namespace rastertlm::analysis
