// The figures that a sweep file names: objectives, what is shown beside them, constraints.
#pragma once

#include <functional>
#include <string>

#include "src/base/errors.h"
#include "src/explore/sweep.h"
#include "src/explore/sweep_file.h"
#include "src/run/input_files.h"

namespace rastertlm::explore {

// `standing`: a parameter of the machines, or why it is none. What is wrong goes to `diagnostics`.
void read_figures(const SweepFile& file, const std::function<run::Settable::Checked(const std::string&)>& standing,
                  Sweep& sweep, Diagnostics& diagnostics);

}  // namespace rastertlm::explore
