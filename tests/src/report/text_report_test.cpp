#include "src/report/text_report.h"

#include <gtest/gtest.h>

#include <sstream>

#include "src/report/json_report.h"
#include "tests/src/report/example_result.h"

namespace rastertlm::report {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string line_with(const std::string& text, const std::string& part) {
  for (const std::string& line : lines_of(text))
    if (line.find(part) != std::string::npos) return line;
  return "no line with " + part;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(TextReport, FirstLineIsTheAnswer) {
  EXPECT_EQ(lines_of(text_report({example_result(), false})).front(),
            "512x512 at 50 Hz: sustained, 50.0 updates/s; limited by computation unit 3: floating-point operations, 84 "
            "% used; headroom 19 %.");
}

TEST(TextReport, SaysThatAMachineDoesNotSustainItsRate) {
  run::Result result = example_result();
  result.answer.sustained = false;
  result.answer.update_rate_hz = result.answer.frame_rate_hz = 50.0 / 3.0;
  result.answer.headroom = -0.583;
  result.answer.bottleneck.utilisation = 2.4;
  EXPECT_EQ(answer_sentence(result),
            "512x512 at 50 Hz: NOT sustained, 16.7 updates/s on a display that scans out 50.0 times a second; limited "
            "by computation unit "
            "3: floating-point operations, 240 % used; it allows 58 % less than the required rate.");
}

TEST(TextReport, SaysWhatIsBrokenWhereTheDisplayDoesNotWork) {
  run::Result result = example_result();
  result.answer.sustained = false;
  result.answer.display_works = false;
  result.answer.limits = {"adder_delay needs 96 ns and has 60"};
  EXPECT_TRUE(holds(answer_sentence(result), "NOT sustained"));
  EXPECT_TRUE(holds(answer_sentence(result), "The picture is not whole: adder_delay needs 96 ns and has 60."));
}

TEST(TextReport, KnowsAMachineThatNothingLimits) {
  run::Result result = example_result();
  result.answer.bottleneck = {};
  EXPECT_EQ(answer_sentence(result), "512x512 at 50 Hz: sustained, 50.0 updates/s; nothing limits it.");
}

TEST(TextReport, ShowsWhereTheCyclesGo) {
  const std::string text = text_report({example_result(), false});
  const std::string line = line_with(text, "  shading");
  for (const char* part :
       {"16.67 MHz", "666,666", "524,288  78.6 %", "100,000  15.0 %", "42,000", "6.3 %", "378", "0.1 %"})
    EXPECT_TRUE(holds(line, part)) << part << " in " << line;
  EXPECT_TRUE(holds(text, "Where the cycles go (2 displayed frames"));
}

TEST(TextReport, TellsBudgetsThatApplyFromThoseThatDoNot) {
  const std::string text = text_report({example_result(), false});
  const std::string applies = line_with(text, "line_start");
  EXPECT_TRUE(holds(applies, "21        119  cycles   18 %  yes")) << applies;
  const std::string compared = line_with(text, "dot_table.load_68000");
  EXPECT_TRUE(holds(compared, "650.2")) << compared;
  EXPECT_TRUE(holds(compared, "us")) << compared;
  EXPECT_TRUE(holds(compared, "(NO)")) << compared;
}

TEST(TextReport, NamesTheWorstLineAndItsSlack) {
  const std::string text = text_report({example_result(), false});
  const auto expect_parts = [&](const std::string& name, const std::vector<const char*>& parts) {
    const std::string line = line_with(text, name);
    for (const char* part : parts) EXPECT_TRUE(holds(line, part)) << part << " in " << line;
  };
  EXPECT_TRUE(holds(text, "Deadlines\n========="));
  expect_parts("  scan line  ", {"frame 1, line 347", "229,337  229,349", "-12", "-0.72", "table load"});
  expect_parts("  vertical retrace  ", {"frame 1", "10,261        8", "10,253", "615.18", "frame start"});
  expect_parts("  hosts' update  ",
               {"frame 1", "399,999", "39,219", "1960.98", "host cycles of a video frame; it takes 2 video frames"});
  run::Result still = example_result();
  still.deadlines.host.shown = false;
  EXPECT_TRUE(holds(line_with(text_report({still, false}), "  hosts' update  "), "the next one"));
}

TEST(TextReport, SaysThatAScreenIsInterlaced) {
  run::Result result = example_result();
  result.interlaced = true;
  EXPECT_TRUE(answer_sentence(result).starts_with("512x512 interlaced at 50 Hz: sustained"));
  EXPECT_TRUE(holds(text_report({result, false}), "A frame is two fields"));
  EXPECT_FALSE(holds(text_report({example_result(), false}), "A frame is two fields"));
}

TEST(TextReport, ShowsBandwidthMemoryAndLogic) {
  const std::string text = text_report({example_result(), false});
  const std::string link = line_with(text, "boards to decision unit");
  for (const char* part : {"32 bits", "33.33 MHz", "133.3 MB/s", "30 MB/s", "27.34 MB/s", "21 %"})
    EXPECT_TRUE(holds(link, part)) << part << " in " << link;
  EXPECT_TRUE(holds(line_with(text, "specular table"), "512 Kibit")) << line_with(text, "specular table");
  EXPECT_TRUE(holds(line_with(text, "  together"), "512 Kibit"));
  EXPECT_TRUE(holds(line_with(text, "comparators"), "1,023"));
}

TEST(TextReport, GivesTheWorstFrameOfEachErrorFigure) {
  run::Result result = example_result();
  result.frames[1].errors[0].max_level = 12;
  result.frames[1].errors[0].psnr_db = 60.0;
  const std::string text = text_report({result, false});
  EXPECT_TRUE(holds(text, "the worst of 2 frames"));
  const std::string line = line_with(text, "  ideal  ");
  for (const char* part : {"2 px", "3 px", "4 px", "12 levels", "8 levels", "0.123457 levels", "60 dB", "0.0123457 %"})
    EXPECT_TRUE(holds(line, part)) << part << " in " << line;
  EXPECT_TRUE(holds(text, "error_*.png: absolute difference from the ideal picture, times 32"));
}

TEST(TextReport, AnInfinitePsnrInOneFrameDoesNotHideAnother) {
  run::Result result = example_result();
  result.frames[0].errors[0].psnr_db.reset();
  EXPECT_TRUE(holds(line_with(text_report({result, false}), "  ideal  "), "66.3012 dB"));
  result.frames[1].errors[0].psnr_db.reset();
  EXPECT_TRUE(holds(line_with(text_report({result, false}), "  ideal  "), "infinite"));
}

TEST(TextReport, SaysWhereThePicturesDiffer) {
  run::Result result = example_result();
  result.frames[1].errors[0].silhouettes.covered_missing = 4;
  const std::string text = text_report({result, false});
  const std::string worst = text.substr(text.find("Where they differ, the worst of the frames"));
  const std::string mean = text.substr(text.find("Where they differ, the mean of the frames"));
  const std::string line = line_with(worst, "silhouettes");
  for (const char* part :
       {" 881 ", " 4 ", " 0.25 ", " 60.5 ", " 0.75 ", " 0.8125 ", " - ", " 0.0123 ", " 0.0456 ", " 0.111 ", " 1.222"})
    EXPECT_TRUE(holds(line, part)) << part << " in " << line;
  EXPECT_TRUE(holds(line_with(mean, "silhouettes"), " 881.0 ")) << line_with(mean, "silhouettes");
  EXPECT_TRUE(holds(line_with(mean, "silhouettes"), " 2.5 ")) << line_with(mean, "silhouettes");
  EXPECT_TRUE(holds(text, "FLIP (0 .. 1, at 67 pixels a degree)"));
  result.frames.pop_back();
  EXPECT_FALSE(holds(text_report({result, false}), "the mean of the frames"));
  result.flip_pixels_per_degree.reset();
  EXPECT_FALSE(holds(text_report({result, false}), "FLIP"));
}

// Reports of earlier programs have no parts.
TEST(TextReport, SaysNothingOfPartsThatItDoesNotKnow) {
  run::Result result = example_result();
  for (run::FrameFigures& frame : result.frames)
    for (reference::ErrorFigures& e : frame.errors) e.inside = e.silhouettes = e.highlights = {};
  EXPECT_FALSE(holds(text_report({result, false}), "Where they differ"));
}

// A pixel of a solid is not a triangle's.
TEST(TextReport, CountsPixelsOfOtherObjectsWhereThereAreSolids) {
  run::Result result = example_result();
  for (const std::uint64_t solids : {0U, 3U}) {
    result.modelled.solids_made = solids;
    const std::string text = text_report({result, false});
    const std::string header = line_with(text, "  reference  missing");
    EXPECT_EQ(holds(header, "other triangle") && holds(header, "same triangle"), solids == 0) << header;
    EXPECT_EQ(holds(header, "other object") && holds(header, "same object"), solids > 0) << header;
    EXPECT_EQ(holds(text, "extra, other object, and of these"), solids > 0);
  }
}

TEST(TextReport, SaysThatNothingWasMeasured) {
  run::Result result = example_result();
  for (run::FrameFigures& frame : result.frames) frame.errors.clear();
  EXPECT_TRUE(holds(text_report({result, false}), "Not measured (--no-reference)."));
}

TEST(TextReport, SaysWhatWasModelledAndWarns) {
  const std::string text = text_report({example_result(), false});
  EXPECT_TRUE(holds(text, "Object processors: 1,024 in the machine, 896 hold an object, 431 simulated."));
  EXPECT_TRUE(holds(text, "896 made, 16 of them of zero area, 1 without a processor."));
  EXPECT_TRUE(holds(text, "Left out: second light: none in the scene"));
  EXPECT_TRUE(holds(text, "Exact pictures: 6 compared with, 3 of them of a view that was not at hand."));
  EXPECT_TRUE(holds(text, "Nothing moves."));
  EXPECT_TRUE(holds(text, "The host needs 84 % of a frame."));
}

TEST(TextReport, TellsOfTheHostOnlyWhenAsked) {
  EXPECT_FALSE(holds(text_report({example_result(), false}), "The simulation itself"));
  EXPECT_TRUE(holds(text_report({example_result(), true}),
                    "1.25 s, 266,666 simulated pixel clocks a second, 123.5 MB at most."));
  EXPECT_TRUE(holds(text_report({example_result(), true}),
                    "Apart from that: 0.75 s for exact pictures, 0.125 s for the figures of errors."));
}

TEST(TextReport, IsTheSameFromTheResultAsFromItsJson) {
  const Contents contents{example_result(), true};
  const Contents stored = read_json(json_text(contents), "r");
  const std::string text = text_report(stored);
  EXPECT_EQ(text, text_report(read_json(json_text(stored), "r")));
  EXPECT_EQ(text, text_report(contents)) << "no figure of the text has more digits than report.json keeps";
}

TEST(TextReport, HasNoBlanksAtTheEndsOfItsLines) {
  for (const std::string& line : lines_of(text_report({example_result(), true})))
    EXPECT_FALSE(!line.empty() && line.back() == ' ') << line;
}

TEST(TextReport, TellsWhatMadePixelsWrong) {
  EXPECT_FALSE(holds(text_report({example_result(), false}), "What made pixels wrong"));
  const std::string text = text_report({example_result(), false, example_blame()});
  EXPECT_TRUE(holds(text, "5,200 of 52,000 pixels have a level that is not the ideal one.\n"));
  EXPECT_TRUE(holds(text, "all that follows is of the other pixels; RMSE 0.412 levels"));
  const std::string row = line_with(text, "  dot product  ");
  for (const char* cell : {"5,185", "25.0 %", "72.5 %", "-47.5 %", "8.75"}) EXPECT_TRUE(holds(row, cell)) << cell;
  EXPECT_TRUE(holds(text, "8.75 levels at column 17, line 18"));
  EXPECT_TRUE(holds(text, "3 of them show words or tables that are not this pose's"));
}

}  // namespace
}  // namespace rastertlm::report
