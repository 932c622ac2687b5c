#include "src/analysis/chain_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using shading::Arithmetic;

const double kRoot3 = std::sqrt(3.0);
constexpr double kHalfBox = 0.5;       // of a link word's interval
constexpr std::uint32_t kBlocks = 48;  // of sums of squares, where their length counts
// What this analysis itself rounds, in double.
constexpr double kOwnRounding = 1e-12;
constexpr std::size_t kPieces = 1U << 14;

Range hull(const Range& a, const Range& b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

// |C|, for the sum of squares S of the words as the squarer reads them. Centred: S is the sum of m (m + 1), exactly 3/4
// less than |C|^2. Literal: a component's square is m^2 or (m + 1)^2, which is off by m + 3/4 at most, and the sum of
// them by sqrt(3) |C| + 3/4.
Range length_of(double squares, bool centred) {
  if (centred) return {std::sqrt(squares + 0.75), std::sqrt(squares + 0.75)};
  return {std::max(kHalfBox * kRoot3, (std::sqrt(3 + 4 * std::max(0.0, squares - 0.75)) - kRoot3) / 2),
          (std::sqrt(3 + 4 * (squares + 0.75)) + kRoot3) / 2};
}

std::size_t index_of(double sum, std::size_t entries) {
  const double scaled = std::floor(sum * static_cast<double>(entries));
  if (!(scaled > 0.0)) return 0;
  return std::min(static_cast<std::size_t>(std::min(scaled, 1e9)), entries - 1);
}

}  // namespace

CosineBound::CosineBound(const shading::ShadingParameters& parameters, std::int64_t normal_bits, ChainSteps steps)
    : normaliser_(parameters, normal_bits),
      steps_(steps),
      centred_(parameters.arithmetic == Arithmetic::centred),
      component_unit_(std::ldexp(1.0, -static_cast<int>(parameters.dot_table_address_bits))),
      product_unit_(std::ldexp(1.0, -static_cast<int>(parameters.dot_table_output_bits))),
      full_component_(std::ldexp(1.0, static_cast<int>(parameters.dot_table_address_bits))) {
  const auto largest = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(normal_bits - 1)));
  const std::uint32_t first = normaliser_.short_limit();
  const std::uint32_t last = 3 * (centred_ ? normaliser_.square(largest, 0) : normaliser_.square(largest, 1));
  root_inputs_ = std::uint64_t{last} - first + 1;
  const unsigned shift = normaliser_.address_shift();
  const bool length_counts = steps_.normal_word || (steps_.component && !centred_);
  const std::uint32_t span =
      ((last - first) / (length_counts ? kBlocks : 1) | static_cast<std::uint32_t>(low_mask(shift))) + 1;
  for (std::uint64_t from = first; from <= last; from += span)
    blocks_.push_back(block_at(static_cast<std::uint32_t>(from),
                               static_cast<std::uint32_t>(std::min<std::uint64_t>(from + span - 1, last))));
}

// Between two addresses the table's word stands and |C| grows with S: its ends are the extremes.
RootBlock CosineBound::block_at(std::uint32_t first, std::uint32_t last) const {
  const unsigned shift = normaliser_.address_shift();
  const double scale = normaliser_.root_scale();
  const double half_word = steps_.root_word ? 0.5 : 0.0;
  RootBlock block{length_of(first, centred_).low,
                  length_of(last, centred_).high,
                  {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}};
  for (std::uint64_t address = first >> shift; address <= last >> shift; ++address) {
    const std::uint64_t begin = std::max<std::uint64_t>(address << shift, first);
    const std::uint64_t end = std::min<std::uint64_t>(((address + 1) << shift) - 1, last);
    const double low = length_of(static_cast<double>(begin), centred_).low;
    const double high = length_of(static_cast<double>(end), centred_).high;
    if (steps_.root_address) {
      const double centre = std::ldexp(static_cast<double>(address) + 0.5, static_cast<int>(shift));
      const double word =
          steps_.root_word ? normaliser_.inverse_root(static_cast<std::uint32_t>(begin)) : scale / std::sqrt(centre);
      block.error = hull(block.error, {word * low / scale - 1, word * high / scale - 1});
    } else {
      // The word nearest to the exact inverse root, which is clamped.
      const double clamp = steps_.root_word ? static_cast<double>(normaliser_.largest_root()) : 1e300;
      const auto error = [&](double length, double off) {
        return std::min(scale / length + off, clamp) * length / scale - 1;
      };
      block.error = hull(block.error, {std::min(error(low, -half_word), error(high, -half_word)),
                                       std::max(error(low, half_word), error(high, half_word))});
    }
  }
  return block;
}

