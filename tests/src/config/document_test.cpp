#include "src/config/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "src/base/errors.h"

namespace rastertlm::config {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
 protected:
  FileTest() : folder_(fs::temp_directory_path() / ("document_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~FileTest() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  fs::path folder_;
};

std::string error_of(const std::string& path) {
  try {
    Document::from_file(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of_text(const std::string& text) {
  try {
    Document::from_text(text, "t.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> paths(const Document& document) {
  std::vector<std::string> result;
  for (const Entry& entry : document.entries()) {
    const char* kind = entry.kind == EntryKind::value ? "" : entry.kind == EntryKind::table ? "table " : "element ";
    result.push_back(kind + entry.path + ":" + std::to_string(entry.line));
  }
  return result;
}

TEST_F(FileTest, SaysWhatIsWrongWithTheFile) {
  const std::string missing = (folder_ / "missing.toml").string();
  EXPECT_EQ(error_of(missing), missing + ": no such file");
  EXPECT_EQ(error_of(folder_.string()), folder_.string() + ": is a directory, a TOML file is expected");
  const std::string empty = write("empty.toml", "");
  EXPECT_EQ(error_of(empty), empty + ": is empty: there is no key in it");
  const std::string comments = write("comments.toml", "# nothing\n\n   \n# here\n");
  EXPECT_EQ(error_of(comments), comments + ": is empty: there is no key in it");
  const std::string below_a_file = write("plain", "x = 1\n") + "/deeper.toml";
  EXPECT_EQ(error_of(below_a_file), below_a_file + ": no such file");
}

TEST_F(FileTest, SaysThatAFileCannotBeRead) {
  // Opens, and fails at the first read, for every user: address 0 of a process is not mapped.
  EXPECT_EQ(error_of("/proc/self/mem"), "/proc/self/mem: cannot be read");
  const std::string loop = (folder_ / "loop.toml").string();
  fs::create_symlink("loop.toml", loop);
  EXPECT_EQ(error_of(loop), loop + ": cannot be opened for reading");
}

TEST_F(FileTest, RefusesOneByteTooManyAndDevicesWithoutEnd) {
  const std::string large = write("large.toml", "x = 1\n#");
  fs::resize_file(large, Document::kMaximumBytes + 1);
  EXPECT_EQ(error_of(large), large + ": is larger than 64 MiB");
  EXPECT_EQ(error_of("/dev/zero"), "/dev/zero: is larger than 64 MiB");
  fs::resize_file(large, Document::kMaximumBytes);  // now the zero bytes are what is wrong
  EXPECT_THAT(error_of(large), testing::HasSubstr("not valid TOML"));
}

TEST(Document, NamesTheLineOfASyntaxError) {
  EXPECT_THAT(error_of_text("a = 1\nb = \n"), testing::StartsWith("t.toml:2: not valid TOML (column "));
  EXPECT_THAT(error_of_text("a = 1\n\na = 2\n"), testing::StartsWith("t.toml:3: not valid TOML"));
  EXPECT_THAT(error_of_text("[host]\nx = 1\n[host]\n"), testing::StartsWith("t.toml:3: not valid TOML"));
  EXPECT_THAT(error_of_text("a = 99999999999999999999\n"), testing::StartsWith("t.toml:1: not valid TOML"));
}

TEST(Document, KeepsTheOrderOfTheFile) {
  const Document document = Document::from_text(
      "zebra = 1\napple = 2\n[host]\nb.c = 3\n[[thing]]\nname = 'x'\n[[thing.turn]]\n[[thing.turn]]\naxis = [1, 0, "
      "0]\n[[thing]]\n"
      "turn = [{degrees = 1}, {degrees = 2}]\n",
      "t.toml");
  EXPECT_EQ(paths(document),
            (std::vector<std::string>{"zebra:1", "apple:2", "table host:3", "table host.b:4", "host.b.c:4",
                                      "element thing[0]:5", "thing[0].name:6", "element thing[0].turn[0]:7",
                                      "element thing[0].turn[1]:8", "thing[0].turn[1].axis:9", "element thing[1]:10",
                                      "element thing[1].turn[0]:11", "thing[1].turn[0].degrees:11",
                                      "element thing[1].turn[1]:11", "thing[1].turn[1].degrees:11"}));
}

TEST(Document, QuotesKeysThatCouldPassForPaths) {
  const Document document = Document::from_text("\"thing[0].name\" = 1\n'a.b' = 2\n", "t.toml");
  EXPECT_EQ(paths(document), (std::vector<std::string>{"\"thing[0].name\":1", "\"a.b\":2"}));
}

TEST(Document, RefusesKeysNestedWithoutEnd) {
  std::string key = "a";
  for (int i = 0; i < 1'000'000; ++i) key += ".a";
  EXPECT_EQ(error_of_text("x = 1\n" + key + " = 1\n"), "t.toml:2: keys are nested more than 32 deep");
  EXPECT_EQ(error_of_text("[" + key + "]\n"), "t.toml:1: keys are nested more than 32 deep");
  EXPECT_EQ(error_of_text("x = {" + key + " = 1}\n"), "t.toml:1: keys are nested more than 32 deep");
  EXPECT_FALSE(parse_value("{" + key + " = 1}").has_value());
  const std::string brackets(1'000'000, '[');
  EXPECT_THAT(error_of_text("x = " + brackets), testing::HasSubstr("not valid TOML"));
  // Dots elsewhere are no nesting.
  const std::string dots(100, '.');
  EXPECT_EQ(error_of_text("a = \"" + dots + "\" # " + dots + "\nb = '" + dots + "'\nc = '''\n" + dots +
                          "\n'''\nd = \"\"\"\\\"" + dots + "\"\"\"\n"),
            "no error");
  EXPECT_EQ(error_of_text("a = [" +
                          [] {
                            std::string list;
                            for (int i = 0; i < 200; ++i) list += "0.5, ";
                            return list;
                          }() +
                          "]\n"),
            "no error");
}

TEST(Document, FindsValuesOnly) {
  const Document document = Document::from_text("[host]\nclock_hz = 5\n", "t.toml");
  ASSERT_NE(document.find("host.clock_hz"), nullptr);
  EXPECT_EQ(std::get<std::int64_t>(document.find("host.clock_hz")->value.value), 5);
  EXPECT_EQ(document.find("host"), nullptr);
}

RC_GTEST_PROP(DocumentFuzz, AnyBytesAreADocumentOrAnInputError, ()) {
  // Random bytes alone stop at the first one: pieces of the grammar reach further in.
  static const std::vector<std::string> pieces{"a",   "b.c",  " = ", "[",    "]",      "[[",        "]]", "{", "}", ",",
                                               "\n",  "\r\n", "\"",  "'",    "1",      "-1",        ".",  "e", "5", "#",
                                               "\\u", "inf",  "nan", "true", "\"\"\"", "'''",       "0x", "_", ":", "Z",
                                               "T",   "\\",   "\0",  "\xff", "\xc3",   "1979-05-27"};
  std::string text;
  for (const auto& index : *rc::gen::container<std::vector<std::uint8_t>>(rc::gen::arbitrary<std::uint8_t>()))
    text += index < 200 ? pieces[index % pieces.size()] : std::string(1, static_cast<char>(index));
  try {
    Document::from_text(text, "fuzz.toml");
  } catch (const InputError& error) {
    RC_ASSERT(error.diagnostics().size() == 1U);
    RC_ASSERT(error.diagnostics()[0].file == "fuzz.toml");
  }
}

// toml++ 3.3 takes for granted that most characters beyond ASCII do not follow a value or begin a key, and goes on from
// what cannot be. Fuzzing found it.
TEST(Document, CharactersBeyondAsciiStandInStringsAndCommentsAlone) {
  using testing::HasSubstr;
  for (const char* text :
       {"a = 1\nb = 0.\xd0\xac\n", "a = 1\n\xd0\xac = 1\n", "a = 1\n[\xd0\xac]\n", "a = 1\nb = [1,\xff]\n"})
    EXPECT_THAT(error_of_text(text), HasSubstr("t.toml:2: not valid TOML: a character beyond ASCII")) << text;
  for (const char* text : {"a = \"\xd0\xac\" # \xd0\xac\n", "\"\xd0\xac\" = 1\n",
                           "\xef\xbb\xbf"
                           "a = 1\n",
                           "a = \"\"\"\n\xd0\xac\"\"\"\n"})
    EXPECT_EQ(error_of_text(text), "no error") << text;
  EXPECT_FALSE(parse_value("0.\xd0\xac"));
  EXPECT_TRUE(parse_value("\"\xd0\xac\""));
}

}  // namespace
}  // namespace rastertlm::config
