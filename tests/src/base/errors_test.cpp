#include "src/base/errors.h"

#include <gtest/gtest.h>

namespace rastertlm {
namespace {

TEST(Diagnostic, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(to_string(Diagnostic{"a.toml", 7, "video.columns", "too small"}), "a.toml:7: video.columns: too small");
  EXPECT_EQ(to_string(Diagnostic{"a.toml", 0, "video.columns", "too small"}), "a.toml: video.columns: too small");
  EXPECT_EQ(to_string(Diagnostic{"a.toml", 7, "", "not a table"}), "a.toml:7: not a table");
  EXPECT_EQ(to_string(Diagnostic{"", 0, "video.columns", "too small"}), "video.columns: too small");
  EXPECT_EQ(to_string(Diagnostic{"", 3, "", "too small"}), "line 3: too small");
  EXPECT_EQ(to_string(Diagnostic{"", 0, "", "too small"}), "too small");
}

TEST(Diagnostics, ThrowAllAtOnceOrNothing) {
  Diagnostics list;
  EXPECT_NO_THROW(list.throw_if_any());
  list.add({"f", 1, "a", "x"});
  list.add({"f", 2, "b", "y"});
  try {
    list.throw_if_any();
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "f:1: a: x\nf:2: b: y");
    EXPECT_EQ(error.diagnostics().size(), 2U);
  }
}

TEST(ModelError, NamesUnitAndCycle) {
  EXPECT_STREQ(ModelError("board[3]", 1234, "a word wrapped").what(), "board[3], cycle 1234: a word wrapped");
}

TEST(NearestWord, FindsWhatWasMeant) {
  const std::vector<std::string> known{"columns", "lines", "refresh_hz"};
  EXPECT_EQ(nearest_word("colums", known), "columns");
  EXPECT_EQ(nearest_word("line", known), "lines");
  EXPECT_EQ(nearest_word("refresh", known), "refresh_hz");
  EXPECT_EQ(nearest_word("zzzzzzzz", known), "");
  EXPECT_EQ(nearest_word("columns", {}), "");
}

}  // namespace
}  // namespace rastertlm
