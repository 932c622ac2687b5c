// report.json before it is text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "src/report/schema.h"

namespace rastertlm::report {

nlohmann::ordered_json json_value(const Contents& contents);

// As json_text() writes it.
std::string text_of_json(const nlohmann::ordered_json& json);

}  // namespace rastertlm::report
