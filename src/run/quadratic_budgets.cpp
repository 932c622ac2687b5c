#include "src/run/quadratic_budgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/span_unit/parameters.h"
#include "src/run/budget.h"
#include "src/run/drawing_limits.h"
#include "src/run/in_turn.h"

namespace rastertlm::run {
namespace {

using quadratic::Quadratic;

constexpr double kPicosecond = 1e-12;
constexpr double kMicroseconds = 1e6;

// A pixel of the span units together.
double pixel_ns(const quadratic::Machine& m) {
  return m.span_unit.clock_ns * static_cast<double>(m.span_unit.pixel_cycles) / static_cast<double>(m.span_unit.units);
}

std::uint64_t most_steps(const quadratic::Machine& m) {
  return span_unit::longest_iteration(m.span_unit, static_cast<std::uint64_t>(m.video.columns),
                                      static_cast<std::uint64_t>(m.video.lines));
}

double fraction_bound(const quadratic::Machine& m, std::uint64_t steps) {
  return m.set_up.linear() ? span_unit::linear_fraction_bound(m.span_unit.fraction_bits, steps)
                           : span_unit::fraction_bound(m.span_unit.fraction_bits, steps);
}

const char* what_bound_holds(span_unit::StartEdge start_edge) {
  switch (start_edge) {
    case span_unit::StartEdge::lattice:
      return "proved, attained";
    case span_unit::StartEdge::prestep:
      return "of rounded registers, proved; what the prestep's fraction and products are rounded by comes on top";
    default:
      return "of rounded registers, proved; up to a step of colour from a pixel to the next comes on top";
  }
}

// Of the slowest frame of the run, unit by unit.
FrameLoad largest_load(const Quadratic& platform) {
  FrameLoad most;
  for (const quadratic::ShownFrame& frame : platform.frames()) {
    const FrameLoad load = frame_load(platform, frame);
    if (load.set_up() > most.set_up()) {
      most.arithmetic = load.arithmetic;
      most.bus = load.bus;
    }
    most.clear = load.clear;
    most.span_unit = std::max(most.span_unit, load.span_unit);
    most.pixel_unit = std::max(most.pixel_unit, load.pixel_unit);
    most.drawing = std::max(most.drawing, load.drawing);
    most.memory = std::max(most.memory, load.memory);
    most.accesses = std::max(most.accesses, load.accesses);
    most.pixels = std::max(most.pixels, load.pixels);
  }
  return most;
}

void add_frame_budgets(const Quadratic& platform, const FrameLoad& load, std::vector<Budget>& budgets) {
  const double frame_us = kMicroseconds * frame_seconds(platform);
  const auto add = [&](const char* name, double seconds, const char* source, const char* moved_by) {
    budgets.push_back(budget(name, kMicroseconds * seconds, frame_us, "us", source, moved_by));
  };
  add("set_up.frame", load.set_up(), "arithmetic and bus words of a frame's triangles",
      "host.*, set_up.*, video.refresh_hz");
  add("bus.frame", load.bus, "bus words of a frame's triangles",
      "host.bus_cycles_per_word, host.bus_bits, host.clock_hz, video.refresh_hz");
  add("span_unit.frame", load.span_unit, "loads, line changes and pixels of a frame", "span_unit.*, video.refresh_hz");
  if (platform.pixel_unit() != nullptr)
    add("pixel_unit.frame", load.pixel_unit, "loads, lines and pixels of a frame that are shaded one by one",
        "pixel_unit.*, set_up.method, video.refresh_hz");
  add("frame_store.frame", load.memory,
      "accesses of a frame times access time, bursts of a shared screen between them: clear, depth tests, writes",
      "frame_store.*, video.refresh_hz");
  add("drawing.frame", load.cleared_and_drawn(),
      "the clear, then span by span what takes longer, the span unit or the memory",
      "span_unit.*, frame_store.*, video.refresh_hz");
  budgets.push_back(in_turn_budget(platform));
}

// What the machine could draw, by whom it is limited; and what it could were all of it whole lines that win.
void add_complexity(const Quadratic& platform, std::vector<Budget>& budgets) {
  const WorstFrame worst = worst_frame(platform);
  const auto add = [&](const std::string& name, double screens, const std::string& source, const std::string& moved_by,
                       bool applies) {
    budgets.push_back(budget(name, worst.complexity, screens, "screens", source, moved_by, applies));
  };
  if (std::isfinite(worst.least().screens))
    add("depth_complexity", worst.least().screens,
        fmt::format("the least of what follows: {}, limited by the {}; of each alone, without what set-up and drawing "
                    "wait for each other (frame.in_turn)",
                    worst.least().name, worst.least().unit),
        worst.least().moved_by, true);
  for (const ComplexityLimit& limit : worst.limits)
    if (std::isfinite(limit.screens))
      add("depth_complexity." + limit.name, limit.screens, limit.formula, limit.moved_by, true);
  const quadratic::Machine& m = platform.machine();
  const double frame_ns = 1e9 * frame_seconds(platform);
  const auto screen = static_cast<double>(m.video.columns * m.video.lines);
  add("depth_complexity.pixels_alone", frame_ns / (pixel_ns(m) * screen),
      "frame / pixel of the span unit, in screens: no clear, no load, no line change",
      "span_unit.clock_ns, span_unit.pixel_cycles, span_unit.units, video.*", false);
  add("depth_complexity.all_won", memory_limits(platform).complexity_within(frame_seconds(platform)),
      "(accesses of a frame - clear) / (reads and writes of a screen): whole lines, the farthest first",
      "frame_store.*, video.*", false);
}

void add_access(const Quadratic& platform, const FrameLoad& load, std::vector<Budget>& budgets) {
  const quadratic::Machine& m = platform.machine();
  const frame_store::MemoryLimits memory = memory_limits(platform);
  budgets.push_back(budget("frame_store.access", m.frame_store.access_ns,
                           memory.access_ns_within(load.accesses, frame_seconds(platform)), "ns",
                           "an access; the slowest with which a frame's fit it, what a shared screen reads left out",
                           "frame_store.*, video.refresh_hz"));
  budgets.push_back(budget("frame_store.access_of_pixel", m.frame_store.access_ns,
                           memory.access_ns_of_pixel(pixel_ns(m)), "ns",
                           "an access; the slowest that keeps up with the span unit where every pixel wins",
                           "frame_store.width_bits, frame_store.banks, frame_store.depth_test, span_unit.clock_ns, "
                           "span_unit.pixel_cycles, span_unit.units",
                           false));
}

// Drawing is the span unit's work, and what the memory makes of it: whichever takes longer is in the way.
Bottleneck bottleneck_of(const quadratic::Machine& m, const FrameLoad& load, double seconds) {
  const double drawing = load.cleared_and_drawn() / seconds;
  const double set_up = load.set_up() / seconds;
  const bool in_turn = draws_in_turn_with_screen(m);
  // Drawn in some video frames, shown in one more.
  const double turn = in_turn ? std::ceil(drawing) + 1.0 : drawing;
  if (set_up > turn) return {"set-up processor", load.bus_is_slower() ? "bus words" : "arithmetic and bus", set_up};
  if (in_turn) return {"frame store", "one buffer, drawn and shown in turn", turn};
  if (load.drawing <= 0.0) return drawing > 0.0 ? Bottleneck{"frame store", "the clear", drawing} : Bottleneck{};
  if (load.memory_is_slower()) return {"frame store", "memory accesses", drawing};
  if (load.pixel_unit_is_slower()) return {"pixel unit", "loads, lines and pixels that are shaded", drawing};
  const char* const after_clear = "loads, lines and pixels, after the clear";
  return {"span unit", load.clear > 0.0 ? after_clear : "loads, lines and pixels", drawing};
}

// What units wait for each other is in the way as well: of a frame's time, whoever works the most of it.
Bottleneck with_waits(Bottleneck bottleneck, const Quadratic& platform) {
  const double utilisation = in_turn(platform).frame / frame_seconds(platform);
  if (utilisation <= bottleneck.utilisation) return bottleneck;
  constexpr double kNotable = 1.01;
  if (utilisation > kNotable * bottleneck.utilisation)
    bottleneck.resource +=
        bottleneck.unit == "set-up processor" ? ", held up by clear and drawing" : ", and waiting for set-up";
  bottleneck.utilisation = utilisation;
  return bottleneck;
}

// Screens on which a viewer sees what is being drawn, or parts of two frames.
void add_warnings_of_screens(const Quadratic& platform, std::uint64_t displayed, std::vector<std::string>& warnings) {
  const video::Timing& timing = platform.timing();
  if (draws_in_turn_with_screen(platform.machine()) && platform.frames().size() > 1) {
    // From the end of the screen that has shown a frame to the start of that which shows the next one.
    const std::uint64_t passed = platform.end_ps() - platform.frames().front().set_up.shown_ps;
    const std::uint64_t screens = timing.clock.cycles_at(passed).count() / timing.frame.count();
    warnings.push_back(
        fmt::format("of {} screens {} show the one buffer while it is drawn, between the whole frames that are shown "
                    "here (frame_store.buffers)",
                    screens, screens - (platform.frames().size() - 1)));
  }
  std::uint64_t torn = 0;
  std::uint64_t lines = 0;
  for (std::size_t frame = 0; frame < std::min<std::size_t>(displayed, platform.frames().size()); ++frame) {
    torn += platform.frames()[frame].torn_lines > 0 ? 1 : 0;
    lines += platform.frames()[frame].torn_lines;
  }
  if (torn > 0)
    warnings.push_back(
        fmt::format("{} of {} displayed frames are torn: {} lines of their screens do not show them as they were when "
                    "they were whole (frame_store.swap, frame_store.buffers)",
                    torn, displayed, lines));
}

// Of the longest iteration that the scene made; what a triangle across the screen would make is a budget.
void add_warning_of_fraction(const Quadratic& platform, std::vector<std::string>& warnings) {
  const quadratic::Machine& m = platform.machine();
  const std::uint64_t steps = platform.span_unit().counters().steps;
  const double bound = fraction_bound(m, steps);
  constexpr double kHalfALevel = 0.5;
  constexpr double kLevels = 255.0;
  if (bound <= kHalfALevel) return;
  warnings.push_back(
      fmt::format("{} fraction bits may be off by {} after the {} steps of the longest iteration drawn "
                  "(span_unit.fraction_bits)",
                  m.span_unit.fraction_bits,
                  bound > kLevels ? std::string("any level") : fmt::format("{:.3g} levels", bound), steps));
}

}  // namespace

std::vector<Budget> quadratic_budgets(const Quadratic& platform) {
  const quadratic::Machine& m = platform.machine();
  const FrameLoad load = largest_load(platform);
  std::vector<Budget> budgets;
  add_frame_budgets(platform, load, budgets);
  add_complexity(platform, budgets);
  add_access(platform, load, budgets);
  const auto screen = static_cast<double>(m.video.columns * m.video.lines);
  budgets.push_back(budget("span_unit.screen", 1e-3 * pixel_ns(m) * screen, kMicroseconds / m.video.refresh_hz, "us",
                           "000/001, section 7: the whole screen once, a pixel a clock",
                           "span_unit.clock_ns, span_unit.pixel_cycles, span_unit.units, video.*", false));
  budgets.push_back(
      budget("span_unit.fraction", fraction_bound(m, most_steps(m)), 0.5, "levels",
             fmt::format("2^-(bits + 1) {}, k the steps from the left of the screen across it ({})",
                         m.set_up.linear() ? "(k + 1)" : "(k^2 + k + 2) / 2", what_bound_holds(m.span_unit.start_edge)),
             "span_unit.fraction_bits, set_up.method, video.*", false));
  return budgets;
}

Bottleneck frame_bottleneck(const Quadratic& platform, const quadratic::ShownFrame& frame) {
  return with_waits(bottleneck_of(platform.machine(), frame_load(platform, frame), frame_seconds(platform)), platform);
}

Answer quadratic_answer(const Quadratic& platform, const std::vector<Budget>& budgets) {
  const quadratic::Machine& m = platform.machine();
  const FrameLoad load = largest_load(platform);
  const video::Timing& timing = platform.timing();
  Answer answer;
  answer.required_rate_hz = m.video.refresh_hz;
  answer.display_rate_hz = timing.obtained_refresh_hz();
  answer.frame_rate_hz = answer.update_rate_hz = platform.frames_per_second();
  answer.bottleneck = with_waits(bottleneck_of(m, load, frame_seconds(platform)), platform);
  answer.headroom = 1.0 / answer.bottleneck.utilisation - 1.0;
  const quadratic::ShownFrame& last = platform.frames().back();
  const std::uint64_t begin = last.set_up.begin_ps;
  answer.latency_first_pixel_us = static_cast<double>(last.first_pixel_ps - begin) * 1e-6;
  answer.latency_last_pixel_us = static_cast<double>(last.last_pixel_ps - begin) * 1e-6;
  answer.latency_frames = static_cast<std::uint64_t>(
      std::ceil(static_cast<double>(last.set_up.shown_ps - begin) * kPicosecond * answer.display_rate_hz));
  // As of the object machine: in whole pixel clocks the display may be a hair below what is asked of it.
  answer.sustained = answer.frame_rate_hz >= attainable_rate(platform) * (1 - 1e-9);
  for (const Budget& b : budgets)
    if (b.applies && !b.fits && b.unit == "us" && b.name != "frame.in_turn")
      answer.limits.push_back(fmt::format("{}: a frame needs {:.6g} us and has {:.6g} us; it moves with {}", b.name,
                                          b.used, b.available, b.moved_by));
  if (answer.limits.empty() && !answer.sustained) answer.limits.push_back(what_waits(platform));
  return answer;
}

std::vector<std::string> quadratic_warnings(const Quadratic& platform, std::uint64_t displayed) {
  std::vector<std::string> warnings;
  add_warnings_of_screens(platform, displayed, warnings);
  add_warning_of_fraction(platform, warnings);
  host::SetUpCounts all;  // of what is displayed, not of frames beside it that tell the rate
  for (std::size_t frame = 0; frame < std::min<std::size_t>(displayed, platform.frames().size()); ++frame) {
    const host::SetUpCounts& counts = platform.frames()[frame].set_up.counts;
    all.colour += counts.colour;
    all.lighting += counts.lighting;
    all.subdivision += counts.subdivision;
    all.wraps += counts.wraps;
  }
  const auto tell = [&](std::uint64_t count, const char* what) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", count, what));
  };
  tell(all.colour.flat_undefined, "triangles are drawn in one colour: the solver had no answer for them");
  tell(all.colour.flat_low, "triangles lower than 1/64 pixel are drawn in one colour");
  tell(all.colour.at_limit,
       platform.machine().set_up.test_points == set_up::TestPoints::h1h2
           ? "triangles are split no further, and may hold a highlight's centre (highlight_test.depth_limit)"
           : "triangles are split no further, and off by more than highlight_test.threshold_levels");
  const set_up::SubdivisionCounts& cut = all.subdivision;
  tell(cut.at_limit - cut.at_grid_limit, "triangles are cut no further than subdivision.depth_limit says");
  tell(cut.at_grid_limit,
       "triangles are cut no further: highlight subdivision has 16 fraction bits for corners, set_up.snap_bits of them "
       "for those of triangles");
  tell(cut.unfound,
       "triangles may hold a highlight's centre, and the search for it has no answer: they are not cut there");
  tell(all.wraps, "triangles have slopes that the registers do not hold as signed numbers: prestep shows other pixels");
  tell(all.lighting.clamped_knots, "colours at points are beyond the levels and clamped");
  tell(all.lighting.not_finite, "colours at points are no numbers and taken as black");
  return warnings;
}

}  // namespace rastertlm::run
