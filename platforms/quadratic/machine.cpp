#include "platforms/quadratic/machine.h"

#include <fmt/format.h>

#include "modules/video/timing.h"

namespace rastertlm::quadratic {

void Machine::declare(parameter::Table& table) {
  declare_file(table);
  table.choice("platform", platform, {"quadratic"},
               {.unit = "", .description = "Which kind of machine this is.", .moves = "nothing", .exempt = true});
  set_up.declare(table);
  declare_units(table);
}

void Machine::declare_file(parameter::Table& table) {
  table.integer("schema", schema, {1, 1},
                {.unit = "", .description = "Version of the machine file's form.", .moves = "nothing", .exempt = true});
  table.choice("fidelity", fidelity, {"line"},
               {.unit = "",
                .description = "One transaction a scan line and link, closed-form spans; the only fidelity so far.",
                .moves = "nothing",
                .exempt = true});
}

void Machine::declare_units(parameter::Table& table) {
  video.declare(table);
  host.declare(table, "answer.frame_rate_hz");
  span_unit.declare(table);
  frame_store.declare(table);
  software.declare(table);
}

void Machine::check(Diagnostics& diagnostics, const std::string& file) const {
  set_up.check(file, diagnostics);
  check_units(diagnostics, file);
}

void Machine::check_units(Diagnostics& diagnostics, const std::string& file) const {
  span_unit.check(file, diagnostics);
  frame_store.check(file, diagnostics);
  check_depth(diagnostics, file);
  if (video.interlaced)
    diagnostics.add({file, 0, "video.interlaced", "this machine's frame store shows whole frames: false alone"});
  if (stores_numbers() && !frame_store.depth_test)
    diagnostics.add(
        {file, 0, "span_unit.share", "without a depth test triangles must be drawn in their order: \"columns\" alone"});
  try {
    frame_store::check_scan_out(frame_store, layout(), video::timing(video), file, diagnostics);
  } catch (const InputError& error) {
    for (Diagnostic diagnostic : error.diagnostics()) {
      diagnostic.file = file;
      diagnostics.add(std::move(diagnostic));
    }
  }
}

set_up::WordFormat Machine::depth_format() const {
  return {static_cast<int>(span_unit.depth_bits), static_cast<std::size_t>(video.columns),
          static_cast<std::size_t>(video.lines), set_up::EdgeForm::snapped};
}

// Near must be before far, and what rounding may add up to from pixel to pixel must stay within the margins beside
// them: depth would wrap from near to far.
void Machine::check_depth(Diagnostics& diagnostics, const std::string& file) const {
  const auto holds = [&](std::int64_t bits) {
    set_up::WordFormat format = depth_format();
    format.word_bits = static_cast<int>(bits);
    return set_up::near_depth(format) < set_up::far_depth(format);
  };
  if (!holds(span_unit.depth_bits)) {
    std::int64_t least = span_unit.depth_bits;
    while (!holds(least)) ++least;
    diagnostics.add(
        {file, 0, "span_unit.depth_bits",
         fmt::format("{} bits hold no depth on a screen of {} x {}, whose margins are {} units on both "
                     "sides; at least {} are accepted",
                     span_unit.depth_bits, video.columns, video.lines, set_up::depth_margin(depth_format()), least)});
  }
  const std::uint64_t steps = span_unit::longest_iteration(span_unit, static_cast<std::uint64_t>(video.columns),
                                                           static_cast<std::uint64_t>(video.lines));
  const auto margin = static_cast<double>(set_up::depth_margin(depth_format()));
  std::int64_t least = span_unit.depth_fraction_bits;
  while (span_unit::linear_fraction_bound(least, steps) > margin) ++least;
  if (least > span_unit.depth_fraction_bits)
    diagnostics.add({file, 0, "span_unit.depth_fraction_bits",
                     fmt::format("with {} bits depth may be off by {:.6g} units across a screen of {} x {}, beyond its "
                                 "margin of {}, and wrap; at least {} are accepted",
                                 span_unit.depth_fraction_bits,
                                 span_unit::linear_fraction_bound(span_unit.depth_fraction_bits, steps), video.columns,
                                 video.lines, margin, least)});
}

host::SetUpFormat Machine::set_up_format() const {
  return {viewport(), static_cast<unsigned>(span_unit.depth_bits), set_up::SpanFormat::of(span_unit, video.lines)};
}

frame_store::MemoryLayout Machine::layout() const {
  return frame_store::MemoryLayout::of(frame_store, static_cast<std::uint64_t>(video.columns),
                                       static_cast<std::uint64_t>(video.lines),
                                       static_cast<unsigned>(span_unit.depth_bits), stores_numbers());
}

}  // namespace rastertlm::quadratic
