#include "src/report/json_report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "src/base/errors.h"
#include "src/report/statistics.h"
#include "tests/src/report/example_result.h"

namespace rastertlm::report {
namespace {

using Json = nlohmann::ordered_json;

Json example_json(bool host = true) { return Json::parse(json_text({example_result(), host, example_blame()})); }

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

// Every path that leads to a value, elements of lists as "[]".
void add_paths(const Json& json, const std::string& path, std::set<std::string>& paths) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items())
      add_paths(value, path.empty() ? key : fmt::format("{}.{}", path, key), paths);
  } else if (json.is_array()) {
    for (const Json& element : json) add_paths(element, path + "[]", paths);
  } else {
    paths.insert(path);
  }
}

TEST(JsonReport, KeepsTheKeysOfSchema1InTheirOrder) {
  const Json json = example_json();
  EXPECT_EQ(keys_of(json),
            (std::vector<std::string>{
                "schema", "platform", "config_digest", "scene_digest", "frames",   "video", "answer",
                "units",  "budgets",  "deadlines",     "links",        "memories", "logic", "flip_pixels_per_degree",
                "images", "errors",   "modelled",      "blame",        "warnings", "host"}));
  const auto has = [](const Json& object, const std::vector<std::string>& keys) {
    for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
  };
  has(json["answer"], {"frame_rate_hz", "display_rate_hz", "update_rate_hz", "required_rate_hz", "sustained",
                       "headroom", "bottleneck", "latency_frames", "initial_load_frames", "limits"});
  has(json["answer"]["bottleneck"], {"unit", "resource", "utilisation"});
  has(json["units"][0], {"name", "clock_hz", "cycles", "busy", "starved", "blocked", "idle"});
  has(json["budgets"][0], {"name", "used", "available", "unit", "fits", "applies", "source"});
  has(json["deadlines"], {"retrace", "lines", "host"});
  has(json["deadlines"]["lines"], {"worst", "slack_cycles"});
  has(json["deadlines"]["lines"]["worst"], {"frame", "line", "slack_cycles", "needs"});
  EXPECT_EQ(json["deadlines"]["lines"]["slack_cycles"], Json::parse("[10363, 110, -12]"));
  EXPECT_EQ(json["deadlines"]["lines"]["worst"]["slack_cycles"], -12);
  EXPECT_EQ(json["deadlines"]["host"]["slack_us"], 1960.98);
  has(json["links"][0], {"name", "bits", "clock_hz", "bytes", "peak_bytes_per_s", "achieved_bytes_per_s",
                         "active_bytes_per_s", "utilisation"});
  has(json["memories"][0], {"name", "instances", "words", "bits_per_word", "total_bits"});
  has(json["images"][0], {"frame", "file", "error", "errors"});
  has(json["images"][0]["error"], {"reference", "covered_missing", "covered_extra", "max_level", "rmse_level",
                                   "psnr_db", "over_one_level_percent"});
  has(json["images"][0]["error"]["silhouettes"], {"compared", "rmse_level", "edge_jump_rms_level", "flip_mean"});
  has(json["errors"][0], {"reference", "frames", "worst", "mean"});
  has(json["errors"][0]["mean"]["highlights"], {"compared", "rmse_level", "flicker_rms_level", "ciede2000_p99"});
  has(json["modelled"]["object_processors"], {"available", "used", "instantiated"});
  has(json["modelled"]["lines"], {"total", "evaluated"});
  has(json["modelled"]["coefficients"], {"total", "sent"});
  has(json["modelled"], {"left_out"});
}

TEST(JsonReport, HoldsWhatTheResultSays) {
  const Json json = example_json();
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["frames"], 2);
  EXPECT_EQ(json["answer"]["update_rate_hz"], 50.00005);
  EXPECT_EQ(json["answer"]["bottleneck"]["unit"], "computation unit 3");
  EXPECT_EQ(json["links"][0]["bytes"], 18'446'744'073'709'551'615U) << "counts are exact";
  EXPECT_EQ(json["units"][0]["clock_hz"], 16666666.7) << "nine significant digits";
  EXPECT_EQ(json["memories"][0]["total_bits"], 16 * 4096 * 8);
  EXPECT_EQ(json["images"][1]["file"], "frame_0001.png");
  EXPECT_EQ(json["images"][0]["animation_frame"], -1);
  EXPECT_EQ(json["images"][0]["error"]["reference"], "ideal");
  EXPECT_EQ(json["images"][0]["error"], json["images"][0]["errors"][0]);
  EXPECT_EQ(json["images"][0]["error"]["rmse_level"], 0.123457) << "six significant digits";
  EXPECT_EQ(json["images"][0]["error"]["over_one_level_percent"], 0.0123457);
}

