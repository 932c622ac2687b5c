#include "src/explore/sweep_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "src/explore/page_assets.h"
#include "src/explore/sensitivity.h"
#include "src/explore/sweep_text.h"
#include "src/explore/sweep_words.h"
#include "src/report/page_document.h"

namespace rastertlm::explore {
namespace {

using report::json_string;

constexpr std::size_t kDigestDigits = 12;  // enough to find a point in the store

// `most` of the rows, evenly spread: the first and the last among them.
std::vector<std::size_t> spread(const std::vector<std::size_t>& rows, std::size_t most) {
  if (rows.size() <= most) return rows;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < most; ++k) chosen.push_back(rows[k * (rows.size() - 1) / (most - 1)]);
  return chosen;
}

// "[a,b]" of what `text` makes of each element.
template <typename Elements, typename Text>
std::string json_list(const Elements& elements, const Text& text) {
  std::string list = "[";
  for (const auto& element : elements) {
    if (list.size() > 1) list += ',';
    list += text(element);
  }
  list += ']';
  return list;
}
std::string json_texts(const std::vector<std::string>& texts) { return json_list(texts, json_string); }

// JSON has no infinity.
std::string figure_json(const std::optional<double>& figure) {
  if (!figure || std::isnan(*figure)) return "null";
  if (std::isinf(*figure)) return *figure > 0.0 ? R"("inf")" : R"("-inf")";
  return fmt::format("{}", *figure);
}

const char* state_text(State state) {
  switch (state) {
    case State::waiting:
      return "waiting";
    case State::done:
      return "done";
    case State::failed:
      return "failed";
  }
  return "";
}

std::string axis_json(const Axis& axis, const std::string& name) {
  return fmt::format(R"({{"path":{},"name":{},"unit":{},"values":{},"curves":{},"given":{}}})", json_string(axis.path),
                     json_string(name), json_string(axis.unit), json_texts(axis.values), json_texts(axis.curves),
                     axis.given);
}

std::string objective_json(const Objective& objective, const std::string& name) {
  return fmt::format(R"({{"path":{},"name":{},"unit":{},"most":{},"logarithmic":{}}})", json_string(objective.path),
                     json_string(name), json_string(objective.unit), objective.sense == Sense::maximise,
                     objective.logarithmic);
}

std::string further_json(const FurtherFigure& figure, const std::string& name) {
  return fmt::format(R"({{"path":{},"name":{},"unit":{}}})", json_string(figure.path), json_string(name),
                     json_string(figure.unit));
}

std::string row_json(const SweepTable& table, const Front& front, std::size_t r) {
  const Row& row = table.rows[r];
  std::vector<std::optional<double>> figures = row.figures;
  figures.insert(figures.end(), row.further.begin(), row.further.end());
  std::string json =
      fmt::format(R"({{"number":{},"state":"{}","values":{},"figures":{})", row.number, state_text(row.state),
                  json_list(row.values, [](auto v) { return std::to_string(v); }), json_list(figures, figure_json));
  if (!row.config_digest.empty()) json += R"(,"digest":)" + json_string(row.config_digest.substr(0, kDigestDigits));
  if (!row.scene_digest.empty()) json += R"(,"scene":)" + json_string(row.scene_digest.substr(0, kDigestDigits));
  if (!row.allowed) json += R"(,"allowed":false)";
  if (!row.error.empty()) json += R"(,"error":)" + json_string(row.error);
  if (front.has(r)) json += R"(,"front":true)";
  if (const auto by = front.beaten_by[r]) json += fmt::format(R"(,"beaten_by":{})", table.rows[*by].number);
  return json + '}';
}

std::vector<std::size_t> numbers_below(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

// Many points show the same: each picture is embedded once.
struct Thumbnails {
  Thumbnails(const SweepTable& table, const std::vector<std::size_t>& rows) {
    std::map<std::string, std::size_t> known;
    for (const std::size_t r : rows) {
      const std::string png = report::base64(table.rows[r].thumbnail);
      const auto [found, is_new] = known.emplace(png, pictures.size());
      if (is_new) pictures.push_back(png);
      numbers.emplace_back(r, found->second);
    }
  }
  std::vector<std::string> pictures;
  std::vector<std::pair<std::size_t, std::size_t>> numbers;  // row and picture
};

std::string data_json(const SweepTable& table, const Front& front, const std::vector<std::string>& notes) {
  const Names names(table);
  const Thumbnails thumbnails(table, rows_with_thumbnail(table, front));
  return fmt::format(
      R"({{"axes":{},"objectives":{},"further":{},"constraints":{},"rows":{},"baseline":{},"pictures":{},"thumbnails":{},"notes":{},"sensitivity":{}}})",
      json_list(numbers_below(table.axes.size()), [&](auto a) { return axis_json(table.axes[a], names.axes[a]); }),
      json_list(numbers_below(table.objectives.size()),
                [&](auto o) { return objective_json(table.objectives[o], names.objectives[o]); }),
      json_list(numbers_below(table.further.size()),
                [&](auto k) { return further_json(table.further[k], names.further[k]); }),
      json_texts(table.constraints),
      json_list(numbers_below(table.rows.size()), [&](auto r) { return row_json(table, front, r); }),
      table.baseline ? std::to_string(*table.baseline) : "null", json_texts(thumbnails.pictures),
      json_list(
          thumbnails.numbers,
          [](const auto& number) { return fmt::format(R"({{"row":{},"picture":{}}})", number.first, number.second); }),
      json_texts(notes), json_string(sensitivity_section(table, find_sensitivity(table))));
}

// The lines of answer_section without the question, which is a heading here: the answer, and what belongs to it.
std::vector<std::string> answer_lines(const SweepTable& table, const Front& front) {
  const std::string label = "Answer";  // ": ..." or ", given ..."
  std::istringstream text(answer_section(table, front));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || line.starts_with("Question: ")) continue;
    lines.push_back(line.starts_with(label) ? line.substr(label.size() + 2) : line);
  }
  if (lines.empty()) lines.emplace_back();
  return lines;
}

}  // namespace

std::vector<std::size_t> rows_with_thumbnail(const SweepTable& table, const Front& front) {
  std::vector<std::size_t> wanted;
  std::vector<std::size_t> others;
  if (table.baseline && !table.rows[*table.baseline].thumbnail.empty()) wanted.push_back(*table.baseline);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    if (table.rows[r].thumbnail.empty() || r == table.baseline) continue;
    if (front.has(r))
      wanted.push_back(r);
    else
      others.push_back(r);
  }
  others = spread(others, kMostOtherThumbnails);
  wanted.insert(wanted.end(), others.begin(), others.end());
  std::size_t bytes = 0;
  std::vector<std::size_t> rows;
  std::set<std::string> embedded;
  for (const std::size_t r : wanted) {
    const std::string png = report::base64(table.rows[r].thumbnail);
    if (embedded.insert(png).second) bytes += png.size();
    if (bytes > kMostThumbnailBytes) break;
    rows.push_back(r);
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::string sweep_page(const SweepTable& table) {
  const Front front = find_front(table);
  std::vector<std::string> notes = answer_lines(table, front);
  const std::string answer = notes.front();
  notes.erase(notes.begin());
  const std::string heading =
      fmt::format("rastertlm explore: {}{}", table.name, table.question.empty() ? "" : ": " + table.question);
  return report::page_text({"rastertlm explore: " + table.name,
                            heading,
                            answer,
                            sweep_text(table),
                            data_json(table, front, notes),
                            {kSweepScript}});
}

}  // namespace rastertlm::explore
