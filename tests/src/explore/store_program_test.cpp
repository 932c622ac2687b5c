// Stores as the program makes them: run, killed, resumed, joined, spoiled.
#include <gmock/gmock.h>

#include <random>

#include "tests/src/explore/explore_program.h"

namespace rastertlm::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using StoreTest = ExploreTest;

TEST_F(StoreTest, HasWhatRenderReports) {
  write("sweep.toml", sweep("[[vary]]\npath = \"decision_unit.topology\"\nvalues = [\"pipeline\", \"tree\"]\n"));
  const Outcome outcome = run(run_sweep());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());  // quiet: no terminal
  ASSERT_EQ(
      run({"render", "machine.toml", "scene.toml", "--set", "decision_unit.topology=pipeline", "--out", "o"}).exit_code,
      0);
  explore::Store store(in_work("s.sqlite"), explore::Store::Opening::look);
  const explore::SweepTable table = store.table();
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.axes.at(0).values, (std::vector<std::string>{"pipeline", "tree"}));
  const std::string key = store.database().text("SELECT result FROM point WHERE number = 0");
  EXPECT_TRUE(store.report(std::stoll(key)) == file_text(in_work("o/report.json")));
  EXPECT_EQ(table.baseline, 1U);  // the machine file's own
  EXPECT_FALSE(table.rows[0].thumbnail.empty());
}

// The first point of a set renders the exact pictures, and the others take them: each as if it were alone, whatever
// poses it shows. Hosts that are slow show old ones; fields of interlaced video have one each.
TEST_F(StoreTest, SharedExactPicturesAreThoseOfEachPoint) {
  write("scene.toml",
        one_triangle() + "[[object.animation]]\ntype = \"spin\"\naxis = [0.0, 0.0, 1.0]\ndeg_per_frame = 9.0\n");
  write("sweep.toml", sweep("[[vary]]\npath = \"host.sustained_mflops\"\nvalues = [1.5, 0.03]\n"
                            "[[vary]]\npath = \"shading.arithmetic\"\nvalues = [\"centred\", \"literal\"]\n",
                            "frames = 3\nset.video.interlaced = true\n"));
  ASSERT_EQ(run(run_sweep({"--jobs", "2"})).exit_code, 0);
  explore::Store store(in_work("s.sqlite"), explore::Store::Opening::look);
  const explore::SweepTable table = store.table();
  ASSERT_EQ(table.rows.size(), 4U);
  std::set<std::string> reports;
  for (const explore::Row& row : table.rows) {
    std::vector<std::string> arguments{"render", "machine.toml", "scene.toml",           "--frames", "3", "--out",
                                       "o",      "--set",        "video.interlaced=true"};
    for (std::size_t axis = 0; axis < table.axes.size(); ++axis) {
      arguments.emplace_back("--set");
      arguments.push_back(table.axes[axis].path + '=' + table.axes[axis].values[row.values[axis]]);
    }
    const Outcome alone = run(arguments);
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    const std::int64_t result =
        store.database().integer("SELECT result FROM point WHERE number = " + std::to_string(row.number));
    EXPECT_TRUE(store.report(result) == file_text(in_work("o/report.json"))) << row.number;
    reports.insert(store.report(result));
  }
  EXPECT_EQ(reports.size(), 4U);
}

TEST_F(StoreTest, ResumedRunsNothingTwiceAndAChangedSweepOnlyWhatIsNew) {
  write("sweep.toml", grid(3));
  ASSERT_EQ(run(run_sweep()).exit_code, 0);
  const StoredResults before = results();
  ASSERT_EQ(before.size(), 6U);
  EXPECT_THAT(run(run_sweep({"--resume"})).out, HasSubstr("6 points: 0 simulated, 6 had their result"));
  write("sweep.toml", grid(5));
  EXPECT_THAT(run(run_sweep({"--resume"})).out, HasSubstr("10 points: 4 simulated, 6 had their result"));
  const StoredResults after = results();
  EXPECT_EQ(after.size(), 10U);
  for (const auto& [key, result] : before) EXPECT_TRUE(after.at(key) == result);
  EXPECT_EQ(table().rows.size(), 10U);
}

