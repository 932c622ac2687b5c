// The tables of a shading processor's bench as the bounds of the chain read them.
#pragma once

#include "src/analysis/chain_bound.h"
#include "src/analysis/shading_search.h"

namespace rastertlm::analysis {

// The level of the exact cosine, one term alone: what the bounds take.
Curve diffuse_curve(double diffuse);
Curve specular_curve(double specular, std::int64_t exponent);

// Of a quantity, as filled; levels of 0..255 before the display's rounding.
LevelTable diffuse_table(const ShadingBench& bench, std::size_t quantity);
LevelTable specular_table(const ShadingBench& bench, std::size_t quantity);

// What a display of fewer bits than eight, and the ambient register of a quantity, add at most; levels.
double display_rounding(const shading::ShadingParameters& parameters);
double ambient_rounding(const shading::ShadingParameters& parameters, const Quantity& quantity);

// The quantity's proved error, in levels: the sum of its terms', for sums that saturate at full scale move no further
// apart. `sums`: of cosine_steps().
double proved_level_error(const ShadingBench& bench, std::size_t quantity, std::span<const Range> sums);

}  // namespace rastertlm::analysis
