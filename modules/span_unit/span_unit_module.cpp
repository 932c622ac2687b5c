#include "modules/span_unit/span_unit_module.h"

#include <algorithm>

#include "modules/stream/simulated_time.h"

namespace rastertlm::span_unit {

using frame_store::SpanPayload;

namespace {

stream::Activity activity_of(UnitWork work) {
  switch (work) {
    case UnitWork::busy:
      return stream::Activity::busy;
    case UnitWork::starved:
      return stream::Activity::starved;
    case UnitWork::blocked:
      return stream::Activity::blocked;
  }
  return stream::Activity::idle;
}

}  // namespace

SpanUnitModule::SpanUnitModule(const sc_core::sc_module_name& name, const SpanUnitParameters& parameters,
                               std::uint32_t columns, std::uint32_t lines, stream::Link& link)
    : sc_module(name),
      bus("bus"),
      out("out"),
      parameters_(parameters),
      unit_(parameters, columns, lines),
      clock_(parameters.clock()),
      link_(link) {
  bus.register_b_transport(this, &SpanUnitModule::receive);
  if (parameters.units > 1 && parameters.share == Share::triangles)
    dealt_ = std::make_unique<DealtUnits>(
        parameters, columns, lines, [this](std::uint64_t begin_ps, const Span& span, const TriangleLoad& load) {
          return store(begin_ps, Cycles(span.cycles), {{&span, 1}, span.count, span.cycles}, load);
        });
}

void SpanUnitModule::receive(LoadPayload& payload, sc_core::sc_time& delay) {
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  payload_.frame = payload.frame;
  switch (payload.kind) {
    case LoadPayload::Kind::frame:
      return begin_frame(payload, delay);
    case LoadPayload::Kind::triangle:
      return draw(payload, delay);
    case LoadPayload::Kind::end:
      return end_frame(payload, delay);
  }
}

// The store answers with the time from which the frame may be drawn.
void SpanUnitModule::begin_frame(LoadPayload&, sc_core::sc_time& delay) {
  payload_.kind = SpanPayload::Kind::frame;
  sc_core::sc_time until = delay;
  out->b_transport(payload_, until);
  memory_keeps_up_ = payload_.keeps_up;
  buffer_free_ = clock_.cycles_at(stream::picoseconds_now() + until.value()).count();
  if (dealt_) dealt_->begin_frame(buffer_free_);
}

// The frame is whole when the last triangle has been drawn, and the host has said that there is no other; one without
// triangles when its buffer is free and cleared.
void SpanUnitModule::end_frame(LoadPayload& payload, sc_core::sc_time& delay) {
  if (dealt_) free_ = dealt_->finish();
  payload_.kind = SpanPayload::Kind::end;
  const std::uint64_t now = stream::picoseconds_now();
  const std::uint64_t told = now + delay.value();
  sc_core::sc_time until = stream::to_time(std::max({end_ps(), clock_.picoseconds(Cycles(buffer_free_)), told}) - now);
  out->b_transport(payload_, until);
  payload.shown_ps = payload_.shown_ps;
}

// When a register set can be written: as many triangles may wait as there are shadow sets, and a set that is drawn from
// is not written.
std::uint64_t SpanUnitModule::set_free_ps() const {
  if (parameters_.shadow_sets == 0) return clock_.picoseconds(Cycles(free_));
  return starts_ps_.size() < static_cast<std::size_t>(parameters_.shadow_sets) ? 0 : starts_ps_.front();
}

// Its words are written as soon as a set is free; it is drawn when they are there, the last triangle has ended and the
// buffer is free.
void SpanUnitModule::draw(LoadPayload& payload, sc_core::sc_time& delay) {
  const std::uint64_t now = stream::picoseconds_now();
  const std::uint64_t asked = now + delay.value();
  const std::uint64_t begin =
      dealt_ ? dealt_->accept(*payload.load, asked, payload.write_ps) : std::max<std::uint64_t>(asked, set_free_ps());
  payload.blocked_ps = begin - asked;
  const std::uint64_t written = begin + payload.write_ps;
  delay = stream::to_time(written - now);
  ++loads_received_;
  words_loaded_ += payload.words;
  if (dealt_) return;
  const auto load_cycles = static_cast<std::uint64_t>(parameters_.load_cycles);
  const std::uint64_t there = std::max(clock_.cycles_at(written).count() + load_cycles, free_);
  const std::uint64_t start = std::max(there, buffer_free_);
  // A load that waited in shadow registers costs nothing.
  const std::uint64_t loading = std::min(load_cycles, there - free_);
  occupancy_.busy += loading;
  occupancy_.starved += there - free_ - loading;
  occupancy_.blocked += start - there;
  blocked_by_buffer_ += start - there;
  tell(stream::Activity::starved, free_, there - loading);
  tell(stream::Activity::busy, there - loading, there);
  tell(stream::Activity::blocked, there, start);
  starts_ps_.push_back(clock_.picoseconds(Cycles(start)));
  if (starts_ps_.size() > static_cast<std::size_t>(std::max<std::int64_t>(parameters_.shadow_sets, 1)))
    starts_ps_.pop_front();
  draw_from(start, *payload.load);
}

void SpanUnitModule::draw_from(std::uint64_t cycle, const TriangleLoad& load) {
  const DrawnLines drawn = unit_.draw(load);
  const auto line_change = static_cast<std::uint64_t>(parameters_.line_change_cycles);
  const std::uint64_t changes = drawn.spans.empty() ? 0 : (drawn.spans.size() - 1) * line_change;
  occupancy_.busy += changes + drawn.cycles;
  if (memory_keeps_up_) {
    free_ = cycle + changes + drawn.cycles;
    store(clock_.picoseconds(Cycles(cycle)), Cycles(free_ - cycle), drawn, load);
    tell(stream::Activity::busy, cycle, free_);
    return;
  }
  for (const Span& span : drawn.spans) {
    const std::uint64_t before = cycle;
    if (&span != drawn.spans.data()) cycle += line_change;
    const std::uint64_t end = cycle + span.cycles;
    std::uint64_t taken = end;
    if (span.count > 0) {
      const std::uint64_t begin_ps = clock_.picoseconds(Cycles(cycle));
      const std::uint64_t memory_end =
          store(begin_ps, Cycles(span.cycles), {{&span, 1}, span.count, span.cycles}, load);
      if (memory_end > begin_ps) taken = std::max(end, clock_.cycles_at(memory_end).count());
    }
    occupancy_.blocked += taken - end;
    tell(stream::Activity::busy, before, end);
    tell(stream::Activity::blocked, end, taken);
    cycle = taken;
  }
  free_ = cycle;
}

// Cycles in which pixels cross; where several units send at once, once.
Cycles SpanUnitModule::crossing(std::uint64_t begin_ps, const DrawnLines& drawn) {
  const auto units = static_cast<std::uint64_t>(parameters_.units);
  if (units == 1) return Cycles(drawn.pixels);
  if (!dealt_) {
    std::uint64_t cycles = 0;
    for (const Span& span : drawn.spans) cycles += (span.count + units - 1) / units;
    return Cycles(cycles);
  }
  const auto pixel = static_cast<std::uint64_t>(parameters_.pixel_cycles);
  const std::uint64_t begin = clock_.cycles_at(begin_ps).count();
  const std::uint64_t end = begin + drawn.pixels * pixel;
  const std::uint64_t alone = std::max(begin, sent_until_);
  if (end <= alone) return Cycles(0);
  sent_until_ = end;
  return Cycles((end - alone + pixel - 1) / pixel);
}

// Returns when the memory has taken the spans.
std::uint64_t SpanUnitModule::store(std::uint64_t begin_ps, Cycles taken, const DrawnLines& drawn,
                                    const TriangleLoad& load) {
  payload_.kind = SpanPayload::Kind::spans;
  payload_.spans = drawn.spans;
  payload_.pixels = drawn.pixels;
  payload_.shading = load.shading;
  payload_.object = load.object;
  payload_.material = load.material;
  pixels_sent_ += drawn.pixels;
  const std::uint64_t words = pixels_sent_ / static_cast<std::uint64_t>(parameters_.units) - link_.words();
  link_.record(words, crossing(begin_ps, drawn), begin_ps, begin_ps + clock_.picoseconds(taken));
  const std::uint64_t now = stream::picoseconds_now();
  sc_core::sc_time until = stream::to_time(begin_ps - now);
  out->b_transport(payload_, until);
  return now + until.value();
}

void SpanUnitModule::watch(const Watcher& watcher) {
  watcher_ = watcher;
  if (dealt_)
    dealt_->watch([this](std::size_t unit, UnitWork work, std::uint64_t begin, std::uint64_t end) {
      watcher_(unit, activity_of(work), clock_.picoseconds(Cycles(begin)), clock_.picoseconds(Cycles(end)));
    });
}

void SpanUnitModule::tell(stream::Activity activity, std::uint64_t begin, std::uint64_t end) const {
  if (watcher_ && end > begin)
    watcher_(0, activity, clock_.picoseconds(Cycles(begin)), clock_.picoseconds(Cycles(end)));
}

std::vector<stream::Occupancy> SpanUnitModule::occupancies() const {
  std::vector<stream::Occupancy> all;
  if (dealt_) {
    for (std::size_t unit = 0; unit < dealt_->units(); ++unit) {
      const UnitCycles& cycles = dealt_->cycles(unit);
      all.push_back({dealt_->end(unit), cycles.busy, cycles.starved, cycles.blocked, 0});
    }
    return all;
  }
  all.push_back(occupancy_);
  all.front().cycles = free_;
  return all;
}

std::uint64_t SpanUnitModule::memory_cycles() const {
  std::uint64_t blocked = 0;
  for (const stream::Occupancy& unit : occupancies()) blocked += unit.blocked;
  return blocked - (dealt_ ? dealt_->buffer_cycles() : blocked_by_buffer_);
}

}  // namespace rastertlm::span_unit