// What is given, curves, names and further figures: in a store, and in joined ones.
TEST_F(StoreTest, KeepsHowASweepIsShown) {
  const std::string text =
      "given = \"host.link_mbit_per_s\"\n[[vary]]\npath = \"host.link_mbit_per_s\"\nvalues = [5, 10]\n[[vary]]\nname = "
      "\"shape\"\nvariant = [ { name = \"a\", curve = \"one\", set = { decision_unit.topology = \"tree\" } }, { name = "
      "\"b\", set = { decision_unit.topology = \"pipeline\" } } ]\n[[column]]\npath = "
      "\"answer.headroom\"\n[[column]]\npath "
      "= \"budgets[no_such].used\"\nname = \"nothing\"\noptional = true\n[[objective]]\npath = "
      "\"images[0].covered_pixels\"\nname = \"seen\"\nscale = \"log\"\nsense = \"maximise\"\n";
  write("sweep.toml", sweep(text));
  ASSERT_EQ(run(run_sweep()).exit_code, 0);
  for (const std::string share : {"1", "2"})
    ASSERT_EQ(run({"explore", "run", "sweep.toml", "--store", share + ".sqlite", "--shard", share + "/2"}).exit_code,
              0);
  ASSERT_EQ(run({"explore", "merge", "joined.sqlite", "1.sqlite", "2.sqlite"}).exit_code, 0);
  for (const char* store : {"s.sqlite", "joined.sqlite"}) {
    const explore::SweepTable found = table(store);
    EXPECT_TRUE(found.axes.at(0).given);
    EXPECT_FALSE(found.axes.at(1).given);
    EXPECT_TRUE(found.axes[0].curves.empty());
    EXPECT_EQ(found.axes[1].curves, (std::vector<std::string>{"one", "b"}));
    EXPECT_EQ(found.objectives.at(0).name, "seen");
    EXPECT_TRUE(found.objectives[0].logarithmic);
    EXPECT_FALSE(found.objectives.at(1).logarithmic);
    ASSERT_EQ(found.further.size(), 2U);
    EXPECT_EQ(found.further[1].name, "nothing");
    for (const explore::Row& row : found.rows) {
      EXPECT_TRUE(row.further.at(0).has_value());
      EXPECT_FALSE(row.further.at(1).has_value());
    }
  }
  const std::string csv = run({"explore", "show", "s.sqlite", "--csv"}).out;
  EXPECT_THAT(csv, HasSubstr(",answer.headroom (fraction),budgets[no_such].used,config_digest"));
}

// Only a report shows that it has no such budget.
TEST_F(StoreTest, NamesAColumnThatReportsDoNotHave) {
  write("sweep.toml", sweep("[[vary]]\npath = \"decision_unit.topology\"\nvalues = [\"pipeline\", \"tree\"]\n"
                            "[[column]]\npath = \"budgets[line_strt].used\"\n"));
  const Outcome outcome = run(run_sweep());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("sweep.toml:8: budgets[line_strt].used"), HasSubstr("nearest: 'line_start'")));
}

TEST_F(StoreTest, JobsAndSharesDoNotMatter) {
  write("sweep.toml", grid(4));
  ASSERT_EQ(run(run_sweep({"--jobs", "1"})).exit_code, 0);
  for (const char* share : {"1/3", "2/3", "3/3"}) {
    const std::string store = std::string("part") + share[0] + ".sqlite";
    ASSERT_EQ(run({"explore", "run", "sweep.toml", "--store", store, "--shard", share, "--jobs", "2"}).exit_code, 0);
  }
  const Outcome merged = run({"explore", "merge", "joined.sqlite", "part1.sqlite", "part2.sqlite", "part3.sqlite"});
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_THAT(merged.out, Not(HasSubstr("no result")));
  EXPECT_TRUE(results("joined.sqlite") == results());
  EXPECT_EQ(run({"explore", "show", "joined.sqlite", "--csv"}).out, run({"explore", "show", "s.sqlite", "--csv"}).out);
  EXPECT_THAT(run({"explore", "merge", "two.sqlite", "part1.sqlite", "part2.sqlite"}).out,
              HasSubstr("2 of 8 points have no result: all of share 3/3; `explore run --resume` with"));
  EXPECT_EQ(names().count("joined.sqlite-wal") + names().count("joined.sqlite.lock"), 0U);
}

