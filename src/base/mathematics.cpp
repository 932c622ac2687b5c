#include "src/base/mathematics.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rastertlm::mathematics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// An unevaluated sum with |low| <= ulp(high) / 2: about 106 bits.
struct Twofold {
  double high;
  double low;
};

Twofold two_sum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

Twofold quick_two_sum(double a, double b) {  // |a| >= |b|
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// Dekker's product: exact for |a|, |b| < 2^996 whose product does not underflow.
Twofold two_product(double a, double b) {
  constexpr double kSplit = 134217729.0;  // 2^27 + 1
  const double a_scaled = kSplit * a;
  const double b_scaled = kSplit * b;
  const double a_high = a_scaled - (a_scaled - a);
  const double b_high = b_scaled - (b_scaled - b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  const double product = a * b;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

Twofold add(Twofold a, Twofold b) {
  const Twofold sum = two_sum(a.high, b.high);
  return quick_two_sum(sum.high, sum.low + (a.low + b.low));
}

Twofold multiply(Twofold a, Twofold b) {
  const Twofold product = two_product(a.high, b.high);
  return quick_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

template <std::size_t N>
double polynomial(double x, const std::array<double, N>& coefficients) {
  double sum = coefficients[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * x + coefficients[i];
  return sum;
}

constexpr Twofold kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Twofold kWholePi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Twofold kRadiansPerDegree{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};

// Taylor's series on |r| <= pi/4: the first term left out is below 3e-18.
// (sin r - r) / r^3 in r^2, and (cos r - 1 + r^2/2) / r^4 in r^2.
constexpr std::array<double, 8> kSine{-1.0 / 6,
                                      1.0 / 120,
                                      -1.0 / 5040,
                                      1.0 / 362880,
                                      -1.0 / 39916800.0,
                                      1.0 / 6227020800.0,
                                      -1.0 / 1307674368000.0,
                                      1.0 / 355687428096000.0};
constexpr std::array<double, 8> kCosine{1.0 / 24,
                                        -1.0 / 720,
                                        1.0 / 40320,
                                        -1.0 / 3628800.0,
                                        1.0 / 479001600.0,
                                        -1.0 / 87178291200.0,
                                        1.0 / 20922789888000.0,
                                        -1.0 / 6402373705728000.0};

double sine_of(Twofold r) {
  const double z = r.high * r.high;
  // The low part counts with the slope cos r, to first order 1 - r^2/2.
  return r.high + (r.high * z * polynomial(z, kSine) + r.low * (1.0 - 0.5 * z));
}

double cosine_of(Twofold r) {
  const double z = r.high * r.high;
  const double half = 0.5 * z;
  const double head = 1.0 - half;  // with its own rounding error kept beside it
  return head + (((1.0 - head) - half) + (z * z * polynomial(z, kCosine) - r.high * r.low));
}

struct Reduced {
  Twofold angle;  // |angle| <= pi/4 and a little
  int quadrant;   // 0..3
};

// Cody and Waite: pi/2 in 33 + 33 + 53 bits; the quotient has at most 20 bits for |x| <= 1e6, so that the first
// products are exact.
Reduced reduce(double x) {
  const double n = std::floor(x * 0x1.45f306dc9c883p-1 + 0.5);
  const Twofold first = two_sum(x - n * 0x1.921fb54400000p+0, -(n * 0x1.0b4611a600000p-34));
  const Twofold last = two_product(n, 0x1.3198a2e037073p-69);
  const Twofold angle = add(first, {-last.high, -last.low});
  return {angle, static_cast<int>(static_cast<std::int64_t>(n) & 3)};
}

// Exact: whole quarter turns are taken off in degrees.
Reduced reduce_degrees(double degrees) {
  const double turn = std::fmod(degrees, 360.0);  // exact by definition, whoever computes it
  const double n = std::floor(turn / 90.0 + 0.5);
  const double rest = turn - 90.0 * n;
  return {multiply({rest, 0.0}, kRadiansPerDegree), static_cast<int>(static_cast<std::int64_t>(n) & 3)};
}

double sine_of(const Reduced& x) {
  const double value = (x.quadrant & 1) != 0 ? cosine_of(x.angle) : sine_of(x.angle);
  return x.quadrant >= 2 ? 0.0 - value : value;
}

double cosine_of(const Reduced& x) {
  const double value = (x.quadrant & 1) != 0 ? sine_of(x.angle) : cosine_of(x.angle);
  return (x.quadrant == 1 || x.quadrant == 2) ? 0.0 - value : value;
}

// The two series differ by a last place at 45 degrees and its odd multiples, where sine and cosine must be equal:
// there, the root of 1/2 with the sign of `value`.
double diagonal_or(double degrees, double value) {
  constexpr double kRootOfHalf = 0x1.6a09e667f3bcdp-1;
  const double turn = std::fmod(degrees, 360.0);
  if (turn != 45.0 && turn != 135.0 && turn != 225.0 && turn != 315.0) return value;
  return value < 0.0 ? -kRootOfHalf : kRootOfHalf;
}

bool reducible(double x) { return std::fabs(x) < 0x1p30; }

// value * 2^exponent for a normal value; rounds once where the result is subnormal.
double scale(double value, int exponent) {
  const auto power = [](int e) { return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52); };
  if (exponent > 1023) return value * power(1023) * power(exponent - 1023 > 1023 ? 1023 : exponent - 1023);
  if (exponent < -1022) return value * power(exponent + 1022 < -1022 ? -1022 : exponent + 1022) * power(-1022);
  return value * power(exponent);
}

// Taylor's series of (exp r - 1 - r) / r^2 on |r| <= ln 2 / 2.
constexpr std::array<double, 13> kExponential{1.0 / 2,
                                              1.0 / 6,
                                              1.0 / 24,
                                              1.0 / 120,
                                              1.0 / 720,
                                              1.0 / 5040,
                                              1.0 / 40320,
                                              1.0 / 362880,
                                              1.0 / 3628800.0,
                                              1.0 / 39916800.0,
                                              1.0 / 479001600.0,
                                              1.0 / 6227020800.0,
                                              1.0 / 87178291200.0};

double exponential(Twofold x) {
  if (x.high > 710.0) return kInfinity;
  if (x.high < -746.0) return 0.0;
  const double k = std::floor(x.high * 0x1.71547652b82fep+0 + 0.5);
  // ln 2 in 42 + 53 bits: k times the first is exact.
  const Twofold first = two_sum(x.high - k * 0x1.62e42fefa3800p-1, -(k * 0x1.ef35793c76730p-45));
  const Twofold r = quick_two_sum(first.high, first.low + x.low);
  const double rest = r.high * r.high * polynomial(r.high, kExponential) + r.low * (1.0 + r.high);
  return scale(1.0 + (r.high + rest), static_cast<int>(k));
}

// x = fraction * 2^exponent with fraction in [sqrt 1/2, sqrt 2); x positive and finite.
struct Split {
  double fraction;
  int exponent;
};

Split split(double x) {
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1023;
  bits = (bits & 0xfffffffffffffULL) | (1023ULL << 52);
  double fraction = std::bit_cast<double>(bits);
  if (fraction > 0x1.6a09e667f3bcdp+0) {
    fraction *= 0.5;
    ++exponent;
  }
  return {fraction, exponent};
}

// log(1 + f) = 2 atanh(s), s = f / (2 + f), |s| < 0.172: s (2 + 2 s^2 / 3 + 2 s^4 / 5 + ...). Coefficients from s^4 on,
// without the 2.
constexpr std::array<double, 11> kAreaTangent{1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13, 1.0 / 15,
                                              1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23, 1.0 / 25};

// To about 2^-64 relative, so that a power keeps its last place when the exponent is large.
Twofold logarithm(double x) {
  const Split part = split(x);
  const double f = part.fraction - 1.0;  // exact
  const Twofold divisor = two_sum(part.fraction, 1.0);
  const double quotient = f / divisor.high;
  const Twofold back = two_product(quotient, divisor.high);
  const Twofold s = quick_two_sum(quotient, (((f - back.high) - back.low) - quotient * divisor.low) / divisor.high);
  const Twofold z = multiply(s, s);
  constexpr Twofold kThird{0x1.5555555555555p-2, 0x1.5555555555555p-56};
  const Twofold series = multiply(z, add(kThird, two_product(z.high, polynomial(z.high, kAreaTangent))));
  const Twofold correction = multiply(s, series);
  const Twofold half = add(s, correction);
  const double k = part.exponent;
  const Twofold whole = two_sum(k * 0x1.62e42fefa3800p-1, k * 0x1.ef35793c76730p-45);
  return add(whole, {2.0 * half.high, 2.0 * half.low});
}

// atan(k / 8), k = 0..8.
constexpr std::array<Twofold, 9> kArcTangent{{{0.0, 0.0},
                                              {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                              {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                              {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                              {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                              {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                              {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                              {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                              {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};
constexpr std::array<double, 8> kArcSeries{-1.0 / 3,  1.0 / 5,  -1.0 / 7,  1.0 / 9,
                                           -1.0 / 11, 1.0 / 13, -1.0 / 15, 1.0 / 17};

// atan(y / x) for 0 <= y <= x, x > 0: the nearest eighth is taken off by the tangent's addition theorem, the rest is at
// most 1/16.
Twofold arc_tangent(double y, double x) {
  const double k = std::floor(8.0 * (y / x) + 0.5);
  const double eighth = 0.125 * k;
  const Twofold product = two_product(eighth, x);
  const double t = ((y - product.high) - product.low) / (x + eighth * y);
  const double z = t * t;
  const Twofold base = kArcTangent[static_cast<std::size_t>(k)];
  const Twofold sum = two_sum(base.high, t);
  return quick_two_sum(sum.high, sum.low + (base.low + t * z * polynomial(z, kArcSeries)));
}

double magnitude_power(double x, double y) {  // x > 0 finite, y finite
  const Twofold logarithm_x = logarithm(x);
  if (std::fabs(y) > 0x1p80) {  // would overflow the exact product; x = 1 was dealt with
    return (logarithm_x.high > 0.0) == (y > 0.0) ? kInfinity : 0.0;
  }
  return exponential(multiply(logarithm_x, {y, 0.0}));
}

bool is_odd(double y) {  // y is an integer
  return std::fabs(y) < 0x1p53 && (static_cast<std::int64_t>(y) & 1) != 0;
}

}  // namespace

double sin(double x) {
  if (!reducible(x)) return kNan;
  if (std::fabs(x) < 0x1p-27) return x;
  return sine_of(reduce(x));
}

double cos(double x) { return reducible(x) ? cosine_of(reduce(x)) : kNan; }

double tan(double x) {
  if (!reducible(x)) return kNan;
  if (std::fabs(x) < 0x1p-27) return x;
  const Reduced reduced = reduce(x);
  return sine_of(reduced) / cosine_of(reduced);
}

double sin_deg(double degrees) {
  if (!std::isfinite(degrees)) return kNan;
  const double size = diagonal_or(std::fabs(degrees), sine_of(reduce_degrees(std::fabs(degrees))));
  return degrees < 0.0 ? 0.0 - size : size;
}

double cos_deg(double degrees) {
  if (!std::isfinite(degrees)) return kNan;
  return diagonal_or(std::fabs(degrees), cosine_of(reduce_degrees(std::fabs(degrees))));
}

double tan_deg(double degrees) { return sin_deg(degrees) / cos_deg(degrees); }

double exp(double x) {
  if (std::isnan(x)) return x;
  return exponential({x, 0.0});
}

double log(double x) {
  if (std::isnan(x) || x < 0.0) return kNan;
  if (x == 0.0) return -kInfinity;
  if (x == kInfinity) return x;
  return logarithm(x).high;
}

double pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return kNan;
  const double size = std::fabs(x);
  if (std::isinf(y)) {
    if (size == 1.0) return 1.0;
    return (size > 1.0) == (y > 0.0) ? kInfinity : 0.0;
  }
  const bool integer = std::floor(y) == y;
  const bool negative = std::signbit(x) && integer && is_odd(y);
  if (x < 0.0 && !std::isinf(x) && !integer) return kNan;
  double result = 1.0;
  if (size == 0.0 || std::isinf(size)) {
    result = (size == 0.0) == (y > 0.0) ? 0.0 : kInfinity;
  } else if (size != 1.0) {
    result = magnitude_power(size, y);
  }
  return negative ? -result : result;
}

double acos(double x) {
  if (std::isnan(x) || x < -1.0 || x > 1.0) return kNan;
  return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x);
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNan;
  double a = std::fabs(x);
  double b = std::fabs(y);
  if (std::isinf(a) || std::isinf(b)) {
    const bool both = std::isinf(a) && std::isinf(b);
    b = std::isinf(b) ? 1.0 : 0.0;
    a = (both || b == 0.0) ? 1.0 : 0.0;
  }
  const double larger = a > b ? a : b;
  if (larger > 0x1p900 || (larger > 0.0 && larger < 0x1p-900)) {  // away from what the exact product cannot hold
    const double factor = larger > 1.0 ? 0x1p-200 : 0x1p200;
    a *= factor;
    b *= factor;
  }
  Twofold angle{0.0, 0.0};
  if (larger > 0.0) angle = b <= a ? arc_tangent(b, a) : arc_tangent(a, b);
  if (b > a) angle = add(kHalfPi, {-angle.high, -angle.low});
  if (std::signbit(x)) angle = add(kWholePi, {-angle.high, -angle.low});
  return std::signbit(y) ? -angle.high : angle.high;
}

double radians(double degrees) {
  if (!std::isfinite(degrees)) return degrees;
  return multiply({degrees, 0.0}, kRadiansPerDegree).high;
}

}  // namespace rastertlm::mathematics
