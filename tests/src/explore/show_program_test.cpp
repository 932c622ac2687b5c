// rastertlm explore show on a store that the program made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "src/explore/front.h"
#include "src/explore/sweep_text.h"
#include "tests/src/explore/explore_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;

class ShowTest : public ExploreTest {
 protected:
  void SetUp() override {
    ExploreTest::SetUp();
    write("sweep.toml", grid(3));
    ASSERT_EQ(run(run_sweep()).exit_code, 0);
  }
};

TEST_F(ShowTest, TellsTheFrontAndStepsOfAStore) {
  const explore::SweepTable found = table();
  const explore::Front front = explore::find_front(found);
  const auto answer = explore::answer_row(found, front);
  ASSERT_TRUE(answer.has_value());
  const std::string text = run({"explore", "show", "s.sqlite"}).out;
  EXPECT_THAT(text, HasSubstr(fmt::format("(point {})", found.rows[*answer].number)));
  EXPECT_THAT(text, HasSubstr(fmt::format("6 points: {} on the front, {} beaten by it.", front.rows.size(),
                                          found.rows.size() - front.rows.size())));
  EXPECT_EQ(text, explore::sweep_text(found));
  EXPECT_THAT(run({"explore", "show", "s.sqlite", "--point", "3"}).out,
              HasSubstr("One parameter moved one step from point 3"));
}

TEST_F(ShowTest, WritesTablesForPrograms) {
  std::istringstream lines(run({"explore", "show", "s.sqlite", "--csv"}).out);
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, HasSubstr("point,state,allowed,baseline,front,beaten_by,host.link_mbit_per_s"));
  std::size_t points = 0;
  while (std::getline(lines, line)) ++points;
  EXPECT_EQ(points, 6U);
  EXPECT_THAT(run({"explore", "show", "s.sqlite", "--csv-sensitivity"}).out,
              HasSubstr("answer.frame_rate_hz,Hz,host.link_mbit_per_s,6.0,2,by_value,"));
  // From 6 Mbit/s on a pipeline: 5 and 7, and a tree.
  const std::string steps = run({"explore", "show", "s.sqlite", "--csv-steps", "--point", "2"}).out;
  EXPECT_THAT(steps, HasSubstr("\nhost.link_mbit_per_s,6.0,5.0,known,0,"));
  EXPECT_THAT(steps, HasSubstr("\nhost.link_mbit_per_s,6.0,7.0,known,4,"));
  EXPECT_THAT(steps, HasSubstr("\ndecision_unit.topology,pipeline,tree,known,3,"));
}

// Number and beater, -1 for none, as SQL reads them.
std::map<std::int64_t, std::int64_t> kept_front(const std::string& store) {
  explore::Database database(store, explore::Database::Access::existing);
  explore::Statement row(database, "SELECT number, coalesce(beaten_by, -1) FROM front");
  std::map<std::int64_t, std::int64_t> kept;
  while (row.step()) kept[row.integer(0)] = row.integer(1);
  return kept;
}

TEST_F(ShowTest, KeepsTheFrontInTheStore) {
  const explore::SweepTable found = table();
  const explore::Front front = explore::find_front(found);
  std::map<std::int64_t, std::int64_t> expected;
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    const auto& by = front.beaten_by[i];
    expected[static_cast<std::int64_t>(found.rows[i].number)] =
        by ? static_cast<std::int64_t>(found.rows[*by].number) : -1;
  }
  ASSERT_EQ(expected.size(), 6U);
  EXPECT_EQ(kept_front(in_work("s.sqlite")), expected);
  // A share knows the front of its own points; joined, they have that of all.
  for (const char* share : {"1/2", "2/2"})
    ASSERT_EQ(run({"explore", "run", "sweep.toml", "--store", fmt::format("{}.sqlite", share[0]), "--shard", share})
                  .exit_code,
              0);
  EXPECT_EQ(kept_front(in_work("1.sqlite")).size(), 3U);
  ASSERT_EQ(run({"explore", "merge", "joined.sqlite", "1.sqlite", "2.sqlite"}).exit_code, 0);
  EXPECT_EQ(kept_front(in_work("joined.sqlite")), expected);
}

// Where only the scene differs, only its digest tells points apart.
TEST_F(ShowTest, TellsScenesApart) {
  write("other.toml", one_triangle() +
                          "[[object.animation]]\ntype = \"spin\"\naxis = [0.0, 0.0, 1.0]\n"
                          "deg_per_frame = 9.0\n");
  std::string text = sweep("");
  text.replace(text.find("\"scene.toml\""), 12, "[\"scene.toml\", \"other.toml\"]");
  write("scenes.toml", text);
  ASSERT_EQ(run({"explore", "run", "scenes.toml", "--store", "scenes.sqlite"}).exit_code, 0);
  const explore::SweepTable found = table("scenes.sqlite");
  ASSERT_EQ(found.rows.size(), 2U);
  EXPECT_EQ(found.rows[0].config_digest, found.rows[1].config_digest);
  EXPECT_NE(found.rows[0].scene_digest, found.rows[1].scene_digest);
  const std::string csv = run({"explore", "show", "scenes.sqlite", "--csv"}).out;
  // A page may be put where there is no folder yet, as a store may.
  ASSERT_EQ(run({"explore", "show", "scenes.sqlite", "--html", "new/folder/page.html"}).exit_code, 0);
  const std::string page = file_text(in_work("new/folder/page.html"));
  for (const explore::Row& row : found.rows) {
    EXPECT_THAT(csv, HasSubstr(row.config_digest + ',' + row.scene_digest));
    EXPECT_THAT(page, HasSubstr("\"scene\":\"" + row.scene_digest.substr(0, 12)));
  }
}

TEST_F(ShowTest, RefusesPointsThatHaveNoFigures) {
  const Outcome none = run({"explore", "show", "s.sqlite", "--point", "6"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("s.sqlite: --point: 6 is no point of the sweep, which has 6"));
  for (const char* tolerance : {"-1", "nan", "inf", "1.5", "-nan", "a lot"}) {
    const Outcome outcome = run({"explore", "show", "s.sqlite", "--tolerance", tolerance});
    EXPECT_EQ(outcome.exit_code, 2) << tolerance;
    EXPECT_THAT(outcome.err, HasSubstr("is not a number from 0 to 1")) << tolerance;
  }
  for (const char* rows : {"0", "-1"}) EXPECT_EQ(run({"explore", "show", "s.sqlite", "--rows", rows}).exit_code, 2);
  EXPECT_EQ(run({"explore", "show", "s.sqlite", "--csv", "--list"}).exit_code, 2);
  ASSERT_EQ(run({"explore", "run", "sweep.toml", "--store", "half.sqlite", "--shard", "1/2"}).exit_code, 0);
  const Outcome waiting = run({"explore", "show", "half.sqlite", "--point", "1"});
  EXPECT_EQ(waiting.exit_code, 2);
  EXPECT_THAT(waiting.err, HasSubstr("point 1 has not run yet, so it has no figures"));
}

}  // namespace
}  // namespace rastertlm::test