TEST_F(StoreTest, AFailingPointIsKeptAndStopsNothing) {
  write("sweep.toml", sweep("[[vary]]\npath = \"host.processors_per_unit\"\nvalues = [1, 8]\n"
                            "[[vary]]\npath = \"object_processor.word_bits\"\nvalues = [8, 24]\n"));
  const Outcome outcome = run(run_sweep());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("point 0 failed: "), HasSubstr("; so did 1 other point"),
                                 HasSubstr("sweep.toml:7: object_processor.word_bits: "), Not(HasSubstr("--set"))));
  const explore::SweepTable table = this->table();
  ASSERT_EQ(table.rows.size(), 4U);
  for (const explore::Row& row : table.rows) {
    const bool narrow = table.axes[1].values[row.values[1]] == "8";
    EXPECT_EQ(row.state, narrow ? explore::State::failed : explore::State::done) << row.error;
    EXPECT_EQ(row.error.empty(), !narrow);
    EXPECT_EQ(row.allowed, !narrow);
  }
  // The user's own --set is named as such; where all points have a bad value the input is bad, again from the store.
  write("sweep.toml", sweep("[[vary]]\npath = \"host.processors_per_unit\"\nvalues = [1, 8]\n"));
  for (const bool again : {false, true}) {
    std::vector<std::string> more{"--store", "bad.sqlite", "--set", "object_processor.word_bits=8"};
    if (again) more.emplace_back("--resume");
    std::vector<std::string> arguments{"explore", "run", "sweep.toml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome all = run(arguments);
    EXPECT_EQ(all.exit_code, 2);
    EXPECT_THAT(all.err, AllOf(HasSubstr("point 0 failed: "), HasSubstr("--set: object_processor.word_bits: ")));
  }
}

// Two of three shares: every third point is missing. A share in part: the first point is named.
TEST(Lacking, NamesTheSharesThatAreMissing) {
  EXPECT_EQ(explore::lacking_text({6, {}}), "");
  EXPECT_EQ(explore::lacking_text({81, {2,  5,  8,  11, 14, 17, 20, 23, 26, 29, 32, 35, 38, 41,
                                        44, 47, 50, 53, 56, 59, 62, 65, 68, 71, 74, 77, 80}}),
            "27 of 81 points have no result: all of share 3/3");
  EXPECT_EQ(explore::lacking_text({12, {1, 3, 5, 7, 9, 11}}), "6 of 12 points have no result: all of share 2/2");
  EXPECT_EQ(explore::lacking_text({12, {4}}), "1 of 12 points has no result: the first is point 4");
}

