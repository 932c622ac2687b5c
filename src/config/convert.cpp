#include "src/config/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "src/base/errors.h"
#include "src/config/value_text.h"

namespace rastertlm::config {
namespace {

using parameter::IndexTriple;
using parameter::Kind;
using parameter::Parameter;
using parameter::Triple;
using parameter::Value;

// Thrown only within this file.
struct Refusal {
  std::string message;
};

std::string with_article(Kind kind) {
  switch (kind) {
    case Kind::integer:
      return "an integer";
    case Kind::real:
      return "a number";
    case Kind::text:
    case Kind::choice:
      return "text in quotes";
    case Kind::integers:
    case Kind::triples:
    case Kind::index_triples:
      return "a " + to_string(kind);
    case Kind::boolean:
    case Kind::triple:
      return to_string(kind);
  }
  return "";
}

[[noreturn]] void wrong_type(const std::string& expected, const Raw& raw) {
  throw Refusal{fmt::format("wrong type: expected {}, found {}", expected, found(raw))};
}

// An override that no integer holds comes as its text.
bool is_whole_number(const std::string& text) {
  const std::size_t first = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  return text.size() > first && std::all_of(text.begin() + static_cast<std::ptrdiff_t>(first), text.end(),
                                            [](char c) { return c >= '0' && c <= '9'; });
}

std::int64_t integer(const Raw& raw) {
  if (const auto* value = std::get_if<std::int64_t>(&raw.value)) return *value;
  if (const auto* value = std::get_if<double>(&raw.value);
      value != nullptr && std::isfinite(*value) && *value == std::floor(*value) && std::abs(*value) < 9e15)
    throw Refusal{fmt::format("wrong type: expected an integer, found {}; write {} without a point", found(raw),
                              static_cast<std::int64_t>(*value))};
  if (const auto* digits = std::get_if<std::string>(&raw.value); digits != nullptr && is_whole_number(*digits))
    throw Refusal{fmt::format("{} is out of range: it does not fit 64 bits, from {} to {}", *digits,
                              std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max())};
  wrong_type("an integer", raw);
}

double real(const Raw& raw) {
  if (const auto* value = std::get_if<std::int64_t>(&raw.value)) return static_cast<double>(*value);
  const auto* value = std::get_if<double>(&raw.value);
  if (value == nullptr) wrong_type("a number", raw);
  if (!std::isfinite(*value)) throw Refusal{fmt::format("{} is not a finite number", *value)};
  return *value;
}

template <class Number>
void check_range(Number value, const Parameter& parameter) {
  if (!parameter.range) return;
  const auto as_real = static_cast<double>(value);
  const bool below =
      parameter.range->above_minimum ? as_real <= parameter.range->minimum : as_real < parameter.range->minimum;
  if (below || as_real > parameter.range->maximum)
    throw Refusal{fmt::format("{} is out of range: it must be {}", value, accepted(parameter))};
}

const RawList& list(const Raw& raw, const std::string& expected) {
  const auto* value = std::get_if<RawList>(&raw.value);
  if (value == nullptr) wrong_type(expected, raw);
  return *value;
}

template <class Number, class Component>
std::array<Number, 3> three(const Raw& raw, const std::string& expected, Component component) {
  const RawList& components = list(raw, expected);
  if (components.size() != 3) throw Refusal{fmt::format("expected {}, found {}", expected, components.size())};
  return {component(components[0]), component(components[1]), component(components[2])};
}

// Every element by `convert_one`; a refusal says which element, from 0.
template <class Element, class Convert>
std::vector<Element> each(const Raw& raw, const Parameter& parameter, Convert convert_one) {
  std::vector<Element> result;
  for (const Raw& element : list(raw, with_article(parameter.kind))) {
    try {
      result.push_back(convert_one(element));
    } catch (const Refusal& refusal) {
      throw Refusal{fmt::format("element [{}]: {}", result.size(), refusal.message)};
    }
  }
  return result;
}

std::string text(const Raw& raw, Kind kind) {
  const auto* value = std::get_if<std::string>(&raw.value);
  if (value == nullptr) wrong_type(with_article(kind), raw);
  return *value;
}

std::string choice(const Raw& raw, const Parameter& parameter) {
  std::string value = text(raw, Kind::choice);
  if (std::find(parameter.choices.begin(), parameter.choices.end(), value) != parameter.choices.end()) return value;
  std::string message = fmt::format("'{}' is not accepted; accepted values: {}", printable(value), accepted(parameter));
  if (const std::string nearest = nearest_word(value, parameter.choices); !nearest.empty())
    message += fmt::format("; nearest: '{}'", nearest);
  throw Refusal{std::move(message)};
}

Value convert_or_throw(const Raw& raw, const Parameter& parameter) {
  const auto checked_integer = [&](const Raw& one) {
    const std::int64_t value = integer(one);
    check_range(value, parameter);
    return value;
  };
  const auto checked_real = [&](const Raw& one) {
    const double value = real(one);
    check_range(value, parameter);
    return value;
  };
  switch (parameter.kind) {
    case Kind::integer:
      return checked_integer(raw);
    case Kind::real:
      return checked_real(raw);
    case Kind::boolean:
      if (const auto* value = std::get_if<bool>(&raw.value)) return *value;
      wrong_type(with_article(Kind::boolean), raw);
    case Kind::text:
      return text(raw, Kind::text);
    case Kind::choice:
      return choice(raw, parameter);
    case Kind::triple:
      return three<double>(raw, "three numbers", checked_real);
    case Kind::integers:
      return each<std::int64_t>(raw, parameter, checked_integer);
    case Kind::triples:
      return each<Triple>(raw, parameter,
                          [&](const Raw& one) { return three<double>(one, "three numbers", checked_real); });
    case Kind::index_triples:
      return each<IndexTriple>(
          raw, parameter, [&](const Raw& one) { return three<std::int64_t>(one, "three integers", checked_integer); });
  }
  throw Refusal{"the declaration has no type"};
}

}  // namespace

std::variant<Value, Mistake> convert(const Raw& raw, const Parameter& parameter) {
  try {
    return convert_or_throw(raw, parameter);
  } catch (Refusal& refusal) {
    return Mistake{std::move(refusal.message)};
  }
}

}  // namespace rastertlm::config
