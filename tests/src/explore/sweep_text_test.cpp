#include "src/explore/sweep_text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "src/explore/sweep_csv.h"
#include "src/explore/sweep_words.h"
#include "src/explore/table_text.h"
#include "tests/src/explore/table_builder.h"

namespace rastertlm::explore {
namespace {

using Values = std::vector<std::size_t>;
using Fields = std::vector<std::string>;

// Bits and rate of 2, 4 and 8 units on a tree or a pipeline; the rate must be 50 Hz.
SweepTable question_table() {
  SweepTable table;
  table.name = "units";
  table.question = "How few units still show it at 50 Hz?";
  table.axes = {axis_of("host.computation_units", {"2", "4", "8"}),
                axis_of("decision_unit.topology", {"\"tree\"", "\"pipeline\""})};
  table.objectives = {{"memories[all].total_bits", "bits", Sense::minimise},
                      {"answer.frame_rate_hz", "Hz", Sense::maximise}};
  table.constraints = {"answer.frame_rate_hz >= 50"};
  add_grid(table, [](const Values& v) {
    const double units = std::pow(2.0, static_cast<double>(v[0]) + 1.0);
    return Figures{1'000.0 * units + (v[1] == 0 ? 500.0 : 0.0), std::min(60.0, 12.5 * units)};
  });
  for (Row& row : table.rows) row.allowed = *row.figures[1] >= 50.0;
  table.baseline = 4;  // 8 units, tree
  return table;
}

bool has_line(const std::string& text, const std::string& line) {
  std::istringstream lines(text);
  for (std::string own; std::getline(lines, own);)
    if (own == line) return true;
  return false;
}

// The words of the line that begins with these words, after them.
Fields words_after(const std::string& text, const std::string& start) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos || line.compare(first, start.size(), start) != 0) continue;
    std::istringstream rest(line.substr(first + start.size()));
    Fields words;
    for (std::string word; rest >> word;) words.push_back(word);
    return words;
  }
  return {};
}

TEST(SweepText, AnswersTheQuestionInALine) {
  const SweepTable table = question_table();
  const std::string text = answer_section(table, find_front(table));
  EXPECT_TRUE(has_line(text, "Question: How few units still show it at 50 Hz?")) << text;
  EXPECT_TRUE(has_line(text,
                       "Answer: computation_units = 4, topology = \"pipeline\" (point 3): all total_bits 4,000, "
                       "the least of 4 points that meet answer.frame_rate_hz >= 50, with frame_rate_hz 50 Hz."))
      << text;
  EXPECT_TRUE(has_line(text,
                       "Against the baseline (point 4): all total_bits -4,500 (-53 %); frame_rate_hz -10 "
                       "Hz (-17 %)."))
      << text;
  EXPECT_TRUE(has_line(text, "6 points: 2 on the front, 2 beaten by it, 2 against the constraints.")) << text;
}

TEST(SweepText, SaysThatNothingMeetsTheConstraints) {
  SweepTable table = question_table();
  for (Row& row : table.rows) row.allowed = false;
  table.rows[0].state = State::failed;
  table.rows[0].error = "line one\nline two";
  const std::string text = sweep_text(table);
  EXPECT_TRUE(has_line(text, "Answer: none yet: no point meets answer.frame_rate_hz >= 50.")) << text;
  EXPECT_TRUE(has_line(text, "6 points: 0 on the front, 0 beaten by it, 5 against the constraints, 1 failed.")) << text;
  EXPECT_NE(text.find("Empty: no point is done and meets the constraints."), std::string::npos);
  EXPECT_EQ(words_after(text, "1      0  "), (Fields{"line", "one", "line", "two"})) << text;
}