// The worst and the mean of both frames.
TEST(JsonReport, HoldsTheErrorsOfAllFrames) {
  run::Result result = example_result();
  result.frames[1].errors[0].rmse_level = 0.223456789;
  const Json json = Json::parse(json_text({result, false}));
  ASSERT_EQ(json["errors"].size(), 3U);
  EXPECT_EQ(json["errors"][0]["reference"], "ideal");
  EXPECT_EQ(json["errors"][0]["frames"], 2);
  EXPECT_EQ(json["errors"][0]["worst"]["rmse_level"], 0.223457);
  EXPECT_EQ(json["errors"][0]["mean"]["rmse_level"], 0.173457);
  EXPECT_EQ(json["errors"][0]["worst"]["wrong_object"], 4);
  EXPECT_EQ(json["errors"][0]["worst"]["highlights"]["compared"], 120);
}

// Reports of earlier programs had neither parts nor later figures.
TEST(JsonReport, ReadsReportsThatHadNotEveryKey) {
  Json json = example_json();
  json.erase("flip_pixels_per_degree");
  json.erase("errors");
  json["modelled"].erase("exact_pictures");
  for (const char* key : {"exact_seconds", "figures_seconds"}) json["host"].erase(key);
  for (Json& image : json["images"])
    for (Json& errors : image["errors"])
      for (const char* key :
           {"over_two_levels_percent", "wrong_order", "edges_measured", "edge_jump_rms_level", "edge_jump_max_level",
            "still_pixels", "flicker_rms_level", "flicker_max_level", "flip_mean", "flip_p95", "ciede2000_mean",
            "ciede2000_p99", "inside", "silhouettes", "highlights"})
        ASSERT_EQ(errors.erase(key), 1U) << key;
  const run::Result result = read_json(json.dump(), "r").result;
  EXPECT_EQ(result.frames[1].errors[2].max_level, 17);
  EXPECT_EQ(result.frames[1].errors[2].silhouettes.compared, 0U);
  EXPECT_FALSE(result.frames[1].errors[2].flicker_rms_level.has_value());
  json["images"][0]["errors"][0].erase("rmse_level");
  EXPECT_THROW(read_json(json.dump(), "r"), InputError) << "which they had";
}

TEST(JsonReport, NamesTheIdealReferenceWhereverItStands) {
  run::Result result = example_result();
  std::swap(result.frames[0].errors[0], result.frames[0].errors[2]);
  const Json json = Json::parse(json_text({result, false}));
  EXPECT_EQ(json["images"][0]["error"]["max_level"], 9);
}

TEST(JsonReport, GivesAnInfinitePsnrAsNull) {
  run::Result result = example_result();
  result.frames[0].errors[0].psnr_db.reset();
  const std::string text = json_text({result, false});
  EXPECT_TRUE(Json::parse(text)["images"][0]["error"]["psnr_db"].is_null());
  EXPECT_FALSE(read_json(text, "r").result.frames[0].errors[0].psnr_db.has_value());
}

TEST(JsonReport, GivesWhatIsNotFiniteAsNull) {
  run::Result result = example_result();
  result.answer.headroom = std::numeric_limits<double>::infinity();
  const std::string text = json_text({result, false});
  EXPECT_TRUE(Json::parse(text)["answer"]["headroom"].is_null());
  EXPECT_EQ(read_json(text, "r").result.answer.headroom, std::numeric_limits<double>::infinity());
}

TEST(JsonReport, HasNoErrorWithoutReference) {
  run::Result result = example_result();
  for (run::FrameFigures& frame : result.frames) frame.errors.clear();
  const Json json = Json::parse(json_text({result, false}));
  EXPECT_TRUE(json["images"][0]["error"].is_null());
  EXPECT_TRUE(json["images"][0]["errors"].empty());
  EXPECT_EQ(json["images"][0]["error_file"], "");
}

TEST(JsonReport, TellsOfTheHostOnlyWhenAsked) {
  EXPECT_TRUE(example_json(true).contains("host"));
  EXPECT_FALSE(example_json(false).contains("host"));
  EXPECT_EQ(json_text({example_result(), false}).find("wall"), std::string::npos);
}

