#include "modules/decision_unit/decision_unit.h"

#include <algorithm>
#include <array>
#include <utility>

#include "src/base/fixed_point.h"

namespace rastertlm::decision_unit {

namespace {

constexpr std::size_t kChunk = 64;  // pixels whose masks stay in registers and the first cache

template <class Word>
void take(Word* __restrict into, const Word* __restrict other, const std::uint32_t* __restrict mask,
          std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto keep = static_cast<Word>(~mask[i]);
    const auto from = static_cast<Word>(mask[i]);
    into[i] = static_cast<Word>((into[i] & keep) | (other[i] & from));
  }
}

// `count` <= kChunk pixels from `first` on.
void merge_chunk(frame::FragmentLine& into, const frame::FragmentLine& other, std::size_t first, std::size_t count) {
  std::array<std::uint32_t, kChunk> mask;
  std::uint32_t any = 0;
  {
    std::uint32_t* __restrict own = into.depth.data() + first;
    const std::uint32_t* __restrict theirs = other.depth.data() + first;
    for (std::size_t i = 0; i < count; ++i) {
      mask[i] = theirs[i] < own[i] ? ~0U : 0U;
      any |= mask[i];
      own[i] = std::min(own[i], theirs[i]);
    }
  }
  {
    std::uint16_t* __restrict own = into.coverage.data() + first;
    const std::uint16_t* __restrict theirs = other.coverage.data() + first;
    for (std::size_t i = 0; i < count; ++i) own[i] = static_cast<std::uint16_t>(own[i] + theirs[i]);
  }
  if (any == 0) return;
  take(into.normal_x.data() + first, other.normal_x.data() + first, mask.data(), count);
  take(into.normal_y.data() + first, other.normal_y.data() + first, mask.data(), count);
  take(into.normal_z.data() + first, other.normal_z.data() + first, mask.data(), count);
  take(into.material.data() + first, other.material.data() + first, mask.data(), count);
  take(into.object.data() + first, other.object.data() + first, mask.data(), count);
}

std::uint64_t seen(const frame::FragmentLine& line) {
  std::uint32_t count = 0;
  for (std::size_t i = line.begin; i < line.end; ++i) count += line.object[i] != 0 ? 1U : 0U;
  return count;
}

}  // namespace

void merge_lines(frame::FragmentLine& into, frame::FragmentLine& other, std::uint32_t background_depth) {
  if (other.empty()) return;
  if (into.empty()) {
    std::swap(into, other);
    return;
  }
  into.extend(other.begin, other.end, background_depth);
  for (std::size_t first = other.begin; first < other.end; first += kChunk)
    merge_chunk(into, other, first, std::min(kChunk, other.end - first));
}

void DecisionUnit::merge(std::span<frame::FragmentLine* const> lines) {
  if (lines.empty()) return;
  std::uint64_t in = 0;
  for (const frame::FragmentLine* line : lines) in += seen(*line);
  if (parameters_.topology == Topology::pipeline) {
    for (std::size_t board = 1; board < lines.size(); ++board) merge_lines(*lines[0], *lines[board], background_depth_);
  } else {
    for (std::size_t apart = 1; apart < lines.size(); apart *= 2)
      for (std::size_t node = 0; node + apart < lines.size(); node += 2 * apart)
        merge_lines(*lines[node], *lines[node + apart], background_depth_);
  }
  const std::uint64_t kept = seen(*lines[0]);
  counters_.fragments_in += in;
  counters_.fragments_kept += kept;
  counters_.fragments_hidden += in - kept;
}

void DecisionUnit::merge(std::span<const frame::CoveredLine* const> boards, std::uint32_t line,
                         object_processor::LineComposer& composer, frame::FragmentLine& out) {
  std::uint64_t in = 0;
  for (const frame::CoveredLine* board : boards) in += board->seen_pixels;
  const std::uint64_t kept = composer.compose(boards, line, out);
  counters_.fragments_in += in;
  counters_.fragments_kept += kept;
  counters_.fragments_hidden += in - kept;
}

std::uint64_t tree_levels(std::uint64_t processors) { return processors < 2 ? 0 : bit_length(processors - 1); }

Cycles latency(Topology topology, std::uint64_t processors, Cycles comparator) {
  return comparator * (topology == Topology::pipeline ? processors : tree_levels(processors));
}

Cycles skew(Topology topology, std::uint64_t processors, Cycles comparator) {
  return comparator * (topology == Topology::pipeline && processors > 0 ? processors - 1 : 0);
}

DecisionLogic decision_logic(const DecisionUnitParameters& parameters, std::uint64_t processors, const LinkWidth& link,
                             std::uint64_t comparator_cycles) {
  DecisionLogic logic;
  const std::uint64_t bits = link.bits();
  logic.link_pins = parameters.double_clocked ? (bits + 1) / 2 : bits;
  std::uint64_t link_registers = 0;
  if (parameters.topology == Topology::pipeline) {
    logic.comparators = processors;
    logic.processor_pins = 2 * logic.link_pins;
    link_registers = processors;
  } else {
    logic.comparators = processors > 0 ? processors - 1 : 0;
    logic.processor_pins = logic.link_pins;
    logic.node_pins = 3 * logic.link_pins;
    // Level l has ceil(N / 2^l) registers.
    for (std::uint64_t level = 1; level <= tree_levels(processors); ++level)
      link_registers += ((processors - 1) >> level) + 1;
  }
  logic.register_bits = link_registers * bits * comparator_cycles;
  return logic;
}

}  // namespace rastertlm::decision_unit
