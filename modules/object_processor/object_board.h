// The object processors of one computation unit, as arrays. A processor is a slot: 21 coefficients and a material word
// in its loading RAM, the same in its backup RAM. Slots that were never written take no memory, processors that a line
// does not touch no time.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modules/object_processor/band_index.h"
#include "modules/object_processor/bus_address.h"
#include "modules/object_processor/line_evaluator.h"
#include "modules/object_processor/parameters.h"
#include "modules/object_processor/prenormaliser.h"
#include "modules/object_processor/span_kernels.h"
#include "modules/object_processor/triangle_processor.h"
#include "src/base/vector_variant.h"
#include "src/frame/covered_line.h"
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
  // For whoever stands on the bus (board_module.h).
  using SlotImage = ProcessorWords;
  static constexpr unsigned kSlotShift = kProcessorShift;
  static constexpr std::size_t words_a_slot() { return kWords; }

  // `processors` slots, numbered from `first_processor` in the whole machine. `columns` and `lines` 1..16384. Every
  // slot starts parked.
  ObjectBoard(const ObjectProcessorParameters& parameters, std::uint32_t processors, std::uint32_t first_processor,
              std::uint32_t columns, std::uint32_t lines, Visit visit = Visit::needed,
              VectorVariant variant = vector_variant());

  std::uint32_t processors() const { return processors_; }
  std::uint32_t first_processor() const { return first_processor_; }
  std::uint32_t columns() const { return columns_; }
  std::uint32_t background_depth() const { return format_.mask(); }

  // A bus write to the loading RAM of slot 0..processors-1; `index` as in triangle_processor.h; the low word_bits of
  // `value` are kept, of the material word the low 8. ModelError where there is no such slot or word.
  void write_word(std::uint32_t slot, std::size_t index, std::uint32_t value) { write_words(slot, index, {&value, 1}); }
  // A burst of words from `index` on.
  void write_words(std::uint32_t slot, std::size_t index, std::span<const std::uint32_t> values);
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
  // keeps the lower number.
  void evaluate_line(std::uint32_t line, frame::FragmentLine& out);

  // The same as spans, for whoever compares them (LineComposer): everything that the board's processors cover on the
  // line. Counts what evaluate_line into an empty line counts. What is returned stays until a line of another band is
  // asked for, bands being kBandLines lines from a multiple of it on, or a copy. Not with late carries
  // (covers_in_spans).
  const frame::CoveredLine& cover_line(std::uint32_t line) {
    const frame::CoveredLine* covered = nullptr;
    cover_lines(line, 1, 1, &covered);
    return *covered;
  }
  // The same of `count` lines from `line` on, `step` apart and all of one band.
  void cover_lines(std::uint32_t line, std::size_t count, std::uint32_t step, const frame::CoveredLine** covered);
  bool covers_in_spans() const { return !late_carry_; }

  const BoardCounters& counters() const { return counters_; }
  // Bytes held now.
  std::uint64_t memory_bytes() const;

 private:
  struct Loading {
    ProcessorWords words;
    std::uint32_t object;
  };
  struct LineEdges {
    std::array<LineWord, 3> edges;
    std::uint32_t depth;  // at column 0
    std::uint32_t depth_step;
  };
  using Edges = std::array<LinearWords, 3>;
  struct Ready {  // a line of a band
    frame::CoveredLine covered;
    std::uint64_t fragments = 0;
    std::uint32_t touched = 0;  // slots that can touch the line
    bool careful = false;       // to be found alone
  };

  Loading& writable(std::uint32_t slot, std::size_t index);
  Loading parked_slot(std::uint32_t slot) const;
  void reserve(std::size_t slots);
  void load(std::uint32_t slot);
  Interval interval_of(const Edges& edges, const HalfPlanes& planes) const;
  void check_line(std::uint32_t line, std::size_t columns) const;
  void make_ready(std::uint32_t line);
  void evaluate_processor(std::uint32_t slot, std::uint32_t line, frame::FragmentLine& out);
  void evaluate_late_carry(std::uint32_t slot, std::uint32_t line, frame::FragmentLine& out);
  LineEdges line_edges(std::uint32_t slot, std::uint32_t line) const;
  template <class Draw>
  void visit_spans(const LineEdges& at, Interval span, const Draw& draw);
  template <class Draw>
  void visit_stepped(const LineEdges& at, std::uint32_t wrapping, Interval span, const Draw& draw);
  void cover_carefully(std::uint32_t line, Ready& ready);
  void cover_span(std::uint32_t slot, const LineEdges& at, Interval span, std::vector<frame::CoveredSpan>& spans);
  void draw_span(std::uint32_t slot, const LineEdges& at, Interval span, frame::FragmentLine& out);
  void resolve_winners(std::uint32_t line, frame::FragmentLine& out);
  void fill_run(std::uint32_t slot, std::uint32_t line, std::size_t begin, std::size_t end, frame::FragmentLine& out);

  static constexpr std::uint32_t kNone = std::uint32_t{1} << 31;  // no line or band, nor near one, modulo 2^32

  // What every line asks for, side by side. Lines of a band that were found together, from ready_first_ on.
  BoardCounters counters_;
  std::uint32_t ready_first_ = kNone;
  std::array<Ready, kBandLines> ready_;

  ObjectProcessorParameters parameters_;
  WordFormat format_;
  Prenormaliser prenormaliser_;
  std::uint32_t processors_;
  std::uint32_t first_processor_;
  std::uint32_t columns_;
  std::uint32_t lines_;
  bool everything_;
  bool late_carry_;

  const SpanKernels& kernels_;

  // A slot, as far as slots were ever written.
  std::vector<Loading> loading_;
  std::vector<Edges> edges_;                    // of the backup RAM
  std::vector<frame::FragmentSource> sources_;  // the rest of the backup RAM
  std::vector<Borders> borders_;                // of the backup words, where they are in closed form
  std::vector<Interval> intervals_;             // lines that the backup words can touch
  std::vector<std::uint8_t> careful_;           // whether an edge could wrap, or has no place in Borders
  std::uint32_t careful_count_ = 0;
  std::vector<std::uint8_t> changed_;  // since the last copy

  std::vector<std::uint32_t> changes_;  // the slots with changed_ set
  BandIndex bands_;

  std::vector<frame::CoveredSpan> spans_;  // of the band that is ready

  // Of the line being evaluated. winner_ is zero between lines.
  Interval touched_;
  std::vector<std::uint32_t> winner_;  // slot + 1 of this board's nearest so far, or 0; one column more than the screen
  std::array<std::vector<std::uint32_t>, 3> normal_;                       // words of the winners before normalisation
  std::vector<std::uint64_t> seen_;                                        // a bit a column, for each line of a band
  std::array<std::vector<frame::CoveredSpan>, kBandLines> careful_spans_;  // of the band that is ready
};

}  // namespace rastertlm::object_processor
