// How far the shading processor can be from lighting in real numbers, proved by interval arithmetic: first the cosine
// that it makes of a normal and a unit vector, then the level that it looks up with it.
//
// Notation, in the order of the chain. N is the normal as the elementary processors show it, C the centre of the box
// that the pre-normalisation unit keeps of it, +-(m + 1/2) a component: |N - C| <= 1/2 a component, in units of the
// link's last place. S is the sum of squares, r the inverse root, n the normalised component of A bits, B the bits of a
// partial product, l the light's unit vector, c = l N / |N| the exact cosine.
//  1 normal word      the angle between C and N is at most asin((sqrt(3) / 2) / |C|)
//  2 inverse root     r = (1 + e) / |C|: e is enumerated over every S, for the table is constant between addresses
//  3 component        n stands for 2^A (1 + e) C_i / |C| + t. Centred: n is read at n + 1/2, so that |t| <= 1/2.
//  Literal:
//                     t is in [-1 - 2^A (1 + e) / (2 |C|), 0], a unit for the floor, half of the multiplicand's for the
//                     m that is read as it stands
//                     Where the product is clamped, e of that component is smaller, and not below 0
//  4 dot product      the light's word is off by d, |d| <= 1/2 of 2^-B, and a partial product by g: centred in [-1/2,
//                     1/2], literal in [-1, 0], with the light's words at 1 - 2^-B of full scale
//     sum             (1 + e) l C / |C| + sum of l_i t_i 2^-A + sum of n_i d_i 2^-(A + B) + sum of g_i 2^-B
//                     |l| = |C / |C|| = 1, and a sum of three absolute values of a unit vector is at most sqrt(3)
//  5 index, table     the index is the floor of the sum, negative ones 0, and saturates; tables never fall, so the
//                     level lies between the entries at the ends of the sum's interval
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "modules/shading/normaliser.h"
#include "modules/shading/parameters.h"

namespace rastertlm::analysis {

struct Range {
  double low = 0.0;
  double high = 0.0;
};

// Which steps are the machine's; the others are exact.
struct ChainSteps {
  bool normal_word = true;   // object_processor.normal_bits
  bool root_address = true;  // shading.normaliser_address_bits
  bool root_word = true;     // shading.normaliser_output_bits
  bool component = true;     // shading.dot_table_address_bits
  bool dot_product = true;   // shading.dot_table_output_bits
  bool table = true;         // shading.index_bits, and the table's words

  static ChainSteps none() { return {false, false, false, false, false, false}; }
};

// Relative errors of the inverse root over sums of squares that share table addresses.
struct RootBlock {
  double shortest = 0.0;  // |C|, in units of the link's last place
  double longest = 0.0;
  Range error;  // e
};

class CosineBound {
 public:
  CosineBound(const shading::ShadingParameters& parameters, std::int64_t normal_bits, ChainSteps steps = {});

  // Where the sum may lie (1: full scale), before it saturates, for every normal that is not short and every unit
  // vector with that cosine.
  Range sum(double cosine) const;
  // Of normals with this sum of squares alone, short ones included; not of the normal that is zero. `half_box`: how far
  // a component of N may be from C's, in the link's last place, where N is another vector than the elementary
  // processors'.
  Range sum_at(double cosine, std::uint32_t squares, double half_box = 0.5) const;

  // The sum's largest error, in the last place of a partial product, over every cosine.
  double largest_sum_error() const;
  // Over every sum of squares of a normal that is not short.
  Range root_error() const;
  // Of a normalised component against 2^A C_i / |C|, in its last place.
  Range component_error() const;
  // Of the sine of the angle between C and N.
  double largest_sine() const;
  std::uint64_t root_inputs() const { return root_inputs_; }  // sums of squares that root_error() is taken over

 private:
  RootBlock block_at(std::uint32_t first, std::uint32_t last) const;
  Range sum_in(double cosine, const RootBlock& block, double half_box) const;

  shading::Normaliser normaliser_;
  ChainSteps steps_;
  bool centred_;
  double component_unit_;  // 2^-A
  double product_unit_;    // 2^-B
  double full_component_;  // 2^A
  std::vector<RootBlock> blocks_;
  std::uint64_t root_inputs_ = 0;
};

// A level as a function of the exact cosine, 0..1: never falls, and is 0 at 0.
using Curve = std::function<double(double)>;

// The words of one material of a diffuse or specular table, in levels of 0..255 as displayed.
using LevelTable = std::vector<double>;

// The machine's level less the exact one, over every cosine from -1 to 1. `sums` are CosineBound::sum() at every end of
// cosine_steps(); `table` empty: the sum itself is looked up in the curve.
Range level_error(std::span<const Range> sums, const LevelTable& table, const Curve& exact);
// The level that the chain may show where the sum lies in `sum`.
Range level_range(Range sum, const LevelTable& table, const Curve& exact);

// Ends of pieces of -1 .. 1. All negative cosines are one piece, whose exact level is 0; the others are finer towards
// 1, where highlights are steep.
const std::vector<double>& cosine_steps();
std::vector<Range> sums_of(const CosineBound& bound);

}  // namespace rastertlm::analysis
