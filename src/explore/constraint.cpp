#include "src/explore/constraint.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "src/explore/figures.h"
#include "src/report/figure_path.h"

namespace rastertlm::explore {
namespace {

struct Sign {
  const char* text;
  Comparison comparison;
};
// Longer ones first: "<=" is no "<".
constexpr std::array<Sign, 7> kSigns{{{"<=", Comparison::at_most},
                                      {">=", Comparison::at_least},
                                      {"==", Comparison::equal},
                                      {"!=", Comparison::not_equal},
                                      {"<", Comparison::less},
                                      {">", Comparison::greater},
                                      {"=", Comparison::equal}}};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

struct Found {
  std::size_t at = std::string::npos;
  Sign sign = kSigns[0];
};

// The comparison outside of brackets, which may hold a "=".
Found find_sign(const std::string& text) {
  int depth = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '[') ++depth;
    if (text[at] == ']') --depth;
    if (depth > 0) continue;
    for (const Sign& sign : kSigns)
      if (text.compare(at, std::char_traits<char>::length(sign.text), sign.text) == 0) return {at, sign};
  }
  return {};
}

bool read_number(const std::string& text, double& value) {
  if (text == "true" || text == "false") {
    value = text == "true" ? 1.0 : 0.0;
    return true;
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

std::variant<Constraint, std::string> parse_constraint(const std::string& text) {
  const Found sign = find_sign(text);
  Constraint constraint{text, trimmed(text.substr(0, sign.at)), sign.sign.comparison, 1.0, false, 0};
  if (sign.at == std::string::npos) {
    constraint.comparison = Comparison::equal;
    constraint.alone = true;
  } else {
    const std::string number = trimmed(text.substr(sign.at + std::char_traits<char>::length(sign.sign.text)));
    if (!read_number(number, constraint.value))
      return fmt::format("'{}' compares with '{}', which is no number, true or false", text, number);
  }
  const std::string mistake = parameter_of(constraint.path).empty() ? report::figure_mistake(constraint.path) : "";
  if (!mistake.empty()) return mistake;
  return constraint;
}

bool meets(const Constraint& constraint, const std::optional<double>& figure) {
  if (!figure) return false;
  switch (constraint.comparison) {
    case Comparison::less:
      return *figure < constraint.value;
    case Comparison::at_most:
      return *figure <= constraint.value;
    case Comparison::equal:
      return *figure == constraint.value;
    case Comparison::not_equal:
      return *figure != constraint.value;
    case Comparison::at_least:
      return *figure >= constraint.value;
    case Comparison::greater:
      return *figure > constraint.value;
  }
  return false;
}

}  // namespace rastertlm::explore
