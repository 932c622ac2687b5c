#include "src/explore/sweep_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "src/explore/sweep_cases.h"
#include "src/explore/sweep_words.h"
#include "src/report/number_text.h"
#include "src/report/text_table.h"

namespace rastertlm::explore {
namespace {

using report::Align;
using report::counted;
using report::grouped;
using report::TextTable;

// "frame_rate_hz 50 Hz".
std::string named_figure(const SweepTable& table, const Names& names, const Row& row, std::size_t objective) {
  return fmt::format("{} {}{}", names.objectives[objective], shown_figure(row.figures[objective]),
                     unit_text(table.objectives[objective].unit, names.objectives[objective]));
}

// Below 0 where `a` comes before `b` by its figures, in the objectives' order.
int order_of(const SweepTable& table, const Row& a, const Row& b) {
  for (std::size_t o = 0; o < table.objectives.size(); ++o) {
    const int way = compare_figures(a.figures[o], b.figures[o], table.objectives[o].sense);
    if (way != 0) return way;
  }
  return 0;
}

bool is_equal(const SweepTable& table, const Row& a, const Row& b) {
  return order_of(table, a, b) == 0 && case_of(table, a) == case_of(table, b);
}

std::string rest_line(std::size_t shown, std::size_t all) {
  return shown < all ? fmt::format("{}{} more; --rows says how many are listed, --csv lists all.\n", kIndent,
                                   grouped(all - shown))
                     : "";
}

std::string constraints_text(const SweepTable& table) {
  std::string text;
  for (const std::string& constraint : table.constraints) text += (text.empty() ? "" : "; ") + in_one_line(constraint);
  return text;
}

// Which of several constraints a point breaks the table does not know.
std::string broken_text(const SweepTable& table, const Row& row) {
  if (row.allowed) return "";
  return fmt::format(", which does not meet {}{}", table.constraints.size() > 1 ? "all of " : "",
                     constraints_text(table));
}

std::string counts_sentence(const SweepTable& table, const Front& front) {
  std::size_t failed = 0;
  std::size_t waiting = 0;
  std::size_t breaking = 0;
  for (const Row& row : table.rows) {
    failed += row.state == State::failed ? 1 : 0;
    waiting += row.state == State::waiting ? 1 : 0;
    breaking += row.state == State::done && !row.allowed ? 1 : 0;
  }
  std::set<std::vector<std::size_t>> cases;
  for (const Row& row : table.rows) cases.insert(case_of(table, row));
  std::string text =
      fmt::format("{}{}: {} on the front{}, {} beaten by it", counted(table.rows.size(), "point", "points"),
                  cases.size() > 1 ? fmt::format(" of {} cases", grouped(cases.size())) : "",
                  grouped(front.rows.size()), cases.size() > 1 ? " of their cases" : "",
                  grouped(table.rows.size() - failed - waiting - breaking - front.rows.size()));
  if (breaking > 0) text += fmt::format(", {} against the constraints", grouped(breaking));
  if (failed > 0) text += fmt::format(", {} failed", grouped(failed));
  if (waiting > 0) text += fmt::format(", {} not run yet", grouped(waiting));
  return text + ".\n";
}

// "bits -500 (-12 %)" for each objective that differs, `row` against `other`.
std::string difference_text(const SweepTable& table, const Names& names, const Row& row, const Row& other) {
  std::string text;
  for (std::size_t o = 0; o < table.objectives.size(); ++o) {
    const auto& own = row.figures[o];
    const auto& before = other.figures[o];
    if (compare_figures(own, before, Sense::minimise) == 0) continue;
    if (!text.empty()) text += "; ";
    text += names.objectives[o] + ' ';
    if (!own || !before) {
      text += shown_figure(own) + " for " + shown_figure(before);
    } else {
      text += change_text(*own - *before, before, unit_text(table.objectives[o].unit, names.objectives[o]));
    }
  }
  return text.empty() ? "equal in all objectives" : text;
}

}  // namespace

std::optional<std::size_t> answer_row(const SweepTable& table, const Front& front) {
  if (front.rows.empty()) return {};
  const std::vector<std::size_t> asked = asked_case(table, front);
  std::optional<std::size_t> answer;
  for (const std::size_t r : front.rows) {
    if (case_of(table, table.rows[r]) != asked) continue;
    if (!answer || order_of(table, table.rows[r], table.rows[*answer]) < 0) answer = r;
  }
  return answer;
}

std::string answer_section(const SweepTable& table, const Front& front) {
  const Names names(table);
  const std::string question = table.question.empty() ? "" : "Question: " + in_one_line(table.question) + '\n';
  const std::string met = table.constraints.empty() ? "" : " that meet " + constraints_text(table);
  const auto answer = answer_row(table, front);
  if (!answer) {
    const bool any_done = std::ranges::any_of(table.rows, [](const Row& row) { return row.state == State::done; });
    const std::string none = !any_done ? "no point is done" : "no point meets " + constraints_text(table);
    return question + "Answer: none yet: " + none + ".\n" + counts_sentence(table, front);
  }
  const Row& row = table.rows[*answer];
  std::string text = question + "Answer";
  if (has_cases(table)) text += ", given " + case_text(table, names, row);
  text += fmt::format(": {} (point {})", choice_text(table, names, row), row.number);
  if (!table.objectives.empty()) {
    const Objective& first = table.objectives.front();
    std::size_t compared = 0;
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      compared += front.compared[r] && case_of(table, table.rows[r]) == case_of(table, row) ? 1 : 0;
    text += fmt::format(": {}, the {} of {}{}", named_figure(table, names, row, 0), wanted_text(first.sense),
                        counted(compared, "point", "points"), met);
    for (std::size_t o = 1; o < table.objectives.size(); ++o)
      text += (o == 1 ? ", with " : ", ") + named_figure(table, names, row, o);
  }
  text += ".\n";
  if (table.baseline && *table.baseline == *answer) text += "That is the baseline.\n";
  if (table.baseline && *table.baseline != *answer && table.rows[*table.baseline].state == State::done)
    text += fmt::format("Against the baseline (point {}{}): {}.\n", table.rows[*table.baseline].number,
                        broken_text(table, table.rows[*table.baseline]),
                        difference_text(table, names, row, table.rows[*table.baseline]));
  return text + counts_sentence(table, front);
}

std::string objectives_section(const SweepTable& table, const Front& front) {
  if (table.objectives.empty()) return "";
  const Names names(table);
  TextTable text({{"objective"},
                  {"path"},
                  {"unit"},
                  {"wanted"},
                  {"best", Align::right},
                  {"worst", Align::right},
                  {"baseline", Align::right}},
                 kIndent);
  for (std::size_t o = 0; o < table.objectives.size(); ++o) {
    const Objective& objective = table.objectives[o];
    const Row* best = nullptr;
    const Row* worst = nullptr;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      if (!front.compared[r] || !table.rows[r].figures[o]) continue;
      const Row* row = &table.rows[r];
      if (best == nullptr || compare_figures(row->figures[o], best->figures[o], objective.sense) < 0) best = row;
      if (worst == nullptr || compare_figures(row->figures[o], worst->figures[o], objective.sense) > 0) worst = row;
    }
    const auto text_of = [&](const Row* row) { return row == nullptr ? "-" : shown_figure(row->figures[o]); };
    text.row({names.objectives[o], in_one_line(objective.path), in_one_line(objective.unit),
              wanted_text(objective.sense), text_of(best), text_of(worst),
              text_of(table.baseline ? &table.rows.at(*table.baseline) : nullptr)});
  }
  return heading("Objectives") + text.text() + kIndent +
         "Best and worst: of the points that are done and meet the constraints.\n";
}

