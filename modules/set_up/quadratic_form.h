// A colour that is quadratic on the screen (000/001, equation 4; here y points down).
#pragma once

namespace rastertlm::set_up {

// I(X, Y) = T5 X^2 + T4 X Y + T3 Y^2 + T2 X + T1 Y + T0 in levels, X and Y in pixels from an origin that is named
// beside it.
template <class T>
struct QuadraticForm {
  T t0{};
  T t1{};
  T t2{};
  T t3{};
  T t4{};
  T t5{};

  T at(const T& x, const T& y) const { return (t5 * x + t4 * y + t2) * x + (t3 * y + t1) * y + t0; }
};

}  // namespace rastertlm::set_up
