#include "src/reference/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "src/reference/coverage.h"
#include "src/reference/piece_light.h"
#include "src/reference/pieces.h"
#include "src/reference/regions.h"
#include "src/reference/solids.h"

namespace rastertlm::reference {
namespace {

// What is seen at a pixel, kept until everything is drawn: only that is shaded.
struct Seen {
  std::uint32_t piece = 0;            // index + 1; 0 none
  std::uint32_t solid = 0;            // likewise
  std::uint32_t last_covered_by = 0;  // the last triangle that was counted
  std::array<double, 2> weights{};
};

double interpolated(double a, double b, double c, const std::array<double, 2>& weights) {
  return a + weights[0] * (b - a) + weights[1] * (c - a);
}

// The depth of a piece's plane, beyond its edges too.
class DepthPlane {
 public:
  explicit DepthPlane(const Piece& piece) : from_(piece.corners[0]) {
    const auto& [a, b, c] = piece.corners;
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    across_ = ((b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y)) / area;
    down_ = ((c.z - a.z) * (b.x - a.x) - (b.z - a.z) * (c.x - a.x)) / area;
  }
  double at(std::size_t column, std::size_t line) const {
    return from_.z + across_ * (static_cast<double>(column) - from_.x) + down_ * (static_cast<double>(line) - from_.y);
  }
  // Of depth, the most that it changes from a pixel to one beside it.
  double slope() const { return std::abs(across_) + std::abs(down_); }

 private:
  const geometry::ScreenVertex<double>& from_;
  double across_;
  double down_;
};

// Of the depth range: surfaces that are no farther apart are not told apart.
constexpr double kLeastGap = 1.0 / 65536.0;

// Whether the planes neither meet between two neighbouring pixels nor come as near as their slopes may bring them
// within a pixel: then one hides the other, and is no neighbour of it.
bool surface_ends(const Piece& first, const Piece& second, std::size_t pixel, std::size_t neighbour,
                  std::size_t columns) {
  if (first.body != second.body) return true;
  const DepthPlane a(first);
  const DepthPlane b(second);
  const auto gap = [&](std::size_t at) { return b.at(at % columns, at / columns) - a.at(at % columns, at / columns); };
  const double here = gap(pixel);
  const double there = gap(neighbour);
  if ((here <= 0.0) != (there <= 0.0)) return false;
  return std::min(std::abs(here), std::abs(there)) > a.slope() + b.slope() + kLeastGap;
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

void draw(const PlacedSolid& solid, std::uint32_t index, frame::ExactFrame& out, std::vector<Seen>& seen) {
  const PlacedSolid::Box box = solid.box({out.columns, out.lines});
  for (std::size_t y = box.first_line; y < box.end_line; ++y)
    for (std::size_t x = box.first_column; x < box.end_column; ++x) {
      const std::size_t pixel = y * out.columns + x;
      const auto hit = solid.hit(static_cast<double>(x), static_cast<double>(y));
      if (!hit) continue;
      ++out.coverage[pixel];
      const bool nearer = hit->depth < out.depth[pixel];
      const bool first_of_equals = hit->depth == out.depth[pixel] && solid.number() < out.object[pixel];
      if (out.object[pixel] != 0 && !nearer && !first_of_equals) continue;
      seen[pixel] = {};
      seen[pixel].solid = index + 1;
      out.depth[pixel] = hit->depth;
      out.object[pixel] = solid.number();
    }
}

glm::dvec3 levels_of(const PlacedSolid& solid, const PieceLight& light, double column, double line, float& specular) {
  const PlacedSolid::Point point = solid.point(solid.hit(column, line).value(), column, line);
  return light.levels(solid.material(), point.normal, point.position, specular);
}

glm::dvec2 place_of(std::size_t pixel, std::size_t columns) {
  const std::size_t line = pixel / columns;
  return {static_cast<double>(pixel % columns), static_cast<double>(line)};
}

void mark(frame::ExactFrame& out, const std::vector<float>& specular, const std::vector<Piece>& pieces,
          const std::vector<PlacedSolid>& solids, const std::vector<Seen>& seen) {
  const auto ends = [&](std::size_t pixel, std::size_t neighbour) {
    if (seen[pixel].solid != 0 || seen[neighbour].solid != 0) return true;
    return surface_ends(pieces[seen[pixel].piece - 1], pieces[seen[neighbour].piece - 1], pixel, neighbour,
                        out.columns);
  };
  const auto hides_itself = [&](std::size_t pixel, std::size_t neighbour) {
    if (seen[pixel].solid == 0) return false;
    const PlacedSolid& solid = solids[seen[pixel].solid - 1];
    return solid.may_hide_itself() &&
           solid.jumps(place_of(pixel, out.columns), place_of(neighbour, out.columns), kLeastGap);
  };
  mark_regions(out, specular, ends, hides_itself);
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
  const std::vector<PlacedSolid> solids = placed_solids(scene, pose, {options.columns, options.lines});
  for (std::size_t i = 0; i < solids.size(); ++i) draw(solids[i], static_cast<std::uint32_t>(i), out, seen);
  std::vector<float> specular(out.pixels(), 0.0F);
  for (std::size_t pixel = 0; pixel < out.pixels(); ++pixel) {
    const Seen& here = seen[pixel];
    glm::dvec3 levels = scene.background;
    if (here.piece != 0) levels = light.levels(drawn.list[here.piece - 1], here.weights, specular[pixel]);
    if (here.solid != 0) {
      const glm::dvec2 place = place_of(pixel, out.columns);
      levels = levels_of(solids[here.solid - 1], light, place.x, place.y, specular[pixel]);
    }
    for (int c = 0; c < 3; ++c) out.rgb.set(3 * pixel + static_cast<std::size_t>(c), levels[c]);
  }
  mark(out, specular, drawn.list, solids, seen);
  return out;
}

}  // namespace rastertlm::reference
