// Levels are whole, so that the differences of equation 6 are exact in any of the numbers. u is half of the last place
// of 1 (floating point), h half of the last place (fixed point). D = x2 y3 - y2 x3.
//
// What all of a1, a2, b1, b2 share is the reciprocal of D, off by a part eta: it moves the point (v, w) at which the
// quadratic is taken to (1 + eta)(v, w), however thin the triangle is. That makes eta |linear part| + (2 eta + eta^2)
// |quadratic part|, which does not grow with the aspect. What is left are the roundings of each product and sum, which
// count with the terms' absolute values and grow with the aspect's square.
//
// Floating point. D is off by a part of at most k u + u, with k = (|x2 y3| + |y2 x3|) / |D|, so its reciprocal by
// eta = (e + u) / (1 - e), e = (k u + u) / (1 - u). At most 7 roundings in a row are left: gamma(7) sum |term| |x^i
// y^j|.
//
// Fixed point. Products and quotients are off by h, sums by nothing, products with whole levels by nothing. So D by
// 2 h, its reciprocal by h + 2 h / (|D| (|D| - 2 h)): eta = |D| h + 2 h / (|D| - 2 h). With A = (1 + eta) |a|, each of
// a1 .. b2 is off by h beyond what it shares, a product of two of them by (A + B) h + h^2 + h. The coefficients T are
// sums of these with whole factors. Every one of these numbers must stay inside the word, or there is no result.
#include "src/analysis/solver_bound.h"

#include <algorithm>
#include <cmath>

namespace rastertlm::analysis {
namespace {

using set_up::Offsets;
using set_up::QuadraticForm;

constexpr double kOfThisSum = 1 + 1e-9;  // these bounds are themselves sums in double

double error_beside(const QuadraticForm<double>& form, const Offsets<double>& at, const Weights& p, Quad level) {
  if (!set_up::is_defined(form)) return kInfinite;
  const QuadraticForm<Quad> exact{form.t0, form.t1, form.t2, form.t3, form.t4, form.t5};
  const Quad v = p.v, w = p.w;
  const double off = to_double(exact.at(v * at.x2 + w * at.x3, v * at.y2 + w * at.y3) - level);
  return std::isnan(off) ? kInfinite : std::fabs(off);
}

double determinant(const Offsets<double>& at) {
  return std::fabs(to_double(static_cast<Quad>(at.x2) * at.y3 - static_cast<Quad>(at.y2) * at.x3));
}

// Absolute values of what the solver computes with.
struct Magnitudes {
  double d, a1, a2, b1, b2, c2, c3, q2, q3, c23, x, y;
  double common;  // of the linear part at the point, all terms with their absolute values; of the quadratic one
  double bent;

