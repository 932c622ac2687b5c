#include "modules/frame_store/memory_layout.h"

#include <algorithm>
#include <array>

namespace rastertlm::frame_store {
namespace {

constexpr std::uint64_t kBits = 64;  // of a word of bits

std::uint64_t ceil_of(std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; }

// Whether one of the bits begin .. end - 1 is set.
bool any(const std::uint64_t* bits, std::uint64_t begin, std::uint64_t end) {
  for (std::uint64_t at = begin; at < end; at += kBits - at % kBits) {
    const std::uint64_t here = std::min(end - at, kBits - at % kBits);
    const std::uint64_t mask = here < kBits ? (std::uint64_t{1} << here) - 1 : ~std::uint64_t{0};
    if ((bits[at / kBits] >> at % kBits & mask) != 0) return true;
  }
  return false;
}

}  // namespace

MemoryLayout MemoryLayout::of(const FrameStoreParameters& parameters, std::uint64_t columns, std::uint64_t lines,
                              unsigned depth_bits, bool ties) {
  MemoryLayout layout;
  layout.columns = columns;
  layout.lines = lines;
  layout.banks = static_cast<std::uint64_t>(parameters.banks);
  const auto width = static_cast<std::uint64_t>(parameters.width_bits);
  layout.buffers = static_cast<std::uint64_t>(parameters.buffers);
  if (parameters.depth_test) {
    layout.depth_bits = depth_bits;
    layout.number_bits = ties ? kTieBits : 0U;
  }
  layout.pixels_a_word = std::max<std::uint64_t>(width / layout.pixel_bits(), 1);
  layout.depth_words = ceil_of(layout.depth_bits + layout.number_bits, width);
  layout.write_words = ceil_of(layout.pixel_bits(), width);
  layout.colour_words = ceil_of(layout.colour_bits, width);
  return layout;
}

std::uint64_t MemoryLayout::accesses(std::uint64_t column, std::uint64_t count, std::uint64_t words_each) const {
  if (count == 0) return 0;
  // Divisions are dear, and most machines need none.
  const std::uint64_t groups =
      pixels_a_word == 1 ? count : (column + count - 1) / pixels_a_word - column / pixels_a_word + 1;
  return (banks == 1 ? groups : ceil_of(groups, banks)) * words_each;
}

std::uint64_t MemoryLayout::span_accesses(std::uint64_t column, std::uint64_t count, std::uint64_t kept,
                                          const std::uint64_t* won) const {
  if (!asks_which_won()) return count * depth_words + kept * write_words;
  if (kept == 0) return accesses(column, count, depth_words);
  if (kept == count) return accesses(column, count, depth_words + write_words);
  std::array<std::uint64_t, kMostBanks> of_bank{};
  const std::uint64_t end = column + count;
  std::uint64_t bank = column / pixels_a_word % banks;
  for (std::uint64_t at = column; at < end; bank = bank + 1 < banks ? bank + 1 : 0) {
    const std::uint64_t next = std::min(end, at - at % pixels_a_word + pixels_a_word);
    of_bank[bank] += depth_words + (any(won, at - column, next - column) ? write_words : 0);
    at = next;
  }
  return *std::max_element(of_bank.begin(), of_bank.end());
}

std::uint64_t MemoryLayout::words_a_bank() const {
  return lines * ceil_of(ceil_of(columns, pixels_a_word), banks) * write_words;
}

}  // namespace rastertlm::frame_store
