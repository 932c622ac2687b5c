#include "src/analysis/vector_files.h"

#include <fmt/format.h>

namespace rastertlm::analysis {

std::string hex_word(std::uint32_t word, unsigned bits) {
  constexpr unsigned kDigitBits = 4;
  return fmt::format("{:0{}x}", word, (bits + kDigitBits - 1) / kDigitBits);
}

}  // namespace rastertlm::analysis
