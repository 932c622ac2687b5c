// Scripts and style of the pages, compiled in from src/report/page and from Debian's Chart.js (cmake/EmbedTexts.cmake).
#pragma once

#include <string_view>

namespace rastertlm::report {

extern const std::string_view kPageStyle;
extern const std::string_view kChartScript;     // Chart.js, with its licence line
extern const std::string_view kCommonScript;    // what all pages share
extern const std::string_view kPicturesScript;  // of a run
extern const std::string_view kRunScript;

}  // namespace rastertlm::report
