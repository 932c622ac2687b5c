#include "modules/shading/path_rom.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "src/base/errors.h"
#include "src/base/fixed_point.h"

namespace rastertlm::shading {
namespace {

double integer_power(double base, std::int64_t exponent) {
  double result = 1.0;
  for (double factor = base; exponent > 0; exponent >>= 1, factor *= factor)
    if ((exponent & 1) != 0) result *= factor;
  return result;
}

}  // namespace

std::vector<std::uint32_t> power_states(std::int64_t exponent, unsigned input_bits, unsigned output_bits,
                                        Arithmetic arithmetic) {
  const std::size_t inputs = std::size_t{1} << input_bits;
  const double top = static_cast<double>(low_mask(output_bits));
  std::vector<std::uint32_t> states(inputs);
  for (std::size_t i = 0; i < inputs; ++i) {
    const double x = arithmetic == Arithmetic::literal ? static_cast<double>(i) / static_cast<double>(inputs - 1)
                                                       : (static_cast<double>(i) + 0.5) / static_cast<double>(inputs);
    states[i] = static_cast<std::uint32_t>(round_half_up(top * integer_power(x, exponent)));
  }
  return states;
}

std::vector<Move> path_of(const std::vector<std::uint32_t>& states, unsigned output_bits) {
  const auto final_state = static_cast<std::uint32_t>(low_mask(output_bits));
  std::vector<Move> moves;
  moves.reserve(states.size() + final_state);
  std::uint32_t drawn = 0;
  for (const std::uint32_t state : states) {
    for (; drawn < state; ++drawn) moves.push_back(Move::up);
    moves.push_back(Move::right);
  }
  for (; drawn < final_state; ++drawn) moves.push_back(Move::up);
  return moves;
}

PathRom::PathRom(const ShadingParameters& parameters)
    : exponents_(parameters.exponents),
      moves_((std::uint64_t{1} << parameters.index_bits) + (std::uint64_t{1} << parameters.level_bits) - 1) {
  const auto output_bits = static_cast<unsigned>(parameters.level_bits);
  for (const std::int64_t exponent : exponents_)
    paths_.push_back(path_of(
        power_states(exponent, static_cast<unsigned>(parameters.index_bits), output_bits, parameters.arithmetic),
        output_bits));
}

bool PathRom::holds(std::int64_t exponent) const {
  return std::find(exponents_.begin(), exponents_.end(), exponent) != exponents_.end();
}

const std::vector<Move>& PathRom::path(std::int64_t exponent, const std::string& key) const {
  const auto found = std::find(exponents_.begin(), exponents_.end(), exponent);
  if (found == exponents_.end())
    throw InputError({"", 0, key,
                      fmt::format("{} is not in the path ROM; accepted: {} (shading.exponents)", exponent,
                                  fmt::join(exponents_, ", "))});
  return paths_[static_cast<std::size_t>(found - exponents_.begin())];
}

}  // namespace rastertlm::shading