// A worker that is killed is a failed point; the others go on, and it can be tried again.
TEST_F(StoreTest, AWorkerThatDiesIsAFailedPointThatIsTriedAgain) {
  write("sweep.toml", grid(40));
  const pid_t explorer = start(run_sweep({"--jobs", "2"}));
  const std::string children = fmt::format("/proc/{0}/task/{0}/children", explorer);
  int kills = 0;
  ASSERT_TRUE(wait_until([&] {
    std::ifstream list(children);
    for (pid_t worker = 0; list >> worker;) kills += ::kill(worker, SIGKILL) == 0 ? 1 : 0;
    return kills >= 6;
  }));
  const Outcome outcome = wait_for(explorer);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;  // not all that was wanted is there
  std::size_t failed = 0;
  for (const explore::Row& row : table().rows) {
    EXPECT_NE(row.state, explore::State::waiting);
    if (row.state != explore::State::failed) continue;
    ++failed;
    EXPECT_THAT(row.error, HasSubstr("the simulation was ended by signal 9 (Killed)"));
  }
  EXPECT_GE(failed, 1U);
  EXPECT_LE(failed, static_cast<std::size_t>(kills));
  EXPECT_THAT(run(run_sweep({"--resume"})).out,
              HasSubstr(fmt::format(": 0 simulated, 80 had their result; {} failed", failed)));
  EXPECT_THAT(run(run_sweep({"--resume", "--retry"})).out, HasSubstr(fmt::format(": {} simulated", failed)));
  ASSERT_EQ(run({"explore", "run", "sweep.toml", "--store", "whole.sqlite"}).exit_code, 0);
  EXPECT_TRUE(results() == results("whole.sqlite"));
}

// Killed at random moments, by a signal that nobody can answer.
TEST_F(StoreTest, KilledAndResumedIsAsIfNeverKilled) {
  constexpr int kKills = 10;
  constexpr int kPoints = 160;
  constexpr int kJobs = 2;
  write("sweep.toml", grid(kPoints / 2));
  ASSERT_EQ(run({"explore", "run", "sweep.toml", "--store", "whole.sqlite"}).exit_code, 0);
  std::mt19937 random(20);
  std::map<std::string, std::string> recorded;
  const auto rows = [&] {
    std::map<std::string, std::string> found;
    explore::Database database(in_work("s.sqlite"), explore::Database::Access::existing);
    if (database.integer("SELECT count(*) FROM sqlite_master WHERE name = 'result'") == 0) return found;
    explore::Statement row(database, "SELECT key, session || ' ' || recorded || ' ' || seconds FROM result");
    while (row.step()) found[row.text(0)] = row.text(1);
    return found;
  };
  for (int kill = 0; kill < kKills; ++kill) {
    const pid_t child = start(run_sweep({"--resume", "--jobs", std::to_string(kJobs)}));
    const std::size_t enough = recorded.size() + 1 + random() % 5;
    ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(in_work("s.sqlite")) && rows().size() >= enough; }));
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 5000));
    ::kill(child, SIGKILL);
    EXPECT_EQ(wait_for(child).signal, SIGKILL);
    const auto now = rows();
    for (const auto& [key, row] : recorded) EXPECT_EQ(now.at(key), row);  // what was recorded was not run again
    recorded = now;
  }
  ASSERT_LT(recorded.size(), static_cast<std::size_t>(kPoints));
  const Outcome last = run(run_sweep({"--resume"}));
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_TRUE(results() == results("whole.sqlite"));
  EXPECT_EQ(run({"explore", "show", "s.sqlite", "--csv"}).out, run({"explore", "show", "whole.sqlite", "--csv"}).out);
  explore::Database database(in_work("s.sqlite"), explore::Database::Access::existing);
  EXPECT_EQ(database.integer("SELECT count(*) FROM result"), kPoints);
  // Every simulation that was started is recorded, or was at work when its parent was killed.
  EXPECT_LE(database.integer("SELECT sum(started) FROM session"), kPoints + kKills * kJobs);
  EXPECT_EQ(database.text("PRAGMA integrity_check"), "ok");
}

TEST_F(StoreTest, AnInterruptLeavesWhatWasRecorded) {
  for (const int signal : {SIGINT, SIGTERM}) {
    write("sweep.toml", grid(2000));
    const pid_t child = start(run_sweep({"--resume"}));
    ASSERT_TRUE(wait_until([&] {
      return std::filesystem::exists(in_work("s.sqlite")) && std::filesystem::file_size(in_work("s.sqlite")) > 0 &&
             !results().empty();
    }));
    ::kill(child, signal);
    const Outcome outcome = wait_for(child);
    EXPECT_EQ(outcome.exit_code, 128 + signal);
    EXPECT_THAT(outcome.err, HasSubstr("--resume goes on"));
    EXPECT_EQ(names().count("s.sqlite.lock"), 0U);
    EXPECT_GT(results().size(), 0U);
    std::filesystem::remove(in_work("s.sqlite"));
  }
}

