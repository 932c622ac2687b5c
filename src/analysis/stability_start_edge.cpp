// Colours of whole triangles: what the span unit's registers show at every pixel, beside what is proved of them. The
// derivation stands in configs/hard_cases/start_edge.toml.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "modules/set_up/quadratic_solver.h"
#include "modules/set_up/span_load.h"
#include "modules/span_unit/span_registers.h"
#include "modules/span_unit/span_unit.h"
#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/exact_number.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using set_up::ColourTriangle;
using set_up::QuadraticForm;
using span_unit::SpanUnitParameters;
using span_unit::StartEdge;

enum class Knots { any, extreme };

struct Family {
  double size_pixels = 0.0;  // longest side along an axis; 0: the screen's
  double least_area_pixels = 1000.0;
  Knots knots = Knots::any;
};

double unit_of(const ColourTriangle& t) { return std::ldexp(1.0, -t.fraction_bits); }

ColourTriangle random_triangle(const Family& family, const quadratic::Machine& machine, Numbers& numbers) {
  ColourTriangle t;
  t.fraction_bits = static_cast<int>(machine.set_up.snap_bits);
  const std::int64_t one = std::int64_t{1} << t.fraction_bits;
  const auto part = [&](std::int64_t samples, std::int64_t& low, std::int64_t& high) {
    const std::int64_t all = (samples - 1) * one;
    const std::int64_t size =
        family.size_pixels > 0.0 ? round_half_up(family.size_pixels * static_cast<double>(one)) : all;
    low = size < all ? numbers.whole(0, all - size) : 0;
    high = std::min(all, low + size);
  };
  std::int64_t left = 0, right = 0, top = 0, bottom = 0;
  part(machine.video.columns, left, right);
  part(machine.video.lines, top, bottom);
  const double least = std::max(1.0, 2 * family.least_area_pixels * static_cast<double>(one * one));
  do {
    for (auto& corner : t.corners) corner = {numbers.whole(left, right), numbers.whole(top, bottom)};
  } while (static_cast<double>(std::abs(geometry::doubled_area(t.corners[0], t.corners[1], t.corners[2]))) < least);
  const auto& [a, b, c] = t.corners;
  const auto offset = [&](std::int64_t to, std::int64_t from) { return static_cast<double>(to - from) * unit_of(t); };
  const set_up::BarycentricSolver<double> solver(offset(b.x, a.x), offset(b.y, a.y), offset(c.x, a.x),
                                                 offset(c.y, a.y));
  const set_up::LinearSolver<double> linear(offset(b.x, a.x), offset(b.y, a.y), offset(c.x, a.x), offset(c.y, a.y));
  for (auto& form : t.colour) {
    const auto level = [&] {
      return static_cast<double>(family.knots == Knots::extreme ? 255 * numbers.whole(0, 1) : numbers.whole(0, 255));
    };
    const set_up::SixColours<double> six{level(), level(), level(), level(), level(), level()};
    form = machine.set_up.linear() ? linear.solve(six.i1, six.i2, six.i3) : solver.solve(six);
  }
  return t;
}

