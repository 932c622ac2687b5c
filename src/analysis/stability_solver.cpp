// The quadratic through six colours, in the numbers of the set-up processor, beside a running error bound.
//
// Levels are whole, so that the differences of equation 6 are exact. The determinant D = x2 y3 - y2 x3 is off by a part
// of at most k u + u, with k = (|x2 y3| + |y2 x3|) / |D| and u half of the last place, so its reciprocal by
// eta = (e + u) / (1 - e), e = (k u + u) / (1 - u). All of a1, a2, b1, b2 share that part: it moves the point (v, w) at
// which the quadratic is taken to (1 + eta)(v, w), however thin the triangle is. What is left are the roundings of each
// product and sum, at most 7 in a row, each of which counts with the terms' absolute values: gamma(7) of
// sum |term| |x^i y^j|, which grows with the aspect's square.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "modules/set_up/quadratic_solver.h"
#include "src/analysis/stability_cores.h"

namespace rastertlm::analysis {
namespace {

__extension__ using Quad = __float128;
using set_up::Offsets;
using set_up::QuadraticForm;
using set_up::SixColours;
using Levels = std::array<double, 6>;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kParts = 4;  // points in fourths of v and w: exact in any of the numbers

template <class T>
SixColours<T> six(const Levels& levels) {
  const auto at = [&](std::size_t i) { return T(levels[i]); };
  return {at(0), at(1), at(2), at(3), at(4), at(5)};
}

struct Point {
  double v, w;
};

// |form - the quadratic through the levels| at the point, the form's coefficients taken as they are.
template <class T>
double error_of(const QuadraticForm<T>& form, const Offsets<double>& at, const Levels& levels, const Point& p) {
  if (!set_up::is_defined(form)) return kInfinite;
  const QuadraticForm<Quad> exact{static_cast<Quad>(form.t0), static_cast<Quad>(form.t1), static_cast<Quad>(form.t2),
                                  static_cast<Quad>(form.t3), static_cast<Quad>(form.t4), static_cast<Quad>(form.t5)};
  const Quad v = p.v, w = p.w, u = 1 - v - w;
  const Quad level = u * (2 * u - 1) * levels[0] + v * (2 * v - 1) * levels[1] + w * (2 * w - 1) * levels[2] +
                     4 * (u * v * levels[3] + u * w * levels[4] + v * w * levels[5]);
  const double off = static_cast<double>(exact.at(v * at.x2 + w * at.x3, v * at.y2 + w * at.y3) - level);
  return std::isnan(off) ? kInfinite : std::fabs(off);
}

// The bound of the head of this file; `u` half of the last place. Infinite where D has no digit that is right.
double bound_of(const Offsets<double>& at, const Levels& levels, const Point& p, double u) {
  const double area =
      std::fabs(static_cast<double>(static_cast<Quad>(at.x2) * at.y3 - static_cast<Quad>(at.y2) * at.x3));
  const double k = (std::fabs(at.x2 * at.y3) + std::fabs(at.y2 * at.x3)) / area;
  const double e = (k * u + u) / (1 - u);
  if (!(e < 0.5)) return kInfinite;
  const double eta = (e + u) / (1 - e);
  const set_up::Differences<double> c(six<double>(levels));
  const double a1 = std::fabs(at.x3) / area, a2 = std::fabs(at.y3) / area;
  const double b1 = std::fabs(at.x2) / area, b2 = std::fabs(at.y2) / area;
  const double q2 = std::fabs(2 * c.c12), q3 = std::fabs(2 * c.c13), c23 = std::fabs(c.c23);
  const double x = std::fabs(p.v * at.x2 + p.w * at.x3), y = std::fabs(p.v * at.y2 + p.w * at.y3);
  const double linear = std::fabs(c.c2) * (a1 * y + a2 * x) + std::fabs(c.c3) * (b1 * y + b2 * x);
  const double square = (q2 * a2 * a2 + c23 * a2 * b2 + q3 * b2 * b2) * x * x +
                        (q2 * a1 * a1 + c23 * a1 * b1 + q3 * b1 * b1) * y * y +
                        (2 * q2 * a1 * a2 + c23 * (a1 * b2 + a2 * b1) + 2 * q3 * b1 * b2) * x * y;
  const double gamma = 7 * u / (1 - 7 * u);
  const double common = std::fabs(c.c2) * p.v + std::fabs(c.c3) * p.w;
  const double bent = q2 * p.v * p.v + c23 * p.v * p.w + q3 * p.w * p.w;
  // (1 + eta)^2 on what rounding leaves; 1e-9 for this sum itself, in double.
  return (gamma * (linear + square) * (1 + eta) * (1 + eta) + eta * common + (2 * eta + eta * eta) * bent) * (1 + 1e-9);
}

// Random, of the case's family: corners 2 and 3 from corner 1. In `T` they are exact.
template <class T>
Offsets<double> triangle(const HardCase& c, Numbers& numbers) {
  const auto held = [](double value) { return static_cast<double>(static_cast<T>(value)); };
  const auto any = [&] { return numbers.uniform(-c.size_pixels, c.size_pixels); };
  Offsets<double> at{any(), any(), any(), any()};
  if (c.family == TriangleFamily::level) at.y2 = 0.0;
  if (c.family == TriangleFamily::near_level) at.y2 = at.y2 < 0 ? -c.height_pixels : c.height_pixels;
  if (c.family == TriangleFamily::sliver) {
    const double part = numbers.uniform(0.2, 0.8), length = std::hypot(at.x2, at.y2);
    const double height = length / c.aspect;
    at.x3 = part * at.x2 - at.y2 / length * height;
    at.y3 = part * at.y2 + at.x2 / length * height;
  }
  return {held(at.x2), held(at.y2), held(at.x3), held(at.y3)};
}

bool is_of_family(const HardCase& c, const Offsets<double>& at) {
  const double area = std::fabs(at.x2 * at.y3 - at.y2 * at.x3);
  const double longest =
      std::max({std::hypot(at.x2, at.y2), std::hypot(at.x3, at.y3), std::hypot(at.x3 - at.x2, at.y3 - at.y2)});
  if (c.family == TriangleFamily::sliver) return area > 0.0;
  return area > 0.2 * longest * longest;
}

template <class T>
Measurement measure(const HardCase& c, set_up::Solver solver, Numbers& numbers, std::int64_t tries) {
  Measurement worst{"", "levels", 0.0, 0.0, BoundKind::proved};
  const double u = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2;
  for (std::int64_t round = 0; round < tries; ++round) {
    Offsets<double> at = triangle<T>(c, numbers);
    while (!is_of_family(c, at)) at = triangle<T>(c, numbers);
    Levels levels{};
    for (double& level : levels) level = static_cast<double>(numbers.whole(0, 255));
    const Offsets<T> corners{static_cast<T>(at.x2), static_cast<T>(at.y2), static_cast<T>(at.x3),
                             static_cast<T>(at.y3)};
    const QuadraticForm<T> form = set_up::solve<T, 1>(solver, corners, {six<T>(levels)})[0];
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; i + j <= kParts; ++j) {
        const Point p{static_cast<double>(i) / kParts, static_cast<double>(j) / kParts};
        if (i + j > 0) keep_worst(worst, error_of(form, at, levels, p), bound_of(at, levels, p, u));
      }
  }
  return worst;
}

}  // namespace

std::vector<Measurement> measure_solver(const HardCase& c, const quadratic::Machine& machine, Numbers& numbers,
                                        std::int64_t tries) {
  if (machine.set_up.arithmetic == set_up::SetUpArithmetic::fixed) return {};
  const bool single = machine.set_up.arithmetic == set_up::SetUpArithmetic::single_precision;
  Measurement worst = single ? measure<float>(c, machine.set_up.solver, numbers, tries)
                             : measure<double>(c, machine.set_up.solver, numbers, tries);
  worst.what = fmt::format("triangles of {} pixels in {} bits", c.size_pixels, single ? 32 : 64);
  return {worst};
}

}  // namespace rastertlm::analysis
