// Figures of a report.json by path, on a report that is written here by hand.
#include "src/report/figure_path.h"

#include <gmock/gmock.h>

#include <limits>

#include "src/base/errors.h"

namespace rastertlm::report {
namespace {

using testing::HasSubstr;

const char* const kReport = R"({"schema": 1, "platform": "imogene",
  "answer": {"frame_rate_hz": 25.5, "sustained": true, "headroom": null, "bottleneck": {"unit": "host"}},
  "budgets": [{"name": "dot_table.words", "used": 3, "unit": "words"}, {"name": "line [0]", "used": 7, "unit": "us"}],
  "logic": [{"name": "a", "count": 2, "unit": "pins"}, {"name": "b", "count": 5, "unit": "adders"},
            {"name": "c", "count": 40, "unit": "pins"}],
  "deadlines": {"lines": {"slack_cycles": [4, -2, 9]}},
  "images": [{"error": {"psnr_db": 40.0}, "errors": [{"reference": "ideal", "max_level": 2}, {"reference": "true", "max_level": 8}]},
             {"error": {"psnr_db": null}, "errors": [{"reference": "ideal", "max_level": 3}]}],
  "memories": []})";

Figures figures() { return {kReport, "report.json"}; }

TEST(FigurePath, FindsKeysElementsAndFolds) {
  const Figures f = figures();
  EXPECT_EQ(f.value("answer.frame_rate_hz"), 25.5);
  EXPECT_EQ(f.value("answer.sustained"), 1.0);
  EXPECT_EQ(f.value("answer.headroom"), std::nullopt);
  EXPECT_EQ(f.value("budgets[dot_table.words].used"), 3.0);
  EXPECT_EQ(f.value("budgets[line [0]].used"), 7.0);
  EXPECT_EQ(f.value("budgets[1].used"), 7.0);
  EXPECT_EQ(f.value("budgets[2].used"), std::nullopt);
  EXPECT_EQ(f.value("sum(logic[unit=pins].count)"), 42.0);
  EXPECT_EQ(f.value("max(logic[].count)"), 40.0);
  EXPECT_EQ(f.value("min(deadlines.lines.slack_cycles[])"), -2.0);
  EXPECT_EQ(f.value("mean(deadlines.lines.slack_cycles[])"), 11.0 / 3.0);
  EXPECT_EQ(f.value("images[1].errors[ideal].max_level"), 3.0);
  EXPECT_EQ(f.value("max(images[].errors[].max_level)"), 8.0);
  EXPECT_EQ(f.value("sum(memories[].total_bits)"), 0.0);
}

TEST(FigurePath, OfWhatIsNullTheLeastIsStillKnownButNoSum) {
  EXPECT_EQ(figures().value("min(images[].error.psnr_db)"), 40.0);
  EXPECT_EQ(figures().value("sum(images[].error.psnr_db)"), std::nullopt);
  EXPECT_EQ(figures().value("images[1].error.psnr_db"), std::nullopt);
}

TEST(FigurePath, KnowsUnits) {
  EXPECT_EQ(figure_unit("answer.frame_rate_hz"), "Hz");
  EXPECT_EQ(figure_unit("sum(memories[].total_bits)"), "bits");
  EXPECT_EQ(figure_unit("budgets[line_start].used"), "");
  EXPECT_EQ(figures().unit("budgets[line [0]].used"), "us");
  EXPECT_EQ(figures().unit("sum(logic[unit=pins].count)"), "pins");
}

TEST(FigurePath, SaysWhatIsWrongBeforeThereIsAReport) {
  EXPECT_EQ(figure_mistake("answer.headroom"), "");
  EXPECT_EQ(figure_mistake("images[0].errors[ideal].rmse_level"), "");
  EXPECT_EQ(figure_mistake("max(images[].error.rmse_level)"), "");
  EXPECT_THAT(figure_mistake("answer.hedroom"), HasSubstr("nearest: 'answer.headroom'"));
  EXPECT_THAT(figure_mistake("budget[line_start].used"), HasSubstr("nearest: 'budgets[].used'"));
  EXPECT_THAT(figure_mistake("memories[].total_bits"), HasSubstr("write sum(memories[].total_bits)"));
  EXPECT_THAT(figure_mistake("host.wall_seconds"), HasSubstr("unknown figure"));  // not of the model
  for (const char* text : {"", ".", "answer.", "budgets[a.used", "top(memories[].total_bits)", "answer..headroom"})
    EXPECT_THAT(figure_mistake(text), HasSubstr("unknown figure")) << text;
}

TEST(FigurePath, SaysWhatAReportLacks) {
  const Figures f = figures();
  EXPECT_EQ(f.absent("answer.headroom"), "");  // null, but there
  EXPECT_EQ(f.absent("images[1].error.psnr_db"), "");
  EXPECT_EQ(f.absent("sum(memories[].total_bits)"), "");
  EXPECT_THAT(f.absent("budgets[dot_table.word].used"), HasSubstr("nearest: 'dot_table.words'"));
  EXPECT_THAT(f.absent("answer.bottleneck.unit"), HasSubstr("is no number"));
  EXPECT_THAT(f.absent("modelled.fragments.kept"), HasSubstr("no 'modelled'"));
  EXPECT_THROW(Figures("not json", "x.json"), InputError);
}

// As compare() has it: a picture without a difference, one without a common pixel, one that lacks a pixel, one apart.
constexpr const char* kPictures = R"({"images": [
  {"error": {"compared": 9, "covered_missing": 0, "covered_extra": 0, "psnr_db": null, "psnr_outline_db": null}},
  {"error": {"compared": 0, "covered_missing": 0, "covered_extra": 0, "psnr_db": null, "psnr_outline_db": null}},
  {"error": {"compared": 0, "covered_missing": 1, "covered_extra": 0, "psnr_db": null, "psnr_outline_db": 20.5}},
  {"host_slack_us": null,
   "error": {"compared": 9, "covered_missing": 0, "covered_extra": 1, "psnr_db": 45.5, "psnr_outline_db": 30.25}}]})";

TEST(FigurePath, TakesThePsnrOfEqualPicturesAsInfinite) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Figures figures(kPictures, "report.json");
  EXPECT_EQ(figures.value("images[0].error.psnr_db"), kInfinite);
  EXPECT_EQ(figures.value("images[0].error.psnr_outline_db"), kInfinite);
  EXPECT_EQ(figures.value("images[1].error.psnr_db"), std::nullopt);
  EXPECT_EQ(figures.value("images[1].error.psnr_outline_db"), std::nullopt);
  EXPECT_EQ(figures.value("images[2].error.psnr_db"), std::nullopt);
  EXPECT_EQ(figures.value("images[2].error.psnr_outline_db"), 20.5);
  EXPECT_EQ(figures.value("images[3].error.psnr_db"), 45.5);
  EXPECT_EQ(figures.value("images[3].host_slack_us"), std::nullopt);
  EXPECT_EQ(figures.value("min(images[].error.psnr_db)"), 45.5);
  EXPECT_EQ(figures.value("max(images[].error.psnr_db)"), kInfinite);
}

}  // namespace
}  // namespace rastertlm::report