// A triangle's colour with absolute values: what its constants are at most, wherever its registers start.
class Magnitudes {
 public:
  Magnitudes(const ColourTriangle& t, const QuadraticForm<double>& form) {
    const auto [left, right] = std::minmax({t.corners[0].x, t.corners[1].x, t.corners[2].x});
    const auto [top, bottom] = std::minmax({t.corners[0].y, t.corners[1].y, t.corners[2].y});
    // A pixel more on each side: registers start on the lattice.
    width_ = static_cast<double>(right - left) * unit_of(t) + 2;
    height_ = static_cast<double>(bottom - top) * unit_of(t) + 2;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& from = t.corners[i];
      const auto& to = t.corners[(i + 1) % 3];
      if (to.y != from.y)
        slope_ = std::max(slope_, std::fabs(static_cast<double>(to.x - from.x) / static_cast<double>(to.y - from.y)));
    }
    slope_ += 1;  // its whole part
    t1_ = std::fabs(form.t1);
    t2_ = std::fabs(form.t2);
    t3_ = std::fabs(form.t3);
    t4_ = std::fabs(form.t4);
    t5_ = std::fabs(form.t5);
    t0_ = std::fabs(form.t0);
  }

  // Of doubles, after so many lines, and pixels with carries: the constants count as often as registers add them.
  double rounding(double lines, double pixels) const {
    constexpr double kHalfPlace = std::numeric_limits<double>::epsilon() / 2;
    constexpr double kGamma = 15 * kHalfPlace / (1 - 15 * kHalfPlace);
    const double along_x = 2 * t5_ * width_ + t4_ * height_ + t2_;
    const double along_y = t4_ * width_ + 2 * t3_ * height_ + t1_;
    const double second = t5_ * slope_ * slope_ + t4_ * slope_ + t3_;
    const double value = t0_ + 0.5 + along_x * width_ + along_y * height_;
    const double line_step = along_x * slope_ + along_y + second;
    return kGamma *
           (value + lines * line_step + pixels * (along_x + t5_) + lines * lines * second +
            lines * pixels * (2 * t5_ * slope_ + t4_) + pixels * pixels * t5_) *
           (1 + 1e-9);
  }

  // A register that steps from pixel to pixel or from line to line leaves its word on the way.
  bool wraps(double most) const {
    return 2 * t5_ * width_ + t4_ * height_ + t2_ > most || 2 * (t5_ * slope_ * slope_ + t4_ * slope_ + t3_) > most;
  }

 private:
  double t0_, t1_, t2_, t3_, t4_, t5_, width_, height_, slope_ = 0.0;
};

struct Line {
  double since_top = 0.0;
  double x = 0.0;  // of the first pixel, from corner 1
  double y = 0.0;
};

class Bench {
 public:
  explicit Bench(const quadratic::Machine& machine, const Tampering& tampering)
      : machine_(machine),
        tampering_(tampering),
        p_(machine.span_unit),
        unit_(p_, static_cast<std::uint32_t>(machine.video.columns), static_cast<std::uint32_t>(machine.video.lines)) {}

  void measure(const ColourTriangle& t) {
    span_unit::TriangleLoad load = set_up::span_load(t, set_up::SpanFormat::of(p_, machine_.video.lines));
    if (load.count == 0) return;
    ++drawn;
    if (load.wraps) {  // a prestep that wraps is counted by the machine and promises nothing
      ++unpromised;
      return;
    }
    if (tampering_.span_load) tampering_.span_load(load);
    const std::int64_t top = load.halves[0].first_line;
    const span_unit::DrawnLines lines = unit_.draw(load);
    bool leaves = false;
    for (std::size_t c = 0; c < span_unit::kChannels; ++c) {
      const Magnitudes most(t, t.colour[c]);
      leaves = leaves || most.wraps(std::ldexp(0.5, static_cast<int>(p_.word_bits - p_.fraction_bits)));
      for (const span_unit::Span& span : lines.spans)
        measure_line({static_cast<double>(span.line) - static_cast<double>(top),
                      span.column - static_cast<double>(t.corners[0].x) * unit_of(t),
                      span.line - static_cast<double>(t.corners[0].y) * unit_of(t)},
                     t.colour[c], most, span, c);
    }
    wrapped += leaves ? 1 : 0;
  }

  Measurement worst{"", "levels", 0.0, 0.0, BoundKind::proved};
  std::int64_t drawn = 0;       // that touch a line
  std::int64_t wrapped = 0;     // of them, whose slopes leave the word
  std::int64_t unpromised = 0;  // of them, of which nothing is said