std::string front_section(const SweepTable& table, const Front& front, std::size_t most_rows) {
  const Names names(table);
  std::string text = heading("Front: what no other point beats");
  if (front.rows.empty()) return text + kIndent + "Empty: no point is done and meets the constraints.\n";
  std::vector<std::size_t> order = front.rows;
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return order_of(table, table.rows[a], table.rows[b]) < 0; });
  sort_by_case(table, front, order);
  CaseTables rows(table, names, "equal to it");
  std::size_t shown = 0;
  std::size_t covered = 0;
  for (std::size_t i = 0; i < order.size() && shown < most_rows; ++shown) {
    std::size_t end = i + 1;
    while (end < order.size() && is_equal(table, table.rows[order[i]], table.rows[order[end]])) ++end;
    rows.add(table.rows[order[i]], end - i > 1 ? counted(end - i - 1, "point", "points") : "");
    covered += end - i;
    i = end;
  }
  return text + rows.text() + rest_line(covered, order.size());
}

std::string beaten_section(const SweepTable& table, const Front& front, std::size_t most_rows) {
  const Names names(table);
  CaseTables rows(table, names, "beaten by");
  std::vector<std::size_t> beaten;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (front.beaten_by[r]) beaten.push_back(r);
  sort_by_case(table, front, beaten);
  const std::size_t all = beaten.size();
  const std::size_t shown = std::min(all, most_rows);
  for (std::size_t i = 0; i < shown; ++i)
    rows.add(table.rows[beaten[i]], std::to_string(table.rows[*front.beaten_by[beaten[i]]].number));
  std::string text;
  if (table.baseline && front.compared[*table.baseline]) {
    const Row& base = table.rows[*table.baseline];
    const auto by = front.beaten_by[*table.baseline];
    text += by ? fmt::format("{}The baseline (point {}) is beaten by point {}: {}.\n", kIndent, base.number,
                             table.rows[*by].number, difference_text(table, names, table.rows[*by], base))
               : fmt::format("{}The baseline (point {}) is on the front.\n", kIndent, base.number);
  }
  if (all > 0) text += rows.text() + rest_line(shown, all);
  return text.empty() ? "" : heading("What the front beats") + text;
}

