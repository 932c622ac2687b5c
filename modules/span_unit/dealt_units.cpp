#include "modules/span_unit/dealt_units.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace rastertlm::span_unit {
namespace {

constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

std::uint64_t count(std::int64_t value) { return static_cast<std::uint64_t>(value); }

}  // namespace

DealtUnits::DealtUnits(const SpanUnitParameters& parameters, std::uint32_t columns, std::uint32_t lines, Store store)
    : parameters_(parameters), clock_(parameters.clock()), store_(std::move(store)) {
  units_.reserve(count(parameters.units));
  for (std::int64_t k = 0; k < parameters.units; ++k)
    units_.push_back({SpanUnit(parameters, columns, lines), {}, {}, {}, {}, 0, 0, 0, {}});
}

// As many triangles may wait as there are shadow sets; without one the unit must have ended.
bool DealtUnits::has_free_set(const Unit& unit) const {
  if (parameters_.shadow_sets == 0) return !unit.drawing() && unit.waiting.empty();
  return unit.waiting.size() < count(parameters_.shadow_sets);
}

// What has not begun when a set becomes free cannot be changed by this load, and what has begun could not be changed by
// an earlier one: units are advanced in the order of time, and only as far as that takes.
std::uint64_t DealtUnits::accept(const TriangleLoad& load, std::uint64_t asked_ps, std::uint64_t write_ps) {
  Unit& unit = units_[turn_];
  turn_ = (turn_ + 1) % units_.size();
  while (!has_free_set(unit)) advance();
  const std::size_t sets = count(parameters_.shadow_sets);
  const std::size_t known = unit.starts_ps.size() + unit.waiting.size();
  std::uint64_t set_free = 0;
  if (sets == 0)
    set_free = clock_.picoseconds(Cycles(unit.free));
  else if (known >= sets)  // the triangle that was so many before this one has started
    set_free = unit.starts_ps[known - sets];
  const std::uint64_t begin = std::max(asked_ps, set_free);
  unit.waiting.push_back({load, clock_.cycles_at(begin + write_ps).count() + count(parameters_.load_cycles)});
  return begin;
}

std::uint64_t DealtUnits::finish() {
  while (advance()) {
  }
  std::uint64_t end = 0;
  for (const Unit& unit : units_) end = std::max(end, unit.free);
  return end;
}

// When the unit next does something.
std::uint64_t DealtUnits::due(const Unit& unit) const {
  if (unit.drawing()) return unit.cycle;
  return unit.waiting.empty() ? kNever : std::max({unit.waiting.front().ready, unit.free, buffer_free_});
}

bool DealtUnits::advance() {
  Unit* first = nullptr;
  std::uint64_t when = kNever;
  for (Unit& unit : units_)
    if (due(unit) < when) {
      first = &unit;
      when = due(unit);
    }
  if (first == nullptr) return false;
  if (first->drawing())
    draw_span(*first);
  else
    start(*first);
  return true;
}

void DealtUnits::start(Unit& unit) {
  const std::uint64_t there = std::max(unit.waiting.front().ready, unit.free);
  const std::uint64_t begin = std::max(there, buffer_free_);
  const std::uint64_t loading = std::min<std::uint64_t>(count(parameters_.load_cycles), there - unit.free);
  unit.cycles.busy += loading;
  unit.cycles.starved += there - unit.free - loading;
  unit.cycles.blocked += begin - there;
  buffer_cycles_ += begin - there;
  tell(unit, UnitWork::starved, unit.free, there - loading);
  tell(unit, UnitWork::busy, there - loading, there);
  tell(unit, UnitWork::blocked, there, begin);
  unit.load = unit.waiting.front().load;
  unit.waiting.pop_front();
  unit.starts_ps.push_back(clock_.picoseconds(Cycles(begin)));
  if (unit.starts_ps.size() > count(std::max<std::int64_t>(parameters_.shadow_sets, 1))) unit.starts_ps.pop_front();
  const std::span<const Span> spans = unit.core.draw(unit.load).spans;
  unit.spans.assign(spans.begin(), spans.end());
  unit.next = 0;
  unit.cycle = begin;
  if (!unit.drawing()) unit.free = unit.cycle;
}

void DealtUnits::draw_span(Unit& unit) {
  const Span& span = unit.spans[unit.next++];
  const std::uint64_t end = unit.cycle + span.cycles;
  unit.cycles.busy += span.cycles;
  std::uint64_t taken = end;
  if (span.count > 0) {
    const std::uint64_t memory_end = store_(clock_.picoseconds(Cycles(unit.cycle)), span, unit.load);
    taken = std::max(end, clock_.cycles_at(memory_end).count());
  }
  unit.cycles.blocked += taken - end;
  tell(unit, UnitWork::busy, unit.cycle, end);
  tell(unit, UnitWork::blocked, end, taken);
  unit.cycle = taken;
  if (unit.drawing()) {
    tell(unit, UnitWork::busy, unit.cycle, unit.cycle + count(parameters_.line_change_cycles));
    unit.cycle += count(parameters_.line_change_cycles);
    unit.cycles.busy += count(parameters_.line_change_cycles);
  } else {
    unit.free = unit.cycle;
  }
}

void DealtUnits::tell(const Unit& unit, UnitWork work, std::uint64_t begin, std::uint64_t end) const {
  if (watcher_ && end > begin) watcher_(static_cast<std::size_t>(&unit - units_.data()), work, begin, end);
}

SpanCounters DealtUnits::counters() const {
  SpanCounters sum;
  for (const Unit& unit : units_) sum += unit.core.counters();
  return sum;
}

}  // namespace rastertlm::span_unit
