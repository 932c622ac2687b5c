// Which pixels a mesh covers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/covered_picture.h"
#include "src/analysis/triangle_screen.h"
#include "src/base/mathematics.h"

namespace rastertlm::analysis {
namespace {

enum class CaseMesh { sphere, fan, lattice };
struct MeshSize {
  CaseMesh mesh = CaseMesh::sphere;
  std::int64_t slices = 12;
  std::int64_t stacks = 8;
  std::int64_t triangles = 1000;
};

// Off the grid, and off the middle between samples.
struct Disc {
  double x, y, radius;
  explicit Disc(const CoveredPicture& picture)
      : x(static_cast<double>(picture.columns()) / 2 - 0.37),
        y(static_cast<double>(picture.lines()) / 2 - 0.71),
        radius(0.45 * static_cast<double>(std::min(picture.columns(), picture.lines()))) {}
  // Within `inner` parts of the radius every pixel is covered, beyond the whole none; the grid moves corners by less
  // than a pixel.
  int expected(double px, double py, double inner) const {
    const double distance = std::hypot(px - x, py - y);
    if (distance < inner * radius - 1) return 1;
    return distance > radius + 1 ? 0 : -1;
  }
};

Position on_sphere(const MeshSize& c, std::int64_t slice, std::int64_t stack) {
  const double azimuth = 2 * mathematics::kPi * static_cast<double>(slice % c.slices) / static_cast<double>(c.slices);
  const double polar = mathematics::kPi * static_cast<double>(stack) / static_cast<double>(c.stacks);
  const double turned = azimuth + 0.1;  // radians: no edge is upright on the screen
  const bool pole = stack == 0 || stack == c.stacks;
  const double ring = pole ? 0.0 : mathematics::sin(polar);
  // Leaning towards the eye: a ring of corners that is level on the screen stays in order on any grid, and no triangle
  // would fold.
  const double lean = 0.3;
  const double up = -mathematics::cos(polar), near = ring * mathematics::cos(turned);
  return {ring * mathematics::sin(turned), up * mathematics::cos(lean) + near * mathematics::sin(lean),
          near * mathematics::cos(lean) - up * mathematics::sin(lean)};
}

Measurement wrong_pixels(const CoveredPicture& picture, const ExpectedCount& expected) {
  return {fmt::format("{} triangles, {} folded by the grid", picture.triangles(), picture.folded()), "pixels",
          static_cast<double>(picture.differing(expected)), 0.0,
          picture.is_exact() ? BoundKind::proved : BoundKind::required};
}

// Distance of a facet's plane from the middle of the unit sphere: the polyhedron's outline holds the disc of the least.
double plane_distance(const Facet& t) {
  const Position a{t[1].x - t[0].x, t[1].y - t[0].y, t[1].z - t[0].z};
  const Position b{t[2].x - t[0].x, t[2].y - t[0].y, t[2].z - t[0].z};
  const Position n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return std::fabs(n.x * t[0].x + n.y * t[0].y + n.z * t[0].z) / std::hypot(n.x, n.y, n.z);
}

Measurement sphere(const MeshSize& c, CoveredPicture& picture) {
  const Disc disc(picture);
  double inner = 1.0;
  const auto add = [&](const Facet& unit) {
    inner = std::min(inner, plane_distance(unit));
    Facet facet = unit;
    for (Position& p : facet) p = {disc.x + disc.radius * p.x, disc.y + disc.radius * p.y, p.z};
    if (doubled_area(facet) > 0) picture.draw(facet);
  };
  for (std::int64_t stack = 0; stack < c.stacks; ++stack)
    for (std::int64_t slice = 0; slice < c.slices; ++slice) {
      const Position a = on_sphere(c, slice, stack), b = on_sphere(c, slice + 1, stack);
      const Position d = on_sphere(c, slice, stack + 1), e = on_sphere(c, slice + 1, stack + 1);
      if (stack > 0) add({a, b, e});
      if (stack + 1 < c.stacks) add({a, e, d});
    }
  return wrong_pixels(picture, [&](double x, double y) { return disc.expected(x, y, inner); });
}

Measurement fan(const MeshSize& c, CoveredPicture& picture) {
  const Disc disc(picture);
  const auto rim = [&](std::int64_t i) {
    const double angle = 2 * mathematics::kPi * static_cast<double>(i % c.triangles) / static_cast<double>(c.triangles);
    return Position{disc.x + disc.radius * mathematics::cos(angle), disc.y + disc.radius * mathematics::sin(angle),
                    0.0};
  };
  for (std::int64_t i = 0; i < c.triangles; ++i) picture.draw({Position{disc.x, disc.y, 0.0}, rim(i), rim(i + 1)});
  const double inner = mathematics::cos(mathematics::kPi / static_cast<double>(c.triangles));
  return wrong_pixels(picture, [&](double x, double y) { return disc.expected(x, y, inner); });
}

// Squares with corners on samples, cut along either diagonal: level, upright and diagonal edges through samples. A
// sample on a left or top side is inside, so that all pixels of the screen are known.
Measurement lattice(const MeshSize& c, CoveredPicture& picture) {
  const std::int64_t pitch = std::max<std::int64_t>(1, (std::min(picture.columns(), picture.lines()) - 2) / c.slices);
  const auto at = [&](std::int64_t i, std::int64_t j) {
    return Position{static_cast<double>(1 + i * pitch), static_cast<double>(1 + j * pitch), 0.0};
  };
  for (std::int64_t j = 0; j < c.slices; ++j)
    for (std::int64_t i = 0; i < c.slices; ++i) {
      const Position p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), s = at(i, j + 1);
      const bool falling = (i + j) % 2 == 0;
      picture.draw(falling ? Facet{p, q, r} : Facet{p, q, s});
      picture.draw(falling ? Facet{p, r, s} : Facet{q, r, s});
    }
  const auto side = static_cast<double>(1 + c.slices * pitch);
  // Where edges have scales of their own, a sample on the outline is on either side.
  const bool either = !picture.is_exact();
  return wrong_pixels(picture, [=](double x, double y) {
    if (either && (x == 1 || x == side || y == 1 || y == side)) return kAnyCount;
    return x >= 1 && x < side && y >= 1 && y < side ? 1 : 0;
  });
}

class CoverageCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.choice("mesh", of_.mesh, {"sphere", "fan", "lattice"}, {"", "What is drawn.", "the catalogue's figures"});
    table.integer("slices", of_.slices, {3, 4096},
                  {"", "Of the sphere, around; of the lattice, across.", "the catalogue's figures"});
    table.integer("stacks", of_.stacks, {2, 4096},
                  {"", "Of the sphere, from pole to pole.", "the catalogue's figures"});
    table.integer("triangles", of_.triangles, {3, 100'000},
                  {"", "Of the fan, around one vertex.", "the catalogue's figures"});
  }
  std::string step(const run::Inputs::Content& machine) const override { return coverage_step(machine); }

  Measured measure(Trial& trial) const override {
    const auto screen = TriangleScreen::of(trial);
    CoveredPicture picture(*screen, screen->grids().on_screen);
    switch (of_.mesh) {
      case CaseMesh::sphere:
        return {{sphere(of_, picture)}, {}};
      case CaseMesh::fan:
        return {{fan(of_, picture)}, {}};
      case CaseMesh::lattice:
        break;
    }
    return {{lattice(of_, picture)}, {}};
  }

 private:
  MeshSize of_;
};

}  // namespace

std::unique_ptr<CaseKind> coverage_case() { return std::make_unique<CoverageCase>(); }

}  // namespace rastertlm::analysis
