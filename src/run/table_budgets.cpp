#include "src/run/table_budgets.h"

#include <fmt/format.h>

#include <cmath>

#include "modules/shading/loader_budget.h"
#include "src/run/budget.h"

namespace rastertlm::run {
namespace {

// 004, section 5.3.6, of the MC68000-12: "could compute all the values for a frame in less than 19 ms".
constexpr double kSpecularClaimUs = 19'000.0;

// In microseconds.
struct Times {
  double retrace = 0.0;  // as asked for: what the paper's figures are set against
  double frame = 0.0;
  double own = 0.0;     // what this machine's loaders have
  double update = 0.0;  // what the slowest of them needed
};

Times times_of(imogene::Imogene& platform) {
  const imogene::Machine& machine = platform.machine();
  const video::Timing& timing = platform.timing();
  Times times;
  times.retrace = machine.video.vertical_retrace_us;
  times.frame = timing.clock.seconds(timing.frame) * 1e6;
  times.own = machine.loader.when == shading::LoadTime::retrace ? timing.clock.seconds(timing.vertical_retrace) * 1e6
                                                                : times.frame;
  times.update = platform.table_loader().longest_load_seconds() * 1e6;
  return times;
}

// The paper sets the sequencer against the retrace and the 68000s against the frame. Stated for comparison: this
// machine depends on what a frame of it loads in the time that it has ("tables.update").
void add_load(const shading::LoadBudget& load, const Times& times, std::vector<Budget>& budgets) {
  const bool by_sequencer = load.name.ends_with("_sequencer");
  budgets.push_back(budget(load.name, load.used, by_sequencer ? times.retrace : times.frame, load.unit,
                           load.source + (by_sequencer ? "; vertical retrace" : "; video frame"),
                           load.moved_by + (by_sequencer ? ", video.vertical_retrace_us" : ", video.refresh_hz"),
                           false));
  if (load.name == "specular.load_68000")
    budgets.push_back(budget("specular.paper_19ms", load.used, kSpecularClaimUs, load.unit,
                             load.source + "; 004, section 5.3.6, claims \"less than 19 ms\" for a 12 MHz clock",
                             load.moved_by, false));
}

void add_loads(const imogene::Machine& machine, const Times& times, std::vector<Budget>& budgets) {
  const std::vector<shading::LoadBudget> loads =
      shading::load_budgets(machine.shading, machine.loader, machine.shading.materials);
  const bool sequencer = machine.loader.kind == shading::LoaderKind::sequencer;
  const auto time_of = [&](const std::string& table) {
    for (const auto& load : loads)
      if (load.name == table + (sequencer ? ".load_sequencer" : ".load_68000")) return load.used;
    return 0.0;
  };
  for (const shading::LoadBudget& load : loads) {
    if (load.unit == "us") {
      add_load(load, times, budgets);
    } else if (load.unit == "words") {
      const double in_time = load.used * times.own / time_of(load.name.substr(0, load.name.find('.')));
      budgets.push_back(budget(load.name, load.used, std::floor(in_time), load.unit,
                               load.source + "; words that this machine's loaders write in their time", load.moved_by,
                               false));
    } else {
      const std::int64_t in_time =
          shading::path_moves_in(times.own * 1e-6, machine.shading, machine.loader, machine.shading.materials);
      budgets.push_back(
          budget(load.name, load.used, static_cast<double>(in_time), load.unit,
                 load.source + "; moves of this machine's specular loader in a material's share of its time",
                 load.moved_by + ", shading.materials, loader.argument_cycles, " + kLoaderKeys, false));
    }
  }
}

}  // namespace

void add_table_budgets(imogene::Imogene& platform, std::vector<Budget>& budgets) {
  const imogene::Machine& machine = platform.machine();
  const Times times = times_of(platform);
  add_loads(machine, times, budgets);
  const bool retrace = machine.loader.when == shading::LoadTime::retrace;
  for (const shading::LoadBudget& load :
       shading::reload_budgets(machine.shading, machine.loader, machine.shading.materials))
    budgets.push_back(budget(load.name, load.used, times.own, load.unit,
                             load.source + (retrace ? "; vertical retrace" : "; video frame"), load.moved_by, false));
  budgets.push_back(budget("tables.update", times.update, times.own, "us",
                           retrace ? "what a frame of this run loads, slowest loader; vertical retrace"
                                   : "what a frame of this run loads into the other bank, slowest loader, with the "
                                     "message that says so; video frame",
                           kLoaderKeys, times.update > 0.0));
}

bool late_tables_are_shown(const imogene::Machine& machine) {
  return machine.loader.when == shading::LoadTime::retrace;
}

std::string late_tables_warning(imogene::Imogene& platform, const std::vector<FrameFigures>& frames) {
  std::uint64_t lines = 0;
  std::uint64_t torn = 0;
  for (const FrameFigures& frame : frames) {
    lines += frame.late_table_lines;
    torn += frame.late_table_lines > 0 ? 1 : 0;
  }
  if (lines == 0) return "";
  const Times times = times_of(platform);
  return fmt::format(
      "{} lines of {} frames were shaded from half-written tables: a load takes {:.6g} us and the vertical retrace has "
      "{:.6g} us",
      lines, torn, times.update, times.own);
}

}  // namespace rastertlm::run
