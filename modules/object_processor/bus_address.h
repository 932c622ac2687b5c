// The address map of the object processors on a host bus (004, section 5.2.3): "Each coefficient has a specific address
// indicating the number of the Triangle Processor, the number of the Elementary Processor and the address in the
// loading RAM." Byte addresses of 32-bit words: board, processor, word (of a triangle processor: elementary processor *
// 3 + address, 21 the material). Processors of other kinds have a bus of their own, and their own shift.
#pragma once

#include <cstdint>

#include "modules/object_processor/triangle_processor.h"

namespace rastertlm::object_processor {

inline constexpr unsigned kWordShift = 2;       // bytes of a word
inline constexpr unsigned kProcessorShift = 7;  // 32 words a processor, 22 of them in use
inline constexpr unsigned kBoardShift = 32;     // up to 2^25 processors a board
static_assert(kWords <= (1U << (kProcessorShift - kWordShift)));

constexpr std::uint64_t bus_address(std::uint32_t board, std::uint32_t processor, std::size_t word,
                                    unsigned processor_shift = kProcessorShift) {
  return std::uint64_t{board} << kBoardShift | std::uint64_t{processor} << processor_shift |
         std::uint64_t{word} << kWordShift;
}

struct BusTarget {
  std::uint32_t board = 0;
  std::uint32_t processor = 0;
  std::size_t word = 0;
};
constexpr BusTarget bus_target(std::uint64_t address, unsigned processor_shift = kProcessorShift) {
  return {static_cast<std::uint32_t>(address >> kBoardShift),
          static_cast<std::uint32_t>((address >> processor_shift) & ((1U << (kBoardShift - processor_shift)) - 1)),
          static_cast<std::size_t>((address >> kWordShift) & ((1U << (processor_shift - kWordShift)) - 1))};
}

}  // namespace rastertlm::object_processor
