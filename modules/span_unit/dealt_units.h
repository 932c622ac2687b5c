// Several span units to which triangles are dealt in turn: what they draw, and when, in the order of time, because they
// share the frame store's memory. Knows no SystemC.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "modules/span_unit/span_unit.h"

namespace rastertlm::span_unit {

// Where a unit's cycles went: the three add up to the cycle at which its last triangle ended.
struct UnitCycles {
  std::uint64_t busy = 0;
  std::uint64_t starved = 0;
  std::uint64_t blocked = 0;
};

enum class UnitWork { busy, starved, blocked };

class DealtUnits {
 public:
  // Takes a span that begins at `begin_ps`; returns when the memory has taken it. Called in the order of time; at the
  // same time, of units.
  using Store = std::function<std::uint64_t(std::uint64_t begin_ps, const Span& span, const TriangleLoad& load)>;

  DealtUnits(const SpanUnitParameters& parameters, std::uint32_t columns, std::uint32_t lines, Store store);

  // Told what a unit did from one cycle to another.
  using Watcher = std::function<void(std::size_t unit, UnitWork work, std::uint64_t begin, std::uint64_t end)>;
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  // The frame's triangles may be drawn from this cycle of the units' clock on.
  void begin_frame(std::uint64_t cycle) { buffer_free_ = cycle; }

  // A load for the next unit in turn, asked for at `asked_ps`, not before the last one. Its words take `write_ps` once
  // a register set of the unit is free; returns when that is.
  std::uint64_t accept(const TriangleLoad& load, std::uint64_t asked_ps, std::uint64_t write_ps);
  // Draws what waits. Returns the cycle at which the last unit ends.
  std::uint64_t finish();

  std::size_t units() const { return units_.size(); }
  const UnitCycles& cycles(std::size_t unit) const { return units_[unit].cycles; }
  std::uint64_t end(std::size_t unit) const { return units_[unit].free; }
  // Cycles that units waited for the buffer, all together; the rest of blocked is the memory's.
  std::uint64_t buffer_cycles() const { return buffer_cycles_; }
  SpanCounters counters() const;

 private:
  struct Waiting {
    TriangleLoad load;
    std::uint64_t ready = 0;  // cycle of the first pixel, if nothing else waits
  };
  struct Unit {
    SpanUnit core;
    std::deque<Waiting> waiting;
    std::deque<std::uint64_t> starts_ps;  // of the last triangles
    TriangleLoad load;
    std::vector<Span> spans;  // of the triangle that is drawn
    std::size_t next = 0;     // of spans; all have been drawn: the unit is free
    std::uint64_t cycle = 0;
    std::uint64_t free = 0;
    UnitCycles cycles;
    bool drawing() const { return next < spans.size(); }
  };

  std::uint64_t due(const Unit& unit) const;
  bool advance();
  void start(Unit& unit);
  void draw_span(Unit& unit);
  void tell(const Unit& unit, UnitWork work, std::uint64_t begin, std::uint64_t end) const;
  bool has_free_set(const Unit& unit) const;

  SpanUnitParameters parameters_;
  Clock clock_;
  Store store_;
  std::vector<Unit> units_;
  std::size_t turn_ = 0;
  std::uint64_t buffer_free_ = 0;
  std::uint64_t buffer_cycles_ = 0;
  Watcher watcher_;
};

}  // namespace rastertlm::span_unit
