#include "platforms/adaptive/machine.h"

namespace rastertlm::adaptive {

Machine::Machine() {
  platform_name = "adaptive";
  set_up.method = ShadingMethod::regular_subdivision;
  set_up.attributes = set_up::Attributes::perspective;
}

void Machine::declare(parameter::Table& table) {
  declare_file(table);
  table.choice("platform", kind, {"adaptive"},
               {.unit = "", .description = "Which kind of machine this is.", .moves = "nothing", .exempt = true});
  set_up.declare_adaptive(table);
  declare_units(table);
  pixel_unit.declare(table);
}

void Machine::check(Diagnostics& diagnostics, const std::string& file) const {
  set_up.check_method("adaptive", file, diagnostics);
  check_units(diagnostics, file);
}

}  // namespace rastertlm::adaptive
