#include "modules/decision_unit/parameters.h"

namespace rastertlm::decision_unit {

void DecisionUnitParameters::declare(parameter::Table& table) {
  table.choice(
      "decision_unit.topology", topology, {"tree", "pipeline"},
      {"", "How the nearest object is found: a pipelined binary tree, or a chain through the object processors.",
       "latency, comparators, registers and pins of the decision unit, budgets[] pipeline_skew"});
  table.boolean("decision_unit.double_clocked", double_clocked,
                {"", "Whether the pins between processors carry two bits a clock.", "pins of an object processor"});
}

}  // namespace rastertlm::decision_unit