TEST_F(StoreTest, TwoExplorersOnOneStore) {
  write("sweep.toml", grid(2000));
  const pid_t child = start(run_sweep());
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(in_work("s.sqlite")) && !results().empty(); }));
  write("other.toml", grid(2));
  std::rename(in_folder("stderr").c_str(), in_folder("first").c_str());
  const Outcome second = run({"explore", "run", "other.toml", "--store", "s.sqlite", "--resume"});
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_THAT(second.err, HasSubstr("another explorer is at work on this store (process " + std::to_string(child)));
  ::kill(child, SIGKILL);
  wait_for(child);
  EXPECT_EQ(run({"explore", "run", "other.toml", "--store", "s.sqlite", "--resume"}).exit_code, 0);
}

TEST_F(StoreTest, FullDisk) {
  write("sweep.toml", grid(60));
  constexpr rlim_t kRoom = 400'000;
  const Outcome full = run(run_sweep(), kRoom);
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_THAT(full.err, HasSubstr("cannot write the store s.sqlite"));
  const StoredResults kept = results();
  EXPECT_FALSE(kept.empty());
  ASSERT_EQ(run(run_sweep({"--resume"})).exit_code, 0);
  const StoredResults all = results();
  EXPECT_EQ(all.size(), 120U);
  for (const auto& [key, result] : kept) EXPECT_TRUE(all.at(key) == result);
}

TEST_F(StoreTest, WhatIsNoStoreOfThisProgram) {
  write("sweep.toml", grid(1));
  const auto refused = [&](const std::string& file, const std::string& why) {
    const std::string before = file_text(in_work(file));
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"explore", "run", "sweep.toml", "--store", file, "--resume"},
          std::vector<std::string>{"explore", "show", file}}) {
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exit_code, 2) << arguments[1] << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr(why)) << arguments[1];
    }
    EXPECT_TRUE(file_text(in_work(file)) == before);
  };
  write("text.sqlite", std::string(5000, 'x'));
  refused("text.sqlite", "is not a store of rastertlm");
  explore::Database(in_work("other.sqlite"), explore::Database::Access::create).execute("CREATE TABLE mine(a)");
  refused("other.sqlite", "is a database, but no store of rastertlm");
  ASSERT_EQ(run(run_sweep()).exit_code, 0);
  explore::Database(in_work("s.sqlite"), explore::Database::Access::existing)
      .execute("PRAGMA journal_mode = DELETE; PRAGMA user_version = 7");
  refused("s.sqlite", "the store is of schema 7, and this program reads 2");
  EXPECT_THAT(run({"explore", "show", "none.sqlite"}).err, HasSubstr("no such store"));
}

TEST_F(StoreTest, ADamagedStoreIsRefusedAndLeftAsItIs) {
  write("sweep.toml", grid(20));
  ASSERT_EQ(run(run_sweep()).exit_code, 0);
  {
    explore::Database database(in_work("s.sqlite"), explore::Database::Access::existing);
    database.text("PRAGMA journal_mode = DELETE");
  }
  std::string bytes = file_text(in_work("s.sqlite"));
  for (std::size_t at = 8192; at < bytes.size(); at += 7) bytes[at] = '\x5a';
  write("s.sqlite", bytes);
  const Outcome outcome = run(run_sweep({"--resume"}));
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the store is damaged"));
  EXPECT_EQ(run({"explore", "show", "s.sqlite"}).exit_code, 2);
  EXPECT_TRUE(file_text(in_work("s.sqlite")) == bytes);
}

