#include "src/report/merged_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>

namespace rastertlm::report {
namespace {

struct Name {
  std::string before;
  std::uint64_t number = 0;
  std::string after;
  bool numbered = false;
};

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

Name split(const std::string& text) {
  const auto begin = std::find_if(text.begin(), text.end(), is_digit);
  if (begin == text.end()) return {text, 0, "", false};
  const auto end = std::find_if_not(begin, text.end(), is_digit);
  return {{text.begin(), begin}, std::strtoull(std::string(begin, end).c_str(), nullptr, 10), {end, text.end()}, true};
}

struct Run {
  Name first;
  std::uint64_t last = 0;
  std::vector<std::string> cells;

  bool is_of_kind(const Run& other) const {
    return first.numbered && other.first.numbered && first.before == other.first.before &&
           first.after == other.first.after;
  }
  bool is_continued_by(const Run& next) const {
    return is_of_kind(next) && next.first.number == last + 1 &&
           std::equal(cells.begin() + 1, cells.end(), next.cells.begin() + 1);
  }
  std::uint64_t size() const { return last - first.number + 1; }
};

std::vector<Run> runs_of(const std::vector<std::vector<std::string>>& rows) {
  std::vector<Run> runs;
  for (const auto& cells : rows) {
    const Name name = split(cells.at(0));
    Run run{name, name.number, cells};
    if (!runs.empty() && runs.back().is_continued_by(run))
      runs.back().last = run.last;
    else
      runs.push_back(std::move(run));
  }
  for (Run& run : runs)
    if (run.size() > 1)
      run.cells[0] = fmt::format("{}{}-{}{}", run.first.before, run.first.number, run.last, run.first.after);
  return runs;
}

}  // namespace

std::vector<std::vector<std::string>> merged_rows(const std::vector<std::vector<std::string>>& rows) {
  const std::vector<Run> runs = runs_of(rows);
  std::vector<std::vector<std::string>> merged;
  for (std::size_t begin = 0; begin < runs.size();) {
    std::size_t end = begin + 1;
    while (end < runs.size() && runs[begin].is_of_kind(runs[end])) ++end;
    // A row that says "1 more" takes as much room as that one.
    const std::size_t shown = end - begin > kMostRowsOfAKind + 1 ? begin + kMostRowsOfAKind : end;
    for (std::size_t i = begin; i < shown; ++i) merged.push_back(runs[i].cells);
    if (shown < end) {
      std::uint64_t more = 0;
      for (std::size_t i = shown; i < end; ++i) more += runs[i].size();
      std::vector<std::string> cells(runs[begin].cells.size());
      cells[0] = fmt::format("... {} more, in report.json", more);
      merged.push_back(std::move(cells));
    }
    begin = end;
  }
  return merged;
}

}  // namespace rastertlm::report
