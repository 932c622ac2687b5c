#include "src/run/drawing_limits.h"

#include <algorithm>
#include <limits>

#include "src/run/in_turn.h"

namespace rastertlm::run {
namespace {

using quadratic::Quadratic;

double screen_pixels(const Quadratic& platform) {
  return static_cast<double>(platform.machine().video.columns * platform.machine().video.lines);
}

constexpr const char* kOfSpanUnit =
    "span_unit.clock_ns, span_unit.pixel_cycles, span_unit.line_change_cycles, "
    "span_unit.load_cycles, span_unit.units, frame_store.clear, video.*";
constexpr const char* kOfMemory =
    "frame_store.access_ns, frame_store.width_bits, frame_store.banks, "
    "frame_store.clear, frame_store.depth_test, frame_store.scan_out, video.*";

}  // namespace

double frame_seconds(const Quadratic& platform) {
  const video::Timing& timing = platform.timing();
  return platform.machine().frame_store.swap == frame_store::Swap::retrace ? timing.clock.seconds(timing.frame)
                                                                           : 1.0 / attainable_rate(platform);
}

bool draws_in_turn_with_screen(const quadratic::Machine& machine) {
  return machine.frame_store.buffers == 1 && machine.frame_store.swap == frame_store::Swap::retrace;
}

frame_store::MemoryLimits memory_limits(const Quadratic& platform) {
  return {platform.machine().frame_store, platform.machine().layout(), platform.timing()};
}

const char* slower_of_drawing(const FrameLoad& load) {
  if (load.memory_is_slower()) return "frame store";
  return load.pixel_unit_is_slower() ? "pixel unit" : "span unit";
}

FrameLoad frame_load(const Quadratic& platform, const quadratic::ShownFrame& frame) {
  const quadratic::Machine& machine = platform.machine();
  const frame_store::MemoryLimits memory = memory_limits(platform);
  const Clock span_clock = machine.span_unit.clock();
  FrameLoad load;
  load.arithmetic = platform.cost().clock().seconds(frame.set_up.computing);
  load.bus = platform.cost().clock().seconds(frame.set_up.writing);
  load.clear = memory.seconds(memory.accesses(0, 0));
  load.span_unit = span_clock.seconds(Cycles(frame.work.span_cycles));
  load.drawing = span_clock.seconds(Cycles(frame.work.span_cycles + frame.work.waiting_cycles));
  if (machine.span_unit.shadow_sets == 0) load.drawing += load.bus / static_cast<double>(machine.span_unit.units);
  load.pixel_unit = machine.pixel_unit.clock().seconds(Cycles(frame.work.shading_cycles));
  load.accesses = memory.accesses(0, 0) + static_cast<double>(frame.work.accesses);
  load.memory = memory.seconds(load.accesses);
  load.pixels = static_cast<double>(frame.drawn.pixels);
  return load;
}

std::vector<ComplexityLimit> complexity_limits(const Quadratic& platform, const quadratic::ShownFrame& frame) {
  const quadratic::Machine& machine = platform.machine();
  const FrameLoad load = frame_load(platform, frame);
  const double screens = load.pixels / screen_pixels(platform);
  const double seconds = frame_seconds(platform);
  // A clear does not grow with what is drawn after it.
  const double for_drawing = draws_in_turn_with_screen(machine) ? 0.0 : std::max(0.0, seconds - load.clear);
  // In accesses: bursts are not spread evenly over a frame.
  const frame_store::MemoryLimits memory = memory_limits(platform);
  const double clear = memory.accesses(0, 0);
  const double for_memory = for_drawing > 0.0 ? std::max(0.0, memory.accesses_within(seconds) - clear) : 0.0;
  const auto of = [&](double available, double used) {
    return used > 0.0 ? screens * available / used : std::numeric_limits<double>::infinity();
  };
  const bool words_wait = machine.span_unit.shadow_sets == 0;
  const char* const of_drawing = words_wait ? "(frame - clear) / (words, then span by span the slower of span unit and "
                                              "memory), times the screens drawn"
                                            : "(frame - clear) / (span by span the slower of span unit and memory), "
                                              "times the screens drawn";
  const bool one_buffer = draws_in_turn_with_screen(machine);
  const auto who = [&](const char* unit) { return one_buffer ? "frame store" : unit; };
  std::vector<ComplexityLimit> limits{
      {"span_unit", who("span unit"), of(for_drawing, load.span_unit),
       "(frame - clear) / (loads, lines and pixels), times the screens drawn", kOfSpanUnit},
      {"memory", "frame store", of(for_memory, load.accesses - clear),
       "(frame - clear) / (tests and writes, bursts of the screen between them), times the screens drawn", kOfMemory},
      {"drawing", who(slower_of_drawing(load)), of(for_drawing, load.drawing), of_drawing,
       "span_unit.*, frame_store.*, video.*"},
      {"set_up", load.bus_is_slower() ? "bus" : "set-up processor", of(seconds, load.set_up()),
       "frame / (arithmetic and bus words), times the screens drawn", "host.*, set_up.*, video.refresh_hz"},
      {"bus", "bus", of(seconds, load.bus), "frame / bus words, times the screens drawn",
       "host.bus_cycles_per_word, host.bus_bits, host.clock_hz, video.refresh_hz"},
  };
  if (platform.pixel_unit() != nullptr)
    limits.push_back({"pixel_unit", who("pixel unit"), of(for_drawing, load.pixel_unit),
                      "(frame - clear) / (loads, lines and pixels that are shaded), times the screens drawn",
                      "pixel_unit.*, set_up.method, frame_store.clear, video.*"});
  return limits;
}

WorstFrame worst_frame(const Quadratic& platform) {
  WorstFrame worst;
  double least = std::numeric_limits<double>::infinity();
  for (const quadratic::ShownFrame& frame : platform.frames()) {
    std::vector<ComplexityLimit> limits = complexity_limits(platform, frame);
    const auto tightest = std::min_element(limits.begin(), limits.end(),
                                           [](const auto& a, const auto& b) { return a.screens < b.screens; });
    const FrameLoad load = frame_load(platform, frame);
    const double complexity = load.pixels / screen_pixels(platform);
    const double room = complexity > 0.0 ? tightest->screens / complexity : std::numeric_limits<double>::max();
    if (room >= least) continue;
    least = room;
    worst.load = load;
    worst.complexity = complexity;
    worst.least_index = static_cast<std::size_t>(tightest - limits.begin());
    worst.limits = std::move(limits);
  }
  return worst;
}

}  // namespace rastertlm::run
