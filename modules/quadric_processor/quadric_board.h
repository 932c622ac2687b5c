// The quadric processors of one computation unit. A processor is a slot: words as in quadric_words.h in its loading RAM
// and the same in its backup RAM. Slots that were never written take no memory, processors that a line does not touch
// no time.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "modules/object_processor/band_index.h"
#include "modules/object_processor/object_board.h"
#include "modules/quadric_processor/parameters.h"
#include "modules/quadric_processor/quadric_pixel.h"
#include "modules/quadric_processor/quadric_words.h"
#include "modules/quadric_processor/ray_kernels.h"
#include "modules/quadric_processor/solid_region.h"
#include "src/base/vector_variant.h"
#include "src/frame/covered_line.h"

namespace rastertlm::quadric_processor {

using object_processor::BoardCounters;
using object_processor::kBandLines;
using object_processor::Visit;

// The screen and the words of the machine that a board is part of.
struct QuadricScreen {
  std::uint32_t columns = 512;  // 1..16384, as lines
  std::uint32_t lines = 512;
  unsigned depth_bits = 24;  // of depth and normal words
  DepthRange range;
};

class QuadricBoard {
 public:
  using SlotImage = QuadricImage;
  static constexpr unsigned kSlotShift = kQuadricShift;

  // `processors` slots; until it is told otherwise, slot i shows the object first_processor + i + 1. Every slot starts
  // parked.
  QuadricBoard(const QuadricParameters& parameters, const QuadricScreen& screen, std::uint32_t processors,
               std::uint32_t first_processor, Visit visit = Visit::needed, VectorVariant variant = vector_variant());

  std::uint32_t processors() const { return processors_; }
  std::uint32_t columns() const { return screen_.columns; }
  std::size_t words_a_slot() const { return words_of_slot(static_cast<std::size_t>(parameters_.caps)); }

  // A burst of words of 32 bits to the loading RAM of slot 0..processors-1, from `index` on; bits above a word's width
  // are lost. ModelError where there is no such slot or word.
  void write_words(std::uint32_t slot, std::size_t index, std::span<const std::uint32_t> values);
  void write(std::uint32_t slot, const QuadricWords& words);
  // Observer: the object, from 1, whose words the slot's loading RAM holds.
  void set_object(std::uint32_t slot, std::uint32_t object);

  // Loading RAMs to backup RAMs, at vertical retrace. Returns how many slots had been written since the last copy.
  std::uint32_t copy();

  QuadricWords backup(std::uint32_t slot) const;
  Interval lines_of_processor(std::uint32_t slot) const;  // that it can touch
  std::uint32_t slots_in_use() const;                     // whose backup words can touch a line

  // What the board's processors cover of `count` lines from `line` on, `step` apart and all of one band, as solids. It
  // stays until a line of another band is asked for, or a copy.
  void cover_lines(std::uint32_t line, std::size_t count, std::uint32_t step, const frame::CoveredLine** covered);
  bool covers_in_spans() const { return true; }

  const BoardCounters& counters() const { return counters_; }
  std::uint64_t memory_bytes() const;

 private:
  struct Slot {
    QuadricImage loading{};
    std::uint32_t object = 0;
    QuadricWords words;  // of the backup RAM
    frame::SolidSource source;
    SolidRegion region;
    bool parked = true;
    bool changed = false;
  };
  // What is covered of a line, and the columns of its spans one after the other.
  struct LineRoom {
    bool made = false;
    frame::CoveredLine covered;
    std::uint64_t fragments = 0;
    std::vector<frame::SolidSpan> spans;
    std::vector<std::uint32_t> depth;
    std::vector<std::uint32_t> root;
    std::vector<std::uint8_t> surface;
  };

  // Columns of a line that a slot may cover.
  struct Piece {
    const Slot* slot = nullptr;
    Interval columns;
  };

  Slot& writable(std::uint32_t slot, std::size_t index);
  void load(Slot& slot) const;
  void keep_widths(QuadricWords& words) const;
  void check_line(std::uint32_t line) const;
  LineRoom& room(std::uint32_t line);
  std::size_t find_pieces(std::uint32_t line);
  void cover(std::uint32_t line, LineRoom& room);
  void cover_slot(const Slot& slot, std::uint32_t line, const Interval& columns, std::size_t at, LineRoom& room);
  RayRequest request_for(const Slot& slot, std::uint32_t line, std::uint32_t column) const;

  static constexpr std::uint32_t kNoBand = ~0U;

  QuadricParameters parameters_;
  QuadricScreen screen_;
  object_processor::RootFormat root_;
  std::uint32_t processors_;
  std::uint32_t first_processor_;
  bool everything_;
  RayKernel kernel_;
  std::deque<Slot> slots_;  // spans point into them while others are added
  std::vector<Interval> intervals_;
  std::vector<std::uint32_t> changes_;
  object_processor::BandIndex bands_;
  std::uint32_t band_ = kNoBand;
  std::array<LineRoom, kBandLines> rooms_;
  std::vector<Piece> pieces_;        // of the line that is being covered
  std::vector<std::uint64_t> seen_;  // of the line that is being covered, a bit a column
  BoardCounters counters_;
};

}  // namespace rastertlm::quadric_processor
