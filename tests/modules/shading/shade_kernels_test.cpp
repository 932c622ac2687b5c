// Does every vector kernel that this processor has shade as the tables say, whatever a loader has made of them so far?
#include "modules/shading/shade_kernels.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "modules/shading/deferred_shader.h"
#include "modules/shading/shade_tables.h"
#include "modules/shading/table_filler.h"

namespace rastertlm::shading {
namespace {

Direction unit(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

// Widths with which the kernels are used.
ShadingParameters kernel_parameters() {
  ShadingParameters p;
  p.lights = *rc::gen::inRange<std::int64_t>(1, 4);
  p.materials = *rc::gen::inRange<std::int64_t>(1, 33);
  p.normaliser_address_bits = *rc::gen::inRange<std::int64_t>(6, 16);
  p.normaliser_output_bits = *rc::gen::inRange<std::int64_t>(10, 14);
  p.dot_table_output_bits = *rc::gen::inRange<std::int64_t>(8, 12);
  p.index_bits = *rc::gen::inRange<std::int64_t>(5, std::min<std::int64_t>(p.dot_table_output_bits, 10) + 1);
  p.diffuse_fraction_bits = *rc::gen::inRange<std::int64_t>(0, 5);
  p.specular_tables = *rc::gen::element<std::int64_t>(1, 3);
  return p;
}

void set_scene(DeferredShader& shader, std::mt19937& random) {
  const auto real = [&] { return static_cast<double>(random() % 2001) / 1000.0 - 1.0; };
  const ShadingParameters& p = shader.parameters();
  for (std::int64_t m = 0; m < p.materials; ++m)
    shader.set_material(static_cast<std::size_t>(m), {{std::abs(real()), 1, 0.5},
                                                      std::abs(real()),
                                                      std::abs(real()),
                                                      std::abs(real()),
                                                      p.exponents[random() % p.exponents.size()]});
  for (std::int64_t l = 0; l < p.lights; ++l) {
    const Direction light = unit(real(), real(), 1.1 + real());
    shader.set_light(static_cast<std::size_t>(l),
                     {light, unit(light[0], light[1], light[2] + 1.0), {1, 0.5, std::abs(real())}});
  }
  shader.set_background({1, 2, 3});
}

frame::FragmentLine random_line(std::size_t columns, std::int64_t normal_bits, std::int64_t materials,
                                std::mt19937& random) {
  frame::FragmentLine in;
  in.resize(columns);
  in.begin = random() % (columns / 3 + 1);
  in.end = columns - random() % (columns / 3 + 1);
  const std::uint32_t mask = (1U << normal_bits) - 1;
  const bool sparse = random() % 2 == 0;
  for (std::size_t c = 0; c < columns; ++c) {
    in.object[c] = random() % 4 == 0 || (sparse && (c / 40) % 2 == 0) ? 0 : 1;
    in.material[c] =
        static_cast<std::uint8_t>(in.object[c] == 0 ? 255 : random() % static_cast<std::uint32_t>(materials));
    in.normal_x[c] = static_cast<std::uint16_t>(random() % 8 == 0 ? 0 : random() & mask);
    in.normal_y[c] = static_cast<std::uint16_t>(random() % 8 == 0 ? 0 : random() & mask);
    in.normal_z[c] = static_cast<std::uint16_t>(random() % 4 == 0 ? 0 : random() & mask);
  }
  return in;
}

// Shades the line thrice: as it stands, with the copy of the tables made, and with it again.
void compare_with_pixels(DeferredShader& shader, const frame::FragmentLine& in) {
  for (int time = 0; time < 3; ++time) {
    const ShadingCounters before = shader.counters();
    frame::RgbLine out;
    shader.shade_line(in, out);
    ShadingCounters counters = before;
    for (std::size_t c = 0; c < in.columns(); ++c) {
      Levels expected{1, 2, 3};
      if (c >= in.begin && c < in.end && in.object[c] != 0)
        expected = shader.shade_pixel(in.normal_x[c], in.normal_y[c], in.normal_z[c], in.material[c], counters);
      for (std::size_t i = 0; i < 3; ++i) RC_ASSERT(out.levels[3 * c + i] == expected[i]);
    }
    RC_ASSERT(counters == shader.counters());
  }
}

std::vector<std::size_t> all_lights(const DeferredShader& shader) {
  std::vector<std::size_t> lights;
  for (std::int64_t l = 0; l < shader.parameters().lights; ++l) lights.push_back(static_cast<std::size_t>(l));
  return lights;
}

RC_GTEST_PROP(ShadeKernels, LineEqualsPixels, ()) {
  const ShadingParameters p = kernel_parameters();
  const auto normal_bits = *rc::gen::inRange<std::int64_t>(8, 13);
  Diagnostics diagnostics;
  p.check(normal_bits, "machine.toml", diagnostics);
  RC_PRE(diagnostics.empty());
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  for (const VectorVariant variant : available_vector_variants()) {
    std::mt19937 random(seed);
    DeferredShader shader(p, normal_bits, 1, variant);
    set_scene(shader, random);
    shader.load();
    compare_with_pixels(shader, random_line(1 + random() % 200, normal_bits, p.materials, random));
  }
}

// The paper's widths are the kernel's: not a word of it is shaded otherwise once the tables are loaded.
TEST(ShadeKernels, AreUsedForTheMachineOfThePaper) {
  std::mt19937 random(3);
  DeferredShader shader(ShadingParameters(), 12);
  set_scene(shader, random);
  const auto made = [&] {
    return ShadeTables::of(std::as_const(shader).front(), shader.normaliser(), shader.parameters(), 12,
                           all_lights(shader), shade_kernels(vector_variant()))
        .has_value();
  };
  EXPECT_TRUE(made());  // empty tables are ramps of 0
  shader.load();
  EXPECT_TRUE(made());
  shader.front().lights[0].diffuse.products[1][7] ^= 1;
  EXPECT_FALSE(made());
}

// A table in which one entry is not what a finished loader leaves is read as it stands.
RC_GTEST_PROP(ShadeKernels, UnfinishedTablesAreReadAsTheyStand, ()) {
  ShadingParameters p;
  p.materials = 3;
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  for (const VectorVariant variant : available_vector_variants()) {
    std::mt19937 random(seed);
    DeferredShader shader(p, 12, 1, variant);
    set_scene(shader, random);
    shader.load();
    const frame::FragmentLine in = random_line(150, 12, p.materials, random);
    compare_with_pixels(shader, in);
    for (int change = 0; change < 5; ++change) {
      const auto address = static_cast<std::uint32_t>(random() % std::as_const(shader).front().words());
      shader.front().write(address, static_cast<std::uint32_t>(random()));
      shader.front().background = {1, 2, 3};
      compare_with_pixels(shader, in);
    }
  }
}

TEST(ShadeTables, FindsTheWordsOfRamps) {
  // Several words may make one table: it is the table that counts.
  std::vector<std::uint16_t> products(2048);
  std::vector<std::uint16_t> products_again(2048);
  for (std::uint32_t word = 0; word <= 2048; ++word) {
    fill(product_ramp(word, 11, Arithmetic::centred), std::span(products));
    const auto found = product_word(products, 11);
    ASSERT_TRUE(found.has_value()) << word;
    fill(product_ramp(*found, 11, Arithmetic::centred), std::span(products_again));
    ASSERT_EQ(products, products_again) << word;
  }
  products[100] ^= 1;
  EXPECT_EQ(product_word(products, 11), std::nullopt);

  std::vector<std::uint8_t> levels(1024);
  std::vector<std::uint8_t> again(1024);
  for (std::uint32_t word = 0; word <= 4080; word += 7) {
    fill(level_ramp(word, 10, 4, Arithmetic::centred), std::span(levels));
    const auto found = level_word(levels, 10, 4);
    ASSERT_TRUE(found.has_value()) << word;
    fill(level_ramp(*found, 10, 4, Arithmetic::centred), std::span(again));
    ASSERT_EQ(levels, again) << word;
  }
  levels[3] ^= 1;
  EXPECT_EQ(level_word(levels, 10, 4), std::nullopt);
}

TEST(ShadeKernels, AMaterialThatTheTablesDoNotHaveIsRefused) {
  for (const VectorVariant variant : available_vector_variants()) {
    std::mt19937 random(5);
    ShadingParameters p;
    p.materials = 3;
    DeferredShader shader(p, 12, 1, variant);
    set_scene(shader, random);
    shader.load();
    frame::FragmentLine in = random_line(90, 12, 3, random);
    frame::RgbLine out;
    shader.shade_line(in, out);
    shader.shade_line(in, out);
    in.object[in.begin + 3] = 1;
    in.material[in.begin + 3] = 3;
    EXPECT_THROW(shader.shade_line(in, out), ModelError) << name_of(variant);
  }
}

}  // namespace
}  // namespace rastertlm::shading
