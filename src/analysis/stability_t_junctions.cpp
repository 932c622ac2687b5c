// Vertices on the edges of other triangles. The grid moves them off the edge, and what lies between is covered twice or
// not at all: no machine is at fault, so it is said how many pixels are lost, and that no others are.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/covered_picture.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

// Coordinates are multiples of it, so that what lies on an edge is known.
constexpr double kStep = 0x1p-16;  // pixels
using Vertex = geometry::SnappedPoint;
using VertexTriangle = std::array<Vertex, 3>;

__extension__ using Wide = __int128;

bool lies_on(const Vertex& v, const Vertex& from, const Vertex& to) {
  const Wide dx = to.x - from.x, dy = to.y - from.y, vx = v.x - from.x, vy = v.y - from.y;
  if (dx * vy != dy * vx) return false;
  const Wide along = dx * vx + dy * vy;
  return along > 0 && along < dx * dx + dy * dy;  // not its ends
}

// How often a vertex lies on another triangle's edge, between its ends.
std::int64_t junctions(const std::vector<VertexTriangle>& mesh) {
  std::vector<Vertex> vertices;
  for (const VertexTriangle& t : mesh)
    for (const Vertex& v : t)
      if (std::find(vertices.begin(), vertices.end(), v) == vertices.end()) vertices.push_back(v);
  std::int64_t count = 0;
  for (const VertexTriangle& t : mesh)
    for (std::size_t i = 0; i < 3; ++i)
      count += std::count_if(vertices.begin(), vertices.end(),
                             [&](const Vertex& v) { return lies_on(v, t[i], t[(i + 1) % 3]); });
  return count;
}

Position at(const Vertex& v) { return {static_cast<double>(v.x) * kStep, static_cast<double>(v.y) * kStep, 0.0}; }

double distance_to_segment(double x, double y, const Position& a, const Position& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double t = std::clamp(((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(x - a.x - t * dx, y - a.y - t * dy);
}

// Two triangles on a common edge, of which one is halved in the edge's middle.
struct HalvedNeighbour {
  Vertex from, to, middle, left, right;

  HalvedNeighbour(const geometry::Viewport& view, Numbers& numbers) {
    const auto whole = [&](std::size_t samples, double low, double high) {
      const double size = static_cast<double>(samples) - 1;
      return 2 * round_half_up(numbers.uniform(low * size, high * size) / kStep / 2);  // even: a middle is whole
    };
    from = {whole(view.columns, 0.02, 0.3), whole(view.lines, 0.3, 0.7)};
    to = {whole(view.columns, 0.7, 0.98), whole(view.lines, 0.3, 0.7)};
    middle = {(from.x + to.x) / 2, (from.y + to.y) / 2};
    left = {whole(view.columns, 0.4, 0.6), whole(view.lines, 0.02, 0.1)};
    right = {whole(view.columns, 0.4, 0.6), whole(view.lines, 0.9, 0.98)};
  }
  std::vector<VertexTriangle> triangles() const {
    return {{from, to, left}, {to, middle, right}, {middle, from, right}};
  }
  std::array<Position, 4> outline() const { return {at(from), at(left), at(to), at(right)}; }
};

bool is_inside(const std::array<Position, 4>& outline, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Position& a = outline[i];
    const Position& b = outline[(i + 1) % outline.size()];
    if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

class Bench {
 public:
  Bench(TriangleScreen& screen, const geometry::SnapGrid& grid)
      : screen_(screen), grid_(grid), picture_(screen, grid) {}

  void measure(const HalvedNeighbour& mesh) {
    const std::vector<VertexTriangle> triangles = mesh.triangles();
    found += junctions(triangles);
    picture_.clear();
    double moved = 0.0;
    for (const VertexTriangle& t : triangles) {
      const Facet facet{at(t[0]), at(t[1]), at(t[2])};
      picture_.draw(facet);
      set_up::ScreenTriangle<double> corners{};
      for (std::size_t i = 0; i < 3; ++i) corners[i] = {facet[i].x, facet[i].y, 0.5, 1.0, {0.0, 0.0, 1.0}};
      moved = std::max(moved, screen_.displacement(corners, grid_));
    }
    compare(mesh, moved);
  }

  std::int64_t found = 0;  // T-junctions
  std::int64_t lost = 0, doubled = 0;
  double elsewhere = 0.0;  // pixels that are wrong and not along the edge
  Measurement along{"", "pixels", 0.0, 0.0, BoundKind::proved};

 private:
  void compare(const HalvedNeighbour& mesh, double moved) {
    const std::array<Position, 4> outline = mesh.outline();
    const Position from = at(mesh.from), to = at(mesh.to);
    std::int64_t wrong = 0, most = 0;
    for (std::int64_t y = 0; y < picture_.lines(); ++y)
      for (std::int64_t x = 0; x < picture_.columns(); ++x) {
        const auto px = static_cast<double>(x), py = static_cast<double>(y);
        const bool beside = distance_to_segment(px, py, from, to) <= moved;
        most += beside ? 1 : 0;
        const int count = picture_.count(x, y);
        if (count == (is_inside(outline, px, py) ? 1 : 0)) continue;
        if (beside) {
          ++wrong;
          (count == 0 ? lost : doubled) += 1;
          continue;
        }
        double nearest = 1e300;
        for (std::size_t i = 0; i < outline.size(); ++i)
          nearest = std::min(nearest, distance_to_segment(px, py, outline[i], outline[(i + 1) % outline.size()]));
        elsewhere += nearest > moved ? 1 : 0;
      }
    keep_worst(along, static_cast<double>(wrong), static_cast<double>(most));
  }

  TriangleScreen& screen_;
  geometry::SnapGrid grid_;
  CoveredPicture picture_;
};

class TJunctionsCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", "the catalogue's figures"});
  }
  std::string step(const run::Inputs::Content& machine) const override { return coverage_step(machine); }
  double try_us(const run::Inputs::Content& /*machine*/) const override { return 4000.0; }

  Measured measure(Trial& trial) const override {
    const auto screen = TriangleScreen::of(trial);
    const std::int64_t tries = trial.tries_or(tries_);
    Bench bench(*screen, screen->grids().on_screen);
    for (std::int64_t round = 0; round < tries; ++round)
      bench.measure(HalvedNeighbour(screen->viewport(), trial.numbers));
    bench.along.what = fmt::format("T-junction with the most pixels of those beside its edge, of {}", bench.found);
    Measured result;
    result.measurements.push_back(bench.along);
    result.measurements.push_back({"wrong pixels away from those edges", "pixels", bench.elsewhere, 0.0,
                                   screen->is_exact() ? BoundKind::proved : BoundKind::required});
    result.measurements.push_back({"T-junctions not recognised, of one a mesh", "vertices",
                                   std::fabs(static_cast<double>(bench.found - tries)), 0.0, BoundKind::required});
    result.notes.push_back(
        fmt::format("T-junction: {} vertices lie on other triangles' edges; {} pixels lost and {} "
                    "drawn twice along them",
                    bench.found, bench.lost, bench.doubled));
    return result;
  }

 private:
  std::int64_t tries_ = 20;
};

}  // namespace

std::unique_ptr<CaseKind> t_junctions_case() { return std::make_unique<TJunctionsCase>(); }

}  // namespace rastertlm::analysis
