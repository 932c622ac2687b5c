// Do the shading cases see a step that is broken on purpose?
#include <gtest/gtest.h>

#include <algorithm>
#include <variant>

#include "src/analysis/stability.h"

namespace rastertlm::analysis {
namespace {

std::optional<Finding> examined(const std::string& name, const run::Inputs::Content& machine,
                                const Tampering& tampering = {}) {
  const HardCase one = read_hard_case(std::string(RASTERTLM_SOURCE_DIR) + "/configs/hard_cases/" + name + ".toml");
  return examine(one, machine, 3, 1000, tampering);
}

run::Inputs::Content object_machine() {
  run::Inputs::Content content;
  content.machine = imogene::Machine{};
  return content;
}

run::Inputs::Content span_machine() {
  run::Inputs::Content content;
  content.machine = quadratic::Machine{};
  return content;
}

const std::vector<std::string> kShading{"exponents",        "light_grazing", "light_straight_on", "normals_full_scale",
                                        "normals_opposing", "normals_short", "normals_unit",      "normals_zero"};

TEST(ShadingCases, HoldForBothArithmeticsAndOtherWidths) {
  run::Inputs::Content content = object_machine();
  auto& machine = std::get<imogene::Machine>(content.machine);
  for (const shading::Arithmetic arithmetic : {shading::Arithmetic::literal, shading::Arithmetic::centred})
    for (const std::int64_t normal_bits : {9, 12, 14}) {
      machine.shading.arithmetic = arithmetic;
      machine.object_processor.normal_bits = normal_bits;
      machine.shading.normaliser_address_bits = 12;
      machine.shading.level_bits = normal_bits == 14 ? 5 : 8;
      for (const std::string& name : kShading) {
        const auto finding = examined(name, content);
        ASSERT_TRUE(finding.has_value()) << name;
        for (const Measurement& m : finding->measurements)
          EXPECT_TRUE(m.holds()) << name << ", " << m.what << ": " << m.measured << " of " << m.bound;
      }
    }
}

TEST(ShadingCases, AreOfTheMachinesThatHaveTheStep) {
  for (const std::string& name : kShading) EXPECT_FALSE(examined(name, span_machine()).has_value()) << name;
  EXPECT_FALSE(examined("exponents_lighting", object_machine()).has_value());
  EXPECT_TRUE(examined("exponents_lighting", span_machine())->holds());
}

// An entry of a table too bright or too dark; a sign or a bit of the link's word lost.
TEST(ShadingCases, SeeATableOrALinkWordThatIsWrong) {
  Tampering dark_middle, bright_end, lost_sign, lost_bit;
  dark_middle.shading_tables = [](shading::TableBank& bank) {
    for (auto& levels : bank.material_tables[0].specular)
      for (std::size_t i = 1023; i < levels.size(); i += 1024) levels[i] = 0;
  };
  bright_end.shading_tables = [](shading::TableBank& bank) {
    for (std::size_t i = 0; i < bank.material_tables[0].diffuse[0].size(); i += 1024)
      bank.material_tables[0].diffuse[0][i] = 255;
  };
  lost_sign.link_normal = [](object_processor::LinkNormal& normal) {
    for (std::uint16_t& word : normal) word &= 0x7FF;
  };
  lost_bit.link_normal = [](object_processor::LinkNormal& normal) { normal[2] ^= 0x100; };
  const auto breaks = [](const char* name, const Tampering& tampering) {
    return !examined(name, object_machine(), tampering)->holds();
  };
  EXPECT_TRUE(breaks("light_straight_on", dark_middle));
  EXPECT_TRUE(breaks("exponents", dark_middle));
  EXPECT_TRUE(breaks("light_grazing", bright_end));
  EXPECT_TRUE(breaks("normals_full_scale", lost_sign));
  EXPECT_TRUE(breaks("normals_short", lost_sign));
  EXPECT_TRUE(breaks("exponents", lost_bit));
  EXPECT_TRUE(breaks("normals_unit", lost_bit));
  EXPECT_TRUE(breaks("normals_zero", lost_bit));
}

TEST(ShadingCases, SeePlanesOfNormalsThatAreOff) {
  Tampering off;
  off.object_words = [](object_processor::TriangleWords& words) { words.normals[0].c += 100'000; };
  EXPECT_FALSE(examined("normals_opposing", object_machine(), off)->holds());
  off.object_words = [](object_processor::TriangleWords& words) {
    for (auto& plane : words.normals) plane = {0, 0, 0};  // vanishes where it should not
  };
  const auto finding = examined("normals_opposing", object_machine(), off);
  EXPECT_FALSE(finding->holds());
  EXPECT_EQ(finding->step, "object_processor.word_bits");
}

TEST(ShadingCases, SeeLightOfAnotherNormal) {
  Tampering off;
  off.lit_point = [](set_up::LitPoint& point) { point.normal.x += 1e-12; };
  EXPECT_FALSE(examined("exponents_lighting", span_machine(), off)->holds());
}

}  // namespace
}  // namespace rastertlm::analysis
