// Keeps what crosses the display side in one displayed frame: the decision unit's lines, and when lines pass. It is
// spliced into the streams of the machine, which knows nothing of it.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/stream/tap_module.h"
#include "src/frame/scan_line.h"

namespace rastertlm::analysis {

class FrameRecorder {
 public:
  // When the first pixel of the first and of the last line passed, in picoseconds since the frame's retrace began.
  struct Passage {
    std::uint64_t first_line_ps = 0;
    std::uint64_t last_line_ps = 0;
  };

  // The lines number, number + count, ... of a picture.
  struct Field {
    std::size_t number = 0;
    std::size_t count = 1;  // fields of a displayed frame
  };

  // Of displayed frame `frame`, which has `lines` lines, or of one of its fields.
  FrameRecorder(std::uint64_t frame, const Field& field, std::size_t lines)
      : frame_(frame), field_(field), lines_(lines) {}

  // For the taps; the recorder outlives the simulation.
  stream::Observer<stream::FragmentPayload> decided();
  stream::Observer<stream::RgbPayload> shaded();

  // By their numbers in the picture; those of another field have no columns.
  const std::vector<frame::FragmentLine>& lines() const { return lines_; }
  const Passage& decided_passage() const { return decided_; }
  const Passage& shaded_passage() const { return shaded_; }

 private:
  bool is_wanted(std::uint64_t frame, std::size_t line) const {
    return frame == frame_ && line % field_.count == field_.number;
  }
  void note(std::size_t line, std::uint64_t first_pixel_ps, Passage& passage) const;

  std::uint64_t frame_;
  Field field_;
  std::vector<frame::FragmentLine> lines_;
  Passage decided_;
  Passage shaded_;
};

}  // namespace rastertlm::analysis
