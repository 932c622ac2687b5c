#include "src/reference/renderer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "src/reference/coverage.h"
#include "src/reference/piece_light.h"
#include "src/reference/pieces.h"

namespace rastertlm::reference {
namespace {

// What is seen at a pixel, kept until every piece is drawn: only that is shaded.
struct Seen {
  std::uint32_t piece = 0;            // index + 1; 0 nothing
  std::uint32_t last_covered_by = 0;  // the last triangle that was counted
  std::array<double, 2> weights{};
};

double interpolated(double a, double b, double c, const std::array<double, 2>& weights) {
  return a + weights[0] * (b - a) + weights[1] * (c - a);
}

// Corner positions in the number type of the edge functions, and the distance of two samples.
Coverage<std::int64_t> snapped_coverage(const Piece& piece, int fraction_bits) {
  std::array<Point<std::int64_t>, 3> points;
  for (std::size_t i = 0; i < 3; ++i) points[i] = {piece.snapped[i].x, piece.snapped[i].y};
  return {points, std::int64_t{1} << fraction_bits};
}

Coverage<double> plain_coverage(const Piece& piece) {
  std::array<Point<double>, 3> points;
  for (std::size_t i = 0; i < 3; ++i) points[i] = {piece.corners[i].x, piece.corners[i].y};
  return {points, 1.0};
}

template <class N>
void draw(const Piece& piece, std::uint32_t index, const Coverage<N>& coverage, frame::ExactFrame& out,
          std::vector<Seen>& seen) {
  const auto& [a, b, c] = piece.corners;
  const Span lines = coverage.lines(out.lines);
  for (std::int64_t y = lines.begin; y < lines.end; ++y) {
    const Span span = coverage.span(y, out.columns);
    for (std::int64_t x = span.begin; x < span.end; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * out.columns + static_cast<std::size_t>(x);
      Seen& here = seen[pixel];
      if (here.last_covered_by != piece.object) ++out.coverage[pixel];
      here.last_covered_by = piece.object;
      const std::array<double, 2> weights = coverage.weights(x, y);
      const double depth = std::clamp(interpolated(a.z, b.z, c.z, weights), 0.0, 1.0);
      if (here.piece != 0 && !(depth < out.depth[pixel])) continue;
      here.piece = index + 1;
      here.weights = weights;
      out.depth[pixel] = depth;
      out.object[pixel] = piece.object;
    }
  }
}

}  // namespace

std::string to_string(Reference reference) {
  switch (reference) {
    case Reference::ideal:
      return "ideal";
    case Reference::snapped:
      return "snapped";
    case Reference::true_model:
      return "true";
  }
  return "";
}

frame::ExactFrame render(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options) {
  const PieceLight light(scene, pose, options);
  const Pieces drawn = pieces(scene, pose, options);
  frame::ExactFrame out;
  out.resize(options.columns, options.lines);
  std::vector<Seen> seen(out.pixels());
  for (std::size_t i = 0; i < drawn.list.size(); ++i) {
    const Piece& piece = drawn.list[i];
    const auto index = static_cast<std::uint32_t>(i);
    if (options.kind == Reference::snapped)
      draw(piece, index, snapped_coverage(piece, drawn.grid.grid.fraction_bits), out, seen);
    else
      draw(piece, index, plain_coverage(piece), out, seen);
  }
  for (std::size_t pixel = 0; pixel < out.pixels(); ++pixel) {
    const Seen& here = seen[pixel];
    const glm::dvec3 levels =
        here.piece == 0 ? scene.background : light.levels(drawn.list[here.piece - 1], here.weights);
    for (int c = 0; c < 3; ++c) out.rgb[3 * pixel + static_cast<std::size_t>(c)] = levels[c];
  }
  return out;
}

}  // namespace rastertlm::reference
