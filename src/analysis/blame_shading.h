// The deferred shading processor's chain for one normal, each step as the machine does it or exactly.
//
// What a step takes and gives. A step that is the machine's gives words; one that is exact gives reals, of full
// precision. A machine's step that is given reals computes with them, and loses only what it loses itself: a table's
// address is cut to the table's size, a ROM's word is the ROM's. An exact step that is given words reads each as what
// it stands for: the centre of its interval where the arithmetic is centred (m + 1/2 of either sign), else the end that
// the floor left (m, or -(m + 1) for a complement), with sums in units of the light word of 1, 2^bits - 1.
//   coefficients       planes of the normal's components             -> words of word_bits, units of normal_unit()
//   pre-normalisation  cut together to normal_bits                    -> LinkNormal
//   normaliser         squares, ROM, products                         -> NormalisedNormal, dot_table_address_bits
//   dot product        tables, signs, terminate adder                 -> its sum, for N.L and N.H
//   diffuse table      index of index_bits, words of the table        -> levels
//   specular table     likewise
//   output rounding    ambient registers, sum, saturation, level      -> 0..255
// With no step exact the levels are DeferredShader::shade_pixel's, bit for bit; with all exact they are the ideal
// picture's, to the last bit (tests).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "modules/object_processor/prenormaliser.h"
#include "modules/set_up/word_format.h"
#include "modules/shading/deferred_shader.h"
#include "src/analysis/blame_step.h"
#include "src/geometry/lighting.h"

namespace rastertlm::analysis {

// Of a pixel: the same normal as the exact planes give it, any length, 1 the unit; and as the machine's words do.
struct PixelNormal {
  glm::dvec3 exact{0.0};
  std::array<std::uint32_t, 3> words{};  // of word_bits, two's complement
};

class ShadingChain {
 public:
  // All outlive it; `shader` has its tables loaded. `surfaces` by material, `lights` directional with specular
  // intensities as the tables have them, all of the machine's model (Blinn, viewer at infinity).
  ShadingChain(const shading::DeferredShader& shader, const object_processor::ObjectProcessorParameters& processor,
               std::span<const geometry::Reflectance> surfaces, std::span<const geometry::LightSource> lights,
               const glm::dvec3& ambient_light);

  // Levels 0..255; whole numbers unless output rounding is exact.
  glm::dvec3 levels(const PixelNormal& normal, std::uint32_t material, StepSet exact) const;

  static constexpr std::array<Step, 7> kChain{Step::coefficients,   Step::pre_normalisation, Step::normaliser,
                                              Step::dot_product,    Step::diffuse_table,     Step::specular_table,
                                              Step::output_rounding};

 private:
  // Between two steps: words where the step before is the machine's, else reals.
  struct Components {
    bool is_words = false;
    object_processor::LinkNormal link{};
    glm::dvec3 real{0.0};  // units of normal_unit
  };
  struct Direction {
    bool is_words = false;
    bool is_zero = false;
    shading::NormalisedNormal words;
    glm::dvec3 real{0.0};
  };
  struct Cosine {
    bool is_words = false;
    std::int32_t sum = 0;  // of the terminate adder
    double real = 0.0;
  };
  Components pre_normalised(const PixelNormal& normal, StepSet exact) const;
  Direction normalised(const Components& components, bool exact) const;
  Direction by_rom(const glm::dvec3& components) const;
  Cosine dot(const Direction& normal, const shading::DotTables& tables, const glm::dvec3& towards, bool exact) const;
  std::size_t index(const Cosine& cosine) const;
  double value(const Cosine& cosine) const;
  double word_value(std::uint32_t magnitude, bool negative) const;
  void add_light(const Direction& normal, std::size_t light, std::uint32_t material, StepSet exact,
                 glm::dvec3& sum) const;
  double displayed(double sum, StepSet exact) const;

  const shading::DeferredShader& shader_;
  object_processor::Prenormaliser prenormaliser_;
  std::span<const geometry::Reflectance> surfaces_;
  std::span<const geometry::LightSource> lights_;
  glm::dvec3 ambient_light_;
  unsigned word_bits_;
  double normal_unit_;
  double largest_component_;  // 2^(normal_bits - 1), of a pre-normalised one
  bool centred_;
  double unit_sum_;  // what the terminate adder has for 1
  double full_level_;
  std::vector<glm::dvec3> halfway_;  // by light
};

}  // namespace rastertlm::analysis
