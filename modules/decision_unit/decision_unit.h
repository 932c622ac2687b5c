// The decision unit: of all object processors the nearest object at every pixel, found along a pipeline or by a binary
// tree. The picture is the same: strictly smaller depth wins, equal depth keeps the lower processor number. Latency,
// registers, comparators and pins differ.
#pragma once

#include <cstdint>
#include <span>

#include "modules/decision_unit/parameters.h"
#include "modules/object_processor/line_composer.h"
#include "src/base/units.h"
#include "src/frame/scan_line.h"

namespace rastertlm::decision_unit {

// fragments_in = fragments_kept + fragments_hidden, always. A fragment is a pixel of a line in which an object is seen.
struct DecisionCounters {
  std::uint64_t fragments_in = 0;
  std::uint64_t fragments_kept = 0;
  std::uint64_t fragments_hidden = 0;
};

class DecisionUnit {
 public:
  // `background_depth`: the word that nothing holds, all ones of the depth word.
  DecisionUnit(const DecisionUnitParameters& parameters, std::uint32_t background_depth)
      : parameters_(parameters), background_depth_(background_depth) {}

  // Merges lines of as many boards, in the order of processor numbers, into lines[0], along the chain or as a tree. The
  // lines have equally many columns; what the others hold afterwards is not specified. Only covered intervals are
  // looked at.
  void merge(std::span<frame::FragmentLine* const> lines);

  // The same where the boards' lines are spans: into `out`, of equally many columns. The nearest and the counts do not
  // depend on the order of comparison, so tree and chain are one.
  void merge(std::span<const frame::CoveredLine* const> boards, std::uint32_t line,
             object_processor::LineComposer& composer, frame::FragmentLine& out);

  const DecisionCounters& counters() const { return counters_; }

 private:
  DecisionUnitParameters parameters_;
  std::uint32_t background_depth_;
  DecisionCounters counters_;
};

// One comparator on a whole line: `into` becomes the nearer of both at every pixel, its own where depths are equal;
// coverage adds up. `other` may be left with the former contents of `into`.
void merge_lines(frame::FragmentLine& into, frame::FragmentLine& other, std::uint32_t background_depth);

// The bits of what crosses a link between processors: 24 + 3 x 12 + 4 = 64 in the paper's machine.
struct LinkWidth {
  std::uint64_t depth_bits = 24;
  std::uint64_t normal_bits = 12;
  std::uint64_t material_bits = 4;
  constexpr std::uint64_t bits() const { return depth_bits + 3 * normal_bits + material_bits; }
};

// What a decision unit of `processors` leaves is made of. All are closed forms of the number of processors N >= 1.
struct DecisionLogic {
  std::uint64_t comparators = 0;  // pipeline N (inside the processors), tree N - 1
  std::uint64_t register_bits =
      0;  // a link word each: pipeline N; tree one a node and one wherever a lone branch waits for its level
  std::uint64_t link_pins = 0;       // pins of one link in one direction
  std::uint64_t processor_pins = 0;  // of an object processor: pipeline in and out, tree out
  std::uint64_t node_pins = 0;       // of a node of the tree: two in, one out; 0 in a pipeline
};
DecisionLogic decision_logic(const DecisionUnitParameters& parameters, std::uint64_t processors, const LinkWidth& link,
                             std::uint64_t comparator_cycles);

// ceil(log2 N): the levels of the tree.
std::uint64_t tree_levels(std::uint64_t processors);

// From a pixel's microinstruction at the first processor to its decision: N or ceil(log2 N) comparators.
Cycles latency(Topology topology, std::uint64_t processors, Cycles comparator);
// By how much the last processor works later than the first: the microinstruction travels with the pixel in a pipeline,
// and is broadcast in a tree.
Cycles skew(Topology topology, std::uint64_t processors, Cycles comparator);

}  // namespace rastertlm::decision_unit
