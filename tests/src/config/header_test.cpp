#include "src/config/header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace rastertlm::config {
namespace {

const std::vector<std::string> kKnown{"imogene", "quadratic"};

std::string mistake(const std::function<void(Diagnostics&)>& use) {
  Diagnostics diagnostics;
  use(diagnostics);
  return diagnostics.list().size() == 1 ? to_string(diagnostics.list()[0])
                                        : std::to_string(diagnostics.list().size()) + " mistakes";
}

std::string platform_mistake(const std::string& text, const std::vector<Override>& set = {}) {
  return mistake(
      [&](Diagnostics& d) { EXPECT_FALSE(choose_platform(Document::from_text(text, "m.toml"), set, kKnown, d)); });
}

std::string schema_mistake(const std::string& text) {
  return mistake([&](Diagnostics& d) { EXPECT_FALSE(check_schema(Document::from_text(text, "m.toml"), 1, d)); });
}

TEST(Header, PeeksBeforeATableIsChosen) {
  const Document document = Document::from_text("schema = 1\nplatform = 'imogene'\nanything = 3\n", "m.toml");
  EXPECT_EQ(peek_schema(document), 1);
  EXPECT_EQ(peek_platform(document), "imogene");
  Diagnostics diagnostics;
  EXPECT_EQ(peek_platform(document, parse_overrides({"platform=adaptive", "platform=quadratic"}, diagnostics)),
            "quadratic");
  EXPECT_EQ(choose_platform(document, parse_overrides({"platform=\"quadratic\""}, diagnostics), kKnown, diagnostics),
            "quadratic");
  EXPECT_TRUE(check_schema(document, 1, diagnostics));
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(peek_platform(Document::from_text("[platform]\nx = 1\n", "m.toml")), std::nullopt);
}

TEST(Header, RefusesUnknownPlatforms) {
  EXPECT_EQ(
      platform_mistake("x = 1\nplatform = 'imogen'\n"),
      "m.toml:2: platform: 'imogen' is not accepted; accepted values: 'imogene', 'quadratic'; nearest: 'imogene'");
  EXPECT_EQ(platform_mistake("x = 1\n"),
            "m.toml: platform: required key is missing; accepted values: 'imogene', 'quadratic'");
  EXPECT_EQ(platform_mistake("platform = 3\n"),
            "m.toml:1: platform: wrong type: expected text in quotes, found the integer 3; accepted values: 'imogene', "
            "'quadratic'");
  Diagnostics diagnostics;
  EXPECT_EQ(platform_mistake("platform = 'imogene'\n", parse_overrides({"platform=zzzzzzzzzzz"}, diagnostics)),
            "--set: platform: 'zzzzzzzzzzz' is not accepted; accepted values: 'imogene', 'quadratic'");
}

TEST(Header, RefusesOtherSchemas) {
  EXPECT_EQ(schema_mistake("\nschema = 2\n"), "m.toml:2: schema: schema 2 is not known: this program reads schema 1");
  EXPECT_EQ(schema_mistake("x = 1\n"), "m.toml: schema: required key is missing: write schema = 1");
  EXPECT_EQ(schema_mistake("schema = '1'\n"),
            "m.toml:1: schema: wrong type: expected the integer 1, found the text \"1\"");
}

}  // namespace
}  // namespace rastertlm::config
