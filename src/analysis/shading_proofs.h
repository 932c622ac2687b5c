// The worst errors of single steps of the shading processor, by running the machine's own core on every input where
// there are at most 2^24 of them.
#pragma once

#include <cstdint>

#include "modules/object_processor/parameters.h"
#include "modules/shading/parameters.h"
#include "src/analysis/measurement.h"

namespace rastertlm::analysis {

inline constexpr std::uint64_t kExhaustive = std::uint64_t{1} << 24;

// The core's own tables are what is looked at: the closed form, which knows nothing of them, says whether they are
// right.
struct Proof {
  double worst = 0.0;
  std::uint64_t inputs = 0;  // that the core ran on; 0: too many, `worst` is the closed form of the same header
  double closed_form = 0.0;
  bool holds() const { return worst <= closed_form + 1e-9; }  // of doubles, each rounded
};

// A component of a normal's word against the centre of its link word's interval, in the link's last place: every shift,
// and every word that may have it. Closed form: 1/2.
Proof prove_normal_words(const object_processor::ObjectProcessorParameters& parameters);

// Indices that are not the sum's, saturated at both ends: every sum of three partial products. Closed form: 0.
Proof prove_terminate_adder(const shading::ShadingParameters& parameters);

// Tables: `prove` runs the fast form of the loaders on every constant that a table may be filled with, `sample` their
// steps, register by register, on `tables` constants at random.
//
// A partial product against n times the light's word, in the product's last place. Closed form: centred 1/2, literal 1.
Proof prove_product_tables(const shading::ShadingParameters& parameters);
Proof sample_product_tables(const shading::ShadingParameters& parameters, Numbers& numbers, std::int64_t tables);

// A level of a diffuse table against k (i + 1/2) / entries (literal: k i / entries), each constant standing for every k
// that is coded so. Levels of 0..255. Closed form: 1/2 for the floor (literal 1), half of the constant's last place.
Proof prove_diffuse_tables(const shading::ShadingParameters& parameters);
Proof sample_diffuse_tables(const shading::ShadingParameters& parameters, Numbers& numbers, std::int64_t tables);

// A level of a specular table against Ks x^E at the centre of the index's interval (literal: i / (entries - 1)), each
// constant standing for every Ks that is coded so. Levels of 0..255. Closed form: 3/2 for three roundings of a half;
// literal 3: half a level of the power, half of the code of Ks, the floor, and less than one because a code of
// 2^level_bits - 1 stands for 1 and multiplies by less.
Proof prove_specular_tables(const shading::ShadingParameters& parameters, std::int64_t exponent);
Proof sample_specular_tables(const shading::ShadingParameters& parameters, std::int64_t exponent, Numbers& numbers,
                             std::int64_t tables);
// The same of one Ks as it is.
double specular_table_error(const shading::ShadingParameters& parameters, std::int64_t exponent, double specular);

}  // namespace rastertlm::analysis
