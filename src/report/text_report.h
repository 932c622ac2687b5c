// report.txt: what an architect reads. The first line is the answer.
#pragma once

#include <string>

#include "src/report/schema.h"

namespace rastertlm::report {

// Whether the machine shows the scene at its rate, what limits it and by how much, in one sentence.
std::string answer_sentence(const run::Result& result);

// The whole report. Made from what read_json() gives, so that a report made again has the same bytes.
std::string text_report(const Contents& contents);

}  // namespace rastertlm::report