TEST_F(StoreTest, MergeRefusesStoresOfOtherSweepsAndAnOutThatIsThere) {
  write("sweep.toml", grid(1));
  ASSERT_EQ(run(run_sweep()).exit_code, 0);
  write("other.toml", grid(2));
  ASSERT_EQ(run({"explore", "run", "other.toml", "--store", "o.sqlite"}).exit_code, 0);
  const Outcome other = run({"explore", "merge", "joined.sqlite", "s.sqlite", "o.sqlite"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("o.sqlite: is of another sweep than s.sqlite"));
  EXPECT_EQ(run({"explore", "merge", "s.sqlite", "o.sqlite"}).exit_code, 2);
  EXPECT_EQ(run({"explore", "merge", "joined.sqlite", "none.sqlite"}).exit_code, 2);
  EXPECT_EQ(names().count("joined.sqlite"), 0U);
  EXPECT_THAT(run({"explore", "run", "sweep.toml", "--store", "s.sqlite"}).err,
              HasSubstr("is there already: --resume"));
}

TEST_F(StoreTest, AMillionPointsAreAskedForTwice) {
  write("sweep.toml", sweep("[[vary]]\npath = \"host.link_mbit_per_s\"\nfrom = 1\nto = 1000\nstep = 1\n"
                            "[[vary]]\npath = \"host.link_set_up_cycles\"\nfrom = 0\nto = 999\nstep = 1\n"));
  const Outcome outcome = run(run_sweep({"--jobs", "2"}));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, testing::MatchesRegex(".*the sweep has 1,000,000 points here, about [0-9]+ (minutes|hours) "
                                                 "with 2 jobs.*--yes simulates more than 100,000\n"));
  EXPECT_EQ(names().count("s.sqlite"), 0U);
  // A share of it is small enough.
  EXPECT_EQ(run(run_sweep({"--shard", "1/100000"})).exit_code, 0);
}

TEST_F(StoreTest, AFigureThatNoReportHasStopsTheSweep) {
  write("sweep.toml", grid(30) + "[[objective]]\npath = \"budgets[line_strat].used\"\nsense = \"minimise\"\n");
  const Outcome outcome = run(run_sweep());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("sweep.toml:19: budgets[line_strat].used: the machine's report has no "
                                           "budgets[line_strat]; known: 'line_start', "),
                                 HasSubstr("; nearest: 'line_start'")));
  // What had come is kept, and serves the sweep that is right; so does a figure that was not asked for then.
  const std::size_t kept = results().size();
  EXPECT_GT(kept, 0U);
  write("sweep.toml", grid(30) +
                          "[[objective]]\npath = \"budgets[line_start].used\"\nsense = \"minimise\"\n"
                          "[[objective]]\npath = \"machine.host.link_mbit_per_s\"\nsense = \"minimise\"\n");
  EXPECT_THAT(run(run_sweep({"--resume"})).out, HasSubstr(fmt::format("{} simulated, {} had", 60 - kept, kept)));
  for (const explore::Row& row : table().rows) {
    EXPECT_GT(row.figures.at(2).value_or(0.0), 0.0);
    EXPECT_EQ(row.figures.at(3), std::stod(table().axes[0].values[row.values[0]]));
  }
}

TEST_F(StoreTest, SetGoesBeforeTheSweep) {
  write("sweep.toml",
        sweep("[[vary]]\npath = \"decision_unit.topology\"\nvalues = [\"tree\"]\n", "set.video.lines = 32\n") +
            "[[objective]]\npath = \"video.lines\"\nsense = \"minimise\"\n");
  ASSERT_EQ(run(run_sweep({"--set", "video.lines=16"})).exit_code, 0);
  EXPECT_EQ(table().rows.at(0).figures.at(2), 16.0);
  EXPECT_THAT(run(run_sweep({"--resume", "--set", "video.line=16"})).err,
              HasSubstr("--set: video.line: unknown key 'video.line'; nearest known: 'video.lines'"));
}

}  // namespace
}  // namespace rastertlm::test
