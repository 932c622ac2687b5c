// The timeline of the object machine. Hosts, their links and the table loaders are watched while they work; what the
// display side does follows from the video timing, line by line. A unit's pixels are drawn when they leave it, those of
// a board when its first processor works on them.
#pragma once

#include <memory>
#include <vector>

#include "platforms/imogene/imogene.h"
#include "src/run/result.h"
#include "src/run/timeline.h"

namespace rastertlm::run {

class ImogeneTimeline {
 public:
  // Before the platform runs, which it watches until then: it must outlive that.
  ImogeneTimeline(const TimelineRange& range, imogene::Imogene& platform);

  void add(const imogene::ShownFrame& shown);
  // When the platform has run.
  Timeline close(const Result& result);

 private:
  struct VideoFrame {
    std::uint64_t frame = 0;
    std::size_t field = 0;
    std::int64_t animation_frame = 0;
  };
  struct Watched {
    TimelineTrack::Group group;
    std::string name;
    bool host;  // what limits the rate may be such a unit
    std::vector<WatchedSpan> spans;
  };
  void watch(const std::string& name, bool host, stream::OccupancyMeter& meter);
  void watch(stream::Link& link);
  TimeWindow window() const;
  TimeWindow window_of(const VideoFrame& shown) const;
  void add_display(const Result& result);
  void add_line(const VideoFrame& shown, std::uint64_t line, std::int64_t slack_cycles);
  void add_quadric_line(const VideoFrame& shown, std::uint64_t line, const std::string& name);
  void add_limits();
  void add_cycles(std::size_t track, Cycles begin, Cycles count, std::string name, const char* key = "",
                  double value = 0.0);
  Cycles retrace_of(const VideoFrame& shown) const;
  Cycles prenormalised_pixels(const VideoFrame& shown, std::uint64_t line) const;

  TimelineRange range_;
  imogene::Imogene& platform_;
  imogene::BoardNeeds needs_;
  std::vector<VideoFrame> shown_;
  std::vector<std::unique_ptr<Watched>> watched_;  // addresses that watchers keep
  Timeline timeline_;
  struct DisplayTracks {
    std::size_t frame = 0, line = 0, limits = 0;
    std::vector<std::size_t> boards, board_links, quadric_boards, quadric_links;
    std::size_t decision = 0, shading = 0, video = 0, decided_link = 0, shaded_link = 0;
  } tracks_;
};

}  // namespace rastertlm::run
