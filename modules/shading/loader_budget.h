// What loading the tables takes, in closed form, for both loaders (004, section 5.3.6; errata 8).
#pragma once

#include <string>
#include <vector>

#include "modules/shading/loader_parameters.h"
#include "modules/shading/table_load.h"

namespace rastertlm::shading {

// One line of the report's budgets. What is available, and whether it fits, the platform knows.
struct LoadBudget {
  std::string name;  // "dot_table.words" ...
  double used = 0.0;
  std::string unit;      // "words", "us", "cycles"
  std::string source;    // the formula
  std::string moved_by;  // the parameters in it
};

// The budgets, in the order in which report.json names them, for `materials` materials, each of the loaders that share
// the table: loaders run at the same time, and the time is that of the largest share. argument_cycles as in `loader`.
std::vector<LoadBudget> load_budgets(const ShadingParameters& shading, const LoaderParameters& loader,
                                     std::int64_t materials);

// What a change of the scene makes this machine load again, by its own loader: "reload.camera", "reload.material",
// "reload.light_colour".
std::vector<LoadBudget> reload_budgets(const ShadingParameters& shading, const LoaderParameters& loader,
                                       std::int64_t materials);

// Time of one step, whichever the loader: a store, or an `up` of a specular path (which stores nothing).
double step_seconds(const LoaderParameters& loader, TableKind kind, bool is_up);
// Time of a whole job, argument steps included.
double job_seconds(const LoaderParameters& loader, const TableJob& job);

// The shortest time that this machine's loaders leave a table between two stores.
struct StoreTime {
  double ns = 0.0;
  std::string source;    // the formula
  std::string moved_by;  // the parameters of the loader whose time it is
};
StoreTime shortest_store_time(const LoaderParameters& loader);

// Whole moves that this machine's specular loader makes along a material's path, after the change of arguments, where
// it has `time` seconds for the largest share of `materials`. A move takes the mean of the path's stores and `up`s.
std::int64_t path_moves_in(double time, const ShadingParameters& shading, const LoaderParameters& loader,
                           std::int64_t materials);

// Logic that the loaders of a machine are.
struct LoaderLogic {
  std::string name;
  std::uint64_t count = 0;
  std::string unit;
};
std::vector<LoaderLogic> loader_logic(const ShadingParameters& shading, const LoaderParameters& loader);

}  // namespace rastertlm::shading
