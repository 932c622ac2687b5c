// What a parameter is: declared once, with its path, type, default, unit, range and meaning. A Table is a view of a
// live configuration structure: whoever reads a file, checks it, writes it back or describes it goes through the same
// declarations.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rastertlm::parameter {

using Triple = std::array<double, 3>;

enum class Kind { integer, real, boolean, text, choice, triple, integers, triples, index_triples };
std::string to_string(Kind kind);

// integer -> int64; real -> double; boolean -> bool; text, choice -> string; triple -> Triple; integers ->
// vector<int64>; triples -> vector<Triple>; index_triples -> vector<array<int64, 3>>
using IndexTriple = std::array<std::int64_t, 3>;
using Value = std::variant<std::int64_t, double, bool, std::string, Triple, std::vector<std::int64_t>,
                           std::vector<Triple>, std::vector<IndexTriple>>;

// The parameter means something only where the choice at `path` (in the same table) has one of `values`.
struct Condition {
  std::string path;
  std::vector<std::string> values;
};

// What every declaration says beside its type and default.
struct About {
  std::string unit;         // "" where it has none
  std::string description;  // one sentence
  std::string moves;        // the figure or picture that moves with it
  std::optional<Condition> only_when = std::nullopt;
  bool required = false;  // has no default: the file must give it
  bool exempt = false;    // a name, an output, threads or fidelity: nothing moves with it, and a test says so
};

template <class Number>
struct Range {
  Number minimum;
  Number maximum;
  bool above_minimum = false;  // the minimum itself is excluded
};

struct Parameter {
  std::string path;  // from the table's root, dotted: "video.columns"
  Kind kind;
  About about;
  std::optional<Range<double>> range;  // integer, integers, real; a triple's components
  std::vector<std::string> choices;    // choice
  Value default_value;
  std::function<Value()> get;
  std::function<void(const Value&)> set;  // the value has the kind's alternative, and has been checked
};

class Table;

// An array of tables, such as [[light]].
struct List {
  std::string path;
  std::string description;
  std::function<Table()> append;  // a view of a new element at the end
  std::function<std::size_t()> size;
  std::function<Table(std::size_t)> element;  // a view of an element
  std::function<Table()> example;             // a view of a default element, for descriptions
  std::function<void()> clear;                // removes every element: what a file lists replaces the default ones
};

class Table {
 public:
  void integer(const std::string& path, std::int64_t& target, Range<std::int64_t> range, About about);
  void real(const std::string& path, double& target, Range<double> range, About about);
  void boolean(const std::string& path, bool& target, About about);
  void text(const std::string& path, std::string& target, About about);
  void triple(const std::string& path, Triple& target, Range<double> range, About about);
  void integers(const std::string& path, std::vector<std::int64_t>& target, Range<std::int64_t> range, About about);
  void triples(const std::string& path, std::vector<Triple>& target, About about);
  void index_triples(const std::string& path, std::vector<IndexTriple>& target, About about);

  // An enumeration with the names of its values in order: value i is named names[i].
  template <class Enum>
  void choice(const std::string& path, Enum& target, std::vector<std::string> names, About about);

  // Elements of type T, which has `void declare(Table&)`.
  template <class T>
  void list(const std::string& path, std::vector<T>& target, std::string description);

  const std::vector<Parameter>& parameters() const { return parameters_; }
  const std::vector<List>& lists() const { return lists_; }
  const Parameter* find(const std::string& path) const;
  // Null where no list of this table has the path.
  const List* find_list(const std::string& path) const;
  // Whether the conditions of a parameter of this table hold as the table stands, those of the choices it depends on
  // included.
  bool applies(const Parameter& parameter) const { return unmet_condition(parameter) == nullptr; }
  // The first of them that does not hold, or null.
  const Condition* unmet_condition(const Parameter& parameter) const;

 private:
  void add(Parameter parameter);
  std::vector<Parameter> parameters_;
  std::vector<List> lists_;
};

// A view of any structure that has `void declare(Table&)`.
template <class T>
Table view(T& configuration) {
  Table table;
  configuration.declare(table);
  return table;
}

template <class Enum>
void Table::choice(const std::string& path, Enum& target, std::vector<std::string> names, About about) {
  auto get = [&target, names]() -> Value { return names.at(static_cast<std::size_t>(target)); };
  auto set = [&target, names](const Value& value) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == std::get<std::string>(value)) target = static_cast<Enum>(i);
  };
  const Value default_value = get();
  add({path, Kind::choice, std::move(about), std::nullopt, std::move(names), default_value, get, set});
}

template <class T>
void Table::list(const std::string& path, std::vector<T>& target, std::string description) {
  lists_.push_back({path, std::move(description),
                    [&target] {
                      target.emplace_back();
                      return view(target.back());
                    },
                    [&target] { return target.size(); }, [&target](std::size_t i) { return view(target.at(i)); },
                    [] {
                      static T element{};
                      return view(element);
                    },
                    [&target] { target.clear(); }});
}

inline constexpr double kAnyReal = std::numeric_limits<double>::max();

}  // namespace rastertlm::parameter
