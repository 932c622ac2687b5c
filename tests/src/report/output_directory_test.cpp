#include "src/report/output_directory.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <set>

#include "src/base/digest.h"
#include "src/base/errors.h"
#include "src/report/json_report.h"
#include "src/report/text_file.h"
#include "src/report/vectors_manifest.h"
#include "tests/src/report/example_result.h"

namespace rastertlm::report {
namespace {

namespace fs = std::filesystem;

class OutputDirectoryTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "rastertlm_output_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string in_folder(const std::string& name) const { return folder_ + '/' + name; }
  std::set<std::string> names(const std::string& folder) const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) found.insert(entry.path().filename().string());
    return found;
  }
  static void make_result(const std::string& directory, const std::string& more = "") {
    OutputDirectory output(directory);
    write_text_file(output.path("report.json"), json_text({example_result(), false}));
    if (!more.empty()) write_text_file(output.path(more), "x");
    output.commit();
  }
  // The number of a process that is gone.
  static long dead_process() {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
    return child;
  }

  std::string folder_;
};

TEST_F(OutputDirectoryTest, IsThereAsAWholeAtTheEnd) {
  const std::string directory = in_folder("a/b/out");
  {
    OutputDirectory output(directory);
    write_text_file(output.path("x"), "1");
    EXPECT_EQ(names(in_folder("a/b")), std::set<std::string>{"out.partial-" + std::to_string(::getpid())});
    output.commit();
  }
  EXPECT_EQ(names(in_folder("a/b")), std::set<std::string>{"out"});
  EXPECT_EQ(read_text_file(directory + "/x"), "1");
}

TEST_F(OutputDirectoryTest, LeavesNothingBehindWithoutCommit) {
  {
    OutputDirectory output(in_folder("a/b/out"));
    write_text_file(output.path("x"), "1");
  }
  EXPECT_TRUE(names(folder_).empty()) << "the directories above were made for it";
}

TEST_F(OutputDirectoryTest, KeepsDirectoriesThatItDidNotMake) {
  fs::create_directories(in_folder("a"));
  { OutputDirectory output(in_folder("a/b/out")); }
  EXPECT_EQ(names(folder_), std::set<std::string>{"a"});
  EXPECT_TRUE(names(in_folder("a")).empty());
}

TEST_F(OutputDirectoryTest, ReplacesItsOwnAndKeepsTheResultsBelow) {
  const std::string directory = in_folder("out");
  make_result(directory, "frame_0001.png");
  make_result(directory + "/teapot_imogene");
  make_result(directory, "frame_0000.png");
  EXPECT_EQ(names(directory), (std::set<std::string>{"report.json", "frame_0000.png", "teapot_imogene"}));
  EXPECT_EQ(names(directory + "/teapot_imogene"), std::set<std::string>{"report.json"});
  EXPECT_EQ(names(folder_), std::set<std::string>{"out"});
}

TEST_F(OutputDirectoryTest, ReplacesVectorsAndNobodyElsesManifest) {
  const std::string directory = in_folder("out");
  {
    OutputDirectory output(directory);
    write_text_file(output.path("manifest.json"), vectors_manifest_text({}));
    write_text_file(output.path("old.hex"), "x");
    output.commit();
  }
  make_result(directory, "new");  // a result takes the place of vectors, as of another result
  EXPECT_EQ(names(directory), (std::set<std::string>{"report.json", "new"}));
  fs::create_directories(in_folder("app"));
  write_text_file(in_folder("app/manifest.json"), R"({"schema": 1, "name": "an app"})");
  EXPECT_THROW(OutputDirectory{in_folder("app")}, InputError);
  EXPECT_EQ(names(in_folder("app")), std::set<std::string>{"manifest.json"});
}

