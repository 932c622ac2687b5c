#include "src/run/quadratic_timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "src/run/quadratic_budgets.h"

namespace rastertlm::run {
namespace {

using Group = TimelineTrack::Group;

// Frames choose what is kept, not times: a frame is computed while another is shown.
constexpr TimeWindow kAllTime{0, 0, std::numeric_limits<std::uint64_t>::max()};

}  // namespace

QuadraticTimeline::QuadraticTimeline(const TimelineRange& range, std::uint64_t frames, quadratic::Quadratic& platform)
    : range_(range), platform_(platform), span_units_(platform.span_unit().occupancies().size()) {
  check_timeline_range(range, frames, static_cast<std::uint64_t>(platform.machine().video.lines));
  const auto of_link = [this](std::vector<WatchedSpan>& spans, unsigned bits) {
    return [this, &spans, bits](std::uint64_t words, std::uint64_t begin_ps, std::uint64_t end_ps) {
      if (words > 0 && range_.frames.has(platform_.frames().size()))
        spans.push_back({"words", begin_ps, end_ps, words * bits / 8});
    };
  };
  platform.watch({[this](stream::Activity activity, std::uint64_t begin_ps, std::uint64_t end_ps) {
                    if (range_.frames.has(platform_.frames().size()))
                      set_up_.push_back({to_string(activity), begin_ps, end_ps, 0});
                  },
                  [this](std::size_t unit, stream::Activity activity, std::uint64_t begin_ps, std::uint64_t end_ps) {
                    if (range_.frames.has(platform_.frames().size()))
                      span_units_.at(unit).push_back({to_string(activity), begin_ps, end_ps, 0});
                  },
                  [this](bool screen, std::uint64_t begin_ps, std::uint64_t end_ps) {
                    if (range_.frames.has(platform_.frames().size()))
                      memory_.push_back({screen ? "screen" : "drawing", begin_ps, end_ps, 0});
                  },
                  of_link(bus_, platform.links().at(0).bits()), of_link(pixels_, platform.links().at(1).bits())});
}

Timeline QuadraticTimeline::close() {
  add_frames();
  const std::size_t line = timeline_.add_track(Group::picture, "line");
  add_limits(timeline_.add_track(Group::picture, "what limits"));
  add_units();
  const std::size_t screen = timeline_.add_track(Group::unit, "scan-out");
  const auto& links = platform_.links();
  add_watched(timeline_, timeline_.add_track(Group::link, links.at(0).name()), bus_, kAllTime);
  add_watched(timeline_, timeline_.add_track(Group::link, links.at(1).name()), pixels_, kAllTime);
  add_screen(line, screen, timeline_.add_track(Group::link, links.at(2).name()));
  timeline_.sort();
  return std::move(timeline_);
}

void QuadraticTimeline::add_units() {
  add_watched(timeline_, timeline_.add_track(Group::unit, "set-up processor"), set_up_, kAllTime);
  add_bus(timeline_.add_track(Group::unit, "bus"));
  for (std::size_t k = 0; k < span_units_.size(); ++k)
    add_watched(timeline_,
                timeline_.add_track(Group::unit, span_units_.size() > 1 ? fmt::format("span unit {}", k) : "span unit"),
                span_units_[k], kAllTime);
  add_watched(timeline_, timeline_.add_track(Group::unit, "frame store"), memory_, kAllTime);
}

// The processor writes its words itself: what it does else, the bus waits for.
void QuadraticTimeline::add_bus(std::size_t track) {
  std::vector<WatchedSpan> spans;
  std::size_t written = 0;
  for (WatchedSpan span : set_up_) {
    const bool writes = written < bus_.size() && span.begin_ps == bus_[written].begin_ps;
    if (writes) ++written;
    if (span.name == std::string_view("busy")) span.name = writes ? "busy" : "starved";
    spans.push_back(span);
  }
  add_watched(timeline_, track, spans, kAllTime);
}

// When each was computed, and when it was on the screen until the next one was; the last one for one screen.
void QuadraticTimeline::add_frames() {
  const std::size_t computed = timeline_.add_track(Group::picture, "set-up");
  const std::size_t shown = timeline_.add_track(Group::picture, "frame");
  const std::vector<quadratic::ShownFrame>& frames = platform_.frames();
  const std::uint64_t screen_ps = platform_.timing().clock.picoseconds(platform_.timing().frame);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (!range_.frames.has(f)) continue;
    const host::SetUpFrame& frame = frames[f].set_up;
    const std::string name = fmt::format("frame {}", f);
    const auto pose = static_cast<double>(frame.animation_frame);
    const std::uint64_t until = f + 1 < frames.size() ? frames[f + 1].set_up.shown_ps : frame.shown_ps + screen_ps;
    if (frame.end_ps > frame.begin_ps)
      timeline_.events.push_back({computed, frame.begin_ps, frame.end_ps, name, "animation frame", pose});
    if (until > frame.shown_ps)
      timeline_.events.push_back({shown, frame.shown_ps, until, name, "animation frame", pose});
  }
}

