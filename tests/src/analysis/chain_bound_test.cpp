// Do the bounds of the shading chain hold at any width, and are they near to what happens?
#include "src/analysis/chain_bound.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "src/analysis/chain_tables.h"
#include "src/analysis/shading_search.h"

namespace rastertlm::analysis {
namespace {

using shading::Arithmetic;
using shading::Direction;
using shading::ShadingParameters;

double size_of(const Range& range) { return std::max(-range.low, range.high); }

Direction random_unit() {
  for (;;) {
    Direction v{};
    for (double& c : v) c = *rc::gen::inRange(-1000, 1001) / 1000.0;
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (length < 0.1) continue;
    for (double& c : v) c /= length;
    if (v[2] > -0.9) return v;
  }
}

// The sum that the dot-product unit makes of N.L, 1 at full scale.
double sum_of(const ShadingBench& bench, const ShadingBench::Pixel& pixel) {
  const shading::DeferredShader& shader = bench.shader();
  const auto normal = shader.normaliser().normalise(pixel.link[0], pixel.link[1], pixel.link[2]);
  const shading::DotTables& tables = shader.front().lights[0].diffuse;
  std::int32_t terms = 0;
  for (std::size_t i = 0; i < 3; ++i)
    terms += shading::DotProduct::signed_term(tables.products[i][normal.magnitude[i]],
                                              normal.negative[i] != tables.negative[i]);
  const bool centred = shader.parameters().arithmetic == Arithmetic::centred;
  return shader.dot_product().sum(terms, 0, 0) /
         std::ldexp(centred ? 2.0 : 1.0, static_cast<int>(shader.parameters().dot_table_output_bits));
}

struct Case {
  ShadingParameters shading;
  object_processor::ObjectProcessorParameters object_processor;
};

Case random_case() {
  Case c;
  c.shading.arithmetic = *rc::gen::element(Arithmetic::literal, Arithmetic::centred);
  c.object_processor.word_bits = *rc::gen::inRange<std::int64_t>(16, 29);
  const auto normal_bits = *rc::gen::inRange<std::int64_t>(6, 15);
  c.object_processor.normal_bits = normal_bits;
  ShadingParameters& p = c.shading;
  p.normaliser_address_bits = *rc::gen::inRange<std::int64_t>(6, std::min<std::int64_t>(2 * normal_bits, 16) + 1);
  p.dot_table_address_bits = *rc::gen::inRange<std::int64_t>(6, 14);
  p.normaliser_output_bits =
      *rc::gen::inRange<std::int64_t>(std::max<std::int64_t>(8, p.dot_table_address_bits + 2 - normal_bits), 17);
  p.dot_table_output_bits = *rc::gen::inRange<std::int64_t>(5, p.dot_table_address_bits + 1);
  p.index_bits = *rc::gen::inRange<std::int64_t>(4, p.dot_table_output_bits + 1);
  p.exponents = {*rc::gen::inRange<std::int64_t>(1, 300)};
  return c;
}

NormalWords random_words(const Direction& direction, unsigned word_bits) {
  const auto bits = *rc::gen::inRange(0, static_cast<int>(word_bits) - 1);
  NormalWords words{};
  for (std::size_t i = 0; i < 3; ++i)
    words[i] = std::llround(std::ldexp(direction[i], bits)) + *rc::gen::inRange(-1, 2);
  return words;
}

TEST(ChainBound, HoldsForSumsAndLevelsAtEveryWidth) {
  EXPECT_TRUE(rc::check([] {
    const Case c = random_case();
    ShadingBench bench(c.shading, c.object_processor,
                       {{"diffuse", 0, 1, 0, c.shading.exponents[0]}, {"specular", 0, 0, 1, c.shading.exponents[0]}});
    bench.set_light(random_unit());
    const CosineBound bound(c.shading, c.object_processor.normal_bits);
    const double proved_diffuse = proved_level_error(bench, 0, sums_of(bound));
    const Curve curve = specular_curve(1, c.shading.exponents[0]);
    for (int i = 0; i < 20; ++i) {
      const Direction near = *rc::gen::arbitrary<bool>() ? bench.light().halfway : random_unit();
      const auto pixel = bench.pixel(random_words(near, bench.word_bits()));
      if (pixel.is_zero) continue;
      const Range sum = bound.sum_at(pixel.towards, pixel.squares);
      const double got = sum_of(bench, pixel);
      RC_ASSERT(got >= sum.low);
      RC_ASSERT(got <= sum.high);
      const Range level = level_range(bound.sum_at(pixel.halfway, pixel.squares), specular_table(bench, 1), curve);
      RC_ASSERT(bench.level(pixel, 1) >= level.low);
      RC_ASSERT(bench.level(pixel, 1) <= level.high);
      if (pixel.is_short) continue;
      RC_ASSERT(got >= bound.sum(pixel.towards).low);
      RC_ASSERT(got <= bound.sum(pixel.towards).high);
      RC_ASSERT(std::fabs(bench.level(pixel, 0) - bench.exact_level(pixel, 0)) <= proved_diffuse);
    }
  }));
}

// The bound of one arithmetic, or of words that are a bit wider, is broken by the other.
TEST(ChainBound, IsBrokenByAnotherChain) {
  const auto worst_beyond = [](const ShadingParameters& machine, const ShadingParameters& claimed) {
    ShadingBench bench(machine, {}, {{"specular", 0, 0, 1, 50}});
    Numbers numbers(1);
    const double seen = search_shading(bench, numbers, 20, 100).levels[0];
    ShadingBench other(claimed, {}, {{"specular", 0, 0, 1, 50}});
    other.set_light({0, 0, 1});
    return seen - proved_level_error(other, 0, sums_of(CosineBound(claimed, 12)));
  };
  ShadingParameters centred, literal, coarse, fine;
  literal.arithmetic = Arithmetic::literal;
  coarse.normaliser_address_bits = 10;
  fine.dot_table_address_bits = fine.dot_table_output_bits = 14;
  EXPECT_LE(worst_beyond(centred, centred), 0.0);
  EXPECT_GT(worst_beyond(literal, centred), 0.0);
  EXPECT_GT(worst_beyond(coarse, centred), 0.0);
  EXPECT_GT(worst_beyond(centred, fine), 0.0);
}

TEST(ChainBound, IsNothingWhereEveryStepIsExact) {
  const CosineBound bound(ShadingParameters{}, 12, ChainSteps::none());
  for (const double cosine : {-1.0, -0.3, 0.0, 0.25, 1.0}) {
    EXPECT_NEAR(bound.sum(cosine).low, cosine, 1e-9);
    EXPECT_NEAR(bound.sum(cosine).high, cosine, 1e-9);
  }
  // What is left is the width of a piece.
  EXPECT_LT(size_of(level_error(sums_of(bound), {}, specular_curve(1, 200))), 0.5);
}

// The figures of single stages, of highlights at exponent 50, that an independent program measured on a grid of
// normals: largest integer differences to a rounded picture, so that the proof may be a level below.
TEST(ChainBound, OfSingleStagesIsNearToWhatWasMeasured) {
  const auto proved = [](Arithmetic arithmetic, std::int64_t address_bits, const ChainSteps& steps) {
    ShadingParameters p;
    p.arithmetic = arithmetic;
    p.normaliser_address_bits = address_bits;
    const std::vector<Range> sums = sums_of(CosineBound(p, 12, steps));
    if (!steps.table) return size_of(level_error(sums, {}, specular_curve(1, 50)));
    ShadingBench bench(p, {}, {{"specular", 0, 0, 1, 50}});
    bench.set_light({0, 0, 1});
    return proved_level_error(bench, 0, sums);
  };
  ChainSteps normaliser = ChainSteps::none(), dot = ChainSteps::none(), table = ChainSteps::none();
  normaliser.root_address = normaliser.root_word = normaliser.component = true;
  dot.dot_product = true;
  table.table = true;
  struct Stage {
    Arithmetic arithmetic;
    std::int64_t address_bits;
    ChainSteps steps;
    double measured;
  };
  for (const Stage& stage :
       {Stage{Arithmetic::centred, 10, normaliser, 41}, Stage{Arithmetic::centred, 12, normaliser, 14},
        Stage{Arithmetic::centred, 14, normaliser, 9}, Stage{Arithmetic::centred, 14, dot, 12},
        Stage{Arithmetic::literal, 12, dot, 22}, Stage{Arithmetic::centred, 14, table, 6},
        Stage{Arithmetic::literal, 12, table, 11}}) {
    const double bound = proved(stage.arithmetic, stage.address_bits, stage.steps);
    EXPECT_GE(bound, stage.measured - 1) << stage.address_bits;
    EXPECT_LE(bound, 1.6 * stage.measured + 1) << stage.address_bits;
  }
}

}  // namespace
}  // namespace rastertlm::analysis
