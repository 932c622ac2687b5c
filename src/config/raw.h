// A value as a file or a command line gives it, before anybody knows which parameter it is for.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace rastertlm::config {

struct Raw;
using RawList = std::vector<Raw>;

// What no parameter takes: a date, a table. `what` names it in messages: "a date".
struct Unusable {
  std::string what;
};

struct Raw {
  std::variant<std::int64_t, double, bool, std::string, RawList, Unusable> value;
};

}  // namespace rastertlm::config
