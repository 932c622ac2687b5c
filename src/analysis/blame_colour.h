// The colour of a pixel of a triangle that a span unit draws, each step as the machine does it or exactly.
//
// The machine's value and the exact one are the ends of a row of values; the difference of two neighbours is a step's
// error, and a step that is exact takes its own away. From the machine's end:
//   the registers' value          as stepped, words rounded to fraction_bits
//     coefficient rounding        (its second part)
//   the same with wide words      the start edge's policy without rounding
//     start edge
//   the form                      as the set-up processor solved it, at the pixel
//     set-up solver               its number format, knots that are clamped, triangles drawn flat
//   the interpolation             through colours that are lit exactly, on the snapped corners
//     coefficient rounding        (its first part: corners that are snapped)
//   the interpolation             the same on corners that are not
//     interpolation method
//   the light                     at the pixel
// Where a pixel unit lights the triangle there are no registers: the light on the snapped corners stands between, and
// what the unit's method makes of it is the interpolation's.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "modules/set_up/span_load.h"
#include "src/analysis/blame_exact.h"
#include "src/analysis/blame_step.h"

namespace rastertlm::analysis {

// A triangle as it was handed to the span unit, placed in the piece that it is of.
class ColourPart {
 public:
  // `linear`: the machine interpolates between corners alone. `piece` outlives it.
  ColourPart(const set_up::ColourTriangle& triangle, const ExactPiece& piece, int piece_bits,
             const reference::PieceLight& light, bool linear);

  const set_up::ColourTriangle& triangle() const { return triangle_; }
  bool covers(std::size_t column, std::size_t line) const;
  // Of the pixel in the snapped triangle; the least of them, negative outside.
  double least_weight(std::size_t column, std::size_t line) const;
  // In units of the depth word.
  double depth(std::size_t column, std::size_t line) const;

  // What the registers and those with wide words hold; nothing where the pixel is not the triangle's own: beyond its
  // edges its form goes on.
  struct Registers {
    glm::dvec3 value{0.0};
    glm::dvec3 wide{0.0};
  };
  // The row of values at a pixel, from the machine's end; levels, neither rounded nor clamped but for the light.
  struct Row {
    glm::dvec3 stepped{0.0};
    glm::dvec3 wide{0.0};
    glm::dvec3 form{0.0};
    glm::dvec3 on_snapped{0.0};
    glm::dvec3 interpolated{0.0};
    glm::dvec3 light{0.0};
    glm::dvec3 value(StepSet exact) const;
  };
  // `light`: at the pixel, as the ideal picture has it.
  Row row(std::size_t column, std::size_t line, const Registers* registers, const glm::dvec3& light) const;

 private:
  Weights in_part(const Weights& in_piece) const;
  glm::dvec3 interpolated(const Weights& weights) const;
  glm::dvec3 form_at(double x, double y) const;
  void light_knots(const reference::PieceLight& light);

  set_up::ColourTriangle triangle_;
  const ExactPiece* piece_;
  const reference::PieceLight* light_;
  bool linear_;
  reference::Piece snapped_piece_;  // the piece with its corners on the grid
  reference::Piece snapped_part_;   // likewise of the triangle
  std::array<Weights, 3> corners_{};
  std::array<glm::dvec3, 6> knots_{};  // corners, middles of 1-2, 1-3, 2-3
};

}  // namespace rastertlm::analysis
