#include "src/run/deadlines.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "src/run/imogene_budgets.h"

namespace rastertlm::run {
namespace {

constexpr std::int64_t kNothingYet = std::numeric_limits<std::int64_t>::max();
constexpr double kPicosecondsPerMicrosecond = 1e6;

const Slack& less_of(const Slack& boards, const Slack& tables) {
  return tables.cycles() < boards.cycles() ? tables : boards;
}

double microseconds(const Clock& clock, std::int64_t cycles) {
  return static_cast<double>(cycles) * clock.period_ns() * 1e-3;
}

}  // namespace

Slack line_slack(const video::Timing& timing, const BoardNeeds& needs, std::size_t line, Cycles tables_wait) {
  Cycles has = timing.horizontal_blanking;
  const bool first = line < timing.fields;
  Cycles needed = std::max(needs.line_start * timing.lines_advanced(line),
                           first ? needs.quadric_first_lines.at(line) : needs.quadric_line_start);
  if (first) {
    has += timing.vertical_retrace;
    needed += needs.copy();
  }
  const Slack boards{has, needed, "line start"};
  return tables_wait == Cycles(0) ? boards : less_of(boards, {timing.line_start(line), tables_wait, "table load"});
}

Slack retrace_slack(const video::Timing& timing, const BoardNeeds& needs, Cycles table_load) {
  return less_of({timing.vertical_retrace, needs.retrace(), "frame start"},
                 {timing.vertical_retrace, table_load, "table load"});
}

DeadlineMeter::DeadlineMeter(const imogene::Imogene& platform)
    : timing_(platform.timing()),
      host_clock_(platform.cost().clock()),
      needs_(imogene::board_needs(platform.machine())) {
  worst_.retrace.available_cycles = timing_.vertical_retrace.count();
  worst_.retrace.boards_cycles = needs_.retrace().count();
  worst_.retrace.slack_cycles = kNothingYet;
  worst_.lines.available_cycles = timing_.horizontal_blanking.count();
  worst_.lines.slack_cycles.assign(static_cast<std::size_t>(platform.machine().video.lines), kNothingYet);
  worst_.lines.worst.slack_cycles = kNothingYet;
  worst_.host.slack_cycles = kNothingYet;
}

void DeadlineMeter::add(const imogene::ShownFrame& shown, FrameFigures& figures) {
  if (shown.field == 0) figures.line_slack_cycles = figures.retrace_slack_cycles = kNothingYet;
  add_lines(shown, figures);
  const Slack retrace = retrace_slack(timing_, needs_, shown.table_load);
  figures.retrace_slack_cycles = std::min(figures.retrace_slack_cycles, retrace.cycles());
  worst_.retrace.tables_cycles = std::max(worst_.retrace.tables_cycles, shown.table_load.count());
  if (retrace.cycles() < worst_.retrace.slack_cycles) {
    worst_.retrace.frame = shown.frame;
    worst_.retrace.slack_cycles = retrace.cycles();
    worst_.retrace.needs = retrace.needs;
  }
  if (shown.updated) add_host(shown, figures);
}

void DeadlineMeter::add_lines(const imogene::ShownFrame& shown, FrameFigures& figures) {
  Deadlines::Lines& lines = worst_.lines;
  for (std::size_t line = shown.field; line < lines.slack_cycles.size(); line += timing_.fields) {
    const Slack slack = line_slack(timing_, needs_, line, shown.tables_wait);
    lines.slack_cycles[line] = std::min(lines.slack_cycles[line], slack.cycles());
    figures.line_slack_cycles = std::min(figures.line_slack_cycles, slack.cycles());
    if (slack.cycles() < lines.worst.slack_cycles)
      lines.worst = {shown.frame,          line,           slack.available.count(),
                     slack.needed.count(), slack.cycles(), microseconds(timing_.clock, slack.cycles()),
                     slack.needs};
  }
}

// An update is to be there at the next retrace; what is missing comes later by whole video frames.
void DeadlineMeter::add_host(const imogene::ShownFrame& shown, FrameFigures& figures) {
  const std::uint64_t frame_ps = timing_.clock.picoseconds(timing_.frame);
  const double slack_us =
      (static_cast<double>(frame_ps) - static_cast<double>(host_clock_.picoseconds(shown.host_cycles))) /
      kPicosecondsPerMicrosecond;
  if (shown.frame == 0 && shown.field == 0) return;  // the initial load
  figures.host_slack_us = figures.host_slack_us ? std::min(*figures.host_slack_us, slack_us) : slack_us;
  const Cycles has = host_clock_.cycles_at(frame_ps + 1) - Cycles(1);  // that end by then
  const auto slack = static_cast<std::int64_t>(has.count()) - static_cast<std::int64_t>(shown.host_cycles.count());
  if (slack < worst_.host.slack_cycles)
    worst_.host = {true,
                   shown.frame,
                   (host_clock_.picoseconds(shown.host_cycles) + frame_ps - 1) / frame_ps,
                   shown.host_cycles.count(),
                   slack,
                   slack_us};
}

Deadlines DeadlineMeter::close(imogene::Imogene& platform) {
  worst_.retrace.slack_us = microseconds(timing_.clock, worst_.retrace.slack_cycles);
  if (worst_.host.slack_cycles == kNothingYet) {
    const HostLoad load = host_load(platform);
    FrameFigures unused;
    imogene::ShownFrame next;
    next.frame = 1;
    next.host_cycles = load.update.cycles;
    next.host_frames = load.frames;
    add_host(next, unused);
    worst_.host.shown = false;
    worst_.host.frame = 0;
  }
  return std::move(worst_);
}

}  // namespace rastertlm::run
