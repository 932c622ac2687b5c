#include "src/config/parameter_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/src/config/sample.h"

namespace rastertlm::config {
namespace {

using testing::HasSubstr;

TEST(ParameterList, TextSaysEverythingAboutAParameter) {
  sample::Configuration configuration;
  const std::string text = parameter_list_text(parameter::view(configuration));
  EXPECT_THAT(text, HasSubstr("[video]\n"
                              "  columns                      integer, from 1 to 16384 pixels; default 512\n"
                              "      Columns of the picture.\n"
                              "      moves: picture\n"));
  EXPECT_THAT(text, HasSubstr("  mode                         one of 'fast', 'exact'; default \"fast\"\n"));
  EXPECT_THAT(text, HasSubstr("  refresh_hz                   number, above 0 and at most 1000 Hz; default 50.0\n"));
  EXPECT_THAT(text, HasSubstr("moves: nothing in the results\n"));
  EXPECT_THAT(text, HasSubstr("[[thing]]  What is seen.\n"));
  EXPECT_THAT(text, HasSubstr("[[thing.turn]]  How it turns.\n"));
  EXPECT_THAT(text, HasSubstr("[[camera.turn]]  How the camera turns.\n"));
  EXPECT_THAT(text, HasSubstr("  name                         text; required\n"));
  EXPECT_THAT(text, HasSubstr("      only where type is 'ball'\n"));
}

TEST(ParameterList, MarkdownHasARowAParameter) {
  sample::Configuration configuration;
  const parameter::Table table = parameter::view(configuration);
  const std::string text = parameter_list_markdown(table);
  EXPECT_THAT(text, HasSubstr("### `[video]`\n"));
  EXPECT_THAT(
      text,
      HasSubstr(
          "| `columns` | integer | `512` | pixels | from 1 to 16384 pixels | Columns of the picture. | picture |\n"));
  EXPECT_THAT(text, HasSubstr("Rate \\| speed."));
  EXPECT_THAT(text, HasSubstr("| `file` | text | required |"));
  EXPECT_THAT(text, HasSubstr("Radius. Only where type is 'ball'."));
  // 13 of the root less the two lists, 6 of a thing, 2 of a turn, which two lists have.
  const std::size_t rows = table.parameters().size() + 6 + 2 * 2;
  std::size_t found = 0;
  for (std::size_t at = text.find("\n| `"); at != std::string::npos; at = text.find("\n| `", at + 1)) ++found;
  EXPECT_EQ(found, rows);
}

}  // namespace
}  // namespace rastertlm::config