std::string failures_section(const SweepTable& table, std::size_t most_rows) {
  std::map<std::string, std::vector<const Row*>> errors;
  for (const Row& row : table.rows)
    if (row.state == State::failed) errors[in_one_line(row.error)].push_back(&row);
  if (errors.empty()) return "";
  TextTable rows({{"points", Align::right}, {"first", Align::right}, {"error"}}, kIndent);
  std::vector<const std::pair<const std::string, std::vector<const Row*>>*> order;
  order.reserve(errors.size());
  for (const auto& entry : errors) order.push_back(&entry);
  std::ranges::stable_sort(order, [](const auto* a, const auto* b) { return a->second.size() > b->second.size(); });
  const std::size_t shown = std::min(most_rows, order.size());
  for (std::size_t i = 0; i < shown; ++i)
    rows.row({grouped(order[i]->second.size()), std::to_string(order[i]->second.front()->number), order[i]->first});
  return heading("Points that failed") + rows.text() + rest_line(shown, order.size());
}

std::optional<std::size_t> start_of_steps(const SweepTable& table, const Front& front,
                                          const std::optional<std::size_t>& chosen) {
  if (chosen) return chosen;
  if (table.baseline && table.rows.at(*table.baseline).state == State::done) return table.baseline;
  return answer_row(table, front);
}

std::string sweep_text(const SweepTable& table, const TextOptions& options) {
  const Front front = find_front(table);
  std::string text = answer_section(table, front) + objectives_section(table, front) +
                     front_section(table, front, options.most_rows) + beaten_section(table, front, options.most_rows) +
                     failures_section(table, options.most_rows) + sensitivity_section(table, find_sensitivity(table));
  const std::optional<std::size_t> from = start_of_steps(table, front, options.from);
  if (from) text += what_if_section(table, find_what_if(table, *from, options.tolerance), options.tolerance);
  return text;
}

}  // namespace rastertlm::explore
