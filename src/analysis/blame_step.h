// The steps between a scene and a level that can make a pixel wrong, by name, number and colour.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace rastertlm::analysis {

// In the order of the data, which is the order of ties: of steps with equal shares of a pixel's error, the first is
// blamed. The numbers are those of the channel `blame.step`.
enum class Step : std::uint8_t {
  none = 0,  // the pixel is right
  coverage = 1,
  depth_order = 2,
  coefficients = 3,
  pre_normalisation = 4,
  normaliser = 5,
  dot_product = 6,
  diffuse_table = 7,
  specular_table = 8,
  interpolation = 9,
  set_up_solver = 10,
  start_edge = 11,
  output_rounding = 12,
  other_words = 13,
};
inline constexpr std::size_t kSteps = 14;

struct StepTraits {
  Step step;
  std::string_view name;
  std::string_view meaning;
  std::array<std::uint8_t, 3> colour;  // of the picture, levels
};

inline constexpr std::array<StepTraits, kSteps> kStepTraits{{
    {Step::none, "right", "the level is the exact one, rounded", {0, 0, 0}},
    {Step::coverage,
     "coverage",
     "the edges' words, through snapped corners, take in the pixel or leave it out",
     {255, 255, 255}},
    {Step::depth_order, "depth order", "the depth words put another triangle in front", {150, 150, 150}},
    {Step::coefficients, "coefficient rounding", "snapped corners and rounded coefficients", {230, 159, 0}},
    {Step::pre_normalisation, "pre-normalisation", "a normal's components cut to short words", {0, 114, 178}},
    {Step::normaliser, "normaliser", "square, inverse root from a ROM, product", {86, 180, 233}},
    {Step::dot_product,
     "dot product",
     "partial products from tables, their sum without the missing ones",
     {213, 60, 0}},
    {Step::diffuse_table, "diffuse table", "its index and its words", {240, 228, 66}},
    {Step::specular_table, "specular table", "its index and its words", {204, 80, 167}},
    {Step::interpolation, "interpolation method", "colour between the points that are lit", {0, 158, 115}},
    {Step::set_up_solver,
     "set-up solver",
     "the form's coefficients from the colours, and the colours themselves",
     {120, 94, 240}},
    {Step::start_edge, "start edge", "stepping along an edge that is on no pixel", {254, 97, 0}},
    {Step::output_rounding, "output rounding", "ambient registers, the sum and its level", {70, 70, 70}},
    {Step::other_words,
     "other words",
     "the picture has words that are not this pose's: late, torn, without a processor",
     {255, 0, 0}},
}};

constexpr const StepTraits& traits_of(Step step) { return kStepTraits.at(static_cast<std::size_t>(step)); }

class StepSet {
 public:
  constexpr StepSet() = default;
  constexpr StepSet with(Step step) const { return StepSet(bits_ | bit(step)); }
  constexpr StepSet without(Step step) const { return StepSet(bits_ & ~bit(step)); }
  constexpr bool has(Step step) const { return (bits_ & bit(step)) != 0; }

 private:
  explicit constexpr StepSet(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Step step) { return std::uint32_t{1} << static_cast<unsigned>(step); }
  std::uint32_t bits_ = 0;
};

}  // namespace rastertlm::analysis