TEST(JsonReport, HasTheBlameOnlyWhereItWasAsked) {
  EXPECT_FALSE(Json::parse(json_text({example_result(), false})).contains("blame"));
  const std::string text = json_text({example_result(), false, example_blame()});
  const Json blame = Json::parse(text)["blame"];
  EXPECT_EQ(blame["legend"][2]["colour"], "#d53c00");
  EXPECT_EQ(blame["frames"][0]["file"], "blame_0001.png");
  EXPECT_EQ(blame["frames"][0]["steps"][1]["interaction_share"], -0.475);
  const Contents read = read_json(text, "report.json");
  EXPECT_EQ(json_text(read), text);
  EXPECT_EQ(read.blame.frames.at(0).steps.at(1).blamed_pixels, 5'185U);
}

TEST(JsonReport, ReadsBackWhatItWrote) {
  for (const bool host : {false, true}) {
    const std::string text = json_text({example_result(), host});
    const Contents contents = read_json(text, "report.json");
    EXPECT_EQ(contents.host_figures, host);
    EXPECT_EQ(json_text(contents), text);
    EXPECT_EQ(contents.result.frames[1].errors[2].reference, "true");
    EXPECT_EQ(contents.result.modelled.fragments_hidden, 9'231U);
    EXPECT_EQ(contents.result.answer.limits, example_result().answer.limits);
    EXPECT_EQ(contents.result.deadlines.lines.slack_cycles, example_result().deadlines.lines.slack_cycles);
  }
}

TEST(JsonReport, EveryKeyIsDescribedAndEveryDescriptionIsAKey) {
  run::Result result = example_result();
  std::set<std::string> written;
  add_paths(example_json(), "", written);
  for (const char* platform : {"quadratic", "adaptive"}) {
    result.platform = platform;
    add_paths(Json::parse(json_text({result, true})), "", written);
  }
  written.insert("images[].error");  // null without reference: described by itself
  std::set<std::string> described;
  for (const parameter::Statistic& s : statistics()) {
    EXPECT_TRUE(described.insert(s.name).second) << s.name << " twice";
    EXPECT_FALSE(s.description.empty()) << s.name;
  }
  EXPECT_EQ(written, described);
}

TEST(JsonReport, NamesTheUnitOfWhatHasOneInItsName) {
  const std::vector<std::pair<std::string, std::string>> endings{
      {"_hz", "Hz"},     {"_bytes_per_s", "bytes/s"}, {"_db", "dB"},     {"_percent", "%"},    {"_ps", "ps"},
      {"_bits", "bits"}, {"_frames", "frames"},       {"_seconds", "s"}, {"_pixels", "pixels"}};
  for (const parameter::Statistic& s : statistics())
    for (const auto& [ending, unit] : endings)
      if (s.name.size() > ending.size() && s.name.ends_with(ending)) {
        EXPECT_EQ(s.unit, unit) << s.name;
      }
}

std::string message_of(const std::string& text) {
  try {
    read_json(text, "DIR/report.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(JsonReport, NamesEverythingThatIsWrongInAFile) {
  Json json = example_json();
  json["answer"].erase("sustained");
  json["units"][0]["busy"] = -1;
  json["links"] = 3;
  json["deadlines"]["lines"]["slack_cycles"][1] = 1.5;
  const std::string message = message_of(json.dump());
  EXPECT_NE(message.find("DIR/report.json: answer.sustained: is missing"), std::string::npos) << message;
  EXPECT_NE(message.find("units[0].busy: is not an integer"), std::string::npos) << message;
  EXPECT_NE(message.find("links: is not a list"), std::string::npos) << message;
  EXPECT_NE(message.find("deadlines.lines.slack_cycles: is not a list of integers"), std::string::npos) << message;
}

TEST(JsonReport, RefusesAnotherSchemaAndWhatIsNoReport) {
  Json json = example_json();
  json["schema"] = 2;
  EXPECT_NE(message_of(json.dump()).find("2 is not the schema that this program reads"), std::string::npos);
  for (const char* text : {"", "{", "[]", "{}", "3", R"({"schema": 1})", R"({"schema": "1", "platform": "imogene"})"}) {
    EXPECT_NE(message_of(text).find("is not a report.json of rastertlm"), std::string::npos) << text;
    EXPECT_FALSE(is_report(text)) << text;
  }
  EXPECT_TRUE(is_report(R"({"schema": 7, "platform": "later"})"));
}

TEST(JsonReport, PassesOverKeysOfLaterPrograms) {
  Json json = example_json();
  json["answer"]["carbon_g"] = 3;
  EXPECT_EQ(read_json(json.dump(), "r").result.answer.latency_frames, 2U);
}

}  // namespace
}  // namespace rastertlm::report
