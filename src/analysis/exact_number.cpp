#include "src/analysis/exact_number.h"

#include <cmath>
#include <cstdint>

namespace rastertlm::analysis {
namespace {

// pi / 180 in 113 bits: the decimal digits of pi in two parts that are exact in 113 bits together.
Quad radians_per_degree() {
  // 3.14159265358979323846264338327950288419716939937510 as a sum of integers over powers of ten.
  const Quad high = static_cast<Quad>(INT64_C(314159265358979323));  // 3.14159265358979323
  const Quad low = static_cast<Quad>(INT64_C(846264338327950288));   // the next 18 digits
  const Quad ten_17 = static_cast<Quad>(INT64_C(100000000000000000));
  const Quad ten_18 = static_cast<Quad>(INT64_C(1000000000000000000));
  const Quad rest = static_cast<Quad>(INT64_C(419716939937510582)) / ten_18;  // and the 18 after them
  return (high + (low + rest) / ten_18) / ten_17 / 180;
}

// Of -45 .. 45 degrees, in radians: the series ends below 2^-120.
Quad sine_series(Quad x) {
  Quad term = x, sum = 0;
  for (int k = 1; k < 60; k += 2) {
    sum += term;
    term *= -x * x / static_cast<Quad>((k + 1) * (k + 2));
  }
  return sum;
}
Quad cosine_series(Quad x) {
  Quad term = 1, sum = 0;
  for (int k = 0; k < 60; k += 2) {
    sum += term;
    term *= -x * x / static_cast<Quad>((k + 1) * (k + 2));
  }
  return sum;
}

// degrees = 90 quarter + rest, |rest| <= 45.
struct Reduced {
  int quarter;  // modulo 4
  Quad radians;
};
Reduced reduced(Quad degrees) {
  const auto turns = static_cast<std::int64_t>(degrees / 360);
  Quad rest = degrees - static_cast<Quad>(turns) * 360;
  int quarter = 0;
  while (rest > 45) {
    rest -= 90;
    ++quarter;
  }
  while (rest < -45) {
    rest += 90;
    --quarter;
  }
  return {((quarter % 4) + 4) % 4, rest * radians_per_degree()};
}

Quad quarter_sine(int quarter, Quad radians) {
  switch (quarter & 3) {
    case 0:
      return sine_series(radians);
    case 1:
      return cosine_series(radians);
    case 2:
      return -sine_series(radians);
    default:
      return -cosine_series(radians);
  }
}

}  // namespace

Quad square_root(Quad value) {
  if (!(value > 0)) return 0;
  Quad root = std::sqrt(static_cast<double>(value));
  for (int step = 0; step < 3; ++step) root = (root + value / root) / 2;  // 53 bits, then 106, then all
  return root;
}

Quad sine_deg(Quad degrees) {
  const Reduced at = reduced(degrees);
  return quarter_sine(at.quarter, at.radians);
}

Quad cosine_deg(Quad degrees) {
  const Reduced at = reduced(degrees);
  return quarter_sine(at.quarter + 1, at.radians);
}

}  // namespace rastertlm::analysis
