// What loading the tables takes, in closed form, for both loaders (004, section 5.3.6; errata 8).
#pragma once

#include <string>
#include <vector>

#include "modules/shading/parameters.h"
#include "modules/shading/table_load.h"

namespace rastertlm::shading {

// One line of the report's budgets. What is available, and whether it fits, the platform knows.
struct LoadBudget {
  std::string name;  // "dot_table.words" ...
  double used = 0.0;
  std::string unit;    // "words", "us", "cycles"
  std::string source;  // the formula
};

// The budgets, in the order in which report.json names them, for `materials` materials, each of one loader: loaders run
// at the same time. argument_cycles as in `loader`.
std::vector<LoadBudget> load_budgets(const ShadingParameters& shading, const LoaderParameters& loader,
                                     std::int64_t materials);

// Time of one step, whichever the loader: a store, or an `up` of a specular path (which stores nothing).
double step_seconds(const LoaderParameters& loader, TableKind kind, bool is_up);
// Time of a whole job, argument steps included.
double job_seconds(const LoaderParameters& loader, const TableJob& job);

}  // namespace rastertlm::shading
