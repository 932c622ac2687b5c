#include "src/analysis/blame_colour.h"

#include <algorithm>
#include <cmath>

#include "src/reference/coverage.h"

namespace rastertlm::analysis {
namespace {

reference::Piece on_grid(const std::array<geometry::SnappedPoint, 3>& corners, int fraction_bits) {
  const double unit = std::ldexp(1.0, -fraction_bits);
  reference::Piece piece;
  for (std::size_t i = 0; i < 3; ++i) {
    piece.corners[i].x = static_cast<double>(corners[i].x) * unit;
    piece.corners[i].y = static_cast<double>(corners[i].y) * unit;
  }
  return piece;
}

Weights between(const Weights& a, const Weights& b) { return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; }

}  // namespace

ColourPart::ColourPart(const set_up::ColourTriangle& triangle, const ExactPiece& piece, int piece_bits,
                       const reference::PieceLight& light, bool linear)
    : triangle_(triangle),
      piece_(&piece),
      light_(&light),
      linear_(linear),
      snapped_piece_(on_grid(piece.piece.snapped, piece_bits)),
      snapped_part_(on_grid(triangle.corners, triangle.fraction_bits)) {
  for (std::size_t i = 0; i < 3; ++i)
    corners_[i] = weights_of(snapped_piece_, snapped_part_.corners[i].x, snapped_part_.corners[i].y);
  light_knots(light);
}

void ColourPart::light_knots(const reference::PieceLight& light) {
  const std::array<Weights, 6> at{corners_[0],
                                  corners_[1],
                                  corners_[2],
                                  between(corners_[0], corners_[1]),
                                  between(corners_[0], corners_[2]),
                                  between(corners_[1], corners_[2])};
  const std::size_t count = triangle_.shading != nullptr ? 0 : (linear_ ? 3 : at.size());
  for (std::size_t i = 0; i < count; ++i) knots_[i] = light.levels(piece_->piece, at[i]);
}

bool ColourPart::covers(std::size_t column, std::size_t line) const {
  std::array<geometry::SnappedPoint, 3> p = triangle_.corners;
  if (geometry::doubled_area(p[0], p[1], p[2]) < 0) std::swap(p[1], p[2]);
  const std::int64_t step = std::int64_t{1} << triangle_.fraction_bits;
  const std::int64_t x = static_cast<std::int64_t>(column) * step;
  const std::int64_t y = static_cast<std::int64_t>(line) * step;
  for (std::size_t i = 0; i < 3; ++i) {
    const geometry::SnappedPoint &from = p[i], &to = p[(i + 1) % 3];
    if (!reference::Side<std::int64_t>({from.x, from.y}, {to.x, to.y}).covers(x, y)) return false;
  }
  return true;
}

double ColourPart::least_weight(std::size_t column, std::size_t line) const {
  const Weights w = weights_of(snapped_part_, static_cast<double>(column), static_cast<double>(line));
  return std::min({w[0], w[1], 1.0 - w[0] - w[1]});
}

double ColourPart::depth(std::size_t column, std::size_t line) const {
  const Weights w = weights_of(snapped_part_, static_cast<double>(column), static_cast<double>(line));
  const auto& z = triangle_.depth;
  return z[0] + w[0] * (z[1] - z[0]) + w[1] * (z[2] - z[0]);
}

// From weights in the piece to weights in its part: both are linear on the surface.
Weights ColourPart::in_part(const Weights& in_piece) const {
  const Weights e1{corners_[1][0] - corners_[0][0], corners_[1][1] - corners_[0][1]};
  const Weights e2{corners_[2][0] - corners_[0][0], corners_[2][1] - corners_[0][1]};
  const Weights d{in_piece[0] - corners_[0][0], in_piece[1] - corners_[0][1]};
  const double area = e1[0] * e2[1] - e2[0] * e1[1];
  if (area == 0.0) return {0.0, 0.0};
  return {(d[0] * e2[1] - e2[0] * d[1]) / area, (e1[0] * d[1] - d[0] * e1[1]) / area};
}

// The quadratic through six colours, or the plane through three, by its values at the knots (Lagrange): no coefficient
// is solved for.
glm::dvec3 ColourPart::interpolated(const Weights& weights) const {
  const double w2 = weights[0], w3 = weights[1], w1 = 1.0 - w2 - w3;
  if (linear_) return w1 * knots_[0] + w2 * knots_[1] + w3 * knots_[2];
  return w1 * (2.0 * w1 - 1.0) * knots_[0] + w2 * (2.0 * w2 - 1.0) * knots_[1] + w3 * (2.0 * w3 - 1.0) * knots_[2] +
         4.0 * w1 * w2 * knots_[3] + 4.0 * w1 * w3 * knots_[4] + 4.0 * w2 * w3 * knots_[5];
}

glm::dvec3 ColourPart::form_at(double x, double y) const {
  const double dx = x - snapped_part_.corners[0].x, dy = y - snapped_part_.corners[0].y;
  return {triangle_.colour[0].at(dx, dy), triangle_.colour[1].at(dx, dy), triangle_.colour[2].at(dx, dy)};
}

ColourPart::Row ColourPart::row(std::size_t column, std::size_t line, const Registers* registers,
                                const glm::dvec3& light) const {
  const auto x = static_cast<double>(column), y = static_cast<double>(line);
  const Weights on_grid = weights_of(snapped_piece_, x, y);
  Row row;
  row.light = light;
  if (triangle_.shading != nullptr) {
    // Snapping moves the light, and the unit's method is what is between that and what it gives.
    const glm::dvec3 moved = light_->levels(piece_->piece, on_grid) - light;
    const glm::dvec3 given = registers != nullptr ? registers->value : light + moved;
    row.stepped = row.wide = row.form = row.on_snapped = given;
    row.interpolated = given - moved;
    return row;
  }
  row.form = form_at(x, y);
  row.wide = registers != nullptr ? registers->wide : row.form;
  row.stepped = registers != nullptr ? registers->value : row.form;
  row.on_snapped = interpolated(in_part(on_grid));
  row.interpolated = interpolated(in_part(ExactSide::weights(*piece_, column, line)));
  return row;
}

glm::dvec3 ColourPart::Row::value(StepSet exact) const {
  const bool coefficients = exact.has(Step::coefficients), start_edge = exact.has(Step::start_edge);
  const bool solver = exact.has(Step::set_up_solver), method = exact.has(Step::interpolation);
  if (coefficients && start_edge && solver && method) return light;
  glm::dvec3 value = stepped;
  if (coefficients) value -= (stepped - wide) + (on_snapped - interpolated);
  if (start_edge) value -= wide - form;
  if (solver) value -= form - on_snapped;
  if (method) value -= interpolated - light;
  return value;
}

}  // namespace rastertlm::analysis
