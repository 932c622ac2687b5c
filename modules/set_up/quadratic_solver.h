// The quadratic through six colours of a triangle, three at its corners and three half way between them (000/001,
// section 3). Templates over the number type: double, float, FixedNumber, Counted<...>.
#pragma once

#include <array>
#include <cmath>

#include "modules/set_up/fixed_number.h"
#include "modules/set_up/quadratic_form.h"
#include "src/geometry/counted.h"

namespace rastertlm::set_up {

// barycentric: one division a triangle, none where it could fail but by the triangle's area. published: the printed
// formulas, undefined where Y2 = 0 (erratum 1). published_swapped: the same with corners 2 and 3 exchanged where
// |Y2| < |Y3|.
enum class Solver { barycentric, published, published_swapped };

// Levels at the corners and at the middles of the edges between them.
template <class T>
struct SixColours {
  T i1{}, i2{}, i3{};
  T i12{}, i13{}, i23{};
};

// What the papers call C (000, section 3): C2 = 4 I12 - 3 I1 - I2 ...
template <class T>
struct Differences {
  T c2, c3, c12, c13, c23;
  explicit Differences(const SixColours<T>& i)
      : c2(T(4.0) * i.i12 - T(3.0) * i.i1 - i.i2),
        c3(T(4.0) * i.i13 - T(3.0) * i.i1 - i.i3),
        c12(i.i1 + i.i2 - T(2.0) * i.i12),
        c13(i.i1 + i.i3 - T(2.0) * i.i13),
        c23(T(4.0) * (i.i1 - i.i12 - i.i13 + i.i23)) {}
};

// What the channels of a triangle share, with corner 1 at the origin.
template <class T>
class BarycentricSolver {
 public:
  BarycentricSolver(const T& x2, const T& y2, const T& x3, const T& y3) {
    const T r = T(1.0) / (x2 * y3 - y2 * x3);
    a1_ = -x3 * r;
    a2_ = y3 * r;
    b1_ = x2 * r;
    b2_ = -y2 * r;
    a11_ = a1_ * a1_;
    a22_ = a2_ * a2_;
    b11_ = b1_ * b1_;
    b22_ = b2_ * b2_;
    ab1_ = a1_ * b1_;
    ab2_ = a2_ * b2_;
    ab12_ = a1_ * b2_ + a2_ * b1_;
    aa_ = T(2.0) * (a1_ * a2_);
    bb_ = T(2.0) * (b1_ * b2_);
  }

  QuadraticForm<T> solve(const SixColours<T>& colours) const {
    const Differences<T> c(colours);
    const T q2 = T(2.0) * c.c12;
    const T q3 = T(2.0) * c.c13;
    QuadraticForm<T> form;
    form.t0 = colours.i1;
    form.t1 = c.c2 * a1_ + c.c3 * b1_;
    form.t2 = c.c2 * a2_ + c.c3 * b2_;
    form.t5 = q2 * a22_ + c.c23 * ab2_ + q3 * b22_;
    form.t3 = q2 * a11_ + c.c23 * ab1_ + q3 * b11_;
    form.t4 = q2 * aa_ + c.c23 * ab12_ + q3 * bb_;
    return form;
  }

 private:
  T a1_, a2_, b1_, b2_;
  T a11_, a22_, b11_, b22_, ab1_, ab2_, ab12_, aa_, bb_;
};

// Linear, through the corners' colours alone (Gouraud).
template <class T>
class LinearSolver {
 public:
  LinearSolver(const T& x2, const T& y2, const T& x3, const T& y3) {
    const T r = T(1.0) / (x2 * y3 - y2 * x3);
    a1_ = -x3 * r;
    a2_ = y3 * r;
    b1_ = x2 * r;
    b2_ = -y2 * r;
  }
  QuadraticForm<T> solve(const T& i1, const T& i2, const T& i3) const {
    const T d2 = i2 - i1;
    const T d3 = i3 - i1;
    QuadraticForm<T> form;
    form.t0 = i1;
    form.t1 = d2 * a1_ + d3 * b1_;
    form.t2 = d2 * a2_ + d3 * b2_;
    return form;
  }

