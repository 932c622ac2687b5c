// Duff's quotient (1979) and Bishop and Weimer's series of it (1986): a dot product of a constant vector and the unit
// normal along a span, where the normal itself is linear on the screen, N = A x + B y + C:
//   (a x + b y + c) / sqrt(d x^2 + e x y + f y^2 + g x + h y + i),  a = L.A  b = L.B  c = L.C,
//   d = A.A  e = 2 A.B  f = B.B  g = 2 A.C  h = 2 B.C  i = C.C
#pragma once

#include <vector>

#include "modules/pixel_unit/attribute_plane.h"
#include "modules/set_up/quadratic_form.h"

namespace rastertlm::pixel_unit {

// A quadratic along a line, by two additions a pixel.
template <class T>
class QuadraticSteps {
 public:
  // I = T5 x^2 + T4 x y + T3 y^2 + T2 x + T1 y + T0 at (x, y), and from there to the right.
  void begin(const set_up::QuadraticForm<T>& form, const T& x, const T& y) {
    const T along = form.t5 * x + form.t4 * y + form.t2;
    value_ = along * x + (form.t3 * y + form.t1) * y + form.t0;
    step_ = along + form.t5 * x + form.t5;
    second_ = form.t5 + form.t5;
  }
  void step() {
    value_ += step_;
    step_ += second_;
  }
  const T& value() const { return value_; }

 private:
  T value_{};
  T step_{};
  T second_{};
};

// |N|^2.
template <class T>
set_up::QuadraticForm<T> square_of(const Plane<Vector3<T>>& normal) {
  using geometry::dot;
  const auto twice = [](const T& value) { return value + value; };
  set_up::QuadraticForm<T> square;
  square.t5 = dot(normal.across, normal.across);
  square.t4 = twice(dot(normal.across, normal.down));
  square.t3 = dot(normal.down, normal.down);
  square.t2 = twice(dot(normal.across, normal.start));
  square.t1 = twice(dot(normal.down, normal.start));
  square.t0 = dot(normal.start, normal.start);
  return square;
}

// Vector . N.
template <class T>
Plane<T> product_of(const Plane<Vector3<T>>& normal, const Vector3<T>& vector) {
  return {geometry::dot(normal.across, vector), geometry::dot(normal.down, vector),
          geometry::dot(normal.start, vector)};
}

// Of a triangle: all its dot products share the root.
template <class T>
class Quotients {
 public:
  void set_up(const Plane<Vector3<T>>& normal, const std::vector<Vector3<T>>& vectors) {
    square_ = square_of(normal);
    numerators_.clear();
    for (const Vector3<T>& vector : vectors) numerators_.push_back(product_of(normal, vector));
    along_.resize(vectors.size());
  }
  void begin_line(const T& x, const T& y) {
    square_along_.begin(square_, x, y);
    for (std::size_t k = 0; k < along_.size(); ++k) along_[k] = value_at(numerators_[k], x, y);
  }
  void step() {
    square_along_.step();
    for (std::size_t k = 0; k < along_.size(); ++k) along_[k] += numerators_[k].across;
  }
  // False where the normal vanishes.
  bool dots(std::vector<T>& dots) const {
    if (!(square_along_.value() > T(0.0))) return false;
    const T length = geometry::square_root(square_along_.value());
    for (std::size_t k = 0; k < along_.size(); ++k) dots[k] = along_[k] / length;
    return true;
  }

 private:
  set_up::QuadraticForm<T> square_;
  std::vector<Plane<T>> numerators_;
  QuadraticSteps<T> square_along_;
  std::vector<T> along_;
};

// The same quotient to second order about (0, 0); `product` and `square` are those of the plane there, square.t0 > 0.
// With q = sqrt(i), m = c / i: T0 = c / q, T1 = (b - m h / 2) / q, T3 = (3 m h^2 / i / 4 - m f - b h / i) / 2 q, and so
// on: the published forms, divided out.
template <class T>
set_up::QuadraticForm<T> series_of(const Plane<T>& product, const set_up::QuadraticForm<T>& square, const T& inverse,
                                   const T& inverse_root) {
  const T m = product.start * inverse;
  const T a = product.across, b = product.down;
  const T g = square.t2 * inverse, h = square.t1 * inverse;  // of i
  const T half = inverse_root * T(0.5);
  const T three_m = T(0.75) * product.start;
  set_up::QuadraticForm<T> form;
  form.t0 = product.start * inverse_root;
  form.t1 = (b + b - product.start * h) * half;
  form.t2 = (a + a - product.start * g) * half;
  form.t3 = (three_m * h * h - m * square.t3 - b * h) * half;
  form.t4 = ((three_m + three_m) * g * h - m * square.t4 - b * g - a * h) * half;
  form.t5 = (three_m * g * g - m * square.t5 - a * g) * half;
  return form;
}

// Of a triangle, about its centre.
template <class T>
class Series {
 public:
  // `normal` is about corner 0. False where the normal vanishes in the centre: there is no series then, and the
  // triangle is drawn as if it had no normal.
  bool set_up(const Plane<Vector3<T>>& normal, const T& centre_x, const T& centre_y,
              const std::vector<Vector3<T>>& vectors) {
    centre_x_ = centre_x;
    centre_y_ = centre_y;
    Plane<Vector3<T>> about = normal;
    about.start = value_at(normal, centre_x, centre_y);
    const set_up::QuadraticForm<T> square = square_of(about);
    forms_.clear();
    along_.resize(vectors.size());
    defined_ = square.t0 > T(0.0);
    if (!defined_) return false;
    const T inverse_root = T(1.0) / geometry::square_root(square.t0);
    const T inverse = inverse_root * inverse_root;
    for (const Vector3<T>& vector : vectors)
      forms_.push_back(series_of(product_of(about, vector), square, inverse, inverse_root));
    return true;
  }
  void begin_line(const T& x, const T& y) {
    if (!defined_) return;
    const T from_x = x - centre_x_, from_y = y - centre_y_;
    for (std::size_t k = 0; k < along_.size(); ++k) along_[k].begin(forms_[k], from_x, from_y);
  }
  void step() {
    if (!defined_) return;
    for (QuadraticSteps<T>& one : along_) one.step();
  }
  bool dots(std::vector<T>& dots) const {
    if (!defined_) return false;
    for (std::size_t k = 0; k < along_.size(); ++k) dots[k] = along_[k].value();
    return true;
  }
  const set_up::QuadraticForm<T>& form(std::size_t k) const { return forms_[k]; }

 private:
  T centre_x_{};
  T centre_y_{};
  bool defined_ = false;
  std::vector<set_up::QuadraticForm<T>> forms_;
  std::vector<QuadraticSteps<T>> along_;
};

}  // namespace rastertlm::pixel_unit
