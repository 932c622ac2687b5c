#include "src/parameter/table.h"

#include <algorithm>
#include <utility>

namespace rastertlm::parameter {
namespace {

Range<double> as_real(Range<std::int64_t> range) {
  return {static_cast<double>(range.minimum), static_cast<double>(range.maximum), range.above_minimum};
}

template <class T>
std::pair<std::function<Value()>, std::function<void(const Value&)>> bind(T& target) {
  return {[&target]() -> Value { return target; }, [&target](const Value& value) { target = std::get<T>(value); }};
}

// How a value is written in a Condition; only scalars decide.
std::string condition_text(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* number = std::get_if<std::int64_t>(&value)) return std::to_string(*number);
  return "";
}

}  // namespace

std::string to_string(Kind kind) {
  switch (kind) {
    case Kind::integer:
      return "integer";
    case Kind::real:
      return "number";
    case Kind::boolean:
      return "true or false";
    case Kind::text:
      return "text";
    case Kind::choice:
      return "choice";
    case Kind::triple:
      return "three numbers";
    case Kind::integers:
      return "list of integers";
    case Kind::triples:
      return "list of three numbers each";
    case Kind::index_triples:
      return "list of three integers each";
  }
  return "";
}

void Table::add(Parameter parameter) { parameters_.push_back(std::move(parameter)); }

void Table::integer(const std::string& path, std::int64_t& target, Range<std::int64_t> range, About about) {
  auto [get, set] = bind(target);
  add({path, Kind::integer, std::move(about), as_real(range), {}, target, get, set});
}

void Table::real(const std::string& path, double& target, Range<double> range, About about) {
  auto [get, set] = bind(target);
  add({path, Kind::real, std::move(about), range, {}, target, get, set});
}

void Table::boolean(const std::string& path, bool& target, About about) {
  auto [get, set] = bind(target);
  add({path, Kind::boolean, std::move(about), std::nullopt, {}, target, get, set});
}

void Table::text(const std::string& path, std::string& target, About about) {
  auto [get, set] = bind(target);
  add({path, Kind::text, std::move(about), std::nullopt, {}, target, get, set});
}

void Table::triple(const std::string& path, Triple& target, Range<double> range, About about) {
  auto [get, set] = bind(target);
  add({path, Kind::triple, std::move(about), range, {}, target, get, set});
}

void Table::integers(const std::string& path, std::vector<std::int64_t>& target, Range<std::int64_t> range,
                     About about) {
  auto [get, set] = bind(target);
  add({path, Kind::integers, std::move(about), as_real(range), {}, target, get, set});
}

void Table::triples(const std::string& path, std::vector<Triple>& target, About about) {
  auto [get, set] = bind(target);
  add({path, Kind::triples, std::move(about), std::nullopt, {}, target, get, set});
}

void Table::index_triples(const std::string& path, std::vector<IndexTriple>& target, About about) {
  auto [get, set] = bind(target);
  add({path, Kind::index_triples, std::move(about), std::nullopt, {}, target, get, set});
}

const Parameter* Table::find(const std::string& path) const {
  for (const Parameter& p : parameters_)
    if (p.path == path) return &p;
  return nullptr;
}

const List* Table::find_list(const std::string& path) const {
  for (const List& list : lists_)
    if (list.path == path) return &list;
  return nullptr;
}

const Condition* Table::unmet_condition(const Parameter& parameter) const {
  const Parameter* current = &parameter;
  // A chain of conditions is at most as long as the table; the count guards against a ring.
  for (std::size_t i = 0; i <= parameters_.size() && current->about.only_when; ++i) {
    const Condition& condition = *current->about.only_when;
    const Parameter* deciding = find(condition.path);
    if (deciding == nullptr) return nullptr;
    if (std::find(condition.values.begin(), condition.values.end(), condition_text(deciding->get())) ==
        condition.values.end())
      return &condition;
    current = deciding;
  }
  return nullptr;
}

}  // namespace rastertlm::parameter
