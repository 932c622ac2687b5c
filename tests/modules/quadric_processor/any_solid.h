// Random words of quadric processors: solids as a host would place them, and words that no host would load.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "modules/quadric_processor/quadric_board.h"
#include "src/base/fixed_point.h"

namespace rastertlm::quadric_processor::test {

inline constexpr std::uint32_t kColumns = 96;
inline constexpr std::uint32_t kLines = 80;
inline constexpr QuadricScreen kScreen{kColumns, kLines, 24, {257, (1 << 24) - 2 - 257}};

// Uniform, whatever RapidCheck's size is.
template <class T>
T drawn(T from, T to) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<T>(from, to));
}
inline double real(double from, double to) { return from + (to - from) * drawn(0, 1 << 20) / (1 << 20); }
inline std::uint64_t bits() { return *rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>()); }
inline std::uint64_t word(double value, unsigned width) {
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value + 0.5))) & low_mask(width);
}

inline QuadricParameters any_parameters() {
  QuadricParameters parameters;
  parameters.per_unit = 4;
  parameters.word_bits = drawn(40, 61);
  parameters.fraction_bits = drawn(0, 15);
  parameters.plane_bits = drawn(32, 49);
  parameters.caps = drawn(0, 7);
  parameters.root_integer_bits = drawn(6, 13);
  parameters.root_guard_bits = drawn(0, 8);
  parameters.multiplier_bits = drawn(16, 33);
  parameters.root_reading = *rc::gen::element(RootReading::floor, RootReading::half_unit);
  return parameters;
}

inline void fill_normals(QuadricWords& words) {
  for (LinearWords& plane : words.normal)
    plane = {static_cast<std::uint32_t>(bits()) & 0xFFFFFF, static_cast<std::uint32_t>(bits()) & 0xFFFFFF,
             static_cast<std::uint32_t>(bits()) & 0xFFFFFF};
  for (std::int32_t& factor : words.normal_of_root) factor = drawn(-(1 << 15), 1 << 15);
  for (CapWords& cap : words.caps)
    cap.normal = {static_cast<std::uint32_t>(bits()) & 0xFFFFFF, static_cast<std::uint32_t>(bits()) & 0xFFFFFF, 9};
  words.material = drawn(0U, 16U);
}

// A conic about some point in some direction, of every kind: ellipses, strips, hyperbolas, inside and outside.
inline SecondOrderWords any_conic(const QuadricParameters& parameters) {
  const auto width = static_cast<unsigned>(parameters.word_bits);
  const double angle = real(0, 6.3), cx = real(-40, 140), cy = real(-40, 140);
  const double unit = std::ldexp(1.0, static_cast<int>(parameters.fraction_bits));
  const auto any_sign = [](double magnitude) { return drawn(0, 3) == 0 ? magnitude : -magnitude; };
  const double along = drawn(0, 4) == 0 ? 0.0 : any_sign(std::exp(real(-3, 4)));
  const double across = any_sign(std::exp(real(-3, 4)));
  const double c = std::cos(angle), s = std::sin(angle);
  const double xx = along * c * c + across * s * s, yy = along * s * s + across * c * c;
  const double xy = 2 * (along - across) * c * s;
  const double x = -2 * xx * cx - xy * cy, y = -2 * yy * cy - xy * cx;
  const double one = xx * cx * cx + yy * cy * cy + xy * cx * cy + real(-100, 4000);
  return {word(one * unit, width),      word((yy + y) * unit, width), word(2 * yy * unit, width),
          word((xx + x) * unit, width), word(xy * unit, width),       word(2 * xx * unit, width)};
}

// A plane of depth that passes through the middle of the range somewhere on the screen.
inline PlaneWords any_plane(const QuadricParameters& parameters) {
  const auto width = static_cast<unsigned>(parameters.plane_bits);
  const double steep = std::exp(real(0, 18));
  const double a = real(-steep, steep), b = drawn(0, 3) == 0 ? 0.0 : real(-steep, steep);
  const double c = real(0, 1 << 24) - a * real(0, kColumns) - b * real(0, kLines);
  return {word(a, width), word(b, width), word(c - b, width)};
}

inline QuadricWords any_solid(const QuadricParameters& parameters) {
  QuadricWords words;
  words.discriminant = any_conic(parameters);
  words.middle = any_plane(parameters);
  words.part = *rc::gen::element(RayPart::between, RayPart::between, RayPart::outside, RayPart::all);
  words.root_shift = drawn(0, 14);
  for (std::size_t i = 0; i < static_cast<std::size_t>(parameters.caps); ++i)
    if (drawn(0, 2) == 0) {
      words.caps[i].keeps = static_cast<CapKeeps>(drawn(1, 4));
      words.caps[i].plane = any_plane(parameters);
    }
  fill_normals(words);
  return words;
}

// Every word wraps.
inline QuadricWords any_bits(const QuadricParameters& parameters) {
  QuadricWords words = any_solid(parameters);
  const std::uint64_t mask = low_mask(static_cast<unsigned>(parameters.word_bits));
  for (std::uint64_t* value : {&words.discriminant.v0, &words.discriminant.dy, &words.discriminant.two_b,
                               &words.discriminant.d0, &words.discriminant.c, &words.discriminant.two_a})
    if (drawn(0, 3) > 0) *value = bits() & mask;
  const std::uint64_t plane = low_mask(static_cast<unsigned>(parameters.plane_bits));
  if (drawn(0, 2) == 0) words.middle = {bits() & plane, bits() & plane, bits() & plane};
  for (CapWords& cap : words.caps)
    if (drawn(0, 3) == 0) cap.plane.a = bits() & plane;
  words.root_shift = drawn(-31, 32);
  return words;
}

}  // namespace rastertlm::quadric_processor::test
