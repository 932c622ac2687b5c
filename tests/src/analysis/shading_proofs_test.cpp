// Are the errors of the shading processor's tables those of a direct formula, at any width?
#include "src/analysis/shading_proofs.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace rastertlm::analysis {
namespace {

using shading::Arithmetic;
using shading::ShadingParameters;

// Tables alone at 1,024 entries of 8 bits, as an independent program has them (tables by direct formula): at most 1.50
// levels, literal, and 0.50 and 0.99, centred, with Ks of 1 and 0.4.
TEST(ShadingProofs, SpecularTablesAloneAreThoseOfTheSpecification) {
  ShadingParameters literal, centred;
  literal.arithmetic = Arithmetic::literal;
  double worst = 0.0;
  for (const std::int64_t exponent : literal.exponents) {
    EXPECT_NEAR(specular_table_error(literal, exponent, 1.0), 1.50, 0.02) << exponent;
    EXPECT_NEAR(specular_table_error(centred, exponent, 1.0), 0.50, 0.01) << exponent;
    worst = std::max(worst, specular_table_error(centred, exponent, 0.4));
  }
  EXPECT_NEAR(worst, 0.99, 0.01);
}

ShadingParameters random_widths() {
  ShadingParameters p;
  p.arithmetic = *rc::gen::element(Arithmetic::literal, Arithmetic::centred);
  p.dot_table_address_bits = *rc::gen::inRange<std::int64_t>(4, 12);
  p.dot_table_output_bits = *rc::gen::inRange<std::int64_t>(4, p.dot_table_address_bits + 1);
  p.index_bits = *rc::gen::inRange<std::int64_t>(3, p.dot_table_output_bits + 1);
  p.level_bits = *rc::gen::inRange<std::int64_t>(2, 9);
  p.diffuse_fraction_bits = *rc::gen::inRange<std::int64_t>(0, 5);
  return p;
}

// The closed forms bound what every input gives, and what every input gives bounds what the steps of a loader give.
TEST(ShadingProofs, LieBetweenStepsAndClosedForms) {
  EXPECT_TRUE(rc::check([] {
    const ShadingParameters p = random_widths();
    const bool centred = p.arithmetic == Arithmetic::centred;
    const auto exponent = *rc::gen::inRange<std::int64_t>(1, 1001);
    Numbers numbers(*rc::gen::arbitrary<std::uint64_t>());
    const double level = 255.0 / (std::ldexp(1.0, int(p.level_bits)) - 1);
    const double constant = centred ? std::ldexp(0.5, -int(p.diffuse_fraction_bits)) : 0.5;
    const auto check = [](const Proof& proof, const Proof& seen, double closed) {
      RC_ASSERT(proof.inputs > 0U);
      RC_ASSERT(proof.worst <= closed + 1e-9);
      RC_ASSERT(seen.worst <= proof.worst);
      RC_ASSERT(seen.worst > 0.0);
    };
    check(prove_product_tables(p), sample_product_tables(p, numbers, 4), centred ? 0.5 : 1.0);
    check(prove_diffuse_tables(p), sample_diffuse_tables(p, numbers, 4), level * ((centred ? 0.5 : 1.0) + constant));
    check(prove_specular_tables(p, exponent), sample_specular_tables(p, exponent, numbers, 4),
          level * (centred ? 1.5 : 3.0));
    RC_ASSERT(prove_terminate_adder(p).worst == 0.0);
    // A single Ks is among all of them.
    RC_ASSERT(specular_table_error(p, exponent, *rc::gen::inRange(0, 1001) / 1000.0) <=
              prove_specular_tables(p, exponent).worst + 1e-9);
  }));
}

TEST(ShadingProofs, NormalWordsAreTheCentresOfTheirIntervals) {
  for (const std::int64_t normal_bits : {4, 9, 12}) {
    object_processor::ObjectProcessorParameters p;
    p.word_bits = 16;
    p.normal_bits = normal_bits;
    const Proof proof = prove_normal_words(p);
    EXPECT_EQ(proof.worst, 0.5) << normal_bits;
    // Words of every shift: twice as many each time.
    EXPECT_EQ(proof.inputs, (std::uint64_t{2} << 16) - (std::uint64_t{1} << normal_bits));
  }
}

TEST(ShadingProofs, SayThatThereAreTooManyInputs) {
  ShadingParameters p;
  p.dot_table_address_bits = p.dot_table_output_bits = 14;
  EXPECT_EQ(prove_product_tables(p).inputs, 0U);
  EXPECT_EQ(prove_product_tables(p).worst, 0.5);
  object_processor::ObjectProcessorParameters wide;
  wide.word_bits = 28;
  EXPECT_EQ(prove_normal_words(wide).inputs, 0U);
}

}  // namespace
}  // namespace rastertlm::analysis
