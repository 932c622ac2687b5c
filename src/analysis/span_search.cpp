#include "src/analysis/span_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "modules/set_up/quadratic_solver.h"
#include "modules/set_up/span_load.h"
#include "modules/span_unit/span_registers.h"
#include "modules/span_unit/span_unit.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

__extension__ using Quad = __float128;
using geometry::SnappedPoint;
using Levels = std::array<double, 6>;

template <class T>
set_up::QuadraticForm<double> solved_in(set_up::Solver solver, const std::array<double, 4>& at, const Levels& l) {
  const auto held = [](double value) { return static_cast<T>(value); };
  const set_up::Offsets<T> offsets{held(at[0]), held(at[1]), held(at[2]), held(at[3])};
  const set_up::SixColours<T> colours{held(l[0]), held(l[1]), held(l[2]), held(l[3]), held(l[4]), held(l[5])};
  const set_up::QuadraticForm<T> form = set_up::solve<T, 1>(solver, offsets, {colours})[0];
  return {static_cast<double>(form.t0), static_cast<double>(form.t1), static_cast<double>(form.t2),
          static_cast<double>(form.t3), static_cast<double>(form.t4), static_cast<double>(form.t5)};
}

class SpanSearch {
 public:
  SpanSearch(const quadratic::Machine& machine, Numbers& numbers, double altitude)
      : machine_(machine),
        numbers_(numbers),
        altitude_(altitude),
        unit_(machine.span_unit, static_cast<std::uint32_t>(machine.video.columns),
              static_cast<std::uint32_t>(machine.video.lines)) {
    triangle_.fraction_bits = machine.set_up.corner_bits();
    one_ = std::int64_t{1} << triangle_.fraction_bits;
  }

  void triangle(std::int64_t family) {
    do {
      choose_corners(family);
      area_ = geometry::doubled_area(triangle_.corners[0], triangle_.corners[1], triangle_.corners[2]);
    } while (area_ == 0);
    choose_colours(family % 2 == 0);
    ++seen_.triangles;
    look_at_solver();
    if (is_thin()) return;
    draw();
  }

  const SpanSeen& seen() const { return seen_; }

 private:
  SnappedPoint any_point() {
    return {numbers_.whole(0, (machine_.video.columns - 1) * one_),
            numbers_.whole(0, (machine_.video.lines - 1) * one_)};
  }

  void choose_corners(std::int64_t family) {
    auto& [a, b, c] = triangle_.corners;
    a = any_point();
    b = any_point();
    c = any_point();
    if (family % 3 == 1)
      b.y = std::clamp<std::int64_t>(a.y + numbers_.whole(-2, 2), 0, (machine_.video.lines - 1) * one_);
    if (family % 3 != 2) return;
    if (family % 6 == 2) return make_thinnest();
    const double t = numbers_.uniform(0, 1);
    const std::int64_t off = 4 * one_;
    c = {round_half_up(static_cast<double>(a.x) + t * static_cast<double>(b.x - a.x)) + numbers_.whole(-off, off),
         round_half_up(static_cast<double>(a.y) + t * static_cast<double>(b.y - a.y)) + numbers_.whole(-off, off)};
    c.x = std::clamp<std::int64_t>(c.x, 0, (machine_.video.columns - 1) * one_);
    c.y = std::clamp<std::int64_t>(c.y, 0, (machine_.video.lines - 1) * one_);
  }

  // A few grid squares of doubled area, from one side of the screen to the other: of sides that have no common divisor,
  // Euclid's algorithm finds the corner whose cross product with them is 1. Areas that have an exact reciprocal are
  // harmless.
  void make_thinnest() {
    const std::int64_t width = (machine_.video.columns - 1) * one_ - numbers_.whole(0, 64);
    std::int64_t height = (machine_.video.lines - 1) * one_ - numbers_.whole(0, 64);
    while (std::gcd(width, height) != 1) --height;
    std::int64_t r0 = width, r1 = height, s0 = 1, s1 = 0;
    while (r1 != 0) {
      const std::int64_t quotient = r0 / r1;
      r0 = std::exchange(r1, r0 - quotient * r1);
      s0 = std::exchange(s1, s0 - quotient * s1);
    }
    const std::int64_t area = 1 + 2 * numbers_.whole(0, 3);  // width * y - height * x of the third corner
    const std::int64_t y = (area * s0 % height + height) % height;
    triangle_.corners = {SnappedPoint{0, 0}, SnappedPoint{width, height}, SnappedPoint{(width * y - area) / height, y}};
    if (triangle_.corners[2].x < 0) triangle_.corners[2] = {width, 0};
    if (numbers_.whole(0, 1) == 0) std::swap(triangle_.corners[0], triangle_.corners[2]);
  }

