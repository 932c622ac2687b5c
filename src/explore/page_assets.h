// The script of a sweep's page, compiled in from src/explore/page (cmake/EmbedTexts.cmake).
#pragma once

#include <string_view>

namespace rastertlm::explore {

extern const std::string_view kSweepScript;

}  // namespace rastertlm::explore
