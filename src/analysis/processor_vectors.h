// The loading RAMs of the object processors as files.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/object_processor/object_board.h"
#include "src/analysis/vector_files.h"
#include "src/analysis/word_worth.h"

namespace rastertlm::analysis {

// Processors by their number in the machine (board x processors a board + slot), both ends included.
struct ProcessorRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

struct ProcessorCounts {
  std::uint64_t with_object = 0;  // in the whole machine
  std::uint64_t listed = 0;       // of them, in the range
};

// More than these are not written at once: each makes eight files.
inline constexpr std::uint64_t kMostListed = 16384;

// Of every processor in the range that holds an object: board<b>_processor<p>_ep<e>.hex and
// board<b>_processor<p>_material.hex; then those of a parked one, and index.csv. The words are those of the backup
// RAMs, so as the loading RAMs held them when the frame's retrace began. Throws InputError where there are more than
// kMostListed, OutputError where something cannot be written.
ProcessorCounts write_processors(const std::vector<object_processor::ObjectBoard>& boards, unsigned word_bits,
                                 const BinaryPoints& points, const ProcessorRange& range, VectorFiles& files);

}  // namespace rastertlm::analysis
