#include "src/run/imogene_figures.h"

#include <fmt/format.h>

#include "modules/object_processor/microprogram.h"
#include "modules/object_processor/second_order_program.h"
#include "modules/quadric_processor/quadric_logic.h"
#include "modules/quadric_processor/quadric_pipeline.h"
#include "modules/quadric_processor/quadric_words.h"
#include "modules/shading/loader_budget.h"
#include "src/run/imogene_budgets.h"

namespace rastertlm::run {
namespace {

using imogene::Imogene;

UnitFigures figures(const std::string& name, const Clock& clock, const stream::Occupancy& occupancy) {
  occupancy.check(name);
  return {name,           clock.frequency_hz(), occupancy.cycles, occupancy.busy, occupancy.starved, occupancy.blocked,
          occupancy.idle, clock.name()};
}

// A unit of the display side works in step with the pixel clock: it is busy or idle, and never waits.
UnitFigures display_unit(const std::string& name, const Imogene& platform, std::uint64_t frames, std::uint64_t busy) {
  const std::uint64_t cycles = frames * platform.timing().fields * platform.timing().frame.count();
  return figures(name, platform.timing().clock, {cycles, busy, 0, 0, cycles - busy});
}

std::uint64_t lines_of(const Imogene& platform) { return static_cast<std::uint64_t>(platform.machine().video.lines); }
std::uint64_t columns_of(const Imogene& platform) {
  return static_cast<std::uint64_t>(platform.machine().video.columns);
}

// Of quadric processors, where the machine has any.
void add_quadric_memories(const imogene::Machine& machine, std::vector<Memory>& memories) {
  const std::uint64_t processors = machine.quadric_processors();
  if (processors == 0) return;
  const auto logic =
      quadric_processor::quadric_logic(machine.quadric, machine.object_processor, machine.material_bits());
  for (const quadric_processor::QuadricRam& ram : logic.rams) {
    if (ram.words == 0) continue;
    memories.push_back({"quadric loading RAMs: " + ram.name, processors, ram.words, ram.bits_per_word});
    memories.push_back({"quadric backup RAMs: " + ram.name, processors, ram.words, ram.bits_per_word});
    if (machine.host.swap == host::Swap::global && ram.replaced > 0)
      memories.push_back({"quadric backup RAMs: " + ram.name + ", kept", processors, ram.replaced, ram.bits_per_word});
  }
  memories.push_back({"quadric processor registers", processors, 1, logic.register_bits});
  if (machine.quadric.alignment != quadric_processor::Alignment::delay) return;
  const decision_unit::LinkWidth width{static_cast<std::uint64_t>(machine.object_processor.word_bits),
                                       static_cast<std::uint64_t>(machine.object_processor.normal_bits),
                                       machine.material_bits()};
  memories.push_back({"delay of triangles' fragments", static_cast<std::uint64_t>(machine.host.computation_units),
                      imogene::quadric_latency(machine).count(), width.bits()});
}

void add_quadric_logic(const imogene::Machine& machine, std::vector<Logic>& figures) {
  const std::uint64_t processors = machine.quadric_processors();
  if (processors == 0) return;
  const auto logic =
      quadric_processor::quadric_logic(machine.quadric, machine.object_processor, machine.material_bits());
  figures.push_back({"quadric processors: adder slices", processors * logic.adders, "adders"});
  figures.push_back({"quadric processors: adder width", processors * logic.adder_bits, "bits"});
  figures.push_back(
      {"quadric processors: multipliers of root and constant", processors * logic.multipliers, "multipliers"});
  figures.push_back(
      {"quadric processors: carry-save rows of these", processors * logic.multiplier_bits, "full adders"});
  figures.push_back({"quadric processors: comparators", processors * logic.comparators, "comparators"});
  figures.push_back({"quadric processors: shifters", processors * logic.shifters, "shifters"});
  figures.push_back({"quadric processor: stages of the root", logic.root_stages, "stages"});
  const auto pipeline = quadric_processor::quadric_pipeline(machine.quadric, machine.object_processor);
  figures.push_back({"quadric processor: root", pipeline.root_cycles, "pixel clocks"});
  figures.push_back({"quadric processor: depth, until all is compared", pipeline.depth_cycles(), "pixel clocks"});
  figures.push_back({"quadric processor: normal, root included", pipeline.root_cycles + pipeline.multiplier_cycles(),
                     "pixel clocks"});
  figures.push_back({"quadric processor: later than a triangle", pipeline.latency_cycles(), "pixel clocks"});
}

}  // namespace

std::vector<UnitFigures> unit_figures(Imogene& platform) {
  std::vector<UnitFigures> units;
  units.push_back(figures("animation unit", platform.cost().clock(), platform.books().animation_unit));
  for (std::size_t k = 0; k < platform.computation_units().size(); ++k)
    units.push_back(
        figures(fmt::format("computation unit {}", k), platform.cost().clock(), platform.books().computation_units[k]));
  const imogene::BoardNeeds needs = imogene::board_needs(platform.machine());
  // Line starts of a displayed frame: one for each line that is passed.
  std::uint64_t line_starts = 0;
  for (std::uint64_t line = 0; line < lines_of(platform); ++line) line_starts += platform.timing().lines_advanced(line);
  const std::uint64_t shown = platform.decision_module().lines_sent() / lines_of(platform);
  for (std::size_t k = 0; k < platform.board_modules().size(); ++k) {
    const auto& board = *platform.board_modules()[k];
    units.push_back(display_unit(fmt::format("object board {}", k), platform, shown,
                                 shown * platform.timing().fields * object_processor::frame_start_cycles().count() +
                                     shown * line_starts * needs.line_start.count() +
                                     board.lines_sent() * columns_of(platform)));
  }
  for (std::size_t k = 0; k < platform.quadric_modules().size(); ++k)
    units.push_back(
        display_unit(fmt::format("quadric board {}", k), platform, shown,
                     shown * (platform.timing().fields * object_processor::second_order_frame_start_cycles().count() +
                              imogene::quadric_line_starts(platform.machine()).count()) +
                         platform.quadric_modules()[k]->lines_sent() * columns_of(platform)));
  const std::uint64_t pixels = platform.decision_module().lines_sent() * columns_of(platform);
  for (const char* name : {"decision unit", "shading processor", "video output"})
    units.push_back(display_unit(name, platform, shown, pixels));
  for (std::size_t engine = 0; engine < shading::TableLoaderModule::kEngines; ++engine)
    units.push_back(figures(shading::kEngineNames[engine], platform.table_loader().clock(engine),
                            platform.books().table_loaders[engine]));
  return units;
}

std::vector<LinkFigures> link_figures(Imogene& platform) {
  std::vector<LinkFigures> figures;
  const double seconds = static_cast<double>(platform.end_ps() - platform.start_ps()) * 1e-12;
  for (const stream::Link& link : platform.books().links) {
    LinkFigures f{link.name(), link.bits(), link.clock().frequency_hz(), link.bytes(), link.peak_bytes_per_second()};
    const double bytes = static_cast<double>(link.bytes());
    const double active = link.clock().seconds(link.active());
    f.achieved_bytes_per_s = bytes / seconds;
    f.active_bytes_per_s = active > 0.0 ? bytes / active : 0.0;
    f.utilisation = f.achieved_bytes_per_s / f.peak_bytes_per_s;
    figures.push_back(f);
  }
  return figures;
}

std::vector<Memory> memory_figures(Imogene& platform) {
  const imogene::Machine& machine = platform.machine();
  const std::uint64_t processors = machine.triangle_processors();
  const auto word_bits = static_cast<std::uint64_t>(machine.object_processor.word_bits);
  std::vector<Memory> memories;
  memories.push_back({"loading RAMs", processors * object_processor::kElementaryProcessors, 3, word_bits});
  memories.push_back({"backup RAMs", processors * object_processor::kElementaryProcessors, 3, word_bits});
  // B y + C replaces C line by line: a picture that is shown again without a copy needs C once more.
  if (machine.host.swap == host::Swap::global)
    memories.push_back({"backup RAMs: C, kept", processors * object_processor::kElementaryProcessors, 1, word_bits});
  const auto logic = object_processor::triangle_processor_logic(machine.object_processor, machine.material_bits());
  memories.push_back({"object processor registers", processors, 1, logic.register_bits});
  const decision_unit::LinkWidth width{word_bits, static_cast<std::uint64_t>(machine.object_processor.normal_bits),
                                       machine.material_bits()};
  const auto decision =
      decision_unit::decision_logic(machine.decision_unit, machine.processors(), width,
                                    static_cast<std::uint64_t>(machine.object_processor.comparator_cycles));
  add_quadric_memories(machine, memories);
  memories.push_back({"decision unit registers", 1, decision.register_bits, 1});
  for (const shading::MemorySize& memory : platform.shader().memories())
    memories.push_back({memory.name, memory.instances, memory.words, memory.bits_per_word});
  return memories;
}

std::vector<Logic> logic_figures(Imogene& platform) {
  const imogene::Machine& machine = platform.machine();
  const std::uint64_t processors = machine.triangle_processors();
  const auto logic = object_processor::triangle_processor_logic(machine.object_processor, machine.material_bits());
  const decision_unit::LinkWidth width{static_cast<std::uint64_t>(machine.object_processor.word_bits),
                                       static_cast<std::uint64_t>(machine.object_processor.normal_bits),
                                       machine.material_bits()};
  const auto decision =
      decision_unit::decision_logic(machine.decision_unit, machine.processors(), width,
                                    static_cast<std::uint64_t>(machine.object_processor.comparator_cycles));
  std::vector<Logic> figures;
  figures.push_back({"object processors: adder slices", processors * logic.adders, "adders"});
  figures.push_back({"object processors: adder width", processors * logic.adder_bits, "bits"});
  figures.push_back({"object processors: shifters", processors * logic.shifters, "shifters"});
  add_quadric_logic(machine, figures);
  figures.push_back({"decision unit: depth comparators", decision.comparators, "comparators"});
  figures.push_back({"link between processors", width.bits(), "bits"});
  figures.push_back({"link between processors: one direction", decision.link_pins, "pins"});
  figures.push_back({"object processor: link pins", decision.processor_pins, "pins"});
  figures.push_back({"decision tree node: link pins", decision.node_pins, "pins"});
  figures.push_back({"decision unit: latency", platform.decision_latency().count(), "pixel clocks"});
  figures.push_back({"pixel to level: latency", platform.pixel_latency().count(), "pixel clocks"});
  for (const shading::LogicSize& size : platform.shader().logic())
    figures.push_back({"shading: " + size.name, size.instances, fmt::format("of {} bits", size.bits)});
  for (const shading::LoaderLogic& logic_of_loader : shading::loader_logic(machine.shading, machine.loader))
    figures.push_back({"tables: " + logic_of_loader.name, logic_of_loader.count, logic_of_loader.unit});
  return figures;
}

Modelled modelled_figures(Imogene& platform, const scene::Scene& scene, bool model_everything) {
  Modelled m;
  m.processors_available = platform.machine().triangle_processors();
  m.quadrics_available = platform.machine().quadric_processors();
  for (const auto& owners : platform.solid_slots().boards) m.quadrics_used += owners.size();
  m.solids_made = scene.solid_count();
  m.solids_dropped = platform.solid_slots().dropped;
  for (const auto& owners : platform.slots().boards) m.processors_used += owners.size();
  m.objects_made = scene.triangle_count();
  for (const scene::Object& object : scene.objects) m.objects_degenerate += object.mesh.degenerate;
  m.objects_dropped = platform.slots().dropped;
  for (std::size_t k = 0; k < platform.computation_units().size(); ++k) {
    const auto& unit = *platform.computation_units()[k];
    m.coefficients_sent += unit.words_sent();
    const std::uint64_t solid_words =
        quadric_processor::words_of_slot(static_cast<std::size_t>(platform.machine().quadric.caps));
    m.coefficients_total += (platform.slots().boards[k].size() * object_processor::kWords +
                             platform.solid_slots().boards[k].size() * solid_words) *
                            unit.updates().size();
  }
  for (const auto& board : platform.boards()) {
    m.processors_instantiated += model_everything ? board.processors() : board.slots_in_use();
    m.lines_evaluated += board.counters().lines_evaluated;
    m.fragments_in += board.counters().fragments_in;
  }
  for (const auto& board : platform.quadric_boards()) {
    m.quadrics_instantiated += model_everything ? board.processors() : board.slots_in_use();
    m.lines_evaluated += board.counters().lines_evaluated;
    m.fragments_in += board.counters().fragments_in;
  }
  m.lines_total =
      (platform.boards().size() + platform.quadric_boards().size()) * platform.decision_module().lines_sent();
  m.fragments_kept = platform.decision().counters().fragments_kept;
  m.fragments_hidden = m.fragments_in - m.fragments_kept;
  if (!model_everything) {
    m.left_out.push_back(fmt::format("{} of {} object processors show nothing and are not evaluated",
                                     m.processors_available - m.processors_instantiated, m.processors_available));
    if (m.quadrics_available > 0)
      m.left_out.push_back(fmt::format("{} of {} quadric processors show nothing and are not evaluated",
                                       m.quadrics_available - m.quadrics_instantiated, m.quadrics_available));
    m.left_out.push_back(fmt::format("{} of {} lines of boards hold nothing and are not evaluated",
                                     m.lines_total - m.lines_evaluated, m.lines_total));
  }
  return m;
}

}  // namespace rastertlm::run
