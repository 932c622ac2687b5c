// Does the processor shade a line as it shades pixels, saturate instead of wrapping, and count what it did?
#include "modules/shading/deferred_shader.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "src/base/errors.h"

namespace rastertlm::shading {
namespace {

Direction unit(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}
Direction halfway(const Direction& light) { return unit(light[0], light[1], light[2] + 1.0); }

// A unit vector as words of the link, by rounding: an own formulation of what the pre-normalisation unit sends.
std::array<std::uint32_t, 3> words_of(const Direction& normal, int bits) {
  const double largest = std::max({std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])});
  const double scale = std::ldexp(1.0, bits - 1) * (largest > 0.5 ? 1.0 : largest > 0.25 ? 2.0 : 4.0);
  std::array<std::uint32_t, 3> words{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double magnitude = std::min(std::floor(std::abs(normal[i]) * scale), std::ldexp(1.0, bits - 1) - 1.0);
    words[i] = static_cast<std::uint32_t>(magnitude) + (normal[i] < 0 ? 1U << (bits - 1) : 0U);
  }
  return words;
}

TEST(DeferredShader, LineEqualsPixelsAtEveryWidth) {
  EXPECT_TRUE(rc::check([] {
    ShadingParameters p;
    p.arithmetic = *rc::gen::element(Arithmetic::literal, Arithmetic::centred);
    const auto normal_bits = *rc::gen::inRange<std::int64_t>(6, 17);
    p.lights = *rc::gen::inRange<std::int64_t>(1, 4);
    p.materials = *rc::gen::inRange<std::int64_t>(1, 6);
    p.normaliser_address_bits = *rc::gen::inRange<std::int64_t>(4, std::min<std::int64_t>(2 * normal_bits, 14) + 1);
    p.normaliser_output_bits = *rc::gen::inRange<std::int64_t>(10, 17);
    p.dot_table_address_bits = *rc::gen::inRange<std::int64_t>(5, 15);
    p.dot_table_output_bits = *rc::gen::inRange<std::int64_t>(5, p.dot_table_address_bits + 1);
    p.index_bits = *rc::gen::inRange<std::int64_t>(3, p.dot_table_output_bits + 1);
    p.level_bits = *rc::gen::inRange<std::int64_t>(2, 9);
    p.specular_tables = *rc::gen::element<std::int64_t>(1, 3);
    Diagnostics diagnostics;
    p.check(normal_bits, "machine.toml", diagnostics);
    RC_PRE(diagnostics.empty());
    DeferredShader shader(p, normal_bits);
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const auto real = [&] { return static_cast<double>(random() % 2001) / 1000.0 - 1.0; };
    for (std::int64_t m = 0; m < p.materials; ++m)
      shader.set_material(
          std::size_t(m),
          {{std::abs(real()), 1, 0.5}, 0.2, std::abs(real()), std::abs(real()), p.exponents[random() % 14]});
    // The last light may be dark: nothing was ever loaded for it.
    for (std::int64_t l = 0; l < p.lights - (p.lights > 1 ? 1 : 0); ++l) {
      const Direction light = unit(real(), real(), 1.0 + real());
      shader.set_light(std::size_t(l), {light, halfway(light), {1, 0.5, 0.75}});
    }
    shader.set_background({1, 2, 3});
    shader.load();
    frame::FragmentLine in;
    in.resize(70);
    in.begin = random() % 20;
    in.end = 30 + random() % 41;
    for (std::size_t c = 0; c < 70; ++c) {
      const std::uint32_t mask = (1U << normal_bits) - 1;
      in.object[c] = random() % 4 == 0 ? 0 : 1;
      in.material[c] =
          static_cast<std::uint8_t>(in.object[c] == 0 ? 255 : random() % static_cast<std::uint32_t>(p.materials));
      in.normal_x[c] = static_cast<std::uint16_t>(random() % 8 == 0 ? 0 : random() & mask);
      in.normal_y[c] = static_cast<std::uint16_t>(random() % 8 == 0 ? 0 : random() & mask);
      in.normal_z[c] = static_cast<std::uint16_t>(random() % 4 == 0 ? 0 : random() & mask);
    }
    frame::RgbLine out;
    shader.shade_line(in, out);
    ShadingCounters counters;
    RC_ASSERT(out.columns() == 70U);
    for (std::size_t c = 0; c < 70; ++c) {
      Levels expected{1, 2, 3};
      if (c >= in.begin && c < in.end && in.object[c] != 0)
        expected = shader.shade_pixel(in.normal_x[c], in.normal_y[c], in.normal_z[c], in.material[c], counters);
      for (std::size_t i = 0; i < 3; ++i) RC_ASSERT(out.levels[3 * c + i] == expected[i]);
    }
    RC_ASSERT(counters == shader.counters());
  }));
}

