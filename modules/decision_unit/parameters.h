// What an architect may choose of the decision unit (004, sections 5.1 and 5.2.3).
#pragma once

#include "src/parameter/table.h"

namespace rastertlm::decision_unit {

// A pipeline compares inside the object processors, one after another; a binary tree of comparators stands beside them.
enum class Topology { tree, pipeline };

struct DecisionUnitParameters {
  Topology topology = Topology::tree;
  bool double_clocked = true;  // two bits a clock on every pin

  void declare(parameter::Table& table);
};

}  // namespace rastertlm::decision_unit
