// The specular power ROM (004, section 5.3.5, figures 5.10 and 5.11): a power function as a path of moves, one bit a
// move, so that it can be scaled by Ks while it is redrawn. Its length depends on the numbers of states alone: inputs +
// outputs - 1.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/shading/parameters.h"

namespace rastertlm::shading {

enum class Move : std::uint8_t {
  right = 0,  // store at the address, next address
  up = 1,     // Ks into the error register
};

// Output states P(i), i = 0 .. 2^input_bits - 1, of x^exponent, in 0 .. 2^output_bits - 1:
// literal: round(top * (i / (inputs - 1))^E), so that 1 is the final state; centred: round(top * ((i + 1/2) /
// inputs)^E). Powers by repeated multiplication in double, so that every machine makes the same ROM.
std::vector<std::uint32_t> power_states(std::int64_t exponent, unsigned input_bits, unsigned output_bits,
                                        Arithmetic arithmetic);

// The moves that draw `states` (which never fall): before each `right`, as many `up` as the state grows. Where the last
// state is not the final one (centred, large exponents), the remaining `up`s follow the last `right` and change
// nothing: every path has the same length.
std::vector<Move> path_of(const std::vector<std::uint32_t>& states, unsigned output_bits);

class PathRom {
 public:
  // Of parameters.exponents, for tables of 2^index_bits entries and level_bits.
  explicit PathRom(const ShadingParameters& parameters);

  // Throws InputError that names `key` and the exponents that the ROM holds.
  const std::vector<Move>& path(std::int64_t exponent, const std::string& key = "exponent") const;
  bool holds(std::int64_t exponent) const;
  std::size_t paths() const { return paths_.size(); }
  // inputs + outputs - 1
  std::uint64_t moves() const { return moves_; }

 private:
  std::vector<std::int64_t> exponents_;
  std::vector<std::vector<Move>> paths_;
  std::uint64_t moves_;
};

}  // namespace rastertlm::shading
