#include "src/config/value_text.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace rastertlm::config {
namespace {

constexpr std::size_t kElementsOnALine = 4;
// Beyond this a bound of an integer parameter is no bound: int64 itself ends there.
constexpr double kNoBound = 9.2e18;

template <class Element>
std::string list_text(const std::vector<Element>& list) {
  const bool tall = !std::is_integral_v<Element> && list.size() > kElementsOnALine;
  std::string text = "[";
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) text += tall ? "," : ", ";
    if (tall) text += "\n  ";
    text += to_toml(parameter::Value(list[i]));
  }
  return text + (tall ? "\n]" : "]");
}

template <>
std::string list_text(const std::vector<parameter::IndexTriple>& list) {
  std::string text = "[";
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) text += list.size() > kElementsOnALine ? "," : ", ";
    if (list.size() > kElementsOnALine) text += "\n  ";
    text += fmt::format("[{}, {}, {}]", list[i][0], list[i][1], list[i][2]);
  }
  return text + (list.size() > kElementsOnALine ? "\n]" : "]");
}

std::string number(double value, bool whole) {
  return whole && std::abs(value) < 9e15 ? fmt::format("{}", static_cast<std::int64_t>(value))
                                         : fmt::format("{}", value);
}

// The bytes of the character that starts with `lead`; 0 where none does.
std::size_t utf8_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead < 0xe0) return 2;
  if (lead >= 0xe0 && lead < 0xf0) return 3;
  if (lead >= 0xf0 && lead < 0xf5) return 4;
  return 0;
}

}  // namespace

std::string to_toml(double value) {
  std::string text = fmt::format("{}", value);
  // A whole number would read back as an integer, and -0 lose its sign.
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string to_toml(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\u{:04X}", code);
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string to_toml(const parameter::Value& value) {
  struct Visitor {
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return to_toml(v); }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(const std::string& v) const { return to_toml(v); }
    std::string operator()(const parameter::Triple& v) const {
      return fmt::format("[{}, {}, {}]", to_toml(v[0]), to_toml(v[1]), to_toml(v[2]));
    }
    std::string operator()(const std::vector<std::int64_t>& v) const { return list_text(v); }
    std::string operator()(const std::vector<parameter::Triple>& v) const { return list_text(v); }
    std::string operator()(const std::vector<parameter::IndexTriple>& v) const { return list_text(v); }
  };
  return std::visit(Visitor{}, value);
}

std::string found(const Raw& raw) {
  struct Visitor {
    std::string operator()(std::int64_t v) const { return fmt::format("the integer {}", v); }
    std::string operator()(double v) const { return "the number " + to_toml(v); }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(const std::string& v) const { return fmt::format("the text \"{}\"", printable(v)); }
    std::string operator()(const RawList& v) const { return fmt::format("a list of {}", v.size()); }
    std::string operator()(const Unusable& v) const { return v.what; }
  };
  return std::visit(Visitor{}, raw.value);
}

std::string accepted(const parameter::Parameter& parameter) {
  if (!parameter.choices.empty()) {
    std::string text;
    for (const std::string& choice : parameter.choices) text += fmt::format("{}'{}'", text.empty() ? "" : ", ", choice);
    return text;
  }
  if (!parameter.range) return "";
  const bool whole = parameter.kind == parameter::Kind::integer || parameter.kind == parameter::Kind::integers;
  const double no_bound = whole ? kNoBound : parameter::kAnyReal;
  const bool has_minimum = parameter.range->minimum > -no_bound;
  const bool has_maximum = parameter.range->maximum < no_bound;
  if (!has_minimum && !has_maximum) return "";
  const std::string minimum = number(parameter.range->minimum, whole);
  const std::string maximum = number(parameter.range->maximum, whole);
  std::string text;
  if (has_minimum && parameter.range->above_minimum) {
    text = "above " + minimum + (has_maximum ? " and at most " + maximum : "");
  } else if (has_minimum) {
    text = has_maximum ? fmt::format("from {} to {}", minimum, maximum) : "at least " + minimum;
  } else {
    text = "at most " + maximum;
  }
  return parameter.about.unit.empty() ? text : text + ' ' + parameter.about.unit;
}

std::string to_text(const parameter::Condition& condition) {
  std::string values;
  for (const std::string& value : condition.values)
    values += fmt::format("{}'{}'", values.empty() ? "" : " or ", value);
  return fmt::format("where {} is {}", condition.path, values);
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(static_cast<unsigned char>(text[i]));
    if (length == 0 || i + length > text.size()) return false;
    std::uint32_t code = static_cast<unsigned char>(text[i]);
    if (length > 1) code &= 0x7fU >> length;
    for (std::size_t k = 1; k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xc0U) != 0x80U) return false;
      code = (code << 6) | (next & 0x3fU);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    if (overlong || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return false;
    i += length;
  }
  return true;
}

std::string printable(std::string_view text) {
  const bool utf8 = is_utf8(text);
  std::string result(text);
  for (char& c : result) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f || (code >= 0x80 && !utf8)) c = '?';
  }
  return result;
}

}  // namespace rastertlm::config
