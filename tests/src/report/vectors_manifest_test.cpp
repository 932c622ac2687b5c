#include "src/report/vectors_manifest.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

namespace rastertlm::report {
namespace {

using Json = nlohmann::json;

VectorsManifest example() {
  VectorsManifest manifest;
  manifest.platform = "imogene";
  manifest.config_digest = "c";
  manifest.scene_digest = "s";
  manifest.frame = 3;
  manifest.animation_frame = 2;
  manifest.machine.word_bits = 24;
  manifest.machine.edges = "scaled";
  manifest.machine.edge_fraction_bits = -1;
  manifest.timing.pixel_clock_ns = 39.7217;
  manifest.timing.first_pixel_rgb_cycle = 10'401;
  manifest.files = {{"a.hex", 21, "00ff"}, {"b.csv", 0, "11"}};
  return manifest;
}

void count_keys(const Json& json, std::map<std::string, int>& keys) {
  for (const auto& [key, value] : json.items()) {
    ++keys[key];
    if (value.is_object()) count_keys(value, keys);
  }
}

TEST(VectorsManifest, HoldsWhatItIsGiven) {
  const Json json = Json::parse(vectors_manifest_text(example()));
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["program"], "rastertlm");
  EXPECT_EQ(json["kind"], "vectors");
  EXPECT_EQ(json["frame"], 3);
  EXPECT_EQ(json["animation_frame"], 2);
  EXPECT_EQ(json["machine"]["word_bits"], 24);
  EXPECT_EQ(json["machine"]["edge_fraction_bits"], -1);
  EXPECT_EQ(json["timing"]["pixel_clock_ns"], 39.7217);
  EXPECT_EQ(json["timing"]["first_pixel_rgb_cycle"], 10'401);
  ASSERT_EQ(json["files"].size(), 2U);
  EXPECT_EQ(json["files"][0]["name"], "a.hex");
  EXPECT_EQ(json["files"][0]["bytes"], 21);
  EXPECT_EQ(json["files"][1]["sha256"], "11");
}

// A test bench without a JSON reader looks for a key by its name.
TEST(VectorsManifest, UsesNoKeyTwice) {
  std::map<std::string, int> keys;
  count_keys(Json::parse(vectors_manifest_text(example())), keys);
  EXPECT_GT(keys.size(), 50U);
  for (const auto& [key, times] : keys) EXPECT_EQ(times, 1) << key;
}

TEST(VectorsManifest, IsKnownFromOthers) {
  EXPECT_TRUE(is_vectors_manifest(vectors_manifest_text(example())));
  EXPECT_TRUE(is_vectors_manifest(R"({"schema": 9, "program": "rastertlm", "kind": "vectors"})")) << "a later schema";
  for (const char* other :
       {"", "[]", "3", "{", "null", R"({"schema": 1})", R"({"name": "an app", "manifest_version": 3})",
        R"({"schema": 1, "program": "rastertlm"})", R"({"schema": 1, "program": "other", "kind": "vectors"})",
        R"({"schema": "1", "program": "rastertlm", "kind": "vectors"})"})
    EXPECT_FALSE(is_vectors_manifest(other)) << other;
}

}  // namespace
}  // namespace rastertlm::report
