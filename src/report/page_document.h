// A page as one file that asks nothing of a network: style, scripts and data are inside, and its own policy lets a
// browser run no other script and fetch nothing.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rastertlm::report {

struct PageDocument {
  std::string title;
  std::string heading;
  std::string answer;                     // one line
  std::string plain_text;                 // for a browser without scripts
  std::string data;                       // JSON, for the scripts
  std::vector<std::string_view> scripts;  // after Chart.js and what is common; they outlive the call
};

// HTML. Texts are escaped, and the data cannot end its element whatever its strings hold. The same bytes for the same
// document.
std::string page_text(const PageDocument& document);

// A text as JSON has it, quotes included; bytes that are not UTF-8 are replaced.
std::string json_string(const std::string& text);

std::string base64(std::span<const std::uint8_t> bytes);
std::string base64(std::string_view bytes);

}  // namespace rastertlm::report
