// The figures of an object machine after a run: where its cycles went, what crossed its links, what it is made of.
#pragma once

#include <vector>

#include "platforms/imogene/imogene.h"
#include "src/run/result.h"

namespace rastertlm::run {

std::vector<UnitFigures> unit_figures(imogene::Imogene& platform);
std::vector<LinkFigures> link_figures(imogene::Imogene& platform);
std::vector<Memory> memory_figures(imogene::Imogene& platform);
std::vector<Logic> logic_figures(imogene::Imogene& platform);
Modelled modelled_figures(imogene::Imogene& platform, const scene::Scene& scene, bool model_everything);

}  // namespace rastertlm::run