  double pixels(std::int64_t steps) const { return static_cast<double>(steps) / static_cast<double>(one_); }

  bool is_thin() const {
    const auto& [a, b, c] = triangle_.corners;
    const auto side = [&](const SnappedPoint& p, const SnappedPoint& q) {
      return std::hypot(pixels(q.x - p.x), pixels(q.y - p.y));
    };
    const double longest = std::max({side(a, b), side(b, c), side(c, a)});
    return std::fabs(static_cast<double>(area_)) / static_cast<double>(one_ * one_) / longest < altitude_;
  }

  void choose_colours(bool extreme) {
    for (double& level : levels_)
      level = static_cast<double>(extreme ? 255 * numbers_.whole(0, 1) : numbers_.whole(0, 255));
    const auto& [a, b, c] = triangle_.corners;
    const std::array<double, 4> at{pixels(b.x - a.x), pixels(b.y - a.y), pixels(c.x - a.x), pixels(c.y - a.y)};
    if (machine_.set_up.linear()) {
      for (std::size_t i = 0; i < 3; ++i) levels_[3 + i] = (levels_[i == 2 ? 1 : 0] + levels_[i == 0 ? 1 : 2]) / 2;
      form_ = set_up::LinearSolver<double>(at[0], at[1], at[2], at[3]).solve(levels_[0], levels_[1], levels_[2]);
    } else if (machine_.set_up.arithmetic == set_up::SetUpArithmetic::single_precision) {
      form_ = solved_in<float>(machine_.set_up.solver, at, levels_);
    } else {
      form_ = solved_in<double>(machine_.set_up.solver, at, levels_);
    }
    for (auto& channel : triangle_.colour) channel = form_;
    const double farthest = std::ldexp(1.0, static_cast<int>(machine_.span_unit.depth_bits)) - 2;
    for (double& depth : triangle_.depth) depth = numbers_.uniform(1, farthest);
  }

  // Of barycentric v and w.
  Quad exact(Quad v, Quad w) const {
    const Quad u = 1 - v - w;
    return u * (2 * u - 1) * levels_[0] + v * (2 * v - 1) * levels_[1] + w * (2 * w - 1) * levels_[2] +
           4 * (u * v * levels_[3] + u * w * levels_[4] + v * w * levels_[5]);
  }

  // From corner 1, in pixels.
  Quad form_at(Quad x, Quad y) const {
    return static_cast<Quad>(form_.t0) + form_.t1 * y + form_.t2 * x + form_.t3 * y * y + form_.t4 * x * y +
           form_.t5 * x * x;
  }

