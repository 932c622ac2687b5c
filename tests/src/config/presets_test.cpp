#include "src/config/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "src/config/document.h"

namespace rastertlm::config {
namespace {

TEST(Presets, FindsByTableAndName) {
  const Presets presets({{"host", {{"b", "x = 1\n"}, {"a", "x = 2\n"}}}, {"loader", {{"c", "x = 3\n"}}}});
  EXPECT_THAT(presets.tables(), testing::ElementsAre("host", "loader"));
  EXPECT_THAT(presets.names("host"), testing::ElementsAre("a", "b"));
  EXPECT_THAT(presets.names("video"), testing::IsEmpty());
  ASSERT_NE(presets.find("loader", "c"), nullptr);
  EXPECT_EQ(*presets.find("loader", "c"), "x = 3\n");
  EXPECT_EQ(presets.find("loader", "a"), nullptr);
  EXPECT_EQ(presets.find("video", "a"), nullptr);
}

// Every file of configs/presets is in the program, byte for byte, and is TOML.
TEST(Presets, TheProgramHasThoseOfTheRepository) {
  namespace fs = std::filesystem;
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(RASTERTLM_SOURCE_DIR) / "configs" / "presets")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    const std::string* compiled =
        Presets::compiled_in().find(entry.path().parent_path().filename().string(), entry.path().stem().string());
    ASSERT_NE(compiled, nullptr) << entry.path();
    EXPECT_EQ(*compiled, text);
    EXPECT_FALSE(Document::from_text(*compiled, entry.path().string()).entries().empty());
  }
  std::size_t known = 0;
  for (const std::string& table : Presets::compiled_in().tables()) known += Presets::compiled_in().names(table).size();
  EXPECT_EQ(known, files);
  EXPECT_NE(Presets::compiled_in().find("host", "t800_20"), nullptr);
}

}  // namespace
}  // namespace rastertlm::config
