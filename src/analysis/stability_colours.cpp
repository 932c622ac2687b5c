// The registers of a colour: on their longest path, and along the start edges of triangles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "modules/set_up/quadratic_solver.h"
#include "modules/set_up/span_load.h"
#include "modules/span_unit/span_registers.h"
#include "modules/span_unit/span_unit.h"
#include "src/analysis/stability_cores.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

// A path of line steps, then of pixel steps. Constants in 1/64 of the registers' last bit, so that all of it is exact
// in integers.
struct Path {
  std::int64_t start, line_step, pixel_step, line_line, line_pixel, pixel_pixel;
};
constexpr std::int64_t kPart = 64;

// Above the fraction: as many that the error of the fewest fraction bits, thousands of levels, does not wrap itself.
constexpr unsigned kWholeBits = 16;

// The error at the path's end, in steps of the last bit, of registers of that width: sums wrap, the error does not.
double error_of(const Path& exact, std::int64_t lines, std::int64_t pixels, unsigned word_bits) {
  const auto word = [](std::int64_t parts) { return static_cast<std::uint64_t>(floor_div(parts + kPart / 2, kPart)); };
  span_unit::ColourRegisters registers(word_bits);
  registers.load({word(exact.start), word(exact.line_step), word(exact.pixel_step), word(exact.line_line),
                  word(exact.line_pixel), word(exact.pixel_pixel)});
  for (std::int64_t k = 0; k < lines; ++k) registers.step_line(false);
  for (std::int64_t k = 0; k < pixels; ++k) registers.step_pixel();
  const std::int64_t value = exact.start + lines * exact.line_step + lines * (lines - 1) / 2 * exact.line_line +
                             pixels * (exact.pixel_step + lines * exact.line_pixel) +
                             pixels * (pixels - 1) / 2 * exact.pixel_pixel;
  const std::uint64_t off = registers.i() * kPart - static_cast<std::uint64_t>(value);
  return std::fabs(static_cast<double>(sign_extend(off, word_bits + bit_length(kPart) - 1))) / kPart;
}

// In levels: the most that was seen. Of the first two paths every constant is half of the last bit off, or 31/64 of it
// the other way; the others are random.
double worst_of_paths(std::int64_t steps, std::int64_t bits, Numbers& numbers, std::int64_t tries) {
  const unsigned word_bits = static_cast<unsigned>(bits) + kWholeBits;
  double worst = 0.0;
  for (const std::int64_t off : {kPart / 2 - 1, -kPart / 2})
    worst = std::max(worst, error_of({off, off, off, off, off, off}, steps / 2, steps - steps / 2, word_bits));
  for (std::int64_t round = 0; round < tries; ++round) {
    const auto part = [&] { return numbers.whole(-100'000, 100'000); };
    const Path path{part(), part(), part(), part(), part(), part()};
    const std::int64_t lines = numbers.whole(0, steps);
    worst = std::max(worst, error_of(path, lines, steps - lines, word_bits));
  }
  return std::ldexp(worst, -static_cast<int>(bits));
}

set_up::ColourTriangle random_triangle(const quadratic::Machine& machine, Numbers& numbers) {
  set_up::ColourTriangle t;
  t.fraction_bits = static_cast<int>(machine.set_up.snap_bits);
  const std::int64_t one = std::int64_t{1} << t.fraction_bits;
  const double unit = 1.0 / static_cast<double>(one);
  do {
    for (auto& corner : t.corners)
      corner = {numbers.whole(0, (machine.video.columns - 1) * one), numbers.whole(0, (machine.video.lines - 1) * one)};
  } while (std::abs(geometry::doubled_area(t.corners[0], t.corners[1], t.corners[2])) < 2000 * one * one);
  const auto& [a, b, c] = t.corners;
  const auto offset = [&](std::int64_t to, std::int64_t from) { return static_cast<double>(to - from) * unit; };
  const set_up::BarycentricSolver<double> solver(offset(b.x, a.x), offset(b.y, a.y), offset(c.x, a.x),
                                                 offset(c.y, a.y));
  for (auto& form : t.colour) {
    const auto level = [&] { return static_cast<double>(numbers.whole(0, 255)); };
    form = solver.solve({level(), level(), level(), level(), level(), level()});
  }
  return t;
}

struct Line {
  std::int64_t since_top = 0;
  double x = 0.0;  // of the first pixel, from corner 1
  double y = 0.0;
};

