// A raw value as a parameter takes it: type, arity, range, finiteness and accepted values.
#pragma once

#include <string>
#include <variant>

#include "src/config/raw.h"
#include "src/parameter/table.h"

namespace rastertlm::config {

// What is wrong, in one sentence without the key.
struct Mistake {
  std::string message;
};

// An integer is accepted where a real is expected, not the reverse.
std::variant<parameter::Value, Mistake> convert(const Raw& raw, const parameter::Parameter& parameter);

}  // namespace rastertlm::config
