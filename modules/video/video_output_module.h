// The video output: assembles the lines that arrive into the frame that the screen shows, with what observers saw of
// each pixel.
#pragma once

#include <tlm_utils/simple_target_socket.h>

#include <functional>
#include <systemc>

#include "modules/stream/line_payload.h"
#include "modules/video/frame_assembly.h"

namespace rastertlm::video {

class VideoOutputModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<VideoOutputModule, stream::kNoBusWidth, stream::RgbProtocol> in;

  // Called with the frame at the end of each of its fields (a frame that is not interlaced has one): in between, lines
  // of the other field are those of the frame before. `last_line_ps` is the time at which the first pixel of the
  // field's last line left, counted from the start of the simulation.
  using FrameSink =
      std::function<void(std::uint64_t frame, std::size_t field, const frame::Frame&, std::uint64_t last_line_ps)>;

  VideoOutputModule(const sc_core::sc_module_name& name, const FrameAssembly::Format& format, FrameSink sink);

  std::uint64_t lines_shown() const { return lines_shown_; }

 private:
  void receive(stream::RgbPayload& payload, sc_core::sc_time& delay);

  FrameAssembly assembly_;
  FrameSink sink_;
  std::uint64_t lines_shown_ = 0;
};

}  // namespace rastertlm::video
