#include "src/run/imogene_timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "modules/object_processor/microprogram.h"
#include "modules/object_processor/second_order_program.h"
#include "modules/quadric_processor/quadric_logic.h"
#include "modules/shading/loader_budget.h"

namespace rastertlm::run {
namespace {

using Group = TimelineTrack::Group;

bool waits_for_nothing(const WatchedSpan& span) { return span.name == std::string_view("idle"); }

}  // namespace

ImogeneTimeline::ImogeneTimeline(const TimelineRange& range, imogene::Imogene& platform)
    : range_(range), platform_(platform), needs_(imogene::board_needs(platform.machine())) {
  check_timeline_range(range, platform.options().frames, static_cast<std::uint64_t>(platform.machine().video.lines));
  watch("animation unit", true, platform.animation_unit().meter());
  for (std::size_t k = 0; k < platform.computation_units().size(); ++k)
    watch(fmt::format("computation unit {}", k), true, platform.computation_units()[k]->meter());
  for (std::size_t engine = 0; engine < shading::TableLoaderModule::kEngines; ++engine)
    watch(shading::kEngineNames[engine], true, platform.table_loader().meter(engine));
  for (stream::Link& link : platform.links()) watch(link);
}

void ImogeneTimeline::watch(const std::string& name, bool host, stream::OccupancyMeter& meter) {
  Watched* watched = watched_.emplace_back(std::make_unique<Watched>(Watched{Group::unit, name, host, {}})).get();
  meter.watch([this, watched](stream::Activity activity, std::uint64_t begin_ps, std::uint64_t end_ps) {
    if (window().touches(begin_ps, end_ps)) watched->spans.push_back({to_string(activity), begin_ps, end_ps, 0});
  });
}

void ImogeneTimeline::watch(stream::Link& link) {
  Watched* watched =
      watched_.emplace_back(std::make_unique<Watched>(Watched{Group::link, link.name(), false, {}})).get();
  link.watch([this, watched, bits = link.bits()](std::uint64_t words, std::uint64_t begin_ps, std::uint64_t end_ps) {
    if (words > 0 && window().touches(begin_ps, end_ps))
      watched->spans.push_back({"message", begin_ps, end_ps, words * bits / 8});
  });
}

// Before the first picture there is none.
TimeWindow ImogeneTimeline::window() const {
  const std::uint64_t origin = platform_.start_ps();
  if (origin == 0) return {};
  const video::Timing& timing = platform_.timing();
  const std::uint64_t last = std::min(range_.frames.last, platform_.options().frames - 1);
  return {origin, origin + timing.clock.picoseconds(timing.frame * (range_.frames.first * timing.fields)),
          origin + timing.clock.picoseconds(timing.frame * ((last + 1) * timing.fields))};
}

Cycles ImogeneTimeline::retrace_of(const VideoFrame& shown) const {
  return platform_.timing().frame * (shown.frame * platform_.timing().fields + shown.field);
}

TimeWindow ImogeneTimeline::window_of(const VideoFrame& shown) const {
  const video::Timing& timing = platform_.timing();
  const std::uint64_t origin = platform_.start_ps();
  return {origin, origin + timing.clock.picoseconds(retrace_of(shown)),
          origin + timing.clock.picoseconds(retrace_of(shown) + timing.frame)};
}

void ImogeneTimeline::add(const imogene::ShownFrame& shown) {
  if (range_.frames.has(shown.frame)) shown_.push_back({shown.frame, shown.field, shown.animation_frame});
}

void ImogeneTimeline::add_cycles(std::size_t track, Cycles begin, Cycles count, std::string name, const char* key,
                                 double value) {
  const Clock& clock = platform_.timing().clock;
  if (count > Cycles(0))
    timeline_.events.push_back(
        {track, clock.picoseconds(begin), clock.picoseconds(begin + count), std::move(name), key, value});
}

Timeline ImogeneTimeline::close(const Result& result) {
  tracks_.frame = timeline_.add_track(Group::picture, "frame");
  tracks_.line = timeline_.add_track(Group::picture, "line");
  tracks_.limits = timeline_.add_track(Group::picture, "what limits");
  const auto boards = platform_.board_modules().size();
  for (const auto& watched : watched_)
    if (watched->group == Group::unit)
      add_watched(timeline_, timeline_.add_track(Group::unit, watched->name), watched->spans, window());
  for (std::size_t k = 0; k < boards; ++k)
    tracks_.boards.push_back(timeline_.add_track(Group::unit, fmt::format("object board {}", k)));
  for (std::size_t k = 0; k < platform_.quadric_modules().size(); ++k)
    tracks_.quadric_boards.push_back(timeline_.add_track(Group::unit, fmt::format("quadric board {}", k)));
  tracks_.decision = timeline_.add_track(Group::unit, "decision unit");
  tracks_.shading = timeline_.add_track(Group::unit, "shading processor");
  tracks_.video = timeline_.add_track(Group::unit, "video output");
  for (const auto& watched : watched_) {
    if (watched->group != Group::link) continue;
    const std::size_t track = timeline_.add_track(Group::link, watched->name);
    add_watched(timeline_, track, watched->spans, window());
    if (watched->name == "decision unit to shading") tracks_.decided_link = track;
    if (watched->name == "shading to video") tracks_.shaded_link = track;
    if (watched->name == fmt::format("board {} to decision unit", tracks_.board_links.size()))
      tracks_.board_links.push_back(track);
    if (watched->name == fmt::format("quadric board {} to decision unit", tracks_.quadric_links.size()))
      tracks_.quadric_links.push_back(track);
  }
  add_display(result);
  add_limits();
  timeline_.sort();
  return std::move(timeline_);
}

void ImogeneTimeline::add_display(const Result& result) {
  const video::Timing& timing = platform_.timing();
  const auto lines = static_cast<std::uint64_t>(platform_.machine().video.lines);
  for (const VideoFrame& shown : shown_) {
    const Cycles retrace = retrace_of(shown);
    add_cycles(tracks_.frame, retrace, timing.frame,
               timing.fields == 1 ? fmt::format("frame {}", shown.frame)
                                  : fmt::format("frame {}, field {}", shown.frame, shown.field),
               "animation frame", static_cast<double>(shown.animation_frame));
    for (const std::size_t board : tracks_.boards)
      add_cycles(board, retrace + needs_.skew, object_processor::frame_start_cycles(), "frame start");
    for (const std::size_t board : tracks_.quadric_boards)
      add_cycles(board, retrace + needs_.skew, object_processor::second_order_frame_start_cycles(), "frame start");
    for (std::uint64_t line = shown.field; line < lines; line += timing.fields)
      if (range_.lines.has(line)) add_line(shown, line, result.deadlines.lines.slack_cycles.at(line));
  }
}

void ImogeneTimeline::add_line(const VideoFrame& shown, std::uint64_t line, std::int64_t slack_cycles) {
  const video::Timing& timing = platform_.timing();
  const Cycles start = retrace_of(shown) + timing.line_start(line);
  const Cycles pixels = retrace_of(shown) + timing.first_pixel(line);
  const Cycles columns(static_cast<std::uint64_t>(platform_.machine().video.columns));
  const Cycles prenormalised = prenormalised_pixels(shown, line);
  const Cycles decided = prenormalised + platform_.decision_latency();
  const Cycles shaded = pixels + platform_.pixel_latency();
  const std::string name = fmt::format("line {}", line);
  add_cycles(tracks_.line, start, timing.line, name, "pixel clocks left, the least over the frames",
             static_cast<double>(slack_cycles));
  for (std::size_t k = 0; k < tracks_.boards.size(); ++k) {
    const std::size_t board = tracks_.boards[k];
    add_cycles(board, start, timing.line, name);
    add_cycles(board, start, needs_.line_start * timing.lines_advanced(line), "line start");
    add_cycles(board, pixels, columns, "pixels");
    add_cycles(tracks_.board_links.at(k), prenormalised, columns, name);
  }
  if (!tracks_.quadric_boards.empty()) add_quadric_line(shown, line, name);
  for (const std::size_t track : {tracks_.decision, tracks_.decided_link}) add_cycles(track, decided, columns, name);
  for (const std::size_t track : {tracks_.shading, tracks_.shaded_link, tracks_.video})
    add_cycles(track, shaded, columns, name);
}

// When the fragments of a line leave the boards, of triangles and of quadrics together.
Cycles ImogeneTimeline::prenormalised_pixels(const VideoFrame& shown, std::uint64_t line) const {
  const imogene::Machine& machine = platform_.machine();
  return retrace_of(shown) + platform_.timing().first_pixel(line) + imogene::quadric_delay(machine) +
         Cycles(static_cast<std::uint64_t>(machine.object_processor.prenormalisation_cycles));
}

// Quadrics step over the lines that are not theirs, begin their line, and work on its pixels: all of it earlier than
// triangles do, or at the same time where these wait for them.
void ImogeneTimeline::add_quadric_line(const VideoFrame& shown, std::uint64_t line, const std::string& name) {
  const video::Timing& timing = platform_.timing();
  const imogene::Machine& machine = platform_.machine();
  const Cycles lead = imogene::quadric_lead(machine);
  const Cycles start = retrace_of(shown) + timing.line_start(line) - lead;
  const Cycles columns(static_cast<std::uint64_t>(machine.video.columns));
  const bool first = line < timing.fields;
  const std::uint64_t passed = timing.lines_advanced(line);
  const Cycles step = quadric_processor::line_step_cycles(machine.quadric, passed, first);
  const Cycles both = quadric_processor::line_start_cycles(machine.quadric, passed, first);
  for (std::size_t k = 0; k < tracks_.quadric_boards.size(); ++k) {
    const std::size_t board = tracks_.quadric_boards[k];
    add_cycles(board, start, timing.line, name);
    add_cycles(board, start, step, "line step");
    add_cycles(board, start + step, both - step, "line start");
    add_cycles(board, start + timing.horizontal_blanking, columns, "pixels");
    add_cycles(tracks_.quadric_links.at(k), prenormalised_pixels(shown, line), columns, name);
  }
}

// In each video frame the unit behind the display that is the last to finish what it began at the retrace, or is still
// at it.
void ImogeneTimeline::add_limits() {
  for (const VideoFrame& shown : shown_) {
    const TimeWindow frame = window_of(shown);
    const Watched* slowest = nullptr;
    std::uint64_t until = frame.begin_ps;
    for (const auto& watched : watched_) {
      if (!watched->host) continue;
      for (const WatchedSpan& span : watched->spans) {
        const std::uint64_t end = std::min(span.end_ps, frame.end_ps);
        if (waits_for_nothing(span) || !frame.touches(span.begin_ps, span.end_ps) || end <= until) continue;
        until = end;
        slowest = watched.get();
      }
    }
    if (slowest == nullptr) continue;
    timeline_.events.push_back(
        {tracks_.limits, frame.begin_ps - frame.origin_ps, until - frame.origin_ps, slowest->name, "of the frame",
         static_cast<double>(until - frame.begin_ps) / static_cast<double>(frame.end_ps - frame.begin_ps)});
  }
}

}  // namespace rastertlm::run