TEST(SweepText, ListsTheFrontAndWhatItBeats) {
  SweepTable table = question_table();
  table.rows[2].figures = table.rows[3].figures;  // a tree of the same figures
  const Front front = find_front(table);
  const std::string text = front_section(table, front, 10);
  // Point, units, topology, bits, rate, how many are equal to it; the least bits first.
  EXPECT_EQ(words_after(text, "2  "), (Fields{"4", "\"tree\"", "4,000", "50", "1", "point"})) << text;
  EXPECT_EQ(words_after(text, "5  "), (Fields{"8", "\"pipeline\"", "8,000", "60"})) << text;
  EXPECT_LT(text.find("4,000"), text.find("8,000"));
  const std::string beaten = beaten_section(table, front, 10);
  EXPECT_EQ(words_after(beaten, "4  "), (Fields{"8", "\"tree\"", "8,500", "60", "5"})) << beaten;
  EXPECT_TRUE(has_line(beaten, "  The baseline (point 4) is beaten by point 5: all total_bits -500 (-5.9 %)."))
      << beaten;
  EXPECT_TRUE(has_line(front_section(table, front, 1), "  1 more; --rows says how many are listed, --csv lists all."));
}

// A unit of two letters is part of many a word.
TEST(SweepText, LeavesAUnitOutWhereItIsAWordOfTheName) {
  EXPECT_TRUE(says_unit("set_up_us", "us"));
  EXPECT_TRUE(says_unit("triangles in", "triangles"));
  EXPECT_TRUE(says_unit("used, us", "us"));
  for (const char* name : {"bus", "used", "busy cycles", "time", ""}) {
    EXPECT_FALSE(says_unit(name, "us")) << name;
    EXPECT_EQ(unit_text("us", name), " us") << name;
  }
  SweepTable table;
  table.axes = {axis_of("host.kind", {"1", "2"})};
  table.objectives = {{"budgets[bus.frame].used", "us", Sense::minimise, "time used by the bus"}};
  add_grid(table, [](const Values& v) { return Figures{10.0 + static_cast<double>(v[0])}; });
  const std::string text = front_section(table, find_front(table), 10);
  EXPECT_EQ(words_after(text, "point"),
            (Fields{"kind", "time", "used", "by", "the", "bus,", "us", "equal", "to", "it"}))
      << text;
}

// Two screens that are given: each has its answer, its front and its points of the beaten.
SweepTable given_table() {
  SweepTable table;
  table.axes = {axis_of("method", {"flat", "smooth", "slow"}), axis_of("screen", {"small", "large"})};
  table.axes[1].given = true;
  table.objectives = {{"budgets[frame].used", "us", Sense::minimise, "time", true},
                      {"images[0].error.rmse_level", "levels", Sense::minimise}};
  table.further = {{"images[0].drawn_pieces", "triangles", "triangles out"}, {"answer.headroom", "fraction", ""}};
  add_grid(table, [](const Values& v) {
    const double size = v[1] == 0 ? 1.0 : 4.0;
    return Figures{10.0 * size * (1.0 + static_cast<double>(v[0])), v[0] == 1 ? 2.0 : 8.0};
  });
  for (Row& row : table.rows) row.further = {100.0 + static_cast<double>(row.number), std::nullopt};
  table.baseline = 1;  // flat, large
  return table;
}

TEST(SweepText, AnswersInTheBaselinesCase) {
  const SweepTable table = given_table();
  const Front front = find_front(table);
  EXPECT_EQ(front.rows, (std::vector<std::size_t>{0, 1, 2, 3}));
  const std::string text = answer_section(table, front);
  EXPECT_TRUE(has_line(text,
                       "Answer, given screen = large: method = flat (point 1): time 40 us, the least of 3 points, "
                       "with rmse_level 8 levels."))
      << text;
  EXPECT_TRUE(has_line(text, "6 points of 2 cases: 4 on the front of their cases, 2 beaten by it.")) << text;
}

TEST(SweepText, ShowsFurtherFiguresCaseByCase) {
  const SweepTable table = given_table();
  const Front front = find_front(table);
  const std::string text = front_section(table, front, 10);
  EXPECT_EQ(words_after(text, "point"),
            (Fields{"method", "time,", "us", "rmse_level", "triangles", "out", "headroom", "equal", "to", "it"}))
      << text;
  EXPECT_EQ(words_after(text, "3  "), (Fields{"smooth", "80", "2", "103", "-"})) << text;
  // The baseline's case comes first; each has a table of its own.
  EXPECT_TRUE(has_line(text, "  Given screen = large:")) << text;
  EXPECT_LT(text.find("Given screen = large:"), text.find("smooth"));
  EXPECT_LT(text.rfind("103"), text.find("Given screen = small:"));
  EXPECT_LT(text.find("Given screen = small:"), text.find("100"));
  EXPECT_EQ(text.find("Given screen = large:"), text.rfind("Given screen = large:"));
  EXPECT_EQ(words_after(beaten_section(table, front, 1), "5  "), (Fields{"slow", "120", "8", "105", "-", "1"}));
  EXPECT_EQ(front_section(question_table(), find_front(question_table()), 9).find("Given"), std::string::npos);
}

