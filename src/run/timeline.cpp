#include "src/run/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "src/base/errors.h"

namespace rastertlm::run {

std::size_t Timeline::add_track(TimelineTrack::Group group, std::string name) {
  tracks.push_back({group, std::move(name)});
  return tracks.size() - 1;
}

void Timeline::sort() {
  std::stable_sort(events.begin(), events.end(), [](const TimelineEvent& a, const TimelineEvent& b) {
    if (a.track != b.track) return a.track < b.track;
    if (a.begin_ps != b.begin_ps) return a.begin_ps < b.begin_ps;
    return a.end_ps > b.end_ps;
  });
}

void check_timeline_range(const TimelineRange& range, std::uint64_t frames, std::uint64_t lines) {
  Diagnostics diagnostics;
  const auto check = [&](const char* option, const NumberRange& wanted, std::uint64_t count, const char* what) {
    if (wanted.first >= count)
      diagnostics.add(
          {option, 0, "", fmt::format("begins at {}, and the {} are 0..{}", wanted.first, what, count - 1)});
  };
  check("--timeline-frames", range.frames, frames, "displayed frames");
  check("--timeline-lines", range.lines, lines, "scan lines");
  diagnostics.throw_if_any();
}

void add_watched(Timeline& timeline, std::size_t track, const std::vector<WatchedSpan>& told,
                 const TimeWindow& window) {
  const std::size_t first = timeline.events.size();
  for (const WatchedSpan& span : told) {
    const std::uint64_t begin = std::max(span.begin_ps, window.begin_ps);
    const std::uint64_t end = std::min(span.end_ps, window.end_ps);
    if (begin >= end) continue;
    TimelineEvent event{track, begin - window.origin_ps, end - window.origin_ps, span.name, "", 0.0};
    if (span.bytes > 0) {
      event.key = "bytes";
      event.value = static_cast<double>(span.bytes);
    }
    TimelineEvent* last = timeline.events.size() > first ? &timeline.events.back() : nullptr;
    const bool goes_on = last != nullptr && last->end_ps == event.begin_ps && last->name == event.name;
    const bool overlaps = last != nullptr && last->end_ps > event.begin_ps;
    if ((goes_on && span.bytes == 0) || overlaps) {
      last->end_ps = std::max(last->end_ps, event.end_ps);
      last->value += event.value;
    } else {
      timeline.events.push_back(std::move(event));
    }
  }
}

const char* to_string(stream::Activity activity) {
  switch (activity) {
    case stream::Activity::busy:
      return "busy";
    case stream::Activity::starved:
      return "starved";
    case stream::Activity::blocked:
      return "blocked";
    case stream::Activity::idle:
      return "idle";
  }
  return "";
}

}  // namespace rastertlm::run