// The lines of every screen on which a frame is, from when it is shown; before the first there is nothing to send. What
// crosses the link counts to the end of the run, when the last frame is shown.
void QuadraticTimeline::add_screen(std::size_t line_track, std::size_t unit_track, std::size_t link_track) {
  const std::vector<quadratic::ShownFrame>& frames = platform_.frames();
  const std::uint64_t screen_ps = platform_.timing().clock.picoseconds(platform_.timing().frame);
  if (range_.frames.has(0)) add_lines(unit_track, 0, frames.front().set_up.shown_ps, Part::pixels, "starved");
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (!range_.frames.has(f)) continue;
    const std::uint64_t from = frames[f].set_up.shown_ps;
    const std::uint64_t until = f + 1 < frames.size() ? frames[f + 1].set_up.shown_ps : from + screen_ps;
    add_lines(line_track, from, until, Part::whole, nullptr);
    add_lines(unit_track, from, until, Part::pixels, nullptr);
    if (f + 1 < frames.size()) add_lines(link_track, from, until, Part::pixels, nullptr);
  }
}

// Of screens between two times; `name`: of every event, or the line's.
void QuadraticTimeline::add_lines(std::size_t track, std::uint64_t from_ps, std::uint64_t until_ps, Part part,
                                  const char* name) {
  const video::Timing& timing = platform_.timing();
  const Clock& clock = timing.clock;
  const Cycles columns(static_cast<std::uint64_t>(platform_.machine().video.columns));
  const auto lines = static_cast<std::uint64_t>(platform_.machine().video.lines);
  for (std::uint64_t screen = clock.cycles_at(from_ps).count() / timing.frame.count();; ++screen) {
    const Cycles retrace = timing.frame * screen;
    if (clock.picoseconds(retrace) >= until_ps) return;
    for (std::uint64_t line = 0; line < lines; ++line) {
      if (!range_.lines.has(line)) continue;
      const Cycles start = retrace + (part == Part::whole ? timing.line_start(line) : timing.first_pixel(line));
      const std::uint64_t begin = std::max(clock.picoseconds(start), from_ps);
      const std::uint64_t end =
          std::min(clock.picoseconds(start + (part == Part::whole ? timing.line : columns)), until_ps);
      if (begin < end)
        timeline_.events.push_back(
            {track, begin, end, name != nullptr ? std::string(name) : fmt::format("line {}", line), "", 0.0});
    }
  }
}

// What each frame is limited by, from when the frame before was shown to when it was.
void QuadraticTimeline::add_limits(std::size_t track) {
  const std::vector<quadratic::ShownFrame>& frames = platform_.frames();
  std::uint64_t before = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const std::uint64_t shown = frames[f].set_up.shown_ps;
    const Bottleneck limit = frame_bottleneck(platform_, frames[f]);
    if (range_.frames.has(f) && shown > before)
      timeline_.events.push_back({track, before, shown, limit.unit, "of the frame", limit.utilisation});
    before = shown;
  }
}

}  // namespace rastertlm::run
