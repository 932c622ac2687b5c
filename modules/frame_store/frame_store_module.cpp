#include "modules/frame_store/frame_store_module.h"

#include <algorithm>

#include "modules/stream/simulated_time.h"

namespace rastertlm::frame_store {
namespace {

// The memory can take no longer than the span unit for any span: nothing else is read through its port, and the
// accesses that a pixel can ask for, its word read and written, fit a pixel's time.
bool keeps_up(const FrameStoreParameters& parameters, const MemoryLayout& layout, std::uint64_t pixel_ps) {
  return parameters.scan_out == ScanOut::separate &&
         (layout.depth_words + layout.write_words) * parameters.access_ps() <= pixel_ps;
}

}  // namespace

FrameStoreModule::FrameStoreModule(const sc_core::sc_module_name& name, const FrameStoreParameters& parameters,
                                   FrameStore& store, const MemoryLayout& layout, const video::Timing& timing,
                                   std::uint64_t pixel_ps)
    : sc_module(name),
      in("in"),
      out("out"),
      parameters_(parameters),
      store_(store),
      layout_(layout),
      timing_(timing),
      schedule_(parameters.access_ps(), parameters.scan_out == ScanOut::shared ? std::optional(timing) : std::nullopt,
                layout.lines, layout.line_accesses()),
      clock_(Clock::from_period_ns("memory access", parameters.access_ns)),
      quick_(keeps_up(parameters, layout, pixel_ps)) {
  rgb_.resize(layout.columns);
  if (parameters.changes_while_shown())
    reader_.emplace(store, timing, static_cast<std::uint32_t>(layout.columns), static_cast<std::uint32_t>(layout.lines),
                    [this](const ScreenReader::Line& line, const frame::RgbLine& levels) { send_read(line, levels); });
  constexpr std::size_t kBits = 64;
  if (layout.asks_which_won()) won_.resize((layout.columns + kBits - 1) / kBits);
  in.register_b_transport(this, &FrameStoreModule::receive);
}

void FrameStoreModule::receive(SpanPayload& payload, sc_core::sc_time& delay) {
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  switch (payload.kind) {
    case SpanPayload::Kind::frame:
      return begin_frame(payload, delay);
    case SpanPayload::Kind::spans:
      return draw(payload, delay);
    case SpanPayload::Kind::end:
      return end_frame(payload, delay);
  }
}

// The frame may be drawn when its buffer is free and has been cleared. Where it is not, what stands there stays: with a
// depth test, what was nearer as well.
void FrameStoreModule::begin_frame(SpanPayload& payload, sc_core::sc_time& delay) {
  payload.keeps_up = quick_ && !reader_;  // a screen sees when each span is drawn
  const std::uint64_t now = stream::picoseconds_now();
  std::uint64_t free = std::max<std::uint64_t>(now + delay.value(), buffer_free_ps_);
  begun_ps_ = free;
  begun_accesses_ = drawing_accesses_ + clear_accesses_;
  if (parameters_.clear) {
    clear_accesses_ += layout_.clear_accesses();
    free = schedule_.serve(free, layout_.clear_accesses());
    clear(free);
  }
  delay = stream::to_time(free - now);
}

// Line by line where the screen may be looking.
void FrameStoreModule::clear(std::uint64_t until_ps) {
  if (!reader_ || parameters_.buffers == 2) return store_.clear();
  for (std::uint64_t line = 0; line < layout_.lines; ++line) {
    reader_->advance(begun_ps_ + (until_ps - begun_ps_) * line / layout_.lines);
    store_.clear(static_cast<std::uint32_t>(line));
  }
}

// One span, of whose payload that many pixels come before.
std::uint32_t FrameStoreModule::draw_span(const SpanPayload& payload, const span_unit::Span& span,
                                          std::uint64_t pixels_before) {
  std::uint64_t* const won = won_.empty() ? nullptr : won_.data();
  if (payload.levels.empty()) return store_.draw({&span, 1}, payload.object, payload.material, won);
  return store_.draw_levels({&span, 1}, payload.levels.subspan(pixels_before, span.count), payload.object,
                            payload.material, won);
}

// A span is seen from the instant at which it begins.
void FrameStoreModule::draw(const SpanPayload& payload, sc_core::sc_time& delay) {
  if (quick_ && won_.empty() && !reader_) {
    const std::uint64_t kept =
        payload.levels.empty() ? store_.draw(payload.spans, payload.object, payload.material)
                               : store_.draw_levels(payload.spans, payload.levels, payload.object, payload.material);
    const std::uint64_t accesses = layout_.span_accesses(0, payload.pixels, kept, nullptr);
    drawing_accesses_ += accesses;
    tell_quick(stream::picoseconds_now() + delay.value(), accesses);
    return;
  }
  const std::uint64_t now = stream::picoseconds_now();
  std::uint64_t until = now + delay.value();
  std::uint64_t pixels = 0;
  for (const span_unit::Span& span : payload.spans) {
    if (reader_) reader_->advance(until);
    const std::uint32_t kept = draw_span(payload, span, pixels);
    pixels += span.count;
    const std::uint64_t accesses =
        layout_.span_accesses(span.column, span.count, kept, won_.empty() ? nullptr : won_.data());
    drawing_accesses_ += accesses;
    if (quick_)
      tell_quick(until, accesses);
    else
      until = schedule_.serve(until, accesses);
  }
  delay = stream::to_time(until - now);
}

// What keeps up is not scheduled.
void FrameStoreModule::tell_quick(std::uint64_t begin_ps, std::uint64_t accesses) const {
  if (watcher_ && accesses > 0) watcher_(false, begin_ps, begin_ps + accesses * parameters_.access_ps());
}

// Two buffers: the other one is free to be drawn when this one is shown. One: when the screen has shown it once, whole;
// or at once where it does not wait for the screen, which then shows it half drawn as well. A retrace swaps two
// buffers once: a frame that takes no time is shown at the next one after its buffer became free.
void FrameStoreModule::end_frame(SpanPayload& payload, const sc_core::sc_time& delay) {
  const std::uint64_t drawn = stream::picoseconds_now() + delay.value();
  note_starved(drawn);
  const bool waits = parameters_.swap == Swap::retrace;
  const std::uint64_t swapped = parameters_.buffers == 2 ? buffer_free_ps_ + 1 : 0;
  payload.shown_ps = waits ? retrace_from(std::max(drawn, swapped)) : drawn;
  const bool once_shown = waits && parameters_.buffers == 1;
  buffer_free_ps_ = once_shown ? retrace_from(payload.shown_ps + 1) : payload.shown_ps;
  if (!reader_) {
    store_.swap();
    return scan_out(payload.frame, payload.shown_ps);
  }
  reader_->advance(drawn);
  store_.swap();
  reader_->expect(payload.frame, retrace_from(drawn));
}

void FrameStoreModule::finish() {
  if (reader_) reader_->finish();
}

// Of the time in which a frame was drawn, what nobody used.
void FrameStoreModule::note_starved(std::uint64_t drawn_ps) {
  if (drawn_ps <= begun_ps_) return;
  const std::uint64_t passed = (drawn_ps - begun_ps_) / parameters_.access_ps();
  const std::uint64_t used = drawing_accesses_ + clear_accesses_ - begun_accesses_ + scan_out_accesses(drawn_ps) -
                             scan_out_accesses(begun_ps_);
  if (passed > used) starved_ += passed - used;
}

stream::Occupancy FrameStoreModule::occupancy(std::uint64_t until_ps) const {
  stream::Occupancy occupancy;
  occupancy.busy = drawing_accesses_ + clear_accesses_ + scan_out_accesses(until_ps);
  // A burst that falls due at the very end counts whole.
  occupancy.cycles = std::max(occupancy.busy, until_ps / parameters_.access_ps());
  occupancy.starved = std::min(starved_, occupancy.cycles - occupancy.busy);
  occupancy.idle = occupancy.cycles - occupancy.busy - occupancy.starved;
  return occupancy;
}

std::uint64_t FrameStoreModule::retrace_from(std::uint64_t picoseconds) const {
  const std::uint64_t clocks = timing_.clock.cycles_at(picoseconds).count();
  const std::uint64_t frame = timing_.frame.count();
  return timing_.clock.picoseconds(Cycles((clocks + frame - 1) / frame * frame));
}

// Simulated time may have passed it by: what is drawn is known before it is.
void FrameStoreModule::send_read(const ScreenReader::Line& line, const frame::RgbLine& levels) {
  torn_lines_.resize(std::max<std::size_t>(torn_lines_.size(), line.frame + 1));
  torn_lines_[line.frame] = line.torn_lines;
  payload_.frame = line.frame;
  payload_.line = line.number;
  payload_.rgb = &levels;
  payload_.fragments = &fragments_;
  const std::uint64_t now = stream::picoseconds_now();
  sc_core::sc_time delay = stream::to_time(std::max(line.first_pixel_ps, now) - now);
  out->b_transport(payload_, delay);
}

// The lines of the first screen that shows it, with their times.
void FrameStoreModule::scan_out(std::uint64_t frame, std::uint64_t shown_ps) {
  const std::uint64_t now = stream::picoseconds_now();
  payload_.frame = frame;
  payload_.rgb = &rgb_;
  payload_.fragments = &fragments_;
  for (std::size_t line = 0; line < layout_.lines; ++line) {
    store_.scan_out(static_cast<std::uint32_t>(line), rgb_);
    payload_.line = line;
    sc_core::sc_time delay = stream::to_time(shown_ps + timing_.clock.picoseconds(timing_.first_pixel(line)) - now);
    out->b_transport(payload_, delay);
  }
}

}  // namespace rastertlm::frame_store
