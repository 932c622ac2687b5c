// The adaptive-shading machine (003) as a machine file describes it: the units of the quadratic machine, with a host
// that finds the triangles with highlights and cuts them up, in front of a span unit that interpolates linearly.
#pragma once

#include "platforms/quadratic/machine.h"

namespace rastertlm::adaptive {

enum class Platform { adaptive };

struct Machine : quadratic::Machine {
  Machine();

  void declare(parameter::Table& table);
  // What no single range can say; `file` names the machine file in the diagnostics.
  void check(Diagnostics& diagnostics, const std::string& file) const;

  Platform kind = Platform::adaptive;
};

}  // namespace rastertlm::adaptive
