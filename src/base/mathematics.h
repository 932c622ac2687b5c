// Transcendental functions that give the same bits on every x86-64: plain IEEE double + - * / and sqrt, no fused
// multiply-add (the project compiles with -ffp-contract=off) and nothing from the C library, whose variants differ by
// processor. Whatever may reach a pixel, a table or a cycle is computed with these.
//
// Largest measured error (tests/src/base/mathematics_test.cpp, against the C library's long double), in units of the
// last place of the result: see each function. Special values (NaN, infinities, zeros with their sign) are those of the
// C standard.
#pragma once

namespace rastertlm::mathematics {

inline constexpr double kPi = 3.14159265358979323846;

// Radians, |x| <= 1e6 (beyond that the reduction loses bits; |x| >= 2^30 gives NaN). sin, cos: 0.8 ulp; tan: 2.5 ulp.
double sin(double x);
double cos(double x);
double tan(double x);

// Degrees, any finite value; exact at multiples of 90, and 45 degrees give sin = cos. 0.8 ulp of the true value.
double sin_deg(double degrees);
double cos_deg(double degrees);
double tan_deg(double degrees);  // 2.5 ulp

// exp: 1 ulp where the result is normal. log: x > 0 (0 gives -infinity, less gives NaN), 1 ulp.
double exp(double x);
double log(double x);

// x^y with the special cases of the C standard; 1 ulp where the result is normal.
double pow(double x, double y);

// acos: -1..1, result 0..pi. atan2: the angle of (x, y), -pi..pi. acos: 2 ulp; atan2: 1.1 ulp.
double acos(double x);
double atan2(double y, double x);

// Rounded once from the exact product: 180 degrees give the double nearest to pi.
double radians(double degrees);

}  // namespace rastertlm::mathematics
