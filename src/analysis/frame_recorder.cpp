#include "src/analysis/frame_recorder.h"

#include "modules/stream/simulated_time.h"

namespace rastertlm::analysis {

// The video timing announces a frame's lines at the instant at which its retrace begins.
void FrameRecorder::note(std::size_t line, std::uint64_t first_pixel_ps, Passage& passage) const {
  const std::uint64_t since_retrace = first_pixel_ps - stream::picoseconds_now();
  if (line < field_.count) passage.first_line_ps = since_retrace;
  if (line + field_.count >= lines_.size()) passage.last_line_ps = since_retrace;
}

stream::Observer<stream::FragmentPayload> FrameRecorder::decided() {
  return [this](const stream::FragmentPayload& payload, std::uint64_t first_pixel_ps) {
    if (!is_wanted(payload.frame, payload.line)) return;
    lines_.at(payload.line) = *payload.fragments;
    note(payload.line, first_pixel_ps, decided_);
  };
}

stream::Observer<stream::RgbPayload> FrameRecorder::shaded() {
  return [this](const stream::RgbPayload& payload, std::uint64_t first_pixel_ps) {
    if (is_wanted(payload.frame, payload.line)) note(payload.line, first_pixel_ps, shaded_);
  };
}

}  // namespace rastertlm::analysis
