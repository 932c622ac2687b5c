// timeline.json: the Trace Event Format, which Perfetto and chrome://tracing open.
#pragma once

#include <string>

#include "src/run/timeline.h"

namespace rastertlm::report {

// Groups are processes and tracks threads, in order; every event is a complete one ("X") with its beginning and
// duration in microseconds, whose six decimals are the model's picoseconds. An event a line; the same bytes for the
// same timeline.
std::string timeline_json(const run::Timeline& timeline);

}  // namespace rastertlm::report
