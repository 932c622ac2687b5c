#include "platforms/imogene/machine.h"

#include <fmt/format.h>

#include <algorithm>

#include "modules/decision_unit/decision_unit.h"
#include "modules/object_processor/microprogram.h"
#include "modules/object_processor/second_order_program.h"
#include "modules/quadric_processor/quadric_logic.h"
#include "modules/quadric_processor/quadric_pipeline.h"
#include "modules/set_up/word_format.h"
#include "src/base/fixed_point.h"

namespace rastertlm::imogene {
namespace {

constexpr std::uint64_t kMostProcessors = std::uint64_t{1} << 31;  // they are numbered in 32 bits

// The frame start must fit the retrace; where every retrace copies, each copy must end before the next begins.
void check_retrace(const Machine& machine) {
  const video::Timing timing = video::timing(machine.video);
  const BoardNeeds needs = board_needs(machine);
  if (needs.frame_start > timing.vertical_retrace)
    throw InputError({"", 0, "video.vertical_retrace_us",
                      fmt::format("the frame start takes {} pixel clocks, and the vertical retrace has {}",
                                  needs.frame_start.count(), timing.vertical_retrace.count())});
  if (const Cycles lead = needs.quadric_lead; needs.frame_start + lead > timing.vertical_retrace)
    throw InputError({"", 0, "quadric_processor.alignment",
                      fmt::format("quadrics start their lines {} pixel clocks early, after a frame start of {}, and "
                                  "the vertical retrace has {}; \"delay\" would do",
                                  lead.count(), needs.frame_start.count(), timing.vertical_retrace.count())});
  if (machine.host.swap == host::Swap::unconditional && needs.copy() >= timing.frame)
    throw InputError(
        {"", 0, "host.swap",
         fmt::format("copied at every retrace, a copy of {} pixel clocks (the last of {} processors is {} "
                     "behind the first) does not end before the next, {} later; a tree, fewer processors "
                     "or \"global\" would do",
                     needs.copy().count(), machine.processors(), needs.skew.count(), timing.frame.count())});
}

void check_quadric_line_start(const Machine& machine) {
  const Cycles needed = board_needs(machine).quadric_line_start;
  const video::Timing timing = video::timing(machine.video);
  if (needed <= timing.horizontal_blanking) return;
  throw InputError({"", 0, "quadric_processor.slice_bits",
                    fmt::format("the line start of quadrics takes {} pixel clocks, and horizontal blanking has {}",
                                needed.count(), timing.horizontal_blanking.count())});
}

}  // namespace

BoardNeeds board_needs(const Machine& machine) {
  BoardNeeds needs{object_processor::line_start_cycles(machine.object_processor.slices()),
                   object_processor::frame_start_cycles(),
                   decision_unit::skew(machine.decision_unit.topology, machine.processors(),
                                       Cycles(static_cast<std::uint64_t>(machine.object_processor.comparator_cycles)))};
  if (machine.quadric.per_unit == 0) return needs;
  const video::Timing timing = video::timing(machine.video);
  needs.frame_start = std::max(needs.frame_start, object_processor::second_order_frame_start_cycles());
  needs.quadric_line_start = quadric_processor::line_start_cycles(machine.quadric, timing.fields);
  needs.quadric_lead = quadric_lead(machine);
  for (std::size_t line = 0; line < timing.fields; ++line)
    needs.quadric_first_lines.at(line) =
        needs.quadric_lead + quadric_processor::line_start_cycles(machine.quadric, timing.lines_advanced(line), true);
  return needs;
}

void Machine::declare(parameter::Table& table) {
  table.integer("schema", schema, {1, 1},
                {.unit = "", .description = "Version of the machine file's form.", .moves = "nothing", .exempt = true});
  table.choice("platform", platform, {"imogene"},
               {.unit = "", .description = "Which kind of machine this is.", .moves = "nothing", .exempt = true});
  table.choice("fidelity", fidelity, {"line"},
               {.unit = "",
                .description = "One transaction a scan line and link, closed-form spans; the only fidelity so far.",
                .moves = "nothing",
                .exempt = true});
  video.declare(table);
  host.declare(table);
  object_processor.declare(table);
  quadric.declare(table);
  decision_unit.declare(table);
  shading.declare(table);
  loader.declare(table);
}

void Machine::check(Diagnostics& diagnostics, const std::string& file) const {
  host.check(diagnostics, file);
  object_processor.check(diagnostics, file);
  quadric.check(object_processor, diagnostics, file);
  shading.check(object_processor.normal_bits, file, diagnostics);
  loader.check(shading, file, diagnostics);
  const auto gather = [&](const auto& step) {
    try {
      step();
    } catch (const InputError& error) {
      for (Diagnostic diagnostic : error.diagnostics()) {
        diagnostic.file = file;
        diagnostics.add(std::move(diagnostic));
      }
    }
  };
  gather([&] { snap_grids(*this); });
  gather([&] {
    const video::Timing timing = video::timing(video);
    const Cycles line_start = object_processor::line_start_cycles(object_processor.slices(), timing.fields);
    if (line_start > timing.horizontal_blanking)
      throw InputError(
          {"", 0, "video.pixel_clock_ns",
           fmt::format("the line start takes {} pixel clocks{}, and horizontal blanking has {}", line_start.count(),
                       timing.fields > 1 ? " (interlaced: two lines' work)" : "", timing.horizontal_blanking.count())});
  });
  gather([&] { check_quadric_line_start(*this); });
  gather([&] { check_retrace(*this); });
  if (processors() > kMostProcessors)
    diagnostics.add(
        {file, 0,
         quadric.per_unit > host.processors_per_unit ? "quadric_processor.per_unit" : "host.processors_per_unit",
         fmt::format("{} units of {} are more than {} processors", host.computation_units,
                     host.processors_per_unit + quadric.per_unit, kMostProcessors)});
}

std::uint64_t Machine::triangle_processors() const {
  return static_cast<std::uint64_t>(host.computation_units) * static_cast<std::uint64_t>(host.processors_per_unit);
}

std::uint64_t Machine::quadric_processors() const {
  return static_cast<std::uint64_t>(host.computation_units) * static_cast<std::uint64_t>(quadric.per_unit);
}

Cycles quadric_latency(const Machine& machine) {
  if (machine.quadric.per_unit == 0) return Cycles(0);
  return Cycles(quadric_processor::quadric_pipeline(machine.quadric, machine.object_processor).latency_cycles());
}

Cycles quadric_delay(const Machine& machine) {
  return machine.quadric.alignment == quadric_processor::Alignment::early_start ? Cycles(0) : quadric_latency(machine);
}

Cycles quadric_lead(const Machine& machine) { return quadric_latency(machine) - quadric_delay(machine); }

Cycles quadric_line_starts(const Machine& machine) {
  const video::Timing timing = video::timing(machine.video);
  Cycles cycles(0);
  for (std::size_t line = 0; line < static_cast<std::size_t>(machine.video.lines); ++line)
    cycles = cycles +
             quadric_processor::line_start_cycles(machine.quadric, timing.lines_advanced(line), line < timing.fields);
  return cycles;
}

quadric_processor::DepthRange depth_range(const Machine& machine) {
  const set_up::WordFormat format{static_cast<int>(machine.object_processor.word_bits),
                                  static_cast<std::size_t>(machine.video.columns),
                                  static_cast<std::size_t>(machine.video.lines)};
  return {set_up::near_depth(format), set_up::far_depth(format)};
}

unsigned Machine::material_bits() const {
  return std::max(1U, bit_length(static_cast<std::uint64_t>(shading.materials - 1)));
}

geometry::SnapGrids snap_grids(const Machine& machine) {
  const auto columns = static_cast<std::size_t>(machine.video.columns);
  const auto lines = static_cast<std::size_t>(machine.video.lines);
  const auto grids = geometry::snap_grids(columns, lines, static_cast<int>(machine.object_processor.word_bits),
                                          static_cast<int>(machine.object_processor.snap_bits));
  if (!grids)
    throw InputError(
        {"", 0, "object_processor.word_bits",
         fmt::format("edge words of {} bits wrap on a screen of {} x {} pixels; {} bits would do",
                     machine.object_processor.word_bits, columns, lines, geometry::word_bits_needed(columns, lines))});
  return *grids;
}

}  // namespace rastertlm::imogene