TEST_F(OutputDirectoryTest, RefusesWhatIsNotItsOwn) {
  fs::create_directories(in_folder("empty"));
  fs::create_directories(in_folder("other"));
  write_text_file(in_folder("other/report.json"), R"({"title": "ours"})");
  fs::create_directories(in_folder("odd/report.json"));
  write_text_file(in_folder("file"), "x");
  for (const char* name : {"empty", "other", "odd", "file", "empty/", "other/../empty"})
    EXPECT_THROW(OutputDirectory{in_folder(name)}, InputError) << name;
  EXPECT_THROW(OutputDirectory{""}, InputError);
  EXPECT_EQ(names(folder_), (std::set<std::string>{"empty", "other", "odd", "file"}));
  EXPECT_EQ(read_text_file(in_folder("other/report.json")), R"({"title": "ours"})");
}

TEST_F(OutputDirectoryTest, RefusesWhatCameToStandThereMeanwhile) {
  OutputDirectory output(in_folder("out"));
  fs::create_directories(in_folder("out"));
  write_text_file(in_folder("out/thesis.txt"), "x");
  EXPECT_THROW(output.commit(), InputError);
  EXPECT_EQ(read_text_file(in_folder("out/thesis.txt")), "x");
}

TEST_F(OutputDirectoryTest, FollowsALink) {
  make_result(in_folder("real"), "old");
  fs::create_symlink("real", in_folder("link"));
  make_result(in_folder("link"), "new");
  EXPECT_TRUE(fs::is_symlink(in_folder("link")));
  EXPECT_EQ(names(in_folder("real")), (std::set<std::string>{"report.json", "new"}));
  fs::create_symlink("nowhere", in_folder("dangling"));
  EXPECT_THROW(OutputDirectory{in_folder("dangling")}, OutputError);
}

TEST_F(OutputDirectoryTest, CannotBeWhereNothingCanBeWritten) {
  write_text_file(in_folder("file"), "x");
  EXPECT_THROW(OutputDirectory{in_folder("file/out")}, OutputError);
  EXPECT_THROW(OutputDirectory{in_folder("file/a/out")}, OutputError);
  EXPECT_THROW(OutputDirectory{"/proc/rastertlm/out"}, OutputError);
  EXPECT_EQ(names(folder_), std::set<std::string>{"file"});
}

TEST_F(OutputDirectoryTest, RemovesWhatDeadProcessesLeft) {
  const std::string dead = std::to_string(dead_process());
  const std::string alive = std::to_string(::getppid());
  for (const std::string& name :
       {"out.partial-" + dead, "out.partial-" + dead + "-old", "out.partial-" + dead + "-removed",
        "out.partial-" + alive, "out.partial-" + dead + "x", std::string("out.partial-"), "my_out.partial-" + dead,
        "out2.partial-" + dead}) {
    fs::create_directories(in_folder(name));
    write_text_file(in_folder(name + "/x"), "1");
  }
  make_result(in_folder("out"));
  EXPECT_EQ(names(folder_), (std::set<std::string>{"out", "out.partial-" + alive, "out.partial-" + dead + "x",
                                                   "out.partial-", "my_out.partial-" + dead, "out2.partial-" + dead}));
}

TEST_F(OutputDirectoryTest, NoticesAFullDisk) {
  EXPECT_THROW(write_text_file("/dev/full", "x"), OutputError);
  EXPECT_THROW(write_text_file(in_folder("none/x"), "x"), OutputError);
  EXPECT_FALSE(read_text_file(folder_).has_value());
}

TEST_F(OutputDirectoryTest, WritesPieceByPieceWithADigest) {
  std::string all;
  TextFileWriter file(in_folder("x"));
  for (int i = 0; i < 200'000; ++i) {
    const std::string piece = std::to_string(i) + '\n';
    file.append(piece);
    all += piece;
  }
  file.close();
  EXPECT_EQ(read_text_file(in_folder("x")), all);
  EXPECT_EQ(file.bytes(), all.size());
  EXPECT_EQ(file.sha256(), sha256_hex(all));
  TextFileWriter full("/dev/full");
  full.append("x");
  EXPECT_THROW(full.close(), OutputError);
  EXPECT_THROW(TextFileWriter{in_folder("none/x")}, OutputError);
}

}  // namespace
}  // namespace rastertlm::report
