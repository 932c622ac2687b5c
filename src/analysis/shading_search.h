// The worst errors of the shading processor's steps that random and adversarial normals and lights find, on the
// machine's own cores, against the same in double.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "modules/object_processor/parameters.h"
#include "modules/object_processor/prenormaliser.h"
#include "modules/shading/deferred_shader.h"
#include "src/analysis/measurement.h"

namespace rastertlm::analysis {

using NormalWords = std::array<std::int64_t, 3>;  // as EP1 shows them: signed integers of word_bits

// A quantity whose error is looked for: light of one kind at full scale, or a material with all three.
struct Quantity {
  std::string name;  // "diffuse", "exponent 50"
  double ambient = 0.0;
  double diffuse = 0.0;
  double specular = 0.0;
  std::int64_t exponent = 1;

  // Levels, not rounded, saturated at 255; cosines with the light and with the halfway vector.
  double exact(double towards, double halfway) const;
};

// A shading processor of these widths with a material a quantity, in the order given.
class ShadingBench {
 public:
  ShadingBench(const shading::ShadingParameters& parameters,
               const object_processor::ObjectProcessorParameters& object_processor, std::vector<Quantity> quantities);

  // `towards` of unit length; the viewer is at infinity.
  void set_light(const shading::Direction& towards);

  struct Pixel {
    NormalWords normal{};
    object_processor::LinkNormal link{};
    unsigned shift = 0;  // of the pre-normalisation unit
    std::uint32_t squares = 0;
    bool is_short = false;
    bool is_zero = false;
    double towards = 0.0;  // exact cosines; 0 of a zero normal
    double halfway = 0.0;
  };
  Pixel pixel(const NormalWords& normal) const;
  // Of the quantity, a grey level 0..255.
  int level(const Pixel& pixel, std::size_t quantity) const;
  double exact_level(const Pixel& pixel, std::size_t quantity) const;

  const std::vector<Quantity>& quantities() const { return quantities_; }
  const shading::DeferredShader& shader() const { return shader_; }
  shading::DeferredShader& shader() { return shader_; }
  const shading::LightArguments& light() const { return light_; }
  unsigned word_bits() const { return word_bits_; }
  unsigned normal_bits() const { return normal_bits_; }

 private:
  unsigned word_bits_;
  unsigned normal_bits_;
  object_processor::Prenormaliser prenormaliser_;
  std::vector<Quantity> quantities_;
  shading::DeferredShader shader_;
  shading::LightArguments light_;
};

// Largest absolute errors.
struct ShadingSeen {
  std::uint64_t normals = 0;
  double normal_word = 0.0;     // the link's last place
  double direction = 0.0;       // the sine of the angle that the normal word turns by
  double inverse_root = 0.0;    // a part of it
  double component = 0.0;       // its last place
  double light_word = 0.0;      // its last place
  double sum = 0.0;             // of a dot product, 2^-dot_table_output_bits
  double normal_diffuse = 0.0;  // levels of diffuse light, by the normal word alone
  std::vector<double> levels;   // a quantity
  std::uint64_t pixels = 0;     // normals times quantities, and what the adversarial search tried
};

// `lights` random lights with `normals` random normals each, then a search that moves the worst of each quantity
// further. No normal is short.
ShadingSeen search_shading(ShadingBench& bench, Numbers& numbers, std::int64_t lights, std::int64_t normals);

}  // namespace rastertlm::analysis
