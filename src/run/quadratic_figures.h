// The figures of a span unit's machine after a run: where its cycles went, what crossed its links, what it is made of.
#pragma once

#include <vector>

#include "platforms/quadratic/quadratic.h"
#include "src/run/result.h"

namespace rastertlm::run {

std::vector<UnitFigures> unit_figures(const quadratic::Quadratic& platform);
std::vector<LinkFigures> link_figures(const quadratic::Quadratic& platform);
std::vector<Memory> memory_figures(const quadratic::Machine& m);
std::vector<Logic> logic_figures(const quadratic::Quadratic& platform);

}  // namespace rastertlm::run
