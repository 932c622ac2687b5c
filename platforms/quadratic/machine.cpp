#include "platforms/quadratic/machine.h"

#include "modules/video/timing.h"

namespace rastertlm::quadratic {

void Machine::declare(parameter::Table& table) {
  table.integer("schema", schema, {1, 1},
                {.unit = "", .description = "Version of the machine file's form.", .moves = "nothing", .exempt = true});
  table.choice("platform", platform, {"quadratic"},
               {.unit = "", .description = "Which kind of machine this is.", .moves = "nothing", .exempt = true});
  table.choice("fidelity", fidelity, {"line"},
               {.unit = "",
                .description = "One transaction a scan line and link, closed-form spans; the only fidelity so far.",
                .moves = "nothing",
                .exempt = true});
  video.declare(table);
  host.declare(table, "answer.frame_rate_hz");
  set_up.declare(table);
  span_unit.declare(table);
  frame_store.declare(table);
  software.declare(table);
}

void Machine::check(Diagnostics& diagnostics, const std::string& file) const {
  set_up.check(file, diagnostics);
  span_unit.check(file, diagnostics);
  frame_store.check(file, diagnostics);
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

host::SetUpFormat Machine::set_up_format() const {
  return {viewport(), static_cast<unsigned>(span_unit.depth_bits), set_up::SpanFormat::of(span_unit, video.lines)};
}

frame_store::MemoryLayout Machine::layout() const {
  return frame_store::MemoryLayout::of(frame_store, static_cast<std::uint64_t>(video.columns),
                                       static_cast<std::uint64_t>(video.lines),
                                       static_cast<unsigned>(span_unit.depth_bits), stores_numbers());
}

}  // namespace rastertlm::quadratic
