#include "modules/video/video_timing_module.h"

#include <algorithm>

#include "modules/stream/failure.h"
#include "modules/stream/simulated_time.h"
#include "src/base/errors.h"

namespace rastertlm::video {

using stream::SyncPayload;

VideoTimingModule::VideoTimingModule(const sc_core::sc_module_name& name, const Timing& timing, std::size_t lines,
                                     std::size_t listeners, std::size_t computation_units, std::uint64_t frames,
                                     std::uint64_t patience, Copy copy)
    : sc_module(name),
      sync("sync", listeners),
      ready("ready", computation_units),
      timing_(timing),
      hears_lines_(listeners, 1),
      lines_(lines),
      frames_(frames),
      patience_(patience),
      copy_(copy) {
  SC_HAS_PROCESS(VideoTimingModule);
  SC_THREAD(run_guarded);
}

bool VideoTimingModule::units_ready() const {
  return std::all_of(ready.begin(), ready.end(), [](const auto& unit) { return unit.read(); });
}

void VideoTimingModule::announce(SyncPayload::Kind kind, Cycles since_frame_start) {
  payload_.kind = kind;
  payload_.frame = shown_ / timing_.fields;
  const sc_core::sc_time since = stream::to_time(timing_.clock, since_frame_start);
  for (std::size_t listener = 0; listener < sync.size(); ++listener) {
    if (kind == SyncPayload::Kind::line && hears_lines_[listener] == 0) continue;
    sc_core::sc_time delay = since;
    sync[listener]->b_transport(payload_, delay);
  }
}

void VideoTimingModule::begin_retrace(std::uint64_t video_frame) {
  const bool units = units_ready();
  payload_.swap = units && tables_ready.read() && (showing_ || begins_frame(video_frame));
  if (payload_.swap && !showing_) {
    first_frame_ps_ = stream::picoseconds_now();
    frames_before_first_ = video_frame;
    showing_ = true;
  }
  payload_.copy = payload_.swap || (showing_ && copy_ == Copy::at_every_retrace);
  payload_.whole = payload_.copy && units;
  if (payload_.whole && !whole_shown_) ++updates_;
  // A whole frame of objects may be shown before its tables; the hosts wait for both.
  whole_shown_ = payload_.whole && !payload_.swap;
  payload_.switch_tables = false;
  payload_.lines = {};
  announce(SyncPayload::Kind::retrace, Cycles(0));
  if (payload_.swap) swapped.notify(sc_core::SC_ZERO_TIME);
  payload_.copy = payload_.whole = payload_.swap = payload_.switch_tables = false;
}

// `line` and those that are announced with it. Returns the first that are not.
std::size_t VideoTimingModule::set_lines(std::size_t line) {
  stream::Lines& lines = payload_.lines;
  lines = {line, 0, timing_.fields, {}};
  const std::size_t band_end = in_bands_ ? (line / stream::kBandLines + 1) * stream::kBandLines : line + 1;
  const std::uint64_t first_ps = timing_.clock.picoseconds(timing_.line_start(line));
  for (; line < std::min(lines_, band_end); line += timing_.fields)
    lines.later_ps[lines.count++] = timing_.clock.picoseconds(timing_.line_start(line)) - first_ps;
  return line;
}

// Lines of the picture that are in the field being shown: all, or those of its parity.
void VideoTimingModule::announce_lines() {
  for (std::size_t line = shown_ % timing_.fields; line < lines_;) {
    const Cycles begins = timing_.line_start(line);
    line = set_lines(line);
    announce(SyncPayload::Kind::line, begins);
  }
}

void VideoTimingModule::run_guarded() {
  stream::run_guarded([this] { run(); });
}

// A video frame:
// 1. the retrace begins; where all is ready, loading RAMs are copied and tables switched, and the hosts may go on
//    (where loading RAMs are copied at every retrace, they are, ready or not);
// 2. its lines are announced with their times as delays: nothing that a line reads can change before the next retrace,
//    so the kernel need not stop at each (tables that are late are brought to the line's time by their loader, which
//    hears of it before the boards);
// 3. whoever runs the simulation gets a chance to look at the picture;
// 4. time passes to the end of the frame, counted from the start of the simulation in cycles.
void VideoTimingModule::run() {
  for (std::uint64_t video_frame = 0; shown_ < frames_ * timing_.fields; ++video_frame) {
    if (!showing_ && video_frame > patience_)
      throw InputError(
          {"", 0, "host",
           "the hosts have not finished a first frame after " + std::to_string(patience_) + " video frames"});
    wait(sc_core::SC_ZERO_TIME);  // who finishes at this very instant is in time
    begin_retrace(video_frame);
    if (showing_) {
      announce_lines();
      ++shown_;
      sc_core::sc_pause();
    }
    const std::uint64_t end = timing_.clock.picoseconds(timing_.frame * (video_frame + 1));
    wait(stream::to_time(end - stream::picoseconds_now()));
  }
  finished_ = true;
  sc_core::sc_pause();
}

}  // namespace rastertlm::video
