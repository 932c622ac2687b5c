#include "src/run/table_budgets.h"

#include <cmath>
#include <string>

#include "modules/shading/loader_budget.h"
#include "src/run/budget.h"

namespace rastertlm::run {

void add_table_budgets(imogene::Imogene& platform, std::vector<Budget>& budgets) {
  const imogene::Machine& machine = platform.machine();
  const bool sequencer = machine.loader.kind == shading::LoaderKind::sequencer;
  const double retrace_us = machine.video.vertical_retrace_us;
  const double frame_us = platform.timing().clock.seconds(platform.timing().frame) * 1e6;
  const double obtained_retrace_us = platform.timing().clock.seconds(platform.timing().vertical_retrace) * 1e6;
  const double own_us = machine.loader.when == shading::LoadTime::retrace ? obtained_retrace_us : frame_us;
  const double update_us = platform.table_loader().longest_load_seconds() * 1e6;
  const std::vector<shading::LoadBudget> loads =
      shading::load_budgets(machine.shading, machine.loader, machine.shading.materials);
  const auto seconds_of = [&](const std::string& table) {
    for (const auto& load : loads)
      if (load.name == table + (sequencer ? ".load_sequencer" : ".load_68000")) return load.used;
    return 0.0;
  };
  for (const shading::LoadBudget& load : loads) {
    const std::string table = load.name.substr(0, load.name.find('.'));
    if (load.unit == "words") {
      const double in_time = load.used * own_us / seconds_of(table);
      budgets.push_back(budget(load.name, load.used, std::floor(in_time), load.unit,
                               load.source + "; words that this machine's loader writes in its time", "", false));
    } else if (load.unit == "us") {
      // The paper sets the sequencer against the retrace and the 68000s against the frame.
      const bool by_sequencer = load.name.ends_with("_sequencer");
      const double available = by_sequencer ? retrace_us : frame_us;
      // Of the tables, those of the dot products alone change while a scene is shown: with the camera.
      const bool applies = update_us > 0.0 && by_sequencer == sequencer && table == "dot_table" &&
                           (by_sequencer == (machine.loader.when == shading::LoadTime::retrace));
      budgets.push_back(budget(load.name, load.used, available, load.unit,
                               load.source + (by_sequencer ? "; vertical retrace" : "; video frame"), kLoaderKeys,
                               applies));
    } else {
      budgets.push_back(budget(load.name, load.used, load.used, load.unit, load.source, "", false));
    }
  }
  budgets.push_back(budget("tables.update", update_us, own_us, "us",
                           machine.loader.when == shading::LoadTime::retrace
                               ? "what a frame of this run loads, slowest loader; vertical retrace"
                               : "what a frame of this run loads into the other bank, slowest loader, with the message "
                                 "that says so; video frame",
                           kLoaderKeys, update_us > 0.0));
}

}  // namespace rastertlm::run
