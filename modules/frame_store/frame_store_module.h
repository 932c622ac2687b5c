// The frame store on its board: spans in, the screen's lines out, and a memory that both wait for.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <optional>
#include <systemc>
#include <vector>

#include "modules/frame_store/frame_store.h"
#include "modules/frame_store/memory_schedule.h"
#include "modules/frame_store/screen_reader.h"
#include "modules/frame_store/span_payload.h"
#include "modules/stream/line_payload.h"
#include "modules/stream/occupancy.h"
#include "modules/video/timing.h"

namespace rastertlm::frame_store {

class FrameStoreModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<FrameStoreModule, stream::kNoBusWidth, SpanProtocol> in;
  tlm_utils::simple_initiator_socket<FrameStoreModule, stream::kNoBusWidth, stream::RgbProtocol> out;

  // `pixel_ps`: the span unit's time a pixel; where the memory takes no longer for any span, spans are not scheduled
  // one by one. Of several units that send spans of their own, divided by their number.
  FrameStoreModule(const sc_core::sc_module_name& name, const FrameStoreParameters& parameters, FrameStore& store,
                   const MemoryLayout& layout, const video::Timing& timing, std::uint64_t pixel_ps);

  // Memory accesses of spans and clears so far, and of lines that were due to be read through the same port before
  // then; of the busiest bank.
  std::uint64_t drawing_accesses() const { return drawing_accesses_; }
  std::uint64_t clear_accesses() const { return clear_accesses_; }
  std::uint64_t scan_out_accesses(std::uint64_t until_ps) const {
    return schedule_.bursts_before(until_ps) * layout_.line_accesses();
  }
  // Where the memory's time went until then, in accesses of the busiest bank: busy with what the three count, starved
  // where a frame was being drawn and the span unit asked for nothing, idle otherwise. It never waits for anybody.
  stream::Occupancy occupancy(std::uint64_t until_ps) const;
  const Clock& clock() const { return clock_; }
  const MemorySchedule& schedule() const { return schedule_; }
  bool never_waited_for() const { return quick_; }
  // When the screen that shows a frame begins, which was shown from `shown_ps` on: the first whole one.
  std::uint64_t screen_ps(std::uint64_t shown_ps) const { return retrace_from(shown_ps); }
  // Lines of a frame's screen that do not show it as it was when it was whole; known once its last line has been sent.
  std::uint64_t torn_lines(std::uint64_t frame) const { return frame < torn_lines_.size() ? torn_lines_[frame] : 0; }
  // Nothing more will be drawn: sends what is left of screens.
  void finish();
  // Told when the memory serves spans and clears, or the screen.
  void watch(const MemorySchedule::Watcher& watcher) {
    watcher_ = watcher;
    schedule_.watch(watcher);
  }

 private:
  void receive(SpanPayload& payload, sc_core::sc_time& delay);
  void begin_frame(SpanPayload& payload, sc_core::sc_time& delay);
  void draw(const SpanPayload& payload, sc_core::sc_time& delay);
  std::uint32_t draw_span(const SpanPayload& payload, const span_unit::Span& span, std::uint64_t pixels_before);
  void tell_quick(std::uint64_t begin_ps, std::uint64_t accesses) const;
  void end_frame(SpanPayload& payload, const sc_core::sc_time& delay);
  void clear(std::uint64_t until_ps);
  void send_read(const ScreenReader::Line& line, const frame::RgbLine& levels);
  void note_starved(std::uint64_t drawn_ps);
  void scan_out(std::uint64_t frame, std::uint64_t shown_ps);
  std::uint64_t retrace_from(std::uint64_t picoseconds) const;

  FrameStoreParameters parameters_;
  FrameStore& store_;
  MemoryLayout layout_;
  video::Timing timing_;
  MemorySchedule schedule_;
  Clock clock_;  // an access a cycle
  bool quick_;
  std::vector<std::uint64_t> won_;  // of a span, a bit a pixel; empty where nobody asks
  frame::RgbLine rgb_;
  frame::FragmentLine fragments_;  // observers of this store look at it as a whole
  stream::RgbPayload payload_;
  std::optional<ScreenReader> reader_;  // where pictures change while they are shown
  std::vector<std::uint64_t> torn_lines_;
  std::uint64_t buffer_free_ps_ = 0;
  std::uint64_t drawing_accesses_ = 0;
  std::uint64_t clear_accesses_ = 0;
  std::uint64_t begun_ps_ = 0;        // the frame that is drawn: its clear, or its first span
  std::uint64_t begun_accesses_ = 0;  // of drawing and clears until then
  std::uint64_t starved_ = 0;
  MemorySchedule::Watcher watcher_;
};

}  // namespace rastertlm::frame_store
