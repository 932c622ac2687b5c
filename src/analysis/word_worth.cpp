#include "src/analysis/word_worth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/object_processor/triangle_processor.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

constexpr std::size_t kConstant = 2;  // address of C'
constexpr std::array<const char*, 3> kTerms{"A", "B", "C'"};
using Units = std::array<const char*, 3>;
constexpr Units kEdgeUnits{"px", "px", "px2"};
constexpr Units kScaledUnits{"steps/column", "steps/line", "steps"};
constexpr Units kDepthUnits{"units/column", "units/line", "units"};
constexpr Units kNormalUnits{"1/column", "1/line", "1"};

}  // namespace

BinaryPoints binary_points(unsigned word_bits, std::size_t columns, std::size_t lines, int snap_fraction_bits,
                           bool scaled) {
  const auto bits = static_cast<int>(word_bits);
  const auto side = static_cast<int>(bit_length(std::max(columns, lines) - 1));
  return {scaled ? 0 : snap_fraction_bits, scaled, bits - side, bits - 2};
}

WordWorth word_worth(const BinaryPoints& points, unsigned word_bits, std::size_t index, std::uint32_t word) {
  using namespace object_processor;
  if (index == kMaterialIndex) return {"material", static_cast<double>(word), "number"};
  const std::size_t processor = index / 3;
  const std::size_t address = index % 3;
  const auto is_signed = [&](int fraction_bits) {
    return std::ldexp(static_cast<double>(sign_extend(word, word_bits)), -fraction_bits);
  };
  const auto named = [&](const std::string& what) { return what + ' ' + kTerms[address]; };
  if (processor < kDepth)
    return {named("edge " + std::to_string(processor)), is_signed(points.edge),
            (points.scaled ? kScaledUnits : kEdgeUnits)[address]};
  if (processor == kDepth)
    return {named("depth"),
            address == kConstant ? std::ldexp(static_cast<double>(word), -points.depth) : is_signed(points.depth),
            kDepthUnits[address]};
  const std::string component(1, static_cast<char>('x' + (processor - kNormalX)));
  return {named("normal " + component), is_signed(points.normal), kNormalUnits[address]};
}

}  // namespace rastertlm::analysis
