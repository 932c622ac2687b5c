// What units and links did, and when: of chosen displayed frames and scan lines. Times are picoseconds since the first
// displayed frame's retrace began, or where frames are computed for a store, since the first one's set-up began.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "modules/stream/occupancy.h"

namespace rastertlm::run {

// First and last, both included.
struct NumberRange {
  std::uint64_t first = 0;
  std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  bool has(std::uint64_t number) const { return number >= first && number <= last; }
};

struct TimelineRange {
  NumberRange frames;  // displayed frames
  NumberRange lines;   // of what goes line by line; what does not is there for the whole of its frames
};

struct TimelineTrack {
  enum class Group { picture, unit, link };
  Group group = Group::unit;
  std::string name;  // of a unit or link: as in Result
};

struct TimelineEvent {
  std::size_t track = 0;
  std::uint64_t begin_ps = 0;
  std::uint64_t end_ps = 0;  // above begin_ps
  std::string name;          // "busy", "line 17"
  const char* key = "";      // of `value`, with its unit; empty: none
  double value = 0.0;
};

// Events are in the order of their tracks, then of their beginnings; of those that begin together the longest comes
// first. On a track each lies within another or beside it.
struct Timeline {
  std::vector<TimelineTrack> tracks;
  std::vector<TimelineEvent> events;

  std::size_t add_track(TimelineTrack::Group group, std::string name);
  void sort();
};

// Throws InputError, naming the option, where a range begins beyond what there is.
void check_timeline_range(const TimelineRange& range, std::uint64_t frames, std::uint64_t lines);

// What a watcher of a unit or of a link was told, in picoseconds since the start of the simulation.
struct WatchedSpan {
  const char* name = "";
  std::uint64_t begin_ps = 0;
  std::uint64_t end_ps = 0;
  std::uint64_t bytes = 0;  // of a link
};
struct TimeWindow {
  std::uint64_t origin_ps = 0;  // the first displayed frame's retrace
  std::uint64_t begin_ps = 0;   // both since the start of the simulation
  std::uint64_t end_ps = 0;
  bool touches(std::uint64_t from_ps, std::uint64_t to_ps) const { return to_ps > begin_ps && from_ps < end_ps; }
};

// Adds what was told in the order of time to a track: what lies in the window, and of what goes beyond it the part
// inside. What follows itself, without bytes, becomes one, and so do what overlaps: several units share it.
void add_watched(Timeline& timeline, std::size_t track, const std::vector<WatchedSpan>& told, const TimeWindow& window);

const char* to_string(stream::Activity activity);

}  // namespace rastertlm::run
