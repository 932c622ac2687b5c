// The object processors of one computation unit, as arrays. A processor is a slot: 21 coefficients and a material word
// in its loading RAM, the same in its backup RAM. Slots that were never written take no memory, processors that a line
// does not touch no time.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "modules/object_processor/line_evaluator.h"
#include "modules/object_processor/parameters.h"
#include "modules/object_processor/prenormaliser.h"
#include "modules/object_processor/triangle_processor.h"
#include "src/frame/scan_line.h"

namespace rastertlm::object_processor {

// Whether everything that the machine has is evaluated, or only what a line needs. The words are the same.
enum class Visit { needed, everything };

// fragments_in = fragments_kept + fragments_hidden, always.
struct BoardCounters {
  std::uint64_t fragments_in = 0;    // pixels covered, a processor
  std::uint64_t fragments_kept = 0;  // of them, seen in the line that leaves the board
  std::uint64_t fragments_hidden = 0;
  std::uint64_t lines_evaluated = 0;     // on which at least one processor was visited
  std::uint64_t processors_visited = 0;  // summed over lines
  std::uint64_t pixels_stepped = 0;      // evaluated one by one because an edge word could wrap
};

class ObjectBoard {
 public:
  // `processors` slots, numbered from `first_processor` in the whole machine. `columns` and `lines` 1..16384. Every
  // slot starts parked.
  ObjectBoard(const ObjectProcessorParameters& parameters, std::uint32_t processors, std::uint32_t first_processor,
              std::uint32_t columns, std::uint32_t lines, Visit visit = Visit::needed);

  std::uint32_t processors() const { return processors_; }
  std::uint32_t first_processor() const { return first_processor_; }
  std::uint32_t background_depth() const { return format_.mask(); }

  // A bus write to the loading RAM of slot 0..processors-1; `index` as in triangle_processor.h; the low word_bits of
  // `value` are kept, of the material word the low 8. ModelError where there is no such slot or word.
  void write_word(std::uint32_t slot, std::size_t index, std::uint32_t value);
  void write(std::uint32_t slot, const TriangleWords& triangle);
  void park(std::uint32_t slot);
  // Observer: the object, from 1, whose words the slot's loading RAM holds. Until it is set, the processor's number
  // + 1.
  void set_object(std::uint32_t slot, std::uint32_t object);

  // Loading RAMs to backup RAMs, at vertical retrace. Returns how many slots had been written since the last copy.
  std::uint32_t copy();

  TriangleWords loading(std::uint32_t slot) const;
  TriangleWords backup(std::uint32_t slot) const;
  std::uint32_t object_of_processor(std::uint32_t slot) const;  // of the backup RAM
  Interval lines_of_processor(std::uint32_t slot) const;        // that it can touch
  std::uint32_t slots_in_use() const;                           // whose backup words can touch a line

  // Merges what the board's processors show on `line` (0..lines-1) into `out`, which holds what arrives from processors
  // with lower numbers, or is cleared; `out` has this board's columns. Strictly smaller depth wins, so that equal depth
  // keeps the lower number. Lines taken in order, some left out or not, cost nothing extra; a step back looks at every
  // slot once.
  void evaluate_line(std::uint32_t line, frame::FragmentLine& out);

  const BoardCounters& counters() const { return counters_; }
  // Bytes held now.
  std::uint64_t memory_bytes() const;

 private:
  struct Slot {
    ProcessorWords loading;
    ProcessorWords backup;
    std::uint32_t loading_object;
    std::uint32_t object;
  };
  struct LineEdges {
    std::array<LineWord, 3> edges;
    std::uint32_t depth;  // at column 0
    std::uint32_t depth_step;
  };

  Slot& writable(std::uint32_t slot, std::size_t index);
  Slot parked_slot(std::uint32_t slot) const;
  Interval interval_of(const ProcessorWords& words) const;
  void rebuild_buckets();
  void select_processors(std::uint32_t line);
  void evaluate_processor(std::uint32_t slot, std::uint32_t line, frame::FragmentLine& out);
  void evaluate_late_carry(std::uint32_t slot, const ProcessorWords& words, std::uint32_t line,
                           frame::FragmentLine& out);
  void draw(std::uint32_t slot, const LineEdges& at, Interval span, frame::FragmentLine& out);
  void draw_stepped(std::uint32_t slot, const LineEdges& at, std::uint32_t wrapping, Interval span,
                    frame::FragmentLine& out);
  void draw_span(std::uint32_t slot, const LineEdges& at, Interval span, frame::FragmentLine& out);
  void resolve_winners(std::uint32_t line, frame::FragmentLine& out);
  void fill_run(std::uint32_t slot, std::uint32_t line, std::size_t begin, std::size_t end, frame::FragmentLine& out);

  static constexpr std::uint32_t kNoLine = std::numeric_limits<std::uint32_t>::max();

  ObjectProcessorParameters parameters_;
  WordFormat format_;
  Prenormaliser prenormaliser_;
  std::uint32_t processors_;
  std::uint32_t first_processor_;
  std::uint32_t columns_;
  std::uint32_t lines_;
  bool everything_;
  bool late_carry_;

  std::vector<Slot> slots_;                  // as far as slots were ever written
  std::vector<std::uint8_t> changed_;        // a slot, since the last copy
  std::vector<std::uint32_t> changes_;       // the slots with changed_ set
  std::vector<Interval> intervals_;          // a slot, of its backup words
  std::vector<std::uint32_t> bucket_begin_;  // lines + 1: where the slots that begin on a line stand in bucket_slots_
  std::vector<std::uint32_t> bucket_slots_;  // in order of their numbers within a line

  std::vector<std::uint32_t> active_;     // slots whose interval holds current_line_, in order of their numbers
  std::vector<std::uint32_t> merged_;     // the next active_, in the making
  std::vector<std::uint32_t> newcomers_;  // of them, those that begin after the line before
  std::uint32_t current_line_ = kNoLine;

  // Of the line being evaluated. winner_ is zero between lines.
  Interval touched_;
  std::vector<std::uint32_t> winner_;  // slot + 1 of this board's nearest so far, or 0; one column more than the screen
  std::array<std::vector<std::uint32_t>, 3> normal_;  // words of the winners before normalisation
  BoardCounters counters_;
};

}  // namespace rastertlm::object_processor
