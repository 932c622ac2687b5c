#include "modules/frame_store/screen_reader.h"

#include <algorithm>
#include <utility>

namespace rastertlm::frame_store {

ScreenReader::ScreenReader(FrameStore& store, const video::Timing& timing, std::uint32_t columns, std::uint32_t lines,
                           Sink sink)
    : store_(store), timing_(timing), lines_(lines), sink_(std::move(sink)) {
  rgb_.resize(columns);
}

void ScreenReader::expect(std::uint64_t frame, std::uint64_t begin_ps) {
  Screen screen{frame, begin_ps, 0, {}};
  screen.whole.reserve(lines_ * rgb_.levels.size());
  for (std::uint32_t line = 0; line < lines_; ++line) {
    store_.scan_out(line, rgb_);
    screen.whole.insert(screen.whole.end(), rgb_.levels.begin(), rgb_.levels.end());
  }
  screens_.push_back(std::move(screen));
}

std::uint64_t ScreenReader::due_ps() const {
  return screens_.front().begin_ps + timing_.clock.picoseconds(timing_.line_start(next_line_));
}

void ScreenReader::advance(std::uint64_t until_ps) {
  while (!screens_.empty() && due_ps() <= until_ps) read_line();
}

void ScreenReader::finish() {
  while (!screens_.empty()) read_line();
}

void ScreenReader::read_line() {
  store_.scan_out(next_line_, rgb_);
  store_.note_line(next_line_);
  const std::uint64_t begin_ps = screens_.front().begin_ps;
  const std::uint64_t first_pixel_ps = begin_ps + timing_.clock.picoseconds(timing_.first_pixel(next_line_));
  const auto at = static_cast<std::ptrdiff_t>(next_line_ * rgb_.levels.size());
  for (Screen& screen : screens_) {
    if (screen.begin_ps != begin_ps) break;
    const bool same = std::equal(rgb_.levels.begin(), rgb_.levels.end(), screen.whole.begin() + at);
    screen.torn_lines += same ? 0 : 1;
    sink_({screen.frame, next_line_, first_pixel_ps, screen.torn_lines}, rgb_);
  }
  if (++next_line_ < lines_) return;
  next_line_ = 0;
  while (!screens_.empty() && screens_.front().begin_ps == begin_ps) screens_.pop_front();
}

}  // namespace rastertlm::frame_store
