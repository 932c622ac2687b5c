// report.html of a run: the answer in one line; the frame, the exact frame and the error between them; bars of units,
// budgets and links; the slack of every scan line; the configuration with the origin of each value.
#pragma once

#include <functional>
#include <string>

#include "src/report/schema.h"

namespace rastertlm::report {

// Where the file of that name is, of those that a run wrote: pictures, channels and configuration are read from there.
// Pictures that are no longer there are left out; of many frames, the first, the last and the one that is farthest from
// the ideal are embedded, as far as they fit. Levels of the exact frame are those of the channels' file, rounded.
using FileOfRun = std::function<std::string(const std::string& name)>;

// Throws InputError where a picture that is there cannot be read.
std::string run_page(const Contents& contents, const FileOfRun& file);

}  // namespace rastertlm::report