Range CosineBound::sum_in(double cosine, const RootBlock& block, double half_box) const {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  Range turned{cosine, cosine};
  if (steps_.normal_word) {
    const double turn = half_box * kRoot3 / block.shortest;  // the sine of an angle, or any angle where it is above 1
    const double kept = std::sqrt(std::max(0.0, 1 - turn * turn));
    turned.low = turn >= 1.0 || cosine <= -kept ? -1.0 : cosine * kept - sine * turn;
    turned.high = turn >= 1.0 || cosine >= kept ? 1.0 : cosine * kept + sine * turn;
  }
  Range error = block.error;
  const double beyond = std::max(0.0, error.high);
  double spread = kOwnRounding;
  if (steps_.component && beyond > 0.0) {  // clamped: other components are at most sqrt(2 e)
    error.low = std::min(error.low, 0.0);
    spread += beyond * std::sqrt(2 * beyond);
  }
  Range sum{std::min(turned.low * (1 + error.low), turned.low * (1 + error.high)),
            std::max(turned.high * (1 + error.low), turned.high * (1 + error.high))};
  double rest = 0.0;  // |t|, in the component's last place
  if (steps_.component) rest = centred_ ? 0.5 : 1 + full_component_ * (1 + error.high) / (2 * block.shortest);
  spread += kRoot3 * rest * component_unit_;
  if (steps_.dot_product) {
    spread += product_unit_ * 0.5 * (kRoot3 * (1 + error.high) + 3 * rest * component_unit_);
    if (centred_) spread += 1.5 * product_unit_;
    if (!centred_) {  // light words of 1 - 2^-B, and floors of three units
      const double scaled = 1 - product_unit_;
      sum = {std::min(sum.low, sum.low * scaled) - 3 * product_unit_, std::max(sum.high, sum.high * scaled)};
    }
  }
  return {sum.low - spread, sum.high + spread};
}

Range CosineBound::sum(double cosine) const {
  Range all = sum_in(cosine, blocks_.front(), kHalfBox);
  for (const RootBlock& block : blocks_) all = hull(all, sum_in(cosine, block, kHalfBox));
  return all;
}

Range CosineBound::sum_at(double cosine, std::uint32_t squares, double half_box) const {
  return sum_in(cosine, block_at(squares, squares), half_box);
}

double CosineBound::largest_sum_error() const {
  const std::vector<double>& ends = cosine_steps();
  double worst = 0.0;
  for (const double sign : {1.0, -1.0})
    for (std::size_t i = 1; i + 1 < ends.size(); ++i) {
      const double low = sign < 0 ? -ends[i + 1] : ends[i], high = sign < 0 ? -ends[i] : ends[i + 1];
      worst = std::max({worst, high - sum(low).low, sum(high).high - low});
    }
  return worst / product_unit_;
}

Range CosineBound::root_error() const {
  Range all = blocks_.front().error;
  for (const RootBlock& block : blocks_) all = hull(all, block.error);
  return all;
}

Range CosineBound::component_error() const {
  Range all{0, 0};
  for (const RootBlock& block : blocks_) {
    const double below = centred_ ? 0.5 : 1 + full_component_ * (1 + block.error.high) / (2 * block.shortest);
    const double above = centred_ ? 0.5 : 0.0;
    all = hull(all, {std::min(0.0, block.error.low) * full_component_ - below,
                     std::max(0.0, block.error.high) * full_component_ + above});
  }
  return all;
}

double CosineBound::largest_sine() const { return std::min(1.0, kHalfBox * kRoot3 / blocks_.front().shortest); }

Range level_range(Range sum, const LevelTable& table, const Curve& exact) {
  if (table.empty()) return {exact(std::clamp(sum.low, 0.0, 1.0)), exact(std::clamp(sum.high, 0.0, 1.0))};
  return {table[index_of(sum.low, table.size())], table[index_of(sum.high, table.size())]};
}

Range level_error(std::span<const Range> sums, const LevelTable& table, const Curve& exact) {
  const std::vector<double>& ends = cosine_steps();
  Range error{0, 0};
  double below = exact(0.0);  // at the piece's lower end
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const Range shown =
        level_range({std::min(sums[i].low, sums[i + 1].low), std::max(sums[i].high, sums[i + 1].high)}, table, exact);
    const double above = exact(std::max(0.0, ends[i + 1]));
    error = hull(error, {shown.low - above, shown.high - below});
    below = above;
  }
  return error;
}

const std::vector<double>& cosine_steps() {
  static const std::vector<double> ends = [] {
    std::vector<double> made{-1.0};
    made.reserve(kPieces + 2);
    for (std::size_t i = 0; i <= kPieces; ++i) {
      const double s = 1 - static_cast<double>(i) / kPieces;
      made.push_back(1 - s * s);
    }
    return made;
  }();
  return ends;
}

std::vector<Range> sums_of(const CosineBound& bound) {
  std::vector<Range> sums;
  sums.reserve(cosine_steps().size());
  for (const double cosine : cosine_steps()) sums.push_back(bound.sum(cosine));
  return sums;
}

}  // namespace rastertlm::analysis
