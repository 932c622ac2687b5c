#include "src/analysis/blame_exact.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "src/reference/coverage.h"

namespace rastertlm::analysis {
namespace {

reference::Coverage<double> coverage_of(const reference::Piece& piece) {
  std::array<reference::Point<double>, 3> points;
  for (std::size_t i = 0; i < 3; ++i) points[i] = {piece.corners[i].x, piece.corners[i].y};
  return {points, 1.0};
}

bool near_box(const reference::Piece& piece, double x, double y) {
  const auto& [a, b, c] = piece.corners;
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  return x >= left - 1.0 && x <= right + 1.0 && y >= top - 1.0 && y <= bottom + 1.0;
}

std::uint32_t nearest(std::span<const Cover> covers, double Cover::*depth) {
  const auto found = std::min_element(covers.begin(), covers.end(),
                                      [&](const Cover& a, const Cover& b) { return a.*depth < b.*depth; });
  return found == covers.end() ? 0 : found->object;
}

}  // namespace

std::uint32_t Seen::object(StepSet made_exact) const {
  if (made_exact.has(Step::coverage)) return made_exact.has(Step::depth_order) ? exact : exact_coverage;
  return made_exact.has(Step::depth_order) ? exact_depth : machine;
}

Step Seen::to_blame() const {
  if (machine == exact) return Step::none;
  if (exact_coverage == exact) return Step::coverage;
  return exact_depth == exact ? Step::depth_order : Step::coverage;
}

Seen seen_by(std::uint32_t machine, std::uint32_t exact, std::span<const Cover> by_exact,
             std::span<const Cover> by_machine) {
  return {machine, exact, nearest(by_exact, &Cover::machine_depth), nearest(by_machine, &Cover::exact_depth)};
}

Weights weights_of(const reference::Piece& piece, double x, double y) {
  const auto& [a, b, c] = piece.corners;
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  constexpr double kThird = 1.0 / 3.0;
  if (area == 0.0) return {kThird, kThird};
  return {((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area,
          ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area};
}

ExactSide::ExactSide(const scene::Scene& scene, const scene::Pose& pose, const reference::RenderOptions& options)
    : options_(options), light_(scene, pose, options) {
  const reference::CutPieces cut = reference::cut_pieces(scene, pose, options);
  grid_ = cut.grid;
  first_of_object_.assign(scene.object_count() + 2, 0);
  for (const reference::CutPiece& one : cut.list) {
    const std::optional<reference::Piece> ideal = reference::as_seen(one, false);
    const std::optional<reference::Piece> snapped = reference::as_seen(one, true);
    if (!ideal && !snapped) continue;
    pieces_.push_back({one, ideal ? *ideal : *snapped, ideal.has_value()});
    ++first_of_object_.at(one.piece.object + 1);
  }
  for (std::size_t object = 1; object < first_of_object_.size(); ++object)
    first_of_object_[object] += first_of_object_[object - 1];
}

bool ExactSide::covers(const ExactPiece& piece, std::size_t column, std::size_t line) {
  if (!piece.in_ideal || !near_box(piece.piece, static_cast<double>(column), static_cast<double>(line))) return false;
  const auto x = static_cast<std::int64_t>(column);
  const reference::Span span = coverage_of(piece.piece).span(static_cast<std::int64_t>(line), column + 1);
  return x >= span.begin && x < span.end;
}

Weights ExactSide::weights(const ExactPiece& piece, std::size_t column, std::size_t line) {
  if (piece.in_ideal)
    return coverage_of(piece.piece).weights(static_cast<std::int64_t>(column), static_cast<std::int64_t>(line));
  return weights_of(piece.piece, static_cast<double>(column), static_cast<double>(line));
}

double ExactSide::depth(const ExactPiece& piece, std::size_t column, std::size_t line) {
  const Weights w = weights(piece, column, line);
  const auto& [a, b, c] = piece.piece.corners;
  return std::clamp(a.z + w[0] * (b.z - a.z) + w[1] * (c.z - a.z), 0.0, 1.0);
}

const ExactPiece* ExactSide::piece_of(std::uint32_t object, std::size_t column, std::size_t line) const {
  const auto [begin, end] = indices_of(object);
  if (end - begin == 1) return &pieces_[begin];
  const ExactPiece* best = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = begin; i < end; ++i) {
    if (!covers(pieces_[i], column, line)) continue;
    const double here = depth(pieces_[i], column, line);
    if (best != nullptr && !(here < nearest)) continue;
    best = &pieces_[i];
    nearest = here;
  }
  double least = -std::numeric_limits<double>::infinity();
  for (std::size_t i = begin; i < end && nearest > 1.0; ++i) {
    const Weights w = weights(pieces_[i], column, line);
    const double inside = std::min({w[0], w[1], 1.0 - w[0] - w[1]});
    if (best != nullptr && !(inside > least)) continue;
    best = &pieces_[i];
    least = inside;
  }
  return best;
}

}  // namespace rastertlm::analysis
