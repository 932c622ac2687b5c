#include "modules/quadric_processor/quadric_pixel.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace rastertlm::quadric_processor {
namespace {

constexpr unsigned kDepthBits = 24;
constexpr DepthRange kRange{257, (1 << 24) - 2 - 257};

// A ray's words, drawn so that roots, caps and range come one before another in every order.
struct Ray {
  QuadricParameters parameters;
  QuadricWords words;
  PixelWords pixel;
};

// Uniform, whatever RapidCheck's size is.
template <class T>
T drawn(T from, T to) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<T>(from, to));
}

Ray any_ray() {
  Ray ray;
  ray.parameters.root_reading = *rc::gen::element(RootReading::floor, RootReading::half_unit);
  ray.parameters.caps = drawn(0, 3);
  const auto depth = [] { return static_cast<std::int64_t>(drawn(-(1 << 23), (1 << 24) + (1 << 23))); };
  ray.pixel.middle = depth();
  ray.words.part = static_cast<RayPart>(drawn(0, 3));
  ray.words.root_shift = drawn(-1, 9);
  const auto bits = static_cast<unsigned>(drawn(20, 34));
  const auto magnitude = static_cast<std::uint64_t>(drawn<std::int64_t>(0, std::int64_t{1} << bits));
  const bool negative = drawn(0, 4) == 0;
  ray.pixel.discriminant = (negative ? ~magnitude : magnitude) & low_mask(48);
  for (std::size_t i = 0; i < kMostCaps; ++i) {
    ray.words.caps[i].keeps = static_cast<CapKeeps>(drawn(0, 4));
    ray.pixel.caps[i] = depth();
    ray.words.caps[i].normal = {static_cast<std::uint32_t>(i), 7, 9};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    ray.pixel.normal[i] = drawn(0U, 1U << kDepthBits);
    ray.words.normal_of_root[i] = drawn(-(1 << 23), 1 << 23);
  }
  return ray;
}

// The same from the definition: the solid's depths as a set of intervals, of which the first is seen.
std::optional<std::int64_t> first_depth(const Ray& ray) {
  constexpr std::int64_t kFar = std::int64_t{1} << 60;
  const bool negative = (ray.pixel.discriminant >> 47) != 0;
  std::int64_t half = 0;
  if (!negative) {
    // floor(sqrt) by trial, of a radicand with twice the root's guard bits of fraction.
    const auto root = static_cast<std::int64_t>(std::sqrt(static_cast<long double>(ray.pixel.discriminant)));
    std::int64_t exact = root;
    while (exact * exact > static_cast<std::int64_t>(ray.pixel.discriminant)) --exact;
    while ((exact + 1) * (exact + 1) <= static_cast<std::int64_t>(ray.pixel.discriminant)) ++exact;
    exact = std::min(exact, (std::int64_t{1} << 16) - 1);
    if (ray.parameters.root_reading == RootReading::half_unit) exact = 2 * exact + 1;
    const double scaled = std::ldexp(static_cast<double>(exact), ray.words.root_shift);
    half = static_cast<std::int64_t>(std::floor(scaled));
  }
  struct Part {
    std::int64_t from, to;
  };
  std::vector<Part> parts;
  const std::int64_t l = ray.pixel.middle;
  if (ray.words.part == RayPart::between && !negative) parts = {{l - half, l + half}};
  if (ray.words.part == RayPart::outside && !negative) parts = {{-kFar, l - half}, {l + half, kFar}};
  if (ray.words.part == RayPart::outside && negative) parts = {{-kFar, kFar}};
  if (ray.words.part == RayPart::all && !negative) parts = {{-kFar, kFar}};
  for (Part& part : parts) {
    part.from = std::max(part.from, kRange.near);
    part.to = std::min(part.to, kRange.far);
    for (std::size_t i = 0; i < static_cast<std::size_t>(ray.parameters.caps); ++i) {
      const std::int64_t at = ray.pixel.caps[i];
      switch (ray.words.caps[i].keeps) {
        case CapKeeps::everything:
          break;
        case CapKeeps::beyond:
          part.from = std::max(part.from, at);
          break;
        case CapKeeps::before:
          part.to = std::min(part.to, at);
          break;
        case CapKeeps::side:
          if (at < 0) part = {1, 0};
          break;
      }
      if (part.from > part.to) break;
    }
    if (part.from <= part.to) return part.from;
  }
  return std::nullopt;
}

RC_GTEST_PROP(QuadricPixelTest, ShowsTheFirstDepthInsideTheSolid, ()) {
  const Ray ray = any_ray();
  const QuadricPixel pixel = QuadricPixelLogic(ray.parameters, kDepthBits, kRange)(ray.words, ray.pixel);
  const std::optional<std::int64_t> expected = first_depth(ray);
  RC_CLASSIFY(pixel.covered && pixel.surface == Surface::near_root, "near root");
  RC_CLASSIFY(pixel.covered && pixel.surface == Surface::far_root, "far root");
  RC_CLASSIFY(pixel.covered && pixel.surface == Surface::cap, "cap");
  RC_CLASSIFY(pixel.covered && pixel.surface == Surface::near_plane, "near plane");
  RC_ASSERT(pixel.covered == expected.has_value());
  if (pixel.covered) {
    RC_ASSERT(pixel.depth == static_cast<std::uint32_t>(*expected));
  }
}

// E -/+ k s, the product rounded down, to within one unit of a sum in real numbers.
RC_GTEST_PROP(QuadricPixelTest, NormalIsThatOfTheSurface, ()) {
  const Ray ray = any_ray();
  const QuadricPixel pixel = QuadricPixelLogic(ray.parameters, kDepthBits, kRange)(ray.words, ray.pixel);
  if (!pixel.covered) return;
  if (pixel.surface == Surface::near_plane) {
    RC_ASSERT((pixel.normal == std::array<std::uint32_t, 3>{0, 0, 1U << 22}));
    return;
  }
  if (pixel.surface == Surface::cap) {
    RC_ASSERT(pixel.normal == ray.words.caps[pixel.cap].normal);
    return;
  }
  const auto root = static_cast<long double>(root_of(ray.pixel.discriminant, ray.parameters.root()));
  const long double sign = pixel.surface == Surface::far_root ? 1.0L : -1.0L;
  for (std::size_t i = 0; i < 3; ++i) {
    const long double exact = static_cast<long double>(ray.pixel.normal[i]) +
                              sign * root * static_cast<long double>(ray.words.normal_of_root[i]) / 65536.0L;
    const long double apart = std::remainder(static_cast<long double>(pixel.normal[i]) - exact, 16777216.0L);
    RC_ASSERT(std::abs(apart) <= 1.0L);
  }
}

TEST(QuadricPixelTest, ARootThatIsTooLargeIsTheLargest) {
  const object_processor::RootFormat format{4, 2, 4, RootReading::floor};
  EXPECT_EQ(root_of(low_mask(40), format), 63U);
  EXPECT_EQ(root_of(format.largest_word(), format), 63U);
}

}  // namespace
}  // namespace rastertlm::quadric_processor