// Sums reach 2051.5 where N meets L or H: an index that wrapped would be a black dot in a highlight.
TEST(DeferredShader, HighlightCentresAreBright) {
  for (const Arithmetic arithmetic : {Arithmetic::literal, Arithmetic::centred}) {
    ShadingParameters p;
    p.arithmetic = arithmetic;
    DeferredShader shader(p, 12);
    shader.set_material(0, {{1, 1, 1}, 0, 1, 0, 1});
    shader.set_material(1, {{1, 1, 1}, 0, 0, 1, 200});
    // The worst sum of three errors: bias, ROM, truncation, in units of 2^-11 (96 levels of 255 at E = 200
    // in an independent program).
    const int darkest_specular = arithmetic == Arithmetic::literal ? 130 : 180;
    ShadingCounters counters;
    int dimmest = 255;
    for (int i = 0; i < 60; ++i)
      for (int j = 1; j < 30; ++j) {
        const double azimuth = i * 0.1047, polar = j * 0.1047;
        const Direction light =
            unit(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
        shader.set_light(0, {light, light, {1, 1, 1}});
        shader.load();
        const auto n = words_of(light, 12);
        EXPECT_GE(shader.shade_pixel(n[0], n[1], n[2], 0, counters)[0], 252) << i << ' ' << j;
        dimmest = std::min<int>(dimmest, shader.shade_pixel(n[0], n[1], n[2], 1, counters)[0]);
      }
    EXPECT_GE(dimmest, darkest_specular);
    EXPECT_EQ(counters.short_normals, 0U);
  }
}

TEST(DeferredShader, OppositeLightAddsNothing) {
  DeferredShader shader(ShadingParameters(), 12);
  shader.set_material(0, {{1, 0.5, 0.25}, 0.1, 0.9, 0.9, 1});
  shader.set_light(0, {{0, 0, -1}, {0, 0, -1}, {1, 1, 1}});
  shader.load();
  ShadingCounters counters;
  EXPECT_EQ(shader.shade_pixel(300, 2048 + 40, 2000, 0, counters),
            (Levels{26, 13, 6}));  // round(25.5), round(12.75), round(6.375)
}

TEST(DeferredShader, SumsOfLightsSaturateOnce) {
  ShadingParameters p;
  p.lights = 3;
  DeferredShader shader(p, 12);
  shader.set_material(0, {{1, 0.5, 0.1}, 0.1, 0.5, 0, 1});
  for (std::size_t l = 0; l < 3; ++l) shader.set_light(l, {{0, 0, 1}, {0, 0, 1}, {1, 1, 1}});
  shader.load();
  ShadingCounters counters;
  const Levels levels = shader.shade_pixel(0, 0, 2047, 0, counters);
  EXPECT_EQ(levels[0], 255);           // 25.5 + 3 x 127.5
  EXPECT_NEAR(levels[1], 204.0, 2.0);  // half of it
  EXPECT_NEAR(levels[2], 40.8, 2.0);
  EXPECT_EQ(counters.saturated_pixels, 1U);
}

TEST(DeferredShader, AZeroNormalShowsAmbientOnly) {
  ShadingParameters p;
  p.index_bits = 3;  // coarse tables: their first entries are not 0
  DeferredShader shader(p, 12);
  shader.set_material(0, {{1, 1, 1}, 0.2, 1, 1, 1});
  shader.set_light(0, {{0, 0, 1}, {0, 0, 1}, {1, 1, 1}});
  shader.load();
  ShadingCounters counters;
  EXPECT_EQ(shader.shade_pixel(0, 2048, 0, 0, counters), (Levels{51, 51, 51}));
  EXPECT_EQ(counters.zero_normals, 1U);
}

TEST(DeferredShader, ThreeSpecularTablesColourTheHighlight) {
  ShadingParameters p;
  p.specular_tables = 3;
  DeferredShader shader(p, 12);
  shader.set_material(0, {{1, 1, 1}, 0, 0, 1, 1});
  shader.set_light(0, {{0, 0, 1}, {0, 0, 1}, {1, 0.5, 0}});
  shader.load();
  ShadingCounters counters;
  const Levels levels = shader.shade_pixel(0, 0, 2047, 0, counters);
  EXPECT_GE(levels[0], 253);
  EXPECT_NEAR(levels[1], 127.5, 2.0);
  EXPECT_EQ(levels[2], 0);
}

TEST(DeferredShader, RefusesWhatTheMachineDoesNotHaveAndWarnsOfProductsAboveOne) {
  DeferredShader shader(ShadingParameters(), 12);
  EXPECT_THROW(shader.set_material(0, {{1, 1, 1}, 0, 0, 1, 7}), InputError);
  EXPECT_THROW(shader.set_material(16, {}), InputError);
  EXPECT_THROW(shader.set_light(1, {}), InputError);
  shader.set_material(2, {{1, 0.5, 1}, 0.1, 0.8, 0.4, 20});
  shader.set_light(0, {{0, 0, 1}, {0, 0, 1}, {1, 1, 1}});
  EXPECT_TRUE(shader.warnings().empty());
  shader.set_light(0, {{0, 0, 1}, {0, 0, 1}, {1.5, 1.5, 1}});
  ASSERT_EQ(shader.warnings().size(), 1U);
  EXPECT_EQ(shader.warnings()[0],
            "material 3: Kd I colour (red, light 1) = 1.2 is above 1 and is clamped to full scale");
  frame::FragmentLine in;
  in.resize(4);
  in.extend(0, 4, 0xFFFFFF);
  in.object[2] = 1;
  in.material[2] = 16;
  frame::RgbLine out;
  EXPECT_THROW(shader.shade_line(in, out), ModelError);
}

TEST(DeferredShader, CountsMemoryBitsByTheirFormulas) {
  ShadingParameters p;
  p.lights = 2;
  std::uint64_t total = 0;
  for (const MemorySize& memory : DeferredShader(p, 12, 2).memories())
    total += memory.instances * memory.words * memory.bits_per_word;
  const std::uint64_t banked = 2 * (6 * 2048 * 11 + 4 * 16384 * 8 + 6) + 48 * 8 + 24;
  EXPECT_EQ(total, 16384U * 12 + 2 * banked + 2 * 14 * 1279);
  EXPECT_EQ(p.total_latency(), Cycles(10));
}

TEST(ShadingParameters, RefusesWidthsThatDoNotFitTogether) {
  const auto refused = [](auto change) {
    ShadingParameters p;
    change(p);
    Diagnostics diagnostics;
    p.check(12, "machine.toml", diagnostics);
    return diagnostics.list().size() == 1 ? diagnostics.list()[0].key : std::to_string(diagnostics.list().size());
  };
  EXPECT_EQ(refused([](ShadingParameters&) {}), "0");
  EXPECT_EQ(refused([](ShadingParameters& p) { p.normaliser_address_bits = 25; }), "shading.normaliser_address_bits");
  EXPECT_EQ(refused([](ShadingParameters& p) { p.dot_table_output_bits = 12; }), "shading.dot_table_output_bits");
  EXPECT_EQ(refused([](ShadingParameters& p) { p.index_bits = 12; }), "shading.index_bits");
  EXPECT_EQ(refused([](ShadingParameters& p) { p.specular_tables = 2; }), "shading.specular_tables");
  EXPECT_EQ(refused([](ShadingParameters& p) { p.exponents = {5, 7, 5}; }), "shading.exponents");
  EXPECT_EQ(refused([](ShadingParameters& p) { p.exponents.clear(); }), "shading.exponents");
}

}  // namespace
}  // namespace rastertlm::shading
