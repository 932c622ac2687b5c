// The video timing: says to every board when the retrace begins and when a line begins, and at the retrace whether the
// loading RAMs are copied. It owns the only clock of the display side.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>

#include <functional>
#include <systemc>
#include <vector>

#include "modules/stream/line_payload.h"
#include "modules/video/timing.h"

namespace rastertlm::video {

class VideoTimingModule : public sc_core::sc_module {
 public:
  using SyncSocket = tlm_utils::simple_initiator_socket<VideoTimingModule, stream::kNoBusWidth, stream::SyncProtocol>;

  sc_core::sc_vector<SyncSocket> sync;                // one a listener, served in order
  sc_core::sc_vector<sc_core::sc_in<bool>> ready;     // one a computation unit: its loading RAMs hold the next frame
  sc_core::sc_in<bool> tables_ready{"tables_ready"};  // the bank that is being written holds the next frame's tables
  sc_core::sc_event swapped;                          // at a retrace at which everything was ready

  enum class Copy {
    when_ready,       // at the retraces at which everything is ready: until then the old picture stays
    at_every_retrace  // from the first picture on, whatever stands in the loading RAMs
  };

  // Shows `frames` displayed frames, the first at the first retrace at which everything is ready (where the video is
  // interlaced, the first that begins even lines). Gives up with an InputError after `patience` video frames without a
  // first picture.
  VideoTimingModule(const sc_core::sc_module_name& name, const Timing& timing, std::size_t lines, std::size_t listeners,
                    std::size_t computation_units, std::uint64_t frames, std::uint64_t patience,
                    Copy copy = Copy::when_ready);

  // Before the simulation: what this listener does depends on no line.
  void announce_retraces_alone(std::size_t listener) { hears_lines_.at(listener) = 0; }

  // Before the simulation: no listener minds whether another has heard of the next lines. Those of a band are then told
  // a listener in one go.
  void announce_lines_in_bands() { in_bands_ = true; }

  // Picoseconds at which the first displayed frame's retrace began, and the number of video frames that began with a
  // new frame of objects, wholly written.
  std::uint64_t first_frame_ps() const { return first_frame_ps_; }
  std::uint64_t updates() const { return updates_; }
  // The objects that are shown are those of the frame that the hosts are at, whose tables are not ready.
  bool objects_ahead() const { return whole_shown_; }
  std::uint64_t frames_before_first() const { return frames_before_first_; }
  // Video frames shown so far, with the one whose lines are being announced not yet among them: the number of the video
  // frame that is being shown; before the first picture, 0.
  std::uint64_t video_frames_shown() const { return shown_; }
  // The last frame has been shown to its end.
  bool finished() const { return finished_; }

 private:
  void run_guarded();
  void run();
  bool units_ready() const;
  void begin_retrace(std::uint64_t video_frame);
  bool begins_frame(std::uint64_t video_frame) const { return video_frame % timing_.fields == 0; }
  void announce_lines();
  std::size_t set_lines(std::size_t line);
  void announce(stream::SyncPayload::Kind kind, Cycles since_frame_start);

  Timing timing_;
  std::vector<std::uint8_t> hears_lines_;  // one a listener
  bool in_bands_ = false;
  std::size_t lines_;
  std::uint64_t frames_;
  std::uint64_t patience_;
  Copy copy_;
  stream::SyncPayload payload_;
  std::uint64_t shown_ = 0;
  std::uint64_t updates_ = 0;
  std::uint64_t first_frame_ps_ = 0;
  std::uint64_t frames_before_first_ = 0;
  bool showing_ = false;
  bool whole_shown_ = false;  // the frame that the hosts are at, without its tables
  bool finished_ = false;
};

}  // namespace rastertlm::video