  void look_at_solver() {
    if (!set_up::is_defined(form_)) return;
    constexpr int kParts = 4;
    const auto& [a, b, c] = triangle_.corners;
    double worst = 0.0;
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; i + j <= kParts; ++j) {
        const Quad v = static_cast<Quad>(i) / kParts, w = static_cast<Quad>(j) / kParts;
        const Quad x = v * pixels(b.x - a.x) + w * pixels(c.x - a.x);
        const Quad y = v * pixels(b.y - a.y) + w * pixels(c.y - a.y);
        worst = std::max(worst, std::fabs(static_cast<double>(form_at(x, y) - exact(v, w))));
      }
    double& seen = is_thin() ? seen_.thin_solved : seen_.solved;
    seen = std::max(seen, worst);
  }

  // Twice the areas against corners 2 and 3, and whether the sample is inside; left and top edges are.
  struct Place {
    std::int64_t v, w;
    bool inside;
  };
  Place place_of(std::int64_t column, std::int64_t line) const {
    const SnappedPoint s{column * one_, line * one_};
    const std::int64_t sign = area_ < 0 ? -1 : 1;
    Place place{0, 0, true};
    for (std::size_t e = 0; e < 3; ++e) {
      const SnappedPoint &from = triangle_.corners[e], &to = triangle_.corners[(e + 1) % 3];
      const std::int64_t value = sign * geometry::doubled_area(from, to, s);
      const std::int64_t down = sign * (to.y - from.y), right = sign * (to.x - from.x);
      const bool left_or_top = down < 0 || (down == 0 && right > 0);
      place.inside = place.inside && (value > 0 || (value == 0 && left_or_top));
      if (e == 2) place.v = value;
      if (e == 0) place.w = value;
    }
    return place;
  }

  void draw() {
    const span_unit::TriangleLoad load =
        set_up::span_load(triangle_, set_up::SpanFormat::of(machine_.span_unit, machine_.video.lines));
    if (load.count == 0 || load.wraps) return;
    for (const span_unit::Span& span : unit_.draw(load).spans) {
      const std::int64_t first = span.column, end = first + span.count;
      for (const std::int64_t column : {first - 1, first, end - 1, end}) {
        if (column < 0 || column >= machine_.video.columns) continue;
        ++seen_.ends;
        const bool covered = column >= first && column < end;
        seen_.wrong += place_of(column, span.line).inside == covered ? 0.0 : 1.0;
      }
      if (span.count > 0 && set_up::is_defined(form_)) look_along(span);
    }
  }

  void look_along(const span_unit::Span& span) {
    const auto word_bits = static_cast<unsigned>(machine_.span_unit.word_bits);
    const auto fraction_bits = static_cast<unsigned>(machine_.span_unit.fraction_bits);
    span_unit::ColourRegisters registers(word_bits);
    registers.load({span.i[0], 0, span.di[0], 0, 0, span.pixel_pixel[0]});
    const auto at =
        static_cast<std::uint32_t>(numbers_.whole(0, 3) == 0 ? numbers_.whole(0, span.count - 1) : span.count - 1);
    for (std::uint32_t i = 0; i < at; ++i) registers.step_pixel();
    const std::int64_t column = span.column + at;
    const Place place = place_of(column, span.line);
    const Quad area = static_cast<Quad>(std::llabs(area_));
    const Quad v = place.v / area, w = place.w / area;
    const Quad form = form_at(pixels(column * one_ - triangle_.corners[0].x),
                              pixels(static_cast<std::int64_t>(span.line) * one_ - triangle_.corners[0].y));
    const double shown =
        std::ldexp(static_cast<double>(sign_extend(registers.i(), word_bits)), -static_cast<int>(fraction_bits)) - 0.5;
    ++seen_.samples;
    seen_.registers = std::max(seen_.registers, std::fabs(shown - static_cast<double>(form)));
    const double level = span_unit::level_of(registers.i(), word_bits, fraction_bits);
    seen_.rounded = std::max(seen_.rounded, std::fabs(level - std::clamp(shown, 0.0, 255.0)));
    const double wanted = std::clamp(static_cast<double>(exact(v, w)), 0.0, 255.0);
    seen_.level = std::max(seen_.level, std::fabs(level - wanted));
    look_at_depth(span, at, v, w);
  }

  void look_at_depth(const span_unit::Span& span, std::uint32_t at, Quad v, Quad w) {
    const auto& p = machine_.span_unit;
    const auto bits = static_cast<unsigned>(p.depth_bits + p.depth_fraction_bits);
    const std::uint64_t word = (span.i[span_unit::kDepthSet] + at * span.di[span_unit::kDepthSet]) & low_mask(bits);
    const auto shown = static_cast<double>(word >> p.depth_fraction_bits);
    const Quad depth = triangle_.depth[0] + v * (triangle_.depth[1] - triangle_.depth[0]) +
                       w * (triangle_.depth[2] - triangle_.depth[0]);
    seen_.depth = std::max(seen_.depth, std::fabs(static_cast<double>(shown - depth)));
  }

  const quadratic::Machine& machine_;
  Numbers& numbers_;
  double altitude_;
  span_unit::SpanUnit unit_;
  set_up::ColourTriangle triangle_;
  std::int64_t one_ = 1;
  std::int64_t area_ = 0;
  Levels levels_{};
  set_up::QuadraticForm<double> form_;
  SpanSeen seen_;
};

}  // namespace

SpanSeen search_spans(const quadratic::Machine& machine, Numbers& numbers, std::int64_t triangles, double altitude) {
  SpanSearch search(machine, numbers, altitude);
  for (std::int64_t i = 0; i < triangles; ++i) search.triangle(i);
  return search.seen();
}

double longest_path_error(const span_unit::SpanUnitParameters& parameters, std::uint64_t steps) {
  // A constant of half a place is 0 or 1 in its word; 64 bits hold what adds up.
  constexpr unsigned kWide = 64;
  const auto lines = static_cast<std::int64_t>(steps / 2), pixels = static_cast<std::int64_t>(steps) - lines;
  const std::int64_t halves = 1 + lines + pixels + lines * (lines - 1) / 2 + lines * pixels + pixels * (pixels - 1) / 2;
  double worst = 0.0;
  for (const std::uint64_t word : {std::uint64_t{0}, std::uint64_t{1}}) {
    span_unit::ColourRegisters registers(kWide);
    registers.load({word, word, word, word, word, word});
    for (std::int64_t i = 0; i < lines; ++i) registers.step_line(false);
    for (std::int64_t i = 0; i < pixels; ++i) registers.step_pixel();
    const double off = static_cast<double>(registers.i()) - 0.5 * static_cast<double>(halves);
    worst = std::max(worst, std::fabs(off));
  }
  return std::ldexp(worst, -static_cast<int>(parameters.fraction_bits));
}

}  // namespace rastertlm::analysis