 private:
  void measure_line(const Line& line, const QuadraticForm<double>& form, const Magnitudes& most,
                    const span_unit::Span& span, std::size_t channel) {
    const QuadraticForm<Extended> exact{form.t0, form.t1, form.t2, form.t3, form.t4, form.t5};
    const auto word_bits = static_cast<unsigned>(p_.word_bits);
    span_unit::ColourRegisters registers(word_bits);
    registers.load({span.i[channel], 0, span.di[channel], 0, 0, span.pixel_pixel[channel]});
    for (std::uint32_t x = 0; x < span.count; ++x) {
      const double shown =
          std::ldexp(static_cast<double>(sign_extend(registers.i(), word_bits)), -static_cast<int>(p_.fraction_bits)) -
          0.5;
      const Extended right = exact.at(static_cast<Extended>(line.x) + x, static_cast<Extended>(line.y));
      keep_worst(worst, std::fabs(static_cast<double>(shown - right)), bound(line, form, most, x));
      registers.step_pixel();
    }
  }

  // As published nothing is proved: it is held against what the lattice does with the same words.
  double bound(const Line& line, const QuadraticForm<double>& form, const Magnitudes& most, std::uint32_t pixel) const {
    const double run = pixel;
    const double steps = line.since_top + run;
    const double rounding = most.rounding(line.since_top, steps);
    if (p_.start_edge != StartEdge::prestep)
      return span_unit::fraction_bound(p_.fraction_bits, static_cast<std::uint64_t>(steps + line.since_top)) + rounding;
    const double slope = std::fabs(2 * form.t5 * line.x + form.t4 * line.y + form.t2);
    const double bend = std::fabs(form.t5);
    const double distance = std::ldexp(1.0, -static_cast<int>(p_.prestep_bits));
    return span_unit::fraction_bound(p_.fraction_bits, static_cast<std::uint64_t>(steps + 1)) + rounding +
           distance * (slope + bend * (3 + 2 * run)) + std::ldexp(2 + run, -static_cast<int>(p_.fraction_bits));
  }

  const quadratic::Machine& machine_;
  const Tampering& tampering_;
  SpanUnitParameters p_;
  span_unit::SpanUnit unit_;
};

class StartEdgeCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", "the catalogue's figures"});
    table.real("size_pixels", family_.size_pixels, {0.0, 16384.0},
               {"pixels", "The most that a triangle is wide or high; 0: as the screen.", "the catalogue's figures"});
    table.real("least_area_pixels", family_.least_area_pixels, {0.0, 1e8, true},
               {"square pixels", "Smaller triangles are not drawn.", "the catalogue's figures"});
    table.choice("knots", family_.knots, {"any", "extreme"},
                 {"", "The levels that a triangle goes through: any, or each 0 or 255.", "the catalogue's figures"});
  }
  std::string step(const run::Inputs::Content& /*machine*/) const override { return "span_unit.start_edge"; }
  double try_us(const run::Inputs::Content& /*machine*/) const override {
    const double side = family_.size_pixels > 0.0 ? family_.size_pixels : 512.0;
    return 1.0 + 0.007 * side * side;
  }

  Measured measure(Trial& trial) const override {
    const quadratic::Machine* machine = trial.span_machine();
    if (machine == nullptr) return {};
    Bench bench(*machine, trial.tampering);
    const std::int64_t tries = trial.tries_or(tries_);
    for (std::int64_t round = 0; round < tries; ++round)
      bench.measure(random_triangle(family_, *machine, trial.numbers));
    bench.worst.what =
        fmt::format("colours of {} triangles, {} of them with steps beyond their word", bench.drawn, bench.wrapped);
    bench.worst.inputs = bench.drawn - bench.unpromised;
    Measured found{{bench.worst}, {}};
    if (bench.unpromised > 0)
      found.notes.push_back(fmt::format(
          "nothing is proved of {} triangles: a prestep's products may wrap (span_unit.start_edge)", bench.unpromised));
    return found;
  }

 private:
  std::int64_t tries_ = 100;
  Family family_;
};

}  // namespace

std::unique_ptr<CaseKind> start_edge_case() { return std::make_unique<StartEdgeCase>(); }

}  // namespace rastertlm::analysis
