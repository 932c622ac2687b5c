// Do words of forms show them, and as near to them as is said?
#include "modules/set_up/anchored_words.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "modules/object_processor/second_order_processor.h"
#include "modules/quadric_processor/quadric_pixel.h"

namespace rastertlm::set_up {
namespace {

constexpr unsigned kBits = 60;

// Uniform, whatever RapidCheck's size is.
double uniform(double limit) {
  const auto word = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::int64_t>(-(1LL << 40), (1LL << 40) + 1));
  return limit * std::ldexp(static_cast<double>(word), -40);
}
Anchor any_anchor() {
  const auto pixel = [] { return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::int64_t>(0, 512)); };
  return {pixel(), pixel()};
}
double pixels(const Anchor& anchor, std::int64_t x, std::int64_t y) {
  return static_cast<double>(std::abs(x - anchor.x) + std::abs(y - anchor.y));
}

RC_GTEST_PROP(AnchoredWords, ALinearFormIsOffByHalfAUnitAPixel, ()) {
  const geometry::LinearForm<double> form{uniform(1e6), uniform(1e6), uniform(1e9)};
  const Anchor anchor = any_anchor();
  const quadric_processor::PlaneWords words = plane_words(anchored_plane(form, anchor), kBits);
  for (std::int64_t y = 0; y < 512; y += 73)
    for (std::int64_t x = 0; x < 512; x += 73) {
      const auto shown =
          quadric_processor::plane_at(words, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y), kBits);
      const long double exact = static_cast<long double>(form.x) * static_cast<long double>(x) +
                                static_cast<long double>(form.y) * static_cast<long double>(y) + form.one;
      RC_ASSERT(std::abs(static_cast<long double>(shown) - exact) <= linear_error(pixels(anchor, x, y)) + 1e-3L);
    }
}

RC_GTEST_PROP(AnchoredWords, ASecondOrderFormIsOffByNoMoreThanItsBound, ()) {
  const geometry::SecondOrderForm<double> form{uniform(1e3), uniform(1e3), uniform(1e3),
                                               uniform(1e6), uniform(1e6), uniform(1e9)};
  const Anchor anchor = any_anchor();
  const object_processor::SecondOrderWords words = anchored_second_order(form, anchor, kBits);
  long double most = 0;
  for (std::int64_t y = 0; y < 512; y += 73)
    for (std::int64_t x = 0; x < 512; x += 73) {
      const auto shown = sign_extend(object_processor::second_order_value(words, static_cast<std::uint64_t>(x),
                                                                          static_cast<std::uint64_t>(y), kBits),
                                     kBits);
      const auto u = static_cast<long double>(x), v = static_cast<long double>(y);
      const long double exact = (form.xx * u + form.xy * v + form.x) * u + (form.yy * v + form.y) * v + form.one;
      const long double off = std::abs(static_cast<long double>(shown) - exact);
      RC_ASSERT(off <= second_order_error(pixels(anchor, x, y)) + 1e-3L);
      most = std::max(most, off);
    }
  RC_CLASSIFY(most > 1000, "more than 1000 units somewhere");
}

// Where the rounded coefficients are half a unit off each, all in the same direction, the bound is reached.
TEST(AnchoredWords, TheBoundIsReached) {
  const double almost = 0.5 - 1e-9;
  const geometry::SecondOrderForm<double> form{almost / 2, almost / 2, almost, 0.0, 0.0, almost};
  const object_processor::SecondOrderWords words = anchored_second_order(form, Anchor{0, 0}, kBits);
  const auto shown = sign_extend(object_processor::second_order_value(words, 100, 100, kBits), kBits);
  EXPECT_NEAR(form.at(100, 100) - static_cast<double>(shown), (100.0 * 100 * 2) / 2 + 0.5, 1e-3);
  EXPECT_LT(form.at(100, 100) - static_cast<double>(shown), second_order_error(200));
  EXPECT_GT(form.at(100, 100) - static_cast<double>(shown), second_order_error(200) - 100.1);
}

// In words as wide as needed the form is exact, whatever the anchor.
RC_GTEST_PROP(AnchoredWords, IntegersAreThemselves, ()) {
  const auto whole = [](double limit) { return std::floor(uniform(limit)); };
  const geometry::SecondOrderForm<double> form{whole(1e3), whole(1e3), whole(1e3), whole(1e6), whole(1e6), whole(1e9)};
  const object_processor::SecondOrderWords words = anchored_second_order(form, any_anchor(), kBits);
  RC_ASSERT(words == anchored_second_order(form, Anchor{0, 0}, kBits));
  RC_ASSERT(sign_extend(object_processor::second_order_value(words, 311, 17, kBits), kBits) ==
            static_cast<std::int64_t>(form.at(311, 17)));
}

}  // namespace
}  // namespace rastertlm::set_up
