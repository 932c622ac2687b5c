// The exact side of a frame: its pieces, which of them is seen at a pixel, and what it gives there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "src/analysis/blame_step.h"
#include "src/reference/piece_light.h"
#include "src/reference/pieces.h"
#include "src/reference/renderer.h"

namespace rastertlm::analysis {

using Weights = std::array<double, 2>;  // of the second and third corner

// Of a point; those of a piece without area are a third each.
Weights weights_of(const reference::Piece& piece, double x, double y);

struct ExactPiece {
  reference::CutPiece cut;
  reference::Piece
      piece;  // as it is seen, clockwise; where the ideal picture does not see it, as the snapped corners do
  bool in_ideal = false;  // it sees it
};

// A triangle that covers a pixel, nearer where its depth is less; both depths in units of the machine's word.
struct Cover {
  std::uint32_t object = 0;
  double exact_depth = 0.0;
  double machine_depth = 0.0;
};

// Which triangle is seen at a pixel, by whose coverage and whose depth: 0 the background.
struct Seen {
  std::uint32_t machine = 0;
  std::uint32_t exact = 0;
  std::uint32_t exact_coverage = 0;  // and the machine's depth
  std::uint32_t exact_depth = 0;     // and the machine's coverage
  std::uint32_t object(StepSet made_exact) const;
  Step to_blame() const;
};
// `by_exact` covers it by its exact edges, `by_machine` by the machine's; in the order of their numbers.
Seen seen_by(std::uint32_t machine, std::uint32_t exact, std::span<const Cover> by_exact,
             std::span<const Cover> by_machine);

class ExactSide {
 public:
  ExactSide(const scene::Scene& scene, const scene::Pose& pose, const reference::RenderOptions& options);

  const std::vector<ExactPiece>& pieces() const { return pieces_; }  // seen by one or the other, in their order
  // The range of pieces() that are of that object.
  std::pair<std::size_t, std::size_t> indices_of(std::uint32_t object) const {
    return {first_of_object_[object], first_of_object_[object + 1]};
  }
  const geometry::FrameGrid& grid() const { return grid_; }
  const reference::PieceLight& light() const { return light_; }

  // The piece of that object to explain a pixel with: the first that covers it and is nearest, as the ideal picture has
  // it, else the one that it is least outside of. Null where the object has none.
  const ExactPiece* piece_of(std::uint32_t object, std::size_t column, std::size_t line) const;

  static bool covers(const ExactPiece& piece, std::size_t column, std::size_t line);
  // 0 near .. 1 far, also outside the piece.
  static double depth(const ExactPiece& piece, std::size_t column, std::size_t line);
  // The same weights as the ideal picture's where the piece covers the pixel.
  static Weights weights(const ExactPiece& piece, std::size_t column, std::size_t line);

 private:
  reference::RenderOptions options_;
  reference::PieceLight light_;
  geometry::FrameGrid grid_;
  std::vector<ExactPiece> pieces_;
  std::vector<std::size_t> first_of_object_;  // index into pieces_, by object; one more than there are objects
};

}  // namespace rastertlm::analysis
