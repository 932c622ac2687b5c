// How far is the whole chain, tables filled incrementally, from shading in double? Every visible normal of a 400 x 400
// grid over the unit disc with a random length in [1/2, 1], three lights one at a time, viewer at infinity. The
// expected cells come from an independent program (C++, tables filled by direct formula): maximum / 99.9th percentile /
// mean of the difference in levels. Accepted: maximum within 2 levels or 15 %, percentile within 2, mean within 0.05 of
// every cell. A maximum is one pixel's, and moves by up to 20 % with the lengths that are drawn (the independent
// program's draw is not known): the median of seven draws is compared. Percentile and mean must hold in every draw.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "modules/shading/deferred_shader.h"

namespace rastertlm::shading {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector unit(const Vector& v) {
  const double length = std::sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

struct Sample {
  Vector normal;
  std::array<std::uint32_t, 3> words;
};

// The pre-normalisation unit in a few lines of its own: one's complement magnitudes of 22-fraction-bit components,
// shifted together until the largest fits.
std::array<std::uint32_t, 3> pre_normalise(const Vector& normal, double length, unsigned normal_bits) {
  std::array<std::int64_t, 3> magnitude{};
  std::int64_t any = 0;
  std::array<bool, 3> negative{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto fixed = static_cast<std::int64_t>(std::floor(normal[i] * length * 4194304.0 + 0.5));
    negative[i] = fixed < 0;
    magnitude[i] = negative[i] ? -1 - fixed : fixed;
    any |= magnitude[i];
  }
  int shift = 0;
  while ((any >> shift) >= (std::int64_t{1} << (normal_bits - 1))) ++shift;
  std::array<std::uint32_t, 3> words{};
  for (std::size_t i = 0; i < 3; ++i)
    words[i] = static_cast<std::uint32_t>(magnitude[i] >> shift) | (negative[i] ? 1U << (normal_bits - 1) : 0U);
  return words;
}

std::vector<Sample> grid(unsigned normal_bits, std::uint64_t draw) {
  std::mt19937_64 random(draw);
  std::vector<Sample> samples;
  for (int j = 0; j < 400; ++j)
    for (int i = 0; i < 400; ++i) {
      const double x = (i + 0.5) / 200.0 - 1.0;
      const double y = (j + 0.5) / 200.0 - 1.0;
      const double square = 1.0 - x * x - y * y;
      if (square < 0.0) continue;
      const Vector normal{x, y, std::sqrt(square)};
      const double length = 0.5 + 0.5 * static_cast<double>(random() >> 11) / 9007199254740992.0;
      samples.push_back({normal, pre_normalise(normal, length, normal_bits)});
    }
  return samples;
}

constexpr std::array<Vector, 3> kLights{{{.5, .6, 1}, {-.8, .3, .5}, {.05, -.1, 1}}};

struct Errors {
  int max = 0;
  int p999 = 0;
  double mean = 0.0;
};

Errors measure(const ShadingParameters& parameters, unsigned normal_bits, const std::vector<Sample>& samples,
               const MaterialArguments& material) {
  std::array<std::int64_t, 256> histogram{};
  DeferredShader shader(parameters, normal_bits);
  shader.set_material(0, material);
  for (const Vector& towards : kLights) {
    const Vector light = unit(towards);
    const Vector halfway = unit({light[0], light[1], light[2] + 1.0});
    shader.set_light(0, {light, halfway, {1, 1, 1}});
    shader.load();
    ShadingCounters counters;
    for (const Sample& sample : samples) {
      const int level = shader.shade_pixel(sample.words[0], sample.words[1], sample.words[2], 0, counters)[1];
      const double exact = material.ambient + material.diffuse * std::max(0.0, dot(sample.normal, light)) +
                           material.specular * std::pow(std::max(0.0, dot(sample.normal, halfway)),
                                                        static_cast<double>(material.exponent));
      const int reference = static_cast<int>(std::floor(255.0 * std::min(1.0, exact) + 0.5));
      histogram[static_cast<std::size_t>(std::abs(level - reference))] += 1;
    }
  }
  Errors errors;
  const auto total = static_cast<double>(3 * samples.size());
  std::int64_t above = 0;
  errors.p999 = -1;
  for (int e = 255; e >= 0; --e) {
    const std::int64_t here = histogram[static_cast<std::size_t>(e)];
    if (here > 0) errors.max = std::max(errors.max, e);
    above += here;
    if (errors.p999 < 0 && static_cast<double>(above) > 0.001 * total) errors.p999 = e;
    errors.mean += e * static_cast<double>(here) / total;
  }
  return errors;
}

struct Cell {
  std::int64_t exponent;
  Errors expected;
};

constexpr std::uint64_t kDraws = 7;

// The cell over all draws: the median of the maxima; percentile and mean are checked draw by draw.
void expect_near(std::array<Errors, kDraws> draws, const Cell& cell) {
  std::sort(draws.begin(), draws.end(), [](const Errors& a, const Errors& b) { return a.max < b.max; });
  const int maximum = draws[kDraws / 2].max;
  std::printf("exponent %3d: max %2d (%d..%d) / %d / %.2f, expected %d / %d / %.2f\n", static_cast<int>(cell.exponent),
              maximum, draws.front().max, draws.back().max, draws.front().p999, draws.front().mean, cell.expected.max,
              cell.expected.p999, cell.expected.mean);
  SCOPED_TRACE("exponent " + std::to_string(cell.exponent));
  EXPECT_LE(std::abs(maximum - cell.expected.max), std::max(2.0, 0.15 * cell.expected.max));
  for (const Errors& draw : draws) {
    EXPECT_LE(std::abs(draw.p999 - cell.expected.p999), 2);
    EXPECT_LE(std::abs(draw.mean - cell.expected.mean), 0.05);
  }
}

void check_column(Arithmetic arithmetic, double ambient, double diffuse, double specular,
                  const std::vector<Cell>& cells) {
  ShadingParameters parameters;
  parameters.arithmetic = arithmetic;
  parameters.normaliser_address_bits = arithmetic == Arithmetic::literal ? 12 : 14;
  std::vector<std::vector<Sample>> grids;
  for (std::uint64_t draw = 1; draw <= kDraws; ++draw) grids.push_back(grid(12, draw));
  for (const Cell& cell : cells) {
    std::array<Errors, kDraws> draws;
    for (std::size_t i = 0; i < kDraws; ++i)
      draws[i] = measure(parameters, 12, grids[i], {{1, 1, 1}, ambient, diffuse, specular, cell.exponent});
    expect_near(draws, cell);
  }
}

TEST(EndToEnd, LiteralSpecular) {
  check_column(Arithmetic::literal, 0, 0, 1,
               {{1, {2, 2, 1.21}},
                {5, {5, 3, 1.16}},
                {10, {7, 5, 0.98}},
                {20, {14, 9, 0.75}},
                {50, {31, 17, 0.51}},
                {100, {57, 28, 0.43}},
                {200, {96, 42, 0.37}}});
}

TEST(EndToEnd, LiteralMix) {
  check_column(Arithmetic::literal, .1, .5, .4,
               {{1, {2, 2, 0.62}},
                {5, {3, 2, 0.52}},
                {10, {4, 3, 0.41}},
                {20, {7, 4, 0.32}},
                {50, {13, 7, 0.30}},
                {100, {24, 11, 0.28}},
                {200, {39, 17, 0.28}}});
}

TEST(EndToEnd, CentredSpecular) {
  check_column(Arithmetic::centred, 0, 0, 1,
               {{1, {1, 1, 0.08}},
                {5, {2, 1, 0.13}},
                {10, {4, 2, 0.15}},
                {20, {6, 4, 0.16}},
                {50, {15, 8, 0.16}},
                {100, {28, 13, 0.16}},
                {200, {52, 21, 0.16}}});
}

TEST(EndToEnd, CentredMix) {
  check_column(Arithmetic::centred, .1, .5, .4,
               {{1, {2, 1, 0.32}},
                {5, {2, 2, 0.37}},
                {10, {2, 2, 0.39}},
                {20, {3, 2, 0.42}},
                {50, {6, 3, 0.45}},
                {100, {11, 5, 0.47}},
                {200, {20, 8, 0.48}}});
}

// Wider words: 14 bits, components of 13, index of 12; and 16, 15, 14. The inverse square root ROM is wide enough not
// to count.
TEST(EndToEnd, WiderWords) {
  const auto check = [](std::int64_t bits, std::int64_t index_bits, const std::vector<Cell>& cells) {
    ShadingParameters parameters;
    parameters.dot_table_address_bits = parameters.dot_table_output_bits = bits - 1;
    parameters.index_bits = index_bits;
    parameters.normaliser_address_bits = 20;
    parameters.normaliser_output_bits = 16;
    const std::vector<Sample> samples = grid(static_cast<unsigned>(bits), 1);
    for (const Cell& cell : cells) {
      const Errors got = measure(parameters, static_cast<unsigned>(bits), samples, {{1, 1, 1}, 0, 0, 1, cell.exponent});
      EXPECT_LE(std::abs(got.max - cell.expected.max), std::max(2.0, 0.15 * cell.expected.max))
          << bits << " bits, E = " << cell.exponent;
      EXPECT_LE(std::abs(got.p999 - cell.expected.p999), 2) << bits << " bits, E = " << cell.exponent;
    }
  };
  check(14, 12, {{50, {4, 2, 0}}, {200, {12, 5, 0}}});
  check(16, 14, {{50, {1, 1, 0}}, {200, {3, 2, 0}}});
}

}  // namespace
}  // namespace rastertlm::shading
