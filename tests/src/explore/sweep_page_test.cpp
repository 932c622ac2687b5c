// Does the page of a sweep hold its points, front and pictures, whatever its names are; and does a browser show them?
#include "src/explore/sweep_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/src/explore/table_builder.h"
#include "tests/support/browser.h"

namespace rastertlm::explore {
namespace {

using Values = std::vector<std::size_t>;

constexpr std::size_t kMostBytes = 5'000'000;
constexpr const char* kScript = "</script><script>window.intruder = 1</script>";

// A PNG of 8 x 8 grey pixels, written by hand with Python's zlib, as large as a noisy one of 64 x 64 by zeros after its
// end.
// `number` makes it unlike others.
std::vector<std::uint8_t> thumbnail(std::size_t bytes, std::uint64_t number) {
  static constexpr std::uint8_t kPng[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
      0x00, 0x00, 0x08, 0x00, 0x00, 0x00, 0x08, 0x08, 0x00, 0x00, 0x00, 0x00, 0xe1, 0x64, 0xe1, 0x57, 0x00,
      0x00, 0x00, 0x2a, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x60, 0x10, 0x50, 0x30, 0x70, 0x08, 0x48,
      0x28, 0x80, 0xd1, 0x0d, 0x0c, 0x50, 0x7a, 0x02, 0x03, 0x94, 0x5e, 0xc0, 0x00, 0xa5, 0x37, 0x30, 0x40,
      0xe9, 0x03, 0x0c, 0x50, 0xfa, 0x02, 0x03, 0x94, 0x7e, 0x00, 0x00, 0x1e, 0x75, 0x1c, 0x01, 0x9f, 0x44,
      0x8f, 0x6d, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  std::vector<std::uint8_t> png(std::max(std::size(kPng) + sizeof number, bytes), 0);
  std::copy(std::begin(kPng), std::end(kPng), png.begin());
  for (std::size_t k = 0; k < sizeof number; ++k) png[png.size() - 1 - k] = static_cast<std::uint8_t>(number >> 8 * k);
  return png;
}

// 1,000 points: units, word length and topology; bits, error and rate. Some fail, some break the constraint.
SweepTable thousand() {
  SweepTable table;
  table.name = kScript;
  table.question = "How few bits still show it?";
  table.axes = {numbered_axis("host.computation_units", 10), numbered_axis("object_processor.word_bits", 25),
                axis_of("decision_unit.topology", {"\"tree\"", "\"pipeline\"", "\"<b>\"", kScript})};
  table.objectives = {{"memories[all].total_bits", "bits", Sense::minimise},
                      {"images[0].error.psnr_db", "dB", Sense::maximise},
                      {"answer.frame_rate_hz", "Hz", Sense::maximise}};
  table.constraints = {"answer.frame_rate_hz >= 12"};
  add_grid(table, [](const Values& v) {
    const double units = static_cast<double>(v[0] + 1);
    const double bits = static_cast<double>(v[1] + 1);
    return Figures{1'000.0 * units * bits + 5'000.0 * static_cast<double>(v[2]), 6.02 * bits,
                   std::min(60.0, 6.0 * units * (v[2] % 2 == 0 ? 1.0 : 1.1))};
  });
  for (Row& row : table.rows) {
    if (row.number % 97 == 5) {
      row.state = State::failed;
      row.error = kScript;
      row.figures.assign(3, std::nullopt);
    } else if (row.number % 31 == 8) {
      row.figures[1] = std::nullopt;
    }
    row.allowed = row.state == State::done && *row.figures[2] >= 12.0;
    if (row.state == State::done) row.thumbnail = thumbnail(9'000, row.number);
  }
  table.baseline = 999;
  return table;
}

TEST(SweepPage, PicturesOfBaselineFrontAndSomeOthers) {
  SweepTable table = thousand();
  for (Row& row : table.rows)
    if (row.state == State::done) row.thumbnail = thumbnail(300, row.number);
  const Front front = find_front(table);
  const std::vector<std::size_t> rows = rows_with_thumbnail(table, front);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_EQ(std::adjacent_find(rows.begin(), rows.end()), rows.end());
  EXPECT_EQ(std::count(rows.begin(), rows.end(), *table.baseline), 1);
  for (const std::size_t r : front.rows) EXPECT_EQ(std::count(rows.begin(), rows.end(), r), 1) << r;
  const bool beaten_baseline = !front.has(*table.baseline);
  EXPECT_EQ(rows.size(), front.rows.size() + (beaten_baseline ? 1 : 0) + kMostOtherThumbnails);
}

TEST(SweepPage, PicturesHaveALimitInBytes) {
  SweepTable table = thousand();
  for (Row& row : table.rows)
    if (row.state == State::done) row.thumbnail = thumbnail(120'000, row.number);
  const std::vector<std::size_t> rows = rows_with_thumbnail(table, find_front(table));
  EXPECT_EQ(rows.size(), kMostThumbnailBytes / 160'000) << "four characters for three bytes";
  EXPECT_EQ(std::count(rows.begin(), rows.end(), *table.baseline), 1) << "the baseline comes first";
}

TEST(SweepPage, EqualPicturesAreThereOnce) {
  SweepTable table = thousand();
  for (Row& row : table.rows)
    if (row.state == State::done) row.thumbnail = thumbnail(120'000, row.number % 2);
  EXPECT_GT(rows_with_thumbnail(table, find_front(table)).size(), kMostOtherThumbnails);
  EXPECT_LT(sweep_page(table).size(), 1'000'000U);
}

TEST(SweepPage, IsTheSameTwiceAndHasNoScriptsOfOthers) {
  const SweepTable table = thousand();
  const std::string page = sweep_page(table);
  EXPECT_EQ(sweep_page(table), page);
  EXPECT_LT(page.size(), kMostBytes);
  EXPECT_EQ(page.find("<script>window.intruder"), std::string::npos);
  EXPECT_NE(page.find("window.intruder"), std::string::npos);
}

TEST(SweepPage, OfASweepWithoutPoints) {
  const std::string page = sweep_page({});
  EXPECT_NE(page.find("</html>"), std::string::npos);
}

TEST(SweepPage, InABrowser) {
  const std::filesystem::path folder = std::filesystem::path(RASTERTLM_ARTEFACTS);
  std::filesystem::create_directories(folder);
  const std::string page = folder / "sweep.html";
  std::ofstream(page, std::ios::binary) << sweep_page(thousand());
  const test::PageOutcome outcome = test::check_page("check_sweep_page.py", {page, folder, "sweep"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
}

// Methods with thresholds, each a curve, on three screens that are given; of one no figure is there.
SweepTable curves() {
  SweepTable table;
  table.name = "methods";
  table.question = "Which method?";
  table.axes = {axis_of("method", {"flat", "cut 4", "cut 2", "cut 1", "exact"}),
                axis_of("screen", {"small", "large", "none"})};
  table.axes[0].curves = {"flat", "cut", "cut", "cut", "exact"};
  table.axes[1].given = true;
  table.objectives = {{"budgets[frame].used", "us", Sense::minimise, "time", true},
                      {"images[0].error.rmse_level", "levels", Sense::minimise, "error", true}};
  table.further = {{"images[0].drawn_pieces", "triangles", ""}};
  add_grid(table, [](const Values& v) {
    static constexpr double kTimes[] = {10, 20, 50, 700, 300};
    static constexpr double kErrors[] = {12, 6, 2, 1, 0.3};
    if (v[1] == 2) return Figures{std::nullopt, std::nullopt};
    return Figures{kTimes[v[0]] * static_cast<double>(1 + v[1]), kErrors[v[0]]};
  });
  for (Row& row : table.rows) row.further = {static_cast<double>(100 + row.number)};
  table.baseline = 1;  // flat, large
  return table;
}

TEST(SweepPage, OfCurvesInABrowser) {
  const std::filesystem::path folder = std::filesystem::path(RASTERTLM_ARTEFACTS);
  std::filesystem::create_directories(folder);
  const std::string page = folder / "curves.html";
  std::ofstream(page, std::ios::binary) << sweep_page(curves());
  const test::PageOutcome outcome = test::check_page("check_curves_page.py", {page, folder, "curves"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
}

}  // namespace
}  // namespace rastertlm::explore
