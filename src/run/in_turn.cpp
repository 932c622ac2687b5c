#include "src/run/in_turn.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/run/drawing_limits.h"

namespace rastertlm::run {
namespace {

using quadratic::Quadratic;

constexpr double kPicosecond = 1e-12;
constexpr double kMicroseconds = 1e6;
constexpr double kRounding = 1e-9;  // of times in whole picoseconds

bool waits_for_retrace(const Quadratic& platform) {
  return platform.machine().frame_store.swap == frame_store::Swap::retrace;
}

InTurn frame_in_turn(const Quadratic& platform, std::size_t number) {
  const quadratic::ShownFrame& frame = platform.frames()[number];
  const std::uint64_t begin = platform.frames()[number - 1].set_up.shown_ps;
  const std::uint64_t end = waits_for_retrace(platform) ? std::max(frame.drawn_ps, begin) : frame.set_up.shown_ps;
  InTurn turn;
  turn.frame = std::max(static_cast<double>(end - begin) * kPicosecond, frame_load(platform, frame).clear);
  turn.held_up = platform.cost().clock().seconds(frame.set_up.blocked);
  turn.starved = platform.machine().span_unit.clock().seconds(Cycles(frame.work.starved_cycles));
  return turn;
}

std::string moved_by(const quadratic::Machine& machine) {
  if (draws_in_turn_with_screen(machine)) return "frame_store.buffers, frame_store.swap";
  const std::string rate = machine.host.cost == host::CostModel::sustained ? "host.sustained_mflops" : "host.clock_hz";
  std::string keys = rate + ", span_unit.shadow_sets";
  if (machine.frame_store.clear) keys += ", frame_store.clear, frame_store.access_ns, frame_store.banks";
  return keys;
}

}  // namespace

InTurn in_turn(const Quadratic& platform) {
  const std::size_t count = platform.frames().size();
  InTurn all;
  for (std::size_t f = 1; f < count; ++f) {
    const InTurn one = frame_in_turn(platform, f);
    if (waits_for_retrace(platform)) {
      if (one.frame > all.frame) all = one;
      continue;
    }
    const double share = 1.0 / static_cast<double>(count - 1);
    all.frame += share * one.frame;
    all.held_up += share * one.held_up;
    all.starved += share * one.starved;
  }
  return all;
}

Budget in_turn_budget(const Quadratic& platform) {
  const double seconds = frame_seconds(platform);
  double used = in_turn(platform).frame;
  if (used > seconds && used <= seconds * (1 + kRounding)) used = seconds;
  return budget("frame.in_turn", kMicroseconds * used, kMicroseconds * seconds, "us",
                waits_for_retrace(platform)
                    ? "measured, the slowest frame: from when the one before is shown until it is whole, with what "
                      "set-up, clear and drawing wait for each other"
                    : "measured, the mean of frames: from one that is whole to the next, with what set-up, clear and "
                      "drawing wait for each other",
                moved_by(platform.machine()));
}

std::string what_waits(const Quadratic& platform) {
  const std::string keys = moved_by(platform.machine());
  if (draws_in_turn_with_screen(platform.machine()))
    return "the one buffer is drawn in one video frame and shown in the next; it moves with " + keys;
  const InTurn turn = in_turn(platform);
  return fmt::format(
      "set-up and drawing wait for each other: a frame takes {:.6g} us and has {:.6g} us; from picture to picture "
      "set-up "
      "waits {:.6g} us for a register set, held up by the buffer, its clear and drawing, and drawing waits {:.6g} us "
      "for "
      "set-up; it moves with {} (of sets, as many as a frame has triangles)",
      kMicroseconds * turn.frame, kMicroseconds * frame_seconds(platform), kMicroseconds * turn.held_up,
      kMicroseconds * turn.starved, keys);
}

double attainable_rate(const Quadratic& platform) {
  return std::min(platform.machine().video.refresh_hz, platform.timing().obtained_refresh_hz());
}

}  // namespace rastertlm::run
