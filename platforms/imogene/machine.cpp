#include "platforms/imogene/machine.h"

#include <fmt/format.h>

#include <algorithm>

#include "modules/decision_unit/decision_unit.h"
#include "modules/object_processor/microprogram.h"
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
  if (machine.host.swap == host::Swap::unconditional && needs.copy() >= timing.frame)
    throw InputError(
        {"", 0, "host.swap",
         fmt::format("copied at every retrace, a copy of {} pixel clocks (the last of {} processors is {} "
                     "behind the first) does not end before the next, {} later; a tree, fewer processors "
                     "or \"global\" would do",
                     needs.copy().count(), machine.processors(), needs.skew.count(), timing.frame.count())});
}

}  // namespace

BoardNeeds board_needs(const Machine& machine) {
  return {object_processor::line_start_cycles(machine.object_processor.slices()),
          object_processor::frame_start_cycles(),
          decision_unit::skew(machine.decision_unit.topology, machine.processors(),
                              Cycles(static_cast<std::uint64_t>(machine.object_processor.comparator_cycles)))};
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
  decision_unit.declare(table);
  shading.declare(table);
  loader.declare(table);
}

void Machine::check(Diagnostics& diagnostics, const std::string& file) const {
  host.check(diagnostics, file);
  object_processor.check(diagnostics, file);
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
  gather([&] { check_retrace(*this); });
  if (processors() > kMostProcessors)
    diagnostics.add({file, 0, "host.processors_per_unit",
                     fmt::format("{} units of {} are more than {} object processors", host.computation_units,
                                 host.processors_per_unit, kMostProcessors)});
}

std::uint64_t Machine::processors() const {
  return static_cast<std::uint64_t>(host.computation_units) * static_cast<std::uint64_t>(host.processors_per_unit);
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
