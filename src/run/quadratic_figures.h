// The figures of a span unit's machine after a run: where its cycles went, what crossed its links, what it is made of,
// and what a frame needs of each resource beside what there is.
#pragma once

#include <vector>

#include "platforms/quadratic/quadratic.h"
#include "src/run/result.h"

namespace rastertlm::run {

// What a frame takes of each unit, were it alone: the slowest frame of the run, in seconds.
struct FrameLoad {
  double set_up = 0.0;             // arithmetic and bus
  double span_unit = 0.0;          // load, lines, pixels
  double memory = 0.0;             // clear, tests and writes, and the screen where it shares the port
  double pixels = 0.0;             // drawn, hidden ones included
  std::uint64_t memory_waits = 0;  // cycles of the span unit, over the run
};
FrameLoad frame_load(const quadratic::Quadratic& platform);

std::vector<UnitFigures> unit_figures(const quadratic::Quadratic& platform);
std::vector<LinkFigures> link_figures(const quadratic::Quadratic& platform);
std::vector<Memory> memory_figures(const quadratic::Quadratic& platform);
std::vector<Logic> logic_figures(const quadratic::Quadratic& platform);
std::vector<Budget> quadratic_budgets(const quadratic::Quadratic& platform);
Answer quadratic_answer(const quadratic::Quadratic& platform, const std::vector<Budget>& budgets);
// Sentences: words that are too narrow for the screen, triangles that are not as their method has them.
std::vector<std::string> quadratic_warnings(const quadratic::Quadratic& platform);

}  // namespace rastertlm::run
