#include "src/report/frames_csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/src/report/example_result.h"

namespace rastertlm::report {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream stream(csv);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = fields_of(line);
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> fields = fields_of(line);
    EXPECT_EQ(fields.size(), header.size());
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(fields.size(), header.size()); ++i)
      EXPECT_TRUE(row.emplace(header[i], fields[i]).second) << header[i] << " twice";
  }
  return rows;
}

TEST(FramesCsv, HasARowAFrameWithEveryFigure) {
  const std::vector<Row> rows = rows_of(frames_csv(example_result()));
  ASSERT_EQ(rows.size(), 2U);
  const Row& row = rows[1];
  const std::vector<std::pair<std::string, std::string>> expected{{"frame", "1"},
                                                                  {"animation_frame", "0"},
                                                                  {"first_pixel_ps", "10000000001"},
                                                                  {"drawn_triangles", "885"},
                                                                  {"facing_triangles", "431"},
                                                                  {"snap_fraction_bits", "5"},
                                                                  {"host_flop", "123456"},
                                                                  {"sent_words", "19712"},
                                                                  {"last_animation_frame", "3"},
                                                                  {"line_slack_cycles", "-12"},
                                                                  {"retrace_slack_cycles", "10253"},
                                                                  {"host_slack_us", "1960.98"},
                                                                  {"ideal_max_level", "9"},
                                                                  {"snapped_max_level", "8"},
                                                                  {"true_max_level", "17"},
                                                                  {"true_rmse_level", "0.123457"},
                                                                  {"ideal_psnr_db", "66.3012"},
                                                                  {"ideal_over_one_level_percent", "0.0123457"},
                                                                  {"ideal_missing_pixels", "2"},
                                                                  {"ideal_extra_pixels", "3"},
                                                                  {"ideal_wrong_order_pixels", "2"},
                                                                  {"true_flicker_rms_level", "0.4375"},
                                                                  {"ideal_silhouettes_compared_pixels", "881"},
                                                                  {"snapped_highlights_missing_pixels", "1"},
                                                                  {"true_inside_psnr_db", "60.5"},
                                                                  {"true_inside_ciede2000_p99", "1.222"}};
  for (const auto& [column, value] : expected) {
    ASSERT_TRUE(row.contains(column)) << column;
    EXPECT_EQ(row.at(column), value) << column;
  }
}

TEST(FramesCsv, LeavesEmptyWhatWasNotMeasured) {
  run::Result result = example_result();
  result.frames[0].errors.pop_back();
  result.frames[0].errors[0].psnr_db.reset();
  result.frames[0].host_slack_us.reset();
  const std::vector<Row> rows = rows_of(frames_csv(result));
  EXPECT_EQ(rows[0].at("host_slack_us"), "");
  EXPECT_EQ(rows[0].at("true_max_level"), "");
  EXPECT_EQ(rows[0].at("true_highlights_rmse_level"), "");
  EXPECT_EQ(rows[0].at("ideal_flip_mean"), "");
  EXPECT_EQ(rows[0].at("ideal_psnr_db"), "");
  EXPECT_EQ(rows[1].at("true_max_level"), "17");
}

TEST(FramesCsv, HasNoErrorColumnsWithoutReference) {
  run::Result result = example_result();
  for (run::FrameFigures& frame : result.frames) frame.errors.clear();
  EXPECT_EQ(frames_csv(result).find("level"), std::string::npos);
}

}  // namespace
}  // namespace rastertlm::report
