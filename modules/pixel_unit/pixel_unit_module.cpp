#include "modules/pixel_unit/pixel_unit_module.h"

#include <algorithm>

#include "modules/stream/simulated_time.h"

namespace rastertlm::pixel_unit {

using frame_store::SpanPayload;

PixelUnitModule::PixelUnitModule(const sc_core::sc_module_name& name, const PixelUnitParameters& parameters,
                                 PixelShader& shader, stream::Link& link)
    : sc_module(name),
      in("in"),
      out("out"),
      parameters_(parameters),
      shader_(shader),
      clock_(parameters.clock()),
      link_(link) {
  in.register_b_transport(this, &PixelUnitModule::receive);
}

void PixelUnitModule::receive(SpanPayload& payload, sc_core::sc_time& delay) {
  if (payload.kind == SpanPayload::Kind::spans && payload.shading != nullptr) return shade(payload, delay);
  if (payload.kind == SpanPayload::Kind::frame) loaded_ = nullptr;
  pass(payload, delay);
  // Spans come one by one: the memory may keep up, this unit need not.
  if (payload.kind == SpanPayload::Kind::frame) payload.keeps_up = false;
}

// In order: behind the levels that are still on their way. A frame is whole when they have arrived.
void PixelUnitModule::pass(SpanPayload& payload, sc_core::sc_time& delay) {
  const std::uint64_t now = stream::picoseconds_now();
  sc_core::sc_time until = stream::to_time(std::max<std::uint64_t>(now + delay.value(), drained_ps_) - now);
  if (payload.kind == SpanPayload::Kind::spans) {
    passed_ += payload.pixels;
    link_.record(payload.pixels, Cycles(payload.pixels));
  }
  out->b_transport(payload, until);
  delay = until;
}

void PixelUnitModule::shade(SpanPayload& payload, sc_core::sc_time& delay) {
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  const std::uint64_t now = stream::picoseconds_now();
  std::uint64_t until = now + delay.value();
  if (payload.shading != loaded_) {
    shader_.set_up(*payload.shading);
    loaded_ = payload.shading;
    const auto load_cycles = static_cast<std::uint64_t>(parameters_.load_cycles);
    const std::uint64_t begin = std::max(clock_.cycles_at(until).count(), free_);
    occupancy_.starved += begin - free_;
    occupancy_.busy += load_cycles;
    free_ = begin + load_cycles;
  }
  for (const span_unit::Span& span : payload.spans)
    if (span.count > 0) until = shade_span(payload, span, until);
  delay = stream::to_time(until - now);
}

// Returns when the next span may come. A pixel enters every `cycles_per_pixel`; its level leaves `latency_cycles` after
// it. Where the memory takes longer than that, the next pixel waits.
std::uint64_t PixelUnitModule::shade_span(const SpanPayload& payload, const span_unit::Span& span,
                                          std::uint64_t at_ps) {
  const auto interval = static_cast<std::uint64_t>(parameters_.cycles_per_pixel);
  const auto latency = static_cast<std::uint64_t>(parameters_.latency_cycles);
  const auto line_cycles = static_cast<std::uint64_t>(parameters_.cycles_per_line);
  const std::uint64_t begin = std::max(clock_.cycles_at(at_ps).count(), free_);
  const std::uint64_t first = begin + line_cycles;
  const std::uint64_t end = first + span.count * interval;
  shader_.shade(span, levels_);
  payload_.frame = payload.frame;
  payload_.spans = {&span, 1};
  payload_.pixels = span.count;
  payload_.levels = levels_;
  payload_.object = payload.object;
  payload_.material = payload.material;
  const std::uint64_t now = stream::picoseconds_now();
  sc_core::sc_time until = stream::to_time(clock_.picoseconds(Cycles(first + latency)) - now);
  link_.record(span.count, Cycles(span.count));
  out->b_transport(payload_, until);
  const std::uint64_t stored_ps = now + until.value();
  const std::uint64_t stored = clock_.cycles_at(stored_ps).count();
  occupancy_.starved += begin - free_;
  occupancy_.busy += end - begin;
  free_ = std::max(end, stored - std::min(stored, latency));
  occupancy_.blocked += free_ - end;
  drained_ps_ = std::max(clock_.picoseconds(Cycles(end - interval + latency)), stored_ps);
  shaded_ += span.count;
  return clock_.picoseconds(Cycles(free_));
}

stream::Occupancy PixelUnitModule::occupancy() const {
  stream::Occupancy occupancy = occupancy_;
  occupancy.cycles = free_;
  return occupancy;
}

}  // namespace rastertlm::pixel_unit
