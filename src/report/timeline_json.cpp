#include "src/report/timeline_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "src/report/number_text.h"

namespace rastertlm::report {
namespace {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string microseconds(std::uint64_t picoseconds) {
  constexpr std::uint64_t kPicosecondsOfOne = 1'000'000;
  return fmt::format("{}.{:06}", picoseconds / kPicosecondsOfOne, picoseconds % kPicosecondsOfOne);
}

int process_of(run::TimelineTrack::Group group) { return static_cast<int>(group) + 1; }

const char* process_name(run::TimelineTrack::Group group) {
  switch (group) {
    case run::TimelineTrack::Group::picture:
      return "picture";
    case run::TimelineTrack::Group::unit:
      return "units";
    case run::TimelineTrack::Group::link:
      return "links";
  }
  return "";
}

// Names and order of processes and threads.
std::string metadata(const run::Timeline& timeline) {
  std::string text;
  const auto add = [&](int process, std::size_t thread, const char* what, const std::string& value) {
    text += fmt::format("{}{{\"ph\":\"M\",\"pid\":{},\"tid\":{},\"name\":\"{}\",\"args\":{{{}}}}}",
                        text.empty() ? "" : ",\n", process, thread, what, value);
  };
  using Group = run::TimelineTrack::Group;
  for (const Group group : {Group::picture, Group::unit, Group::link}) {
    add(process_of(group), 0, "process_name", fmt::format("\"name\":\"{}\"", process_name(group)));
    add(process_of(group), 0, "process_sort_index", fmt::format("\"sort_index\":{}", process_of(group)));
  }
  for (std::size_t k = 0; k < timeline.tracks.size(); ++k) {
    const int process = process_of(timeline.tracks[k].group);
    add(process, k + 1, "thread_name", "\"name\":" + quoted(timeline.tracks[k].name));
    add(process, k + 1, "thread_sort_index", fmt::format("\"sort_index\":{}", k + 1));
  }
  return text;
}

}  // namespace

std::string timeline_json(const run::Timeline& timeline) {
  std::string text = "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[\n" + metadata(timeline);
  for (const run::TimelineEvent& event : timeline.events) {
    text += fmt::format(",\n{{\"ph\":\"X\",\"pid\":{},\"tid\":{},\"ts\":{},\"dur\":{},\"name\":{}",
                        process_of(timeline.tracks.at(event.track).group), event.track + 1,
                        microseconds(event.begin_ps), microseconds(event.end_ps - event.begin_ps), quoted(event.name));
    if (*event.key != '\0') text += fmt::format(",\"args\":{{{}:{}}}", quoted(event.key), to_stored(event.value));
    text += '}';
  }
  return text + "\n]}\n";
}

}  // namespace rastertlm::report