// Without a baseline the first point of the front says which case is meant; where its case has no front, too.
TEST(SweepText, AnswersInACaseThatHasAFront) {
  SweepTable table = given_table();
  for (const std::size_t r : {1, 3, 5}) table.rows[r].allowed = false;
  const Front front = find_front(table);
  EXPECT_EQ(answer_row(table, front), 0U);
  table.baseline.reset();
  EXPECT_EQ(answer_row(table, front), 0U);
}

TEST(SweepText, OrdersParametersByHowFarTheyMove) {
  const SweepTable table = question_table();
  const std::string text = sensitivity_section(table, find_sensitivity(table));
  // Means of 2,250, 4,250 and 8,250 bits, the mean of all is 4,916 2/3; the topology moves 500 of it. Their variances
  // are 6,222,222 and 250 squared, of 6,284,722.
  EXPECT_EQ(words_after(text, "computation_units"), (Fields{"6,000", "122", "%", "2", "8", "99", "%"})) << text;
  EXPECT_EQ(words_after(text, "topology"), (Fields{"500", "10", "%", "\"pipeline\"", "\"tree\"", "0.99", "%"})) << text;
  EXPECT_LT(text.find("computation_units"), text.find("topology"));
}

TEST(SweepText, SaysThatTheBaselineBreaksAConstraint) {
  SweepTable table = question_table();
  ASSERT_EQ(answer_section(table, find_front(table)).find("which does not meet"), std::string::npos);
  table.constraints = {"answer.sustained"};
  table.rows.at(*table.baseline).allowed = false;
  EXPECT_NE(answer_section(table, find_front(table)).find("(point 4, which does not meet answer.sustained): "),
            std::string::npos);
}

// -1 to 2 around a mean of 0.01 is no 30,000 % of anything; 1, 2 and 6 move by 5, of a mean of 3.
TEST(SweepText, LeavesOutPartsOfAMeanThatCancels) {
  const auto cells = [](const Figures& figures) {
    SweepTable table;
    table.axes = {axis_of("host.computation_units", {"1", "2", "4"})};
    table.objectives = {objective_of("answer.headroom", Sense::maximise)};
    for (std::size_t v = 0; v < figures.size(); ++v) add_row(table, {v}, {figures[v]});
    table.baseline = 0;  // a grid of one parameter, no way around it
    const std::string text = sensitivity_section(table, find_sensitivity(table));
    EXPECT_NE(text.find("differences between its 3 points"), std::string::npos) << text;
    return words_after(text, "computation_units");
  };
  EXPECT_EQ(cells({-1.0, -0.97, 2.0}), (Fields{"3", "1", "4", "100", "%"}));
  EXPECT_EQ(cells({1.0, 2.0, 6.0}), (Fields{"5", "167", "%", "1", "4", "100", "%"}));
}

TEST(SweepText, TellsTheBestSteps) {
  const SweepTable table = question_table();
  const std::string text = what_if_section(table, find_what_if(table, 4), 0.0);
  EXPECT_EQ(words_after(text, "least all total_bits  whatever the others do"),
            (Fields{"computation_units", "8", "->", "4", "-4,000", "(-47", "%)", "-10", "(-17", "%)"}))
      << text;
  EXPECT_EQ(words_after(text, "least all total_bits  frame_rate_hz no worse  "),
            (Fields{"topology", "\"tree\"", "->", "\"pipeline\"", "-500", "(-5.9", "%)", "0"}))
      << text;
  EXPECT_EQ(words_after(text, "most frame_rate_hz    whatever the others do"), (Fields{"none"})) << text;
}

