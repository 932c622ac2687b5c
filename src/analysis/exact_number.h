// Numbers that are exact beside those of a machine: 113 bits of precision, and what functions the formulas need of
// them. Nothing here is shared with what it is compared to.
#pragma once

namespace rastertlm::analysis {

__extension__ using Quad = __float128;

// 64 bits of precision, for what is done at every pixel: 2^11 times finer than the doubles that are measured.
using Extended = long double;
inline constexpr double kExtendedPlace = 0x1p-64;  // half of the last place of 1

inline Quad absolute(Quad value) { return value < 0 ? -value : value; }
inline double to_double(Quad value) { return static_cast<double>(value); }

// Of a number that is not negative.
Quad square_root(Quad value);

// Degrees, any; the argument is reduced exactly.
Quad sine_deg(Quad degrees);
Quad cosine_deg(Quad degrees);

}  // namespace rastertlm::analysis
