// What is left of each deadline of the display: the start of every scan line, the vertical retrace, and the retrace
// that waits for the hosts.
#pragma once

#include <cstdint>
#include <vector>

#include "platforms/imogene/imogene.h"
#include "src/run/result.h"

namespace rastertlm::run {

using imogene::BoardNeeds;

// Pixel clocks that are left when line `line` of the picture begins. Horizontal blanking holds the line start, once
// for each line advanced, or the quadric processors' where it is longer; the first line of a video frame has the
// vertical retrace too, which holds skew and frame start. `tables_wait`: clocks from the retrace before which a line
// that starts finds tables that are being loaded, 0 if there are none; it is late by the difference.
struct Slack {
  Cycles available;
  Cycles needed;
  const char* needs = "";  // what is left the least for
  std::int64_t cycles() const {
    return static_cast<std::int64_t>(available.count()) - static_cast<std::int64_t>(needed.count());
  }
};
Slack line_slack(const video::Timing& timing, const BoardNeeds& needs, std::size_t line, Cycles tables_wait);

// Pixel clocks that are left of the vertical retrace: boards and table loaders work side by side.
Slack retrace_slack(const video::Timing& timing, const BoardNeeds& needs, Cycles table_load);

// Gathers what is left in every video frame that is shown.
class DeadlineMeter {
 public:
  explicit DeadlineMeter(const imogene::Imogene& platform);

  // A video frame that was shown; `figures`, of its displayed frame, keeps the worst of its fields.
  void add(const imogene::ShownFrame& shown, FrameFigures& figures);
  // Of the whole run. Where no update came after the first picture, the hosts' is that which the budget "host.update"
  // has: the next one, or where nothing moves what moving everything would take.
  Deadlines close(imogene::Imogene& platform);

 private:
  void add_lines(const imogene::ShownFrame& shown, FrameFigures& figures);
  void add_host(const imogene::ShownFrame& shown, FrameFigures& figures);

  video::Timing timing_;
  Clock host_clock_;
  BoardNeeds needs_;
  Deadlines worst_;
};

}  // namespace rastertlm::run
