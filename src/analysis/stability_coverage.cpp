// Which pixels a mesh covers, and whether EP1 counts right.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "modules/object_processor/elementary_processor.h"
#include "modules/set_up/span_load.h"
#include "modules/span_unit/span_unit.h"
#include "src/analysis/stability_cores.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

struct Position {
  double x, y, z;  // pixels; z towards the eye
};
using Facet = std::array<Position, 3>;

double doubled_area(const Facet& t) {
  return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
}

// How often each pixel is covered, a triangle that the grid has folded over counting -1: a mesh whose neighbours share
// edges covers what is inside its outline once, whatever the grid does to its triangles.
class Picture {
 public:
  explicit Picture(const quadratic::Machine& machine)
      : machine_(machine),
        unit_(machine.span_unit, static_cast<std::uint32_t>(machine.video.columns),
              static_cast<std::uint32_t>(machine.video.lines)),
        count_(static_cast<std::size_t>(machine.video.columns * machine.video.lines)) {}

  void draw(const Facet& facet) {
    set_up::ColourTriangle t;
    t.fraction_bits = static_cast<int>(machine_.set_up.snap_bits);
    const double one = std::ldexp(1.0, t.fraction_bits);
    for (std::size_t i = 0; i < 3; ++i)
      t.corners[i] = {round_half_up(facet[i].x * one), round_half_up(facet[i].y * one)};
    const std::int64_t area = geometry::doubled_area(t.corners[0], t.corners[1], t.corners[2]);
    ++triangles;
    if (area == 0) return;
    const bool fold = (area < 0) != (doubled_area(facet) < 0);
    folded += fold ? 1 : 0;
    const auto columns = static_cast<std::size_t>(machine_.video.columns);
    for (const span_unit::Span& span :
         unit_.draw(set_up::span_load(t, set_up::SpanFormat::of(machine_.span_unit, machine_.video.lines))).spans)
      for (std::uint32_t x = 0; x < span.count; ++x) count_[span.line * columns + span.column + x] += fold ? -1 : 1;
  }

  // `expected`: 0 or 1, or -1 where nothing is said.
  Measurement wrong(const std::function<int(double x, double y)>& expected) const {
    std::int64_t off = 0;
    for (std::int64_t y = 0; y < machine_.video.lines; ++y)
      for (std::int64_t x = 0; x < machine_.video.columns; ++x) {
        const int wanted = expected(static_cast<double>(x), static_cast<double>(y));
        off += wanted >= 0 && count_[static_cast<std::size_t>(y * machine_.video.columns + x)] != wanted ? 1 : 0;
      }
    return {fmt::format("{} triangles, {} folded by the grid", triangles, folded), "pixels", static_cast<double>(off),
            0.0, BoundKind::proved};
  }

  std::int64_t triangles = 0;
  std::int64_t folded = 0;

 private:
  const quadratic::Machine& machine_;
  span_unit::SpanUnit unit_;
  std::vector<int> count_;
};

// Off the grid, and off the middle between samples.
struct Disc {
  double x, y, radius;
  explicit Disc(const quadratic::Machine& machine)
      : x(static_cast<double>(machine.video.columns) / 2 - 0.37),
        y(static_cast<double>(machine.video.lines) / 2 - 0.71),
        radius(0.45 * static_cast<double>(std::min(machine.video.columns, machine.video.lines))) {}
  // Within `inner` parts of the radius every pixel is covered, beyond the whole none; the grid moves corners by less
  // than a pixel.
  int expected(double px, double py, double inner) const {
    const double distance = std::hypot(px - x, py - y);
    if (distance < inner * radius - 1) return 1;
    return distance > radius + 1 ? 0 : -1;
  }
};

Position on_sphere(const HardCase& c, std::int64_t slice, std::int64_t stack) {
  const double azimuth = 2 * std::numbers::pi * static_cast<double>(slice % c.slices) / static_cast<double>(c.slices);
  const double polar = std::numbers::pi * static_cast<double>(stack) / static_cast<double>(c.stacks);
  const double turned = azimuth + 0.1;  // radians: no edge is upright on the screen
  const bool pole = stack == 0 || stack == c.stacks;
  const double ring = pole ? 0.0 : std::sin(polar);
  // Leaning towards the eye: a ring of corners that is level on the screen stays in order on any grid, and no triangle
  // would fold.
  const double lean = 0.3;
  const double up = -std::cos(polar), near = ring * std::cos(turned);
  return {ring * std::sin(turned), up * std::cos(lean) + near * std::sin(lean),
          near * std::cos(lean) - up * std::sin(lean)};
}

