// A store's sweep as a table.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <unordered_map>

#include "src/base/errors.h"
#include "src/explore/constraint.h"
#include "src/explore/figures.h"
#include "src/explore/store.h"
#include "src/report/figure_path.h"

namespace rastertlm::explore {
namespace {

class Reading {
 public:
  Reading(Store& store, Database& database) : store_(store), database_(database) {}

  SweepTable run() {
    Statement sweep(database_, "SELECT id, name, question, baseline FROM sweep ORDER BY entered DESC LIMIT 1");
    if (!sweep.step()) throw InputError(Diagnostic{database_.file(), 0, "", "the store holds no sweep yet"});
    id_ = sweep.integer(0);
    table_.name = sweep.text(1);
    table_.question = sweep.text(2);
    if (!sweep.is_null(3)) table_.baseline = static_cast<std::size_t>(sweep.integer(3));
    axes();
    objectives();
    rows();
    return std::move(table_);
  }

 private:
  void axes() {
    Statement axis(database_, "SELECT path, unit, given FROM axis WHERE sweep = ? ORDER BY position");
    axis.bind(1, id_);
    while (axis.step()) table_.axes.push_back({axis.text(0), axis.text(1), {}, {}, axis.integer(2) != 0});
    Statement choice(database_, "SELECT axis, text, curve FROM choice WHERE sweep = ? ORDER BY axis, position");
    choice.bind(1, id_);
    while (choice.step()) {
      Axis& own = table_.axes.at(static_cast<std::size_t>(choice.integer(0)));
      own.values.push_back(choice.text(1));
      if (!choice.text(2).empty()) own.curves.push_back(choice.text(2));
    }
  }

  void objectives() {
    Statement objective(database_,
                        "SELECT path, unit, sense, name, logarithmic FROM objective WHERE sweep = ? ORDER BY position");
    objective.bind(1, id_);
    while (objective.step()) {
      const Sense sense = objective.text(2) == "maximise" ? Sense::maximise : Sense::minimise;
      table_.objectives.push_back(
          {objective.text(0), objective.text(1), sense, objective.text(3), objective.integer(4) != 0});
    }
    Statement column(database_, "SELECT path, unit, name FROM further WHERE sweep = ? ORDER BY position");
    column.bind(1, id_);
    while (column.step()) table_.further.push_back({column.text(0), column.text(1), column.text(2)});
    const std::string report = store_.any_report();
    if (!report.empty()) {
      const report::Figures figures(report, database_.file());
      const auto add_unit = [&](auto& one) {
        if (one.unit.empty() && parameter_of(one.path).empty()) one.unit = figures.unit(one.path);
      };
      std::ranges::for_each(table_.objectives, add_unit);
      std::ranges::for_each(table_.further, add_unit);
    }
    Statement condition(database_, "SELECT text FROM condition WHERE sweep = ? ORDER BY position");
    condition.bind(1, id_);
    while (condition.step()) {
      table_.constraints.push_back(condition.text(0));
      const auto parsed = parse_constraint(condition.text(0));
      if (const auto* constraint = std::get_if<Constraint>(&parsed)) constraints_.push_back(*constraint);
    }
  }

  void rows() {
    Statement point(
        database_,
        "SELECT number, choices, result.id, state, error, config_digest, picture, scene_digest FROM point LEFT JOIN "
        "result ON result.id = point.result WHERE sweep = ? ORDER BY number");
    point.bind(1, id_);
    while (point.step()) {
      Row row;
      row.number = static_cast<std::uint64_t>(point.integer(0));
      row.values = choices(point.text(1));
      row.figures.resize(table_.objectives.size());
      row.further.resize(table_.further.size());
      if (!point.is_null(2)) {
        row.state = point.text(3) == "failed" ? State::failed : State::done;
        row.error = point.text(4);
        row.config_digest = point.text(5);
        row.scene_digest = point.text(7);
        if (row.state == State::done) fill(point.integer(2), row);
        row.thumbnail = picture(point.text(6));
      }
      row.allowed = row.allowed && row.state == State::done;
      table_.rows.push_back(std::move(row));
    }
  }

  static std::vector<std::size_t> choices(const std::string& text) {
    std::vector<std::size_t> choices;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
      std::size_t choice = 0;
      const auto [next, error] = std::from_chars(at, end, choice);
      if (error != std::errc()) break;
      choices.push_back(choice);
      at = next < end ? next + 1 : end;
    }
    return choices;
  }

  void fill(std::int64_t result, Row& row) {
    for (std::size_t i = 0; i < table_.objectives.size(); ++i)
      row.figures[i] = figure(result, table_.objectives[i].path);
    for (std::size_t i = 0; i < table_.further.size(); ++i) row.further[i] = figure(result, table_.further[i].path);
    row.allowed = std::all_of(constraints_.begin(), constraints_.end(),
                              [&](const Constraint& one) { return meets(one, figure(result, one.path)); });
  }

  std::optional<double> figure(std::int64_t result, const std::string& path) {
    if (figure_.bind(1, result).bind(2, path).step()) {
      const std::optional<double> value = figure_.is_null(0) ? std::nullopt : std::optional(figure_.real(0));
      figure_.run();
      return value;
    }
    return store_.figure(result, path);
  }

  std::vector<std::uint8_t> picture(const std::string& digest) {
    if (digest.empty()) return {};
    const auto known = pictures_.find(digest);
    if (known != pictures_.end()) return known->second;
    Statement statement(database_, "SELECT png FROM picture WHERE digest = ?");
    const std::string bytes = statement.bind(1, digest).step() ? statement.text(0) : std::string();
    return pictures_[digest] = std::vector<std::uint8_t>(bytes.begin(), bytes.end());
  }

  Store& store_;
  Database& database_;
  std::int64_t id_ = 0;
  SweepTable table_;
  std::vector<Constraint> constraints_;
  std::unordered_map<std::string, std::vector<std::uint8_t>> pictures_;
  Statement figure_{database_, "SELECT value FROM figure WHERE result = ? AND path = ?"};
};

}  // namespace

SweepTable Store::table() {
  database_.execute("BEGIN");  // one view of the store, whoever adds to it meanwhile
  SweepTable table = Reading(*this, database_).run();
  database_.execute("COMMIT");
  return table;
}

}  // namespace rastertlm::explore
