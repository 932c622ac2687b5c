#include "src/explore/sweep_figures.h"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <utility>

#include "src/config/value_text.h"
#include "src/explore/constraint.h"
#include "src/explore/figures.h"
#include "src/report/figure_path.h"

namespace rastertlm::explore {
namespace {

using run::Settable;

class FigureReading {
 public:
  FigureReading(const SweepFile& file, const std::function<Settable::Checked(const std::string&)>& standing,
                Sweep& sweep, Diagnostics& diagnostics)
      : file_(file), standing_(standing), sweep_(sweep), diagnostics_(diagnostics) {}

  void run() {
    for (std::size_t i = 0; i < file_.objectives.size(); ++i) {
      const ObjectiveFile& one = file_.objectives[i];
      sweep_.written_objectives.push_back(checked(fmt::format("objective[{}]", i), one.path, one.name, one.optional));
      sweep_.objectives.push_back({one.path, unit(one.path), one.sense, one.name, one.scale == Spacing::logarithmic});
    }
    if (file_.objectives.empty()) add(0, "objective", "nothing counts: give an [[objective]]");
    for (std::size_t i = 0; i < file_.columns.size(); ++i) {
      const ColumnFile& one = file_.columns[i];
      sweep_.written_further.push_back(checked(fmt::format("column[{}]", i), one.path, one.name, one.optional));
      sweep_.further.push_back({one.path, unit(one.path), one.name});
    }
    for (const Word& word : file_.constraints) constraint(word);
  }

 private:
  void add(int line, const std::string& key, const std::string& message) {
    diagnostics_.add({sweep_.file, line, key, message});
  }

  // Each figure, and each name, once.
  Sweep::Written checked(const std::string& key, const std::string& path, const std::string& name, bool optional) {
    const int line = file_.line_of(key + ".path");
    std::string wrong = path.empty() ? "" : mistake(path);
    if (wrong.empty() && !paths_.insert(path).second) wrong = "stands there twice";
    if (!wrong.empty()) add(line, key + ".path", wrong);
    if (!name.empty() && !names_.insert(name).second)
      add(file_.line_of(key + ".name"), key + ".name", fmt::format("'{}' is another figure's name", name));
    return {optional, line};
  }

  void constraint(const Word& word) {
    auto parsed = parse_constraint(word.text);
    if (const auto* wrong = std::get_if<std::string>(&parsed)) add(word.line, "constraints", *wrong);
    auto* constraint = std::get_if<Constraint>(&parsed);
    if (constraint == nullptr) return;
    std::string wrong = mistake(constraint->path);
    if (wrong.empty() && constraint->alone && !is_truth(constraint->path))
      wrong = fmt::format("'{}' is no truth that could stand alone: compare it, as in '{} >= 1'", constraint->path,
                          constraint->path);
    if (!wrong.empty()) add(word.line, "constraints", wrong);
    constraint->line = word.line;
    sweep_.constraints.push_back(std::move(*constraint));
  }

  std::string mistake(const std::string& path) const {
    const std::string parameter = parameter_of(path);
    if (!parameter.empty()) return number_mistake(path, standing_(parameter));
    std::string mistake = report::figure_mistake(path);
    if (mistake.empty() && !sweep_.reference && report::is_error_figure(path))
      return fmt::format("'{}' cannot be had: with reference = false no error is measured", path);
    return mistake;
  }
  static std::string number_mistake(const std::string& path, const Settable::Checked& known) {
    if (!known.mistake.empty() || known.integer) return known.mistake;
    const std::optional<config::Raw> raw = config::parse_value(known.standing);
    const bool number = raw && (std::holds_alternative<std::int64_t>(raw->value) ||
                                std::holds_alternative<double>(raw->value) || std::holds_alternative<bool>(raw->value));
    return number ? "" : fmt::format("'{}' is no number and no truth: it cannot be compared", path);
  }
  bool is_truth(const std::string& path) const {
    const std::string parameter = parameter_of(path);
    if (parameter.empty()) return report::is_truth_figure(path);
    const std::string standing = standing_(parameter).standing;
    return standing == "true" || standing == "false";
  }
  std::string unit(const std::string& path) const {
    const std::string parameter = parameter_of(path);
    return parameter.empty() ? report::figure_unit(path) : standing_(parameter).unit;
  }

  const SweepFile& file_;
  const std::function<Settable::Checked(const std::string&)>& standing_;
  Sweep& sweep_;
  Diagnostics& diagnostics_;
  std::set<std::string> paths_;
  std::set<std::string> names_;
};

}  // namespace

void read_figures(const SweepFile& file, const std::function<Settable::Checked(const std::string&)>& standing,
                  Sweep& sweep, Diagnostics& diagnostics) {
  FigureReading(file, standing, sweep, diagnostics).run();
}

}  // namespace rastertlm::explore