 private:
  T a1_, a2_, b1_, b2_;
};

// The printed formulas with their common terms computed once.
template <class T>
class PublishedSolver {
 public:
  PublishedSolver(const T& x2, const T& y2, const T& x3, const T& y3) : x2_(x2), y2_(y2), x3_(x3), y3_(y3) {}

  QuadraticForm<T> solve(const SixColours<T>& colours) const {
    const Differences<T> c(colours);
    const T area = x2_ * y3_ - y2_ * x3_;
    const T p = T(4.0) * c.c12 * y3_ - c.c23 * y2_;
    const T q = T(4.0) * c.c13 * y2_ - c.c23 * y3_;
    const T u = T(2.0) * x2_ * x2_ * y3_ - T(2.0) * x2_ * y2_ * x3_;
    const T v = T(2.0) * y2_ * x3_ * x3_ - T(2.0) * x2_ * x3_ * y3_;
    const T w = y2_ * x3_ * y3_ - x2_ * y3_ * y3_;
    const T z = x2_ * y2_ * y3_ - y2_ * y2_ * x3_;
    const T denominator = u * w - z * v;
    QuadraticForm<T> form;
    form.t0 = colours.i1;
    form.t1 = (c.c3 * x2_ - c.c2 * x3_) / area;
    form.t2 = (c.c2 * y3_ - c.c3 * y2_) / area;
    form.t5 = (p * w - q * z) / denominator;
    form.t4 = (q * u - p * v) / denominator;
    form.t3 = (T(2.0) * c.c12 - form.t5 * x2_ * x2_ - form.t4 * x2_ * y2_) / (y2_ * y2_);
    return form;
  }

 private:
  T x2_, y2_, x3_, y3_;
};

template <class T>
SixColours<T> exchanged(const SixColours<T>& c) {
  return {c.i1, c.i3, c.i2, c.i13, c.i12, c.i23};
}

inline double as_double(double value) { return value; }
inline double as_double(float value) { return static_cast<double>(value); }
template <class T>
double as_double(const geometry::Counted<T>& value) {
  return static_cast<double>(value.value());
}
template <int kFractionBits>
double as_double(const FixedNumber<kFractionBits>& value) {
  return value.to_double();
}

// Not so where a formula divides by zero or a number does not hold a result.
template <class T>
bool is_defined(const QuadraticForm<T>& form) {
  for (const T* t : {&form.t0, &form.t1, &form.t2, &form.t3, &form.t4, &form.t5})
    if (!std::isfinite(as_double(*t))) return false;
  return true;
}

// Offsets of corners 2 and 3 from corner 1, in pixels.
template <class T>
struct Offsets {
  T x2, y2, x3, y3;
};

// All channels of a triangle; the forms may be undefined (is_defined).
template <class T, std::size_t kCount>
void solve(Solver solver, const Offsets<T>& at, const std::array<SixColours<T>, kCount>& colours,
           std::array<QuadraticForm<T>, kCount>& forms) {
  if (solver == Solver::barycentric) {
    const BarycentricSolver<T> shared(at.x2, at.y2, at.x3, at.y3);
    for (std::size_t c = 0; c < kCount; ++c) forms[c] = shared.solve(colours[c]);
    return;
  }
  const auto size = [](const T& y) { return y < T(0.0) ? -y : y; };
  const bool exchange = solver == Solver::published_swapped && size(at.y2) < size(at.y3);
  const PublishedSolver<T> printed =
      exchange ? PublishedSolver<T>(at.x3, at.y3, at.x2, at.y2) : PublishedSolver<T>(at.x2, at.y2, at.x3, at.y3);
  for (std::size_t c = 0; c < kCount; ++c) forms[c] = printed.solve(exchange ? exchanged(colours[c]) : colours[c]);
}

template <class T, std::size_t kCount>
std::array<QuadraticForm<T>, kCount> solve(Solver solver, const Offsets<T>& at,
                                           const std::array<SixColours<T>, kCount>& colours) {
  std::array<QuadraticForm<T>, kCount> forms;
  solve(solver, at, colours, forms);
  return forms;
}

}  // namespace rastertlm::set_up