TEST(SweepWords, ShortensPathsToWhatTellsThemApart) {
  EXPECT_EQ(short_names({"host.units", "answer.rate_hz", "budgets[dot.words].used", "units[a.b].busy", "units[c].busy",
                         "images[0].ideal.psnr", "images[1].ideal.psnr", "same", "x.same", "sum(memories[].total_bits)",
                         "max(images[].error.rmse)", "max(images[].true.rmse)", "span_unit.count",
                         "machine.span_unit.count"}),
            (Fields{"units", "rate_hz", "dot.words used", "a.b busy", "c busy", "images[0].ideal.psnr",
                    "images[1].ideal.psnr", "same", "x.same", "sum total_bits", "max error.rmse", "max true.rmse",
                    "span_unit.count", "machine.span_unit.count"}));
}

// A reader of RFC 4180.
std::vector<Fields> parsed(const std::string& text) {
  std::vector<Fields> rows(1, Fields(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += c;
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      rows.back().emplace_back();
    } else if (c == '\n' && !quoted) {
      rows.emplace_back(1);
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

RC_GTEST_PROP(SweepCsv, IsReadAgain, ()) {
  SweepTable table = question_table();
  table.rows[1].state = State::failed;
  table.rows[1].error = *rc::gen::container<std::string>(rc::gen::element('a', ',', '"', '\n', ' ', ';', '\r'));
  table.axes[1].values[1] = *rc::gen::container<std::string>(rc::gen::element('b', ',', '"', '[', ' '));
  table.rows[2].figures[0] = *rc::gen::inRange(-1'000'000, 1'000'000) / 8.0;
  const Front front = find_front(table);
  const std::vector<Fields> rows = parsed(table_csv(table, front));
  RC_ASSERT(rows.size() == table.rows.size() + 1);
  RC_ASSERT(rows[0] == (Fields{"point", "state", "allowed", "baseline", "front", "beaten_by", "host.computation_units",
                               "decision_unit.topology", "memories[all].total_bits (bits)", "answer.frame_rate_hz (Hz)",
                               "config_digest", "scene_digest", "error"}));
  std::ranges::replace(table.rows[1].error, '\n', ' ');
  RC_ASSERT(rows[2].back() == table.rows[1].error);
  RC_ASSERT(rows[2][7] == table.axes[1].values[1]);
  RC_ASSERT(std::stod(rows[3][8]) == *table.rows[2].figures[0]);
  RC_ASSERT(rows[3][4] == (front.has(2) ? "1" : "0"));
  RC_ASSERT(rows[1][4].empty());
  for (const Fields& row : rows) RC_ASSERT(row.size() == rows[0].size());
}

TEST(SweepCsv, HasFurtherFiguresBehindTheObjectives) {
  const SweepTable table = given_table();
  const std::vector<Fields> rows = parsed(table_csv(table, find_front(table)));
  EXPECT_EQ(rows[0][10], "images[0].drawn_pieces (triangles)");
  EXPECT_EQ(rows[0][11], "answer.headroom (fraction)");
  EXPECT_EQ(rows[4][10], "103");
  EXPECT_EQ(rows[4][11], "");
  for (const Fields& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_NE(table_text(table, 10).find("answer.headroom (fraction)"), std::string::npos);
}

TEST(SweepCsv, HasEffectsAndMoves) {
  SweepTable table = question_table();
  const std::vector<Fields> effects = parsed(sensitivity_csv(table, find_sensitivity(table)));
  ASSERT_EQ(effects.size(), 1U + 2 * (3 + 2));
  const Fields& two_units = effects[1];
  EXPECT_EQ((Fields{two_units[0], two_units[2], two_units[3], two_units[4], two_units[5], two_units[7]}),
            (Fields{"memories[all].total_bits", "host.computation_units", "2", "2", "by_value", "8"}));
  EXPECT_NEAR(std::stod(two_units[6]), -6000.0, 1e-6);
  table.rows[5].figures[1].reset();
  const std::vector<Fields> moves = parsed(what_if_csv(table, find_what_if(table, 4)));
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_EQ(moves[1], (Fields{"host.computation_units", "8", "4", "known", "2", "-4000", "-10"}));
  EXPECT_EQ(moves[2], (Fields{"decision_unit.topology", "\"tree\"", "\"pipeline\"", "known", "5", "-500", ""}));
}

}  // namespace
}  // namespace rastertlm::explore