  Magnitudes(const Offsets<double>& at, const Levels& levels, const Weights& p) : d(determinant(at)) {
    const set_up::Differences<double> c(six<double>(levels));
    a1 = std::fabs(at.x3) / d;
    a2 = std::fabs(at.y3) / d;
    b1 = std::fabs(at.x2) / d;
    b2 = std::fabs(at.y2) / d;
    c2 = std::fabs(c.c2);
    c3 = std::fabs(c.c3);
    q2 = std::fabs(2 * c.c12);
    q3 = std::fabs(2 * c.c13);
    c23 = std::fabs(c.c23);
    x = std::fabs(p.v * at.x2 + p.w * at.x3);
    y = std::fabs(p.v * at.y2 + p.w * at.y3);
    common = c2 * p.v + c3 * p.w;
    bent = q2 * p.v * p.v + c23 * p.v * p.w + q3 * p.w * p.w;
  }
  double shared(double eta) const { return eta * common + (2 * eta + eta * eta) * bent; }
};

// The part by which a reciprocal of the determinant may be off; infinite where nothing is known of it.
double floating_eta(const Offsets<double>& at, double d, double u) {
  const double k = (std::fabs(at.x2 * at.y3) + std::fabs(at.y2 * at.x3)) / d;
  const double e = (k * u + u) / (1 - u);
  return e < 0.5 ? (e + u) / (1 - e) : kInfinite;
}

bool leaves_word(const Offsets<double>& at, const Magnitudes& m, double eta, double most) {
  const double one = 1 + eta;
  const double a1 = one * m.a1 + 1, a2 = one * m.a2 + 1, b1 = one * m.b1 + 1, b2 = one * m.b2 + 1;
  const double products =
      std::max({a1 * a1, a2 * a2, b1 * b1, b2 * b2, 2 * a1 * a2, 2 * b1 * b2, a1 * b1 + a2 * b2, a1 * b2 + a2 * b1});
  const double sums = (m.c2 + m.c3 + m.q2 + m.q3 + m.c23 + 4 * 4 * 255) * std::max({products, a1, a2, b1, b2, 1.0});
  const double corners = std::fabs(at.x2 * at.y3) + std::fabs(at.y2 * at.x3) + 1;
  return !(std::max({sums, corners, one / m.d + 1}) < most / 2);
}

}  // namespace

double error_of(const QuadraticForm<double>& form, const Offsets<double>& at, const Levels& levels, const Weights& p) {
  const Quad v = p.v, w = p.w, u = 1 - v - w;
  const Quad level = u * (2 * u - 1) * levels[0] + v * (2 * v - 1) * levels[1] + w * (2 * w - 1) * levels[2] +
                     4 * (u * v * levels[3] + u * w * levels[4] + v * w * levels[5]);
  return error_beside(form, at, p, level);
}

double linear_error_of(const QuadraticForm<double>& form, const Offsets<double>& at, const Levels& levels,
                       const Weights& p) {
  const Quad v = p.v, w = p.w;
  return error_beside(form, at, p, (1 - v - w) * levels[0] + v * levels[1] + w * levels[2]);
}

double floating_bound(const Offsets<double>& at, const Levels& levels, const Weights& p, double u) {
  const Magnitudes m(at, levels, p);
  const double eta = floating_eta(at, m.d, u);
  if (std::isinf(eta)) return kInfinite;
  const double linear = m.c2 * (m.a1 * m.y + m.a2 * m.x) + m.c3 * (m.b1 * m.y + m.b2 * m.x);
  const double square =
      (m.q2 * m.a2 * m.a2 + m.c23 * m.a2 * m.b2 + m.q3 * m.b2 * m.b2) * m.x * m.x +
      (m.q2 * m.a1 * m.a1 + m.c23 * m.a1 * m.b1 + m.q3 * m.b1 * m.b1) * m.y * m.y +
      (2 * m.q2 * m.a1 * m.a2 + m.c23 * (m.a1 * m.b2 + m.a2 * m.b1) + 2 * m.q3 * m.b1 * m.b2) * m.x * m.y;
  const double gamma = 7 * u / (1 - 7 * u);
  return (gamma * (linear + square) * (1 + eta) * (1 + eta) + m.shared(eta)) * kOfThisSum;
}

double floating_linear_bound(const Offsets<double>& at, const Levels& levels, const Weights& p, double u) {
  const double d = determinant(at);
  const double eta = floating_eta(at, d, u);
  if (std::isinf(eta)) return kInfinite;
  const double d2 = std::fabs(levels[1] - levels[0]), d3 = std::fabs(levels[2] - levels[0]);
  const double x = std::fabs(p.v * at.x2 + p.w * at.x3), y = std::fabs(p.v * at.y2 + p.w * at.y3);
  const double terms =
      (d2 * (std::fabs(at.x3) * y + std::fabs(at.y3) * x) + d3 * (std::fabs(at.x2) * y + std::fabs(at.y2) * x)) / d;
  const double gamma = 3 * u / (1 - 3 * u);  // of an offset by the reciprocal, of that by a difference, of the sum
  return (gamma * terms * (1 + eta) + eta * (d2 * p.v + d3 * p.w)) * kOfThisSum;
}

double fixed_bound(const Offsets<double>& at, const Levels& levels, const Weights& p, int fraction_bits) {
  const double h = std::ldexp(1.0, -fraction_bits - 1);
  const Magnitudes m(at, levels, p);
  if (!(m.d > 4 * h)) return kInfinite;
  const double eta = m.d * h + 2 * h / (m.d - 2 * h);
  if (leaves_word(at, m, eta, std::ldexp(1.0, 63 - fraction_bits))) return kInfinite;
  const double a1 = (1 + eta) * m.a1, a2 = (1 + eta) * m.a2, b1 = (1 + eta) * m.b1, b2 = (1 + eta) * m.b2;
  const auto product = [h](double a, double b) { return (a + b) * h + h * h + h; };
  const double t1 = (m.c2 + m.c3) * h, t2 = t1;
  const double t5 = m.q2 * product(a2, a2) + m.c23 * product(a2, b2) + m.q3 * product(b2, b2);
  const double t3 = m.q2 * product(a1, a1) + m.c23 * product(a1, b1) + m.q3 * product(b1, b1);
  const double t4 =
      2 * m.q2 * product(a1, a2) + m.c23 * (product(a1, b2) + product(a2, b1)) + 2 * m.q3 * product(b1, b2);
  return (t1 * m.y + t2 * m.x + t3 * m.y * m.y + t4 * m.x * m.y + t5 * m.x * m.x + m.shared(eta)) * kOfThisSum;
}

}  // namespace rastertlm::analysis