// Distance of a facet's plane from the middle of the unit sphere: the polyhedron's outline holds the disc of the least.
double plane_distance(const Facet& t) {
  const Position a{t[1].x - t[0].x, t[1].y - t[0].y, t[1].z - t[0].z};
  const Position b{t[2].x - t[0].x, t[2].y - t[0].y, t[2].z - t[0].z};
  const Position n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return std::fabs(n.x * t[0].x + n.y * t[0].y + n.z * t[0].z) / std::hypot(n.x, n.y, n.z);
}

Measurement sphere(const HardCase& c, const quadratic::Machine& machine) {
  Picture picture(machine);
  const Disc disc(machine);
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
  return picture.wrong([&](double x, double y) { return disc.expected(x, y, inner); });
}

Measurement fan(const HardCase& c, const quadratic::Machine& machine) {
  Picture picture(machine);
  const Disc disc(machine);
  const auto rim = [&](std::int64_t i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i % c.triangles) / static_cast<double>(c.triangles);
    return Position{disc.x + disc.radius * std::cos(angle), disc.y + disc.radius * std::sin(angle), 0.0};
  };
  for (std::int64_t i = 0; i < c.triangles; ++i) picture.draw({Position{disc.x, disc.y, 0.0}, rim(i), rim(i + 1)});
  const double inner = std::cos(std::numbers::pi / static_cast<double>(c.triangles));
  return picture.wrong([&](double x, double y) { return disc.expected(x, y, inner); });
}

// Squares with corners on samples, cut along either diagonal: level, upright and diagonal edges through samples. A
// sample on a left or top side is inside, so that all pixels of the screen are known.
Measurement lattice(const HardCase& c, const quadratic::Machine& machine) {
  Picture picture(machine);
  const std::int64_t pitch =
      std::max<std::int64_t>(1, (std::min(machine.video.columns, machine.video.lines) - 2) / c.slices);
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
  return picture.wrong([&](double x, double y) { return x >= 1 && x < side && y >= 1 && y < side ? 1 : 0; });
}

}  // namespace

std::vector<Measurement> measure_coverage(const HardCase& c, const quadratic::Machine& machine) {
  switch (c.mesh) {
    case CaseMesh::sphere:
      return {sphere(c, machine)};
    case CaseMesh::fan:
      return {fan(c, machine)};
    case CaseMesh::lattice:
      break;
  }
  return {lattice(c, machine)};
}

std::vector<Measurement> measure_linear_form(const object_processor::ObjectProcessorParameters& parameters,
                                             Numbers& numbers, std::int64_t tries) {
  namespace ep = object_processor;
  constexpr std::uint32_t kColumns = 32, kLines = 16;
  const auto word_bits = static_cast<unsigned>(parameters.word_bits);
  const auto mask = static_cast<std::uint32_t>(low_mask(word_bits));
  std::int64_t wrong = 0;
  for (std::int64_t round = 0; round < tries; ++round) {
    // Every fourth: words of ones, whose carries go through all slices.
    const auto word = [&] { return round % 4 == 0 ? mask : static_cast<std::uint32_t>(numbers.whole(0, mask)); };
    const std::uint32_t a = word(), b = word(), c = word();
    ep::ElementaryProcessor processor(parameters);
    processor.write_loading(0, a);
    processor.write_loading(1, b);
    processor.write_loading(2, c);
    processor.run(ep::frame_start_program());
    for (std::uint64_t line = 0; line < kLines; ++line) {
      processor.run(ep::line_start_program(parameters.slices()));
      for (std::uint64_t column = 0; column < kColumns; ++column) {
        const std::uint64_t exact = (a * column + b * (line + 1) + c) & mask;
        wrong += processor.output() != exact ? 1 : 0;
        processor.step(ep::pixel_instruction(parameters.slices()));
      }
    }
  }
  return {{fmt::format("{} words of {} bits", tries * kColumns * kLines, word_bits), "words",
           static_cast<double>(wrong), 0.0, BoundKind::proved}};
}

}  // namespace rastertlm::analysis