// What is proved of a pixel: see configs/hard_cases/start_edge.toml. As published nothing is: it is held against what
// the lattice does with the same words.
double start_edge_bound(const span_unit::SpanUnitParameters& unit, const set_up::QuadraticForm<double>& form,
                        const Line& line, std::int64_t pixel) {
  const auto steps = static_cast<std::uint64_t>(line.since_top + pixel);
  if (unit.start_edge != span_unit::StartEdge::prestep)
    return span_unit::fraction_bound(unit.fraction_bits, steps + static_cast<std::uint64_t>(line.since_top));
  const double slope = std::fabs(2 * form.t5 * line.x + form.t4 * line.y + form.t2);
  const double bend = std::fabs(form.t5);
  const double distance = std::ldexp(1.0, -static_cast<int>(unit.prestep_bits));
  const auto run = static_cast<double>(pixel);
  return span_unit::fraction_bound(unit.fraction_bits, steps + 1) + distance * (slope + bend * (3 + 2 * run)) +
         std::ldexp(2 + run, -static_cast<int>(unit.fraction_bits));
}

void measure_triangle(const set_up::ColourTriangle& t, const quadratic::Machine& machine, span_unit::SpanUnit& unit,
                      Measurement& worst) {
  const span_unit::SpanUnitParameters& p = machine.span_unit;
  const span_unit::TriangleLoad load = set_up::span_load(t, set_up::SpanFormat::of(p, machine.video.lines));
  if (load.count == 0 || load.wraps) return;  // a prestep that wraps is counted by the machine and promises nothing
  const double unit_pixels = std::ldexp(1.0, -t.fraction_bits);
  const auto word_bits = static_cast<unsigned>(p.word_bits);
  for (const span_unit::Span& span : unit.draw(load).spans)
    for (std::size_t c = 0; c < span_unit::kChannels; ++c) {
      const Line line{static_cast<std::int64_t>(span.line) - load.halves[0].first_line,
                      span.column - static_cast<double>(t.corners[0].x) * unit_pixels,
                      span.line - static_cast<double>(t.corners[0].y) * unit_pixels};
      span_unit::ColourRegisters registers(word_bits);
      registers.load({span.i[c], 0, span.di[c], 0, 0, span.pixel_pixel[c]});
      for (std::uint32_t x = 0; x < span.count; ++x) {
        const double shown =
            std::ldexp(static_cast<double>(sign_extend(registers.i(), word_bits)), -static_cast<int>(p.fraction_bits)) -
            0.5;
        const double error = std::fabs(shown - t.colour[c].at(line.x + x, line.y));
        // Forms in double are off by 2^-40 levels themselves.
        keep_worst(worst, error, start_edge_bound(p, t.colour[c], line, x) + std::ldexp(1.0, -40));
        registers.step_pixel();
      }
    }
}

}  // namespace

std::vector<Measurement> measure_differences(const HardCase& c, const quadratic::Machine& machine, Numbers& numbers,
                                             std::int64_t tries) {
  std::vector<Measurement> found;
  for (std::int64_t bits = c.bits_from; bits <= c.bits_to; ++bits)
    found.push_back({fmt::format("{} steps, {} fraction bits", c.steps, bits), "levels",
                     worst_of_paths(c.steps, bits, numbers, tries),
                     span_unit::fraction_bound(bits, static_cast<std::uint64_t>(c.steps)), BoundKind::proved});
  const span_unit::SpanUnitParameters& unit = machine.span_unit;
  const std::int64_t on_screen =
      machine.video.columns + machine.video.lines * (unit.start_edge == span_unit::StartEdge::lattice ? 2 : 1);
  found.push_back({fmt::format("{} steps of this screen, its {} bits", on_screen, unit.fraction_bits), "levels",
                   worst_of_paths(on_screen, unit.fraction_bits, numbers, tries), c.limit_levels, BoundKind::required});
  return found;
}

std::vector<Measurement> measure_start_edge(const quadratic::Machine& machine, Numbers& numbers, std::int64_t tries) {
  Measurement worst{"colours of triangles on the screen", "levels", 0.0, 0.0, BoundKind::proved};
  span_unit::SpanUnit unit(machine.span_unit, static_cast<std::uint32_t>(machine.video.columns),
                           static_cast<std::uint32_t>(machine.video.lines));
  for (std::int64_t round = 0; round < tries; ++round)
    measure_triangle(random_triangle(machine, numbers), machine, unit, worst);
  return {worst};
}

}  // namespace rastertlm::analysis
