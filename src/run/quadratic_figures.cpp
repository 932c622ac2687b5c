#include "src/run/quadratic_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/span_unit/parameters.h"
#include "src/run/budget.h"

namespace rastertlm::run {
namespace {

using quadratic::Quadratic;

constexpr double kPicosecond = 1e-12;

double screen_pixels(const Quadratic& platform) {
  return static_cast<double>(platform.machine().video.columns * platform.machine().video.lines);
}

// Clocks of a frame's triangles in the span unit.
double span_seconds(const Quadratic& platform) {
  const Clock clock = platform.machine().span_unit.clock();
  std::uint64_t busiest = 0;
  for (const stream::Occupancy& unit : platform.span_unit().occupancies()) busiest = std::max(busiest, unit.busy);
  const auto cycles = static_cast<double>(busiest);
  return cycles / clock.frequency_hz() / static_cast<double>(platform.frames().size());
}

}  // namespace

FrameLoad frame_load(const Quadratic& platform) {
  FrameLoad load;
  const Clock& host = platform.cost().clock();
  const frame_store::FrameStoreModule& store = platform.frame_store();
  const auto frames = static_cast<double>(platform.frames().size());
  for (const quadratic::ShownFrame& frame : platform.frames()) {
    load.set_up = std::max(load.set_up, host.seconds(frame.set_up.computing + frame.set_up.writing));
    load.pixels = std::max(load.pixels, static_cast<double>(frame.drawn.pixels));
  }
  load.span_unit = span_seconds(platform);
  const double access = static_cast<double>(platform.machine().frame_store.access_ps()) * kPicosecond;
  load.memory = static_cast<double>(store.drawing_accesses() + store.clear_accesses()) * access / frames +
                static_cast<double>(store.schedule().scan_out_ps()) * kPicosecond;
  load.memory_waits = platform.span_unit().memory_cycles();
  return load;
}

std::vector<UnitFigures> unit_figures(const Quadratic& platform) {
  std::vector<UnitFigures> units;
  const auto add = [&](const std::string& name, double hz, const stream::Occupancy& o) {
    units.push_back({name, hz, o.cycles, o.busy, o.starved, o.blocked, o.idle});
  };
  add("set-up processor", platform.cost().clock().frequency_hz(), platform.set_up_processor().occupancy());
  const std::vector<stream::Occupancy> spans = platform.span_unit().occupancies();
  for (std::size_t k = 0; k < spans.size(); ++k)
    add(spans.size() > 1 ? fmt::format("span unit {}", k) : std::string("span unit"),
        platform.machine().span_unit.clock().frequency_hz(), spans[k]);
  // In accesses, to the end of the last frame's drawing; what no one asked for is idle.
  const frame_store::FrameStoreModule& store = platform.frame_store();
  const std::uint64_t access = platform.machine().frame_store.access_ps();
  stream::Occupancy memory;
  memory.busy = store.drawing_accesses() + store.clear_accesses();
  memory.cycles = std::max(memory.busy, platform.span_unit().end_ps() / access);
  memory.idle = memory.cycles - memory.busy;
  add("frame store", 1.0 / (static_cast<double>(access) * kPicosecond), memory);
  return units;
}

std::vector<LinkFigures> link_figures(const Quadratic& platform) {
  std::vector<LinkFigures> figures;
  const double seconds = static_cast<double>(platform.frames().back().set_up.shown_ps) * kPicosecond;
  for (const stream::Link& link : platform.links()) {
    LinkFigures f;
    f.name = link.name();
    f.bits = link.bits();
    f.clock_hz = link.clock().frequency_hz();
    f.bytes = link.bytes();
    f.peak_bytes_per_s = link.peak_bytes_per_second();
    const double active = link.clock().seconds(link.active());
    f.active_bytes_per_s = active > 0.0 ? static_cast<double>(link.bytes()) / active : 0.0;
    f.achieved_bytes_per_s = seconds > 0.0 ? static_cast<double>(link.bytes()) / seconds : 0.0;
    f.utilisation = f.achieved_bytes_per_s / f.peak_bytes_per_s;
    figures.push_back(f);
  }
  return figures;
}

std::vector<Memory> memory_figures(const Quadratic& platform) {
  const quadratic::Machine& m = platform.machine();
  const auto buffers = static_cast<std::uint64_t>(m.frame_store.buffers);
  const auto pixels = static_cast<std::uint64_t>(m.video.columns * m.video.lines);
  std::vector<Memory> memories{{"frame store, colour", buffers, pixels, frame_store::kColourBits}};
  if (m.frame_store.depth_test)
    memories.push_back({"frame store, depth", 1, pixels, static_cast<std::uint64_t>(m.span_unit.depth_bits)});
  // Six registers a channel and three of depth, and the edges' and lines' in each set; a set is drawn from.
  const auto sets = static_cast<std::uint64_t>((m.span_unit.shadow_sets + 1) * m.span_unit.units);
  const bool linear = m.set_up.method == ShadingMethod::gouraud;
  memories.push_back({"span unit, colour registers", sets, span_unit::kChannels * (linear ? 3U : 6U),
                      static_cast<std::uint64_t>(m.span_unit.word_bits)});
  memories.push_back({"span unit, depth registers", sets, 3,
                      static_cast<std::uint64_t>(m.span_unit.depth_bits + m.span_unit.depth_fraction_bits)});
  return memories;
}

std::vector<Logic> logic_figures(const Quadratic& platform) {
  const span_unit::SpanUnitParameters& p = platform.machine().span_unit;
  const auto units = static_cast<std::uint64_t>(p.units);
  const bool linear = platform.machine().set_up.method == ShadingMethod::gouraud;
  const bool rank = p.start_edge == span_unit::StartEdge::lattice && p.carry == span_unit::Carry::rank;
  // Figure 6: two adders a channel along the line, three at the start edge, and as many again for carries at once.
  const std::uint64_t channel = linear ? 2U + (rank ? 1U : 0U) : 5U + (rank ? 3U : 0U);
  std::vector<Logic> logic{
      {"adders of colour channels", units * span_unit::kChannels * channel, "adders"},
      {"adders of depth", units * (2U + (rank ? 1U : 0U)), "adders"},
      {"comparators of line ends", units, "comparators"},
      {"counters of columns and lines", 2 * units, "counters"},
  };
  if (p.start_edge == span_unit::StartEdge::prestep)
    logic.push_back({"short multipliers", units * (3 * span_unit::kChannels + 1), "multipliers"});
  if (platform.machine().frame_store.depth_test) logic.push_back({"comparators of depth", units, "comparators"});
  return logic;
}

std::vector<Budget> quadratic_budgets(const Quadratic& platform) {
  const quadratic::Machine& m = platform.machine();
  const FrameLoad load = frame_load(platform);
  const double frame_us = 1e6 / m.video.refresh_hz;
  const auto units = static_cast<double>(m.span_unit.units);
  const double pixel_us = m.span_unit.clock_ns * 1e-3 * static_cast<double>(m.span_unit.pixel_cycles) / units;
  const double screen = screen_pixels(platform);
  std::vector<Budget> budgets;
  budgets.push_back(budget("set_up.frame", 1e6 * load.set_up, frame_us, "us",
                           "arithmetic and bus words of a frame's triangles", "host.*, set_up.*, video.refresh_hz"));
  budgets.push_back(budget("span_unit.frame", 1e6 * load.span_unit, frame_us, "us",
                           "loads, line changes and pixels of a frame", "span_unit.*, video.refresh_hz"));
  budgets.push_back(budget("frame_store.frame", 1e6 * load.memory, frame_us, "us",
                           "accesses of a frame times access time: clear, depth tests, writes, shared scan-out",
                           "frame_store.*, video.refresh_hz"));
  budgets.push_back(budget("depth_complexity", load.pixels / screen, frame_us / (pixel_us * screen), "screens",
                           "pixels drawn / pixels of the screen; pixels that the span unit alone draws in a frame",
                           "span_unit.clock_ns, span_unit.pixel_cycles, video.*"));
  budgets.push_back(budget("span_unit.screen", pixel_us * screen, frame_us, "us",
                           "000/001, section 7: the whole screen once, a pixel a clock",
                           "span_unit.clock_ns, video.*"));
  const std::uint64_t steps = span_unit::longest_iteration(m.span_unit, static_cast<std::uint64_t>(m.video.columns),
                                                           static_cast<std::uint64_t>(m.video.lines));
  if (m.set_up.method != ShadingMethod::gouraud)
    budgets.push_back(budget("span_unit.fraction", span_unit::fraction_bound(m.span_unit.fraction_bits, steps), 0.5,
                             "levels",
                             "2^-(bits + 1) (k^2 + k + 2) / 2, k the steps across the whole screen (proved, attained)",
                             "span_unit.fraction_bits, video.*", false));
  return budgets;
}

Answer quadratic_answer(const Quadratic& platform, const std::vector<Budget>& budgets) {
  const quadratic::Machine& m = platform.machine();
  const FrameLoad load = frame_load(platform);
  const video::Timing& timing = platform.timing();
  Answer answer;
  answer.required_rate_hz = m.video.refresh_hz;
  answer.display_rate_hz = timing.obtained_refresh_hz();
  answer.frame_rate_hz = answer.update_rate_hz = platform.frames_per_second();
  const double frame_seconds = 1.0 / answer.required_rate_hz;
  // The span unit's own work, and what the memory makes of it where that takes longer.
  const bool by_memory = load.memory > load.span_unit;
  answer.bottleneck = {"span unit", "loads, lines and pixels", load.span_unit / frame_seconds};
  if (by_memory) answer.bottleneck = {"frame store", "memory accesses", load.memory / frame_seconds};
  if (load.set_up / frame_seconds > answer.bottleneck.utilisation)
    answer.bottleneck = {"set-up processor", "arithmetic and bus", load.set_up / frame_seconds};
  answer.headroom = 1.0 / answer.bottleneck.utilisation - 1.0;
  const quadratic::ShownFrame& last = platform.frames().back();
  const std::uint64_t begin = last.set_up.begin_ps;
  answer.latency_first_pixel_us = static_cast<double>(last.first_pixel_ps - begin) * 1e-6;
  answer.latency_last_pixel_us = static_cast<double>(last.last_pixel_ps - begin) * 1e-6;
  answer.latency_frames = static_cast<std::uint64_t>(
      std::ceil(static_cast<double>(last.set_up.shown_ps - begin) * kPicosecond * answer.display_rate_hz));
  // Frames are shown at retraces: a rate just below the display's may be one frame less over the run.
  answer.sustained = answer.frame_rate_hz >= answer.required_rate_hz * (1 - 1e-9);
  for (const Budget& b : budgets)
    if (b.applies && !b.fits && b.unit == "us" && b.name != "span_unit.screen")
      answer.limits.push_back(fmt::format("{}: a frame needs {:.6g} us and has {:.6g} us; it moves with {}", b.name,
                                          b.used, b.available, b.moved_by));
  if (answer.limits.empty() && !answer.sustained)
    answer.limits.push_back(
        fmt::format("set-up and drawing wait for each other: together they take longer than a frame; it moves with "
                    "span_unit.shadow_sets, {}",
                    m.frame_store.swap == frame_store::Swap::retrace ? "frame_store.swap" : "frame_store.buffers"));
  return answer;
}

std::vector<std::string> quadratic_warnings(const Quadratic& platform) {
  std::vector<std::string> warnings;
  const quadratic::Machine& m = platform.machine();
  const std::uint64_t steps = span_unit::longest_iteration(m.span_unit, static_cast<std::uint64_t>(m.video.columns),
                                                           static_cast<std::uint64_t>(m.video.lines));
  const double bound = span_unit::fraction_bound(m.span_unit.fraction_bits, steps);
  constexpr double kHalfALevel = 0.5;
  if (m.set_up.method != ShadingMethod::gouraud && bound > kHalfALevel)
    warnings.push_back(
        fmt::format("{} fraction bits may be off by {:.3g} levels across the screen (span_unit.fraction_bits)",
                    m.span_unit.fraction_bits, bound));
  host::SetUpCounts all;
  for (const quadratic::ShownFrame& frame : platform.frames()) {
    all.colour += frame.set_up.counts.colour;
    all.lighting += frame.set_up.counts.lighting;
  }
  const auto tell = [&](std::uint64_t count, const char* what) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", count, what));
  };
  tell(all.colour.flat_undefined, "triangles are drawn in one colour: the solver had no answer for them");
  tell(all.colour.flat_low, "triangles lower than 1/64 pixel are drawn in one colour");
  tell(all.colour.at_limit, "triangles are split no further, and off by more than highlight_test.threshold_levels");
  tell(all.lighting.clamped_knots, "colours at points are beyond the levels and clamped");
  tell(all.lighting.not_finite, "colours at points are no numbers and taken as black");
  return warnings;
}

}  // namespace rastertlm::run
