// Does every certificate hold, is a broken one noticed, and are the fewest bits the fewest?
#include "src/analysis/certificates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "src/analysis/certificate_steps.h"

namespace rastertlm::analysis {
namespace {

const report::Certificate& step_of(const report::Certificates& all, const std::string& step) {
  const auto found = std::find_if(all.steps.begin(), all.steps.end(), [&](const auto& c) { return c.step == step; });
  if (found == all.steps.end()) throw std::out_of_range(step);
  return *found;
}

report::Certificates shading_of(const imogene::Machine& machine, std::int64_t tries = 1000) {
  report::Certificates all;
  CertifyOptions options;
  options.tries = tries;
  certify_shading(machine, options, all);
  return all;
}

TEST(Certificates, HoldForBothArithmetics) {
  for (const shading::Arithmetic arithmetic : {shading::Arithmetic::centred, shading::Arithmetic::literal}) {
    imogene::Machine machine;
    machine.shading.arithmetic = arithmetic;
    for (const report::Certificate& c : shading_of(machine).steps) EXPECT_TRUE(c.holds()) << c.step;
  }
}

// By roots of any format, and words with more and fewer fraction bits than a root needs; a root of fewer stages is
// seen.
TEST(Certificates, OfSolidsHold) {
  for (const std::int64_t fraction : {4, 12, 16})
    for (const auto reading : {object_processor::RootReading::floor, object_processor::RootReading::half_unit}) {
      imogene::Machine machine;
      machine.quadric.per_unit = 1;
      machine.quadric.fraction_bits = fraction;
      machine.quadric.root_reading = reading;
      report::Certificates all;
      certify_solids(machine, {}, all);
      ASSERT_EQ(all.steps.size(), 3U);
      for (const report::Certificate& c : all.steps) {
        EXPECT_TRUE(c.holds()) << c.step << ": " << c.seen << " of " << c.proved;
        EXPECT_GT(c.seen, 0.9 * c.proved) << c.step;
      }
    }
  report::Certificates none;
  certify_solids(imogene::Machine(), {}, none);
  EXPECT_TRUE(none.steps.empty());
}

// 004, 5.3.3, gives 12 bits to the normal because sqrt(3) delta N is then below a level of 8 bits: it is, with 10 too.
TEST(Certificates, HaveThePapersBoundOfDiffuseLight) {
  imogene::Machine machine;
  const report::Certificate paper = step_of(shading_of(machine), "diffuse light by the normal's word alone");
  EXPECT_NEAR(paper.proved, 255 * std::sqrt(3.0) * 0.5 / 1024, 0.001);
  EXPECT_GT(paper.seen, 0.6 * paper.proved);
  machine.object_processor.normal_bits = 10;
  EXPECT_NEAR(step_of(shading_of(machine), paper.step).proved, 4 * paper.proved, 0.01);
}

TEST(Certificates, KnowWhatIsNotProved) {
  run::Inputs::Content content;
  imogene::Machine machine;
  machine.object_processor.carry_clock = object_processor::CarryClock::clock2;
  report::Certificates all;
  CertifyOptions options;
  options.tries = 500;
  content.machine = machine;
  certify_planes(content, options, all);
  EXPECT_EQ(step_of(all, "EP1, wrong words").proved, std::numeric_limits<double>::infinity());
  EXPECT_GT(step_of(all, "EP1, wrong words").seen, 0.0);
}

TEST(Certificates, FewestBitsAreTheFewestThatTheProofAllows) {
  imogene::Machine machine;
  report::Certificates all;
  CertifyOptions options;
  options.wanted_levels = 2.0;
  options.exponents = {20};
  certify_widths(machine, options, all);
  ASSERT_EQ(all.guard_bits.size(), 6U);
  const report::GuardBits& index = all.guard_bits.back();
  EXPECT_EQ(index.parameter, "shading.index_bits");
  EXPECT_EQ(all.quantities, (std::vector<std::string>{"diffuse", "exponent 20"}));
  for (const report::GuardBits& row : all.guard_bits)
    for (const report::GuardBits::Share& share : row.shares) {
      ASSERT_TRUE(share.least.has_value()) << row.parameter;
      // As many bits as the machine has are enough just where its own proof says so.
      EXPECT_EQ(*share.least <= row.bits, share.proved <= 2.0) << row.parameter;
    }
  // One bit less does not do.
  machine.shading.index_bits = *index.shares[1].least - 1;
  report::Certificates fewer;
  certify_widths(machine, options, fewer);
  EXPECT_GT(fewer.guard_bits.back().shares[1].proved, 2.0);
}

TEST(Certificates, FractionBitsAreThoseOfTheRule) {
  quadratic::Machine machine;
  CertifyOptions options;
  options.tries = 100;
  options.wanted_levels = 0.5;
  report::Certificates all;
  certify_spans(machine, options, all);
  EXPECT_EQ(all.guard_bits.at(0).shares.at(0).least, 22);  // 2 log2(M) at M = 2,048
  EXPECT_NEAR(all.guard_bits.at(0).shares.at(0).proved, 1.0005, 0.0001);
  EXPECT_NEAR(step_of(all, "constants and forward differences").seen, 1.0, 0.05);  // attained
}

TEST(Certificates, TellABrokenOne) {
  report::Certificates all;
  all.machine = "some.toml";
  all.platform = "imogene";
  all.steps.push_back({"a step", "a.key", "input", report::ProofKind::interval, "here", "levels", 1.0, 0.5, 10});
  EXPECT_TRUE(all.hold());
  all.steps.push_back({"unproved", "a.key", "input", report::ProofKind::formula, "here", "levels",
                       std::numeric_limits<double>::infinity(), 5.0, 10});
  EXPECT_TRUE(all.hold());
  all.steps.push_back({"another", "a.key", "input", report::ProofKind::exhaustive, "here", "levels", 1.0, 1.5, 10});
  EXPECT_FALSE(all.hold());
  EXPECT_NE(report::certificates_text(all).find("BROKEN"), std::string::npos);
  const std::string json = report::certificates_json({all});
  EXPECT_NE(json.find("\"holds\": false,\n    \"steps\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"proved\": null"), std::string::npos);
  EXPECT_NE(json.find("\"proof\": \"interval\""), std::string::npos);
}

}  // namespace
}  // namespace rastertlm::analysis
