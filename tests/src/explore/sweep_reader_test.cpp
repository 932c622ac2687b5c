// Sweep files: what they mean, and what is said of those that are wrong.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "src/base/errors.h"
#include "src/explore/constraint.h"
#include "src/explore/design.h"
#include "src/explore/sweep.h"

namespace rastertlm::explore {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class SweepTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "rastertlm_sweep_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // A sweep of the default machine and scene. Line 1 is the schema, 2 the machine, 3 the scene; `text` begins on 4.
  std::string written(const std::string& text, const std::string& objective = kObjective) const {
    const std::string source = RASTERTLM_SOURCE_DIR;
    std::string file = folder_ + "/sweep.toml";
    std::ofstream(file) << fmt::format(
        "schema = 1\nmachine = \"{0}/configs/machines/imogene.toml\"\nscene = "
        "\"{0}/configs/scenes/teapot.toml\"\n{1}{2}",
        source, text, objective);
    return file;
  }
  Sweep read(const std::string& text, const std::string& objective = kObjective) const {
    return read_sweep(written(text, objective));
  }
  // What is said, without the folder.
  std::string mistake(const std::string& text, const std::string& objective = kObjective) const {
    try {
      Sweep sweep = read(text, objective);
      const Design design(sweep);
      return "";
    } catch (const InputError& error) {
      std::string said = error.what();
      for (std::size_t at = said.find(folder_); at != std::string::npos; at = said.find(folder_))
        said.erase(at, folder_.size() + 1);
      return said;
    }
  }
  static std::vector<std::string> texts(const Vary& axis) {
    std::vector<std::string> texts;
    for (const Choice& choice : axis.choices) texts.push_back(choice.text);
    return texts;
  }
  static std::string vary(const std::string& path, const std::string& what) {
    return fmt::format("[[vary]]\npath = \"{}\"\n{}\n", path, what);
  }

  static constexpr const char* kObjective = "[[objective]]\npath = \"answer.frame_rate_hz\"\nsense = \"maximise\"\n";
  std::string folder_;
};

const char* const kUnits = "host.computation_units";

TEST_F(SweepTest, RangesHaveBothEnds) {
  const auto values = [&](const std::string& path, const std::string& range) {
    return texts(read(vary(path, range)).axes.at(0));
  };
  EXPECT_THAT(values(kUnits, "from = 1\nto = 7\nstep = 2"), ElementsAre("1", "3", "5", "7"));
  EXPECT_THAT(values(kUnits, "from = 1\nto = 8\nstep = 3"), ElementsAre("1", "4", "7"));
  EXPECT_THAT(values(kUnits, "from = 1\nto = 16\nfactor = 2"), ElementsAre("1", "2", "4", "8", "16"));
  EXPECT_THAT(values(kUnits, "from = 2\nto = 10\ncount = 3"), ElementsAre("2", "6", "10"));
  EXPECT_THAT(values(kUnits, "from = 1\nto = 3\ncount = 9"), ElementsAre("1", "2", "3"));  // each once
  EXPECT_THAT(values("host.link_mbit_per_s", "from = 0.1\nto = 0.5\nstep = 0.1"),
              ElementsAre("0.1", "0.2", "0.3", "0.4", "0.5"));
  EXPECT_THAT(values("host.link_mbit_per_s", "from = 1.0\nto = 100.0\ncount = 3\nspacing = \"log\""),
              ElementsAre("1.0", "10.0", "100.0"));
}

TEST_F(SweepTest, AGridHasEveryCombinationOnce) {
  Sweep sweep =
      read(vary(kUnits, "values = [4, 8, 16]") + vary("decision_unit.topology", "values = [\"tree\", \"pipeline\"]"));
  const Design design(sweep);
  ASSERT_EQ(design.size(), 6U);
  std::set<std::vector<std::size_t>> points;
  for (std::uint64_t number = 0; number < 6; ++number) points.insert(design.point(number));
  EXPECT_EQ(points.size(), 6U);
  EXPECT_THAT(design.point(1), ElementsAre(0U, 1U));  // the last axis is the quickest
  // The machine file has 8 units and a tree.
  ASSERT_TRUE(design.baseline());
  EXPECT_THAT(design.point(*design.baseline()), ElementsAre(1U, 0U));
  EXPECT_EQ(sweep.axes[0].unit, "units");
}

TEST_F(SweepTest, OneAtATimeLeavesTheBaselineInOneParameter) {
  Sweep sweep =
      read("mode = \"one_at_a_time\"\n" + vary(kUnits, "values = [2, 8, 16]") +
           vary("host.link_mbit_per_s", "values = [5.0, 10.0]") + "[baseline]\n\"host.link_mbit_per_s\" = 10\n");
  const Design design(sweep);
  ASSERT_EQ(design.size(), 4U);
  ASSERT_EQ(design.baseline(), 0U);
  const std::vector<std::size_t> baseline = design.point(0);
  EXPECT_EQ(sweep.axes[0].choices[baseline[0]].text, "8");  // the machine file's
  EXPECT_EQ(sweep.axes[1].choices[baseline[1]].text, "10.0");
  std::set<std::vector<std::size_t>> points{baseline};
  for (std::uint64_t number = 1; number < 4; ++number) {
    const std::vector<std::size_t> point = design.point(number);
    EXPECT_EQ((point[0] != baseline[0]) + (point[1] != baseline[1]), 1) << number;
    points.insert(point);
  }
  EXPECT_EQ(points.size(), 4U);
}

TEST_F(SweepTest, ALatinHypercubeHasOnePointInEveryStratum) {
  constexpr std::size_t kPoints = 50;
  const std::string text = fmt::format("mode = \"latin_hypercube\"\npoints = {}\nseed = 3\n", kPoints) +
                           vary("host.link_mbit_per_s", "from = 10.0\nto = 60.0") +
                           vary("host.sustained_mflops", "from = 1.0\nto = 32.0\nspacing = \"log\"") +
                           vary("decision_unit.topology", "values = [\"tree\", \"pipeline\"]");
  Sweep sweep = read(text);
  const Design design(sweep);
  ASSERT_EQ(design.size(), kPoints);
  std::set<int> linear;
  std::set<int> logarithmic;
  std::size_t trees = 0;
  for (std::uint64_t number = 0; number < kPoints; ++number) {
    const std::vector<std::size_t> point = design.point(number);
    linear.insert(static_cast<int>(std::stod(sweep.axes[0].choices[point[0]].text) - 10.0));
    logarithmic.insert(static_cast<int>(std::log2(std::stod(sweep.axes[1].choices[point[1]].text)) * 10.0));
    trees += point[2] == 0 ? 1 : 0;
  }
  EXPECT_EQ(linear.size(), kPoints);
  EXPECT_EQ(logarithmic.size(), kPoints);
  EXPECT_EQ(trees, kPoints / 2);
  // The same seed draws the same, another another.
  Sweep again = read(text);
  Sweep other = read(text + "");
  other.seed = 4;
  const Design same(again);
  const Design different(other);
  EXPECT_EQ(texts(again.axes[0]), texts(sweep.axes[0]));
  EXPECT_EQ(same.point(7), design.point(7));
  EXPECT_NE(texts(other.axes[0]), texts(sweep.axes[0]));
}

TEST_F(SweepTest, RandomPointsStayInTheirRanges) {
  Sweep sweep = read("mode = \"random\"\npoints = 200\n" + vary(kUnits, "from = 2\nto = 5") + "[baseline]\n\"" +
                     kUnits + "\" = 9\n");
  const Design design(sweep);
  ASSERT_EQ(design.size(), 201U);
  EXPECT_EQ(sweep.axes[0].choices[design.point(0)[0]].text, "9");
  std::vector<int> drawn(10, 0);
  for (std::uint64_t number = 1; number < design.size(); ++number)
    ++drawn.at(static_cast<std::size_t>(std::stoi(sweep.axes[0].choices[design.point(number)[0]].text)));
  // Four values of equal share: 50 each, give or take five standard deviations.
  for (std::size_t value = 2; value <= 5; ++value) EXPECT_NEAR(drawn[value], 50, 31) << value;
  EXPECT_EQ(drawn[2] + drawn[3] + drawn[4] + drawn[5], 200);
}

TEST_F(SweepTest, TheBaselineAmongDrawnValuesIsOneOfThem) {
  Sweep sweep = read(fmt::format("mode = \"random\"\npoints = 100\n{}[baseline]\n\"{}\" = 3\n",
                                 vary(kUnits, "from = 2\nto = 5"), kUnits));
  const Design design(sweep);
  EXPECT_THAT(texts(sweep.axes[0]), ElementsAre("3", "2", "4", "5"));
  std::set<std::size_t> used;
  for (std::uint64_t number = 0; number < design.size(); ++number) used.insert(design.point(number)[0]);
  EXPECT_EQ(used.size(), 4U);
}

TEST_F(SweepTest, VariantsSetSeveralParametersTogether) {
  const Sweep sweep = read(
      "[[vary]]\nname = \"loader\"\nvariant = [ { name = \"sequencer\", set = { loader.kind = \"sequencer\", "
      "loader.when = "
      "\"retrace\" } }, { name = \"68000s\", set = { loader.kind = \"mc68000\", loader.when = \"frame\" } } ]\n");
  const Vary& axis = sweep.axes.at(0);
  EXPECT_THAT(texts(axis), ElementsAre("sequencer", "68000s"));
  ASSERT_EQ(axis.choices[0].sets.size(), 2U);
  EXPECT_EQ(axis.start, 1U);  // as the machine file has it
}

TEST_F(SweepTest, NamesFileLineKeyAndTheNearestKnown) {
  EXPECT_THAT(mistake(vary("host.computation_unit", "values = [1, 2]")),
              HasSubstr("sweep.toml:5: vary[0].path: unknown key 'host.computation_unit'; nearest known: "
                        "'host.computation_units'"));
  EXPECT_THAT(mistake(vary("camera.vertical_fov", "values = [1, 2]")),
              HasSubstr("nearest known: 'camera.vertical_fov_deg'"));
  EXPECT_THAT(mistake(vary("decision_unit.topology", "values = [\"tree\", \"pipelin\"]")),
              AllOf(HasSubstr("sweep.toml:5: "), HasSubstr("nearest: 'pipeline'")));
  EXPECT_THAT(mistake(vary("host.preset", "values = [\"t800_20\", \"t800_3\"]")), HasSubstr("nearest: 't800_30'"));
  EXPECT_THAT(
      mistake(vary(kUnits, "values = [1, 2]"), "[[objective]]\npath = \"answer.frame_rate\"\nsense = \"maximise\"\n"),
      HasSubstr("sweep.toml:8: objective[0].path: unknown figure 'answer.frame_rate'; nearest: "
                "'answer.frame_rate_hz'"));
  EXPECT_THAT(mistake("set.video.colums = 3\n" + vary(kUnits, "values = [1, 2]")),
              HasSubstr("sweep.toml:4: set.video.colums: unknown key 'video.colums'; nearest known: 'video.columns'"));
  EXPECT_THAT(mistake("fames = 2\n" + vary(kUnits, "values = [1, 2]")), HasSubstr("sweep.toml:4: fames: unknown key"));
  EXPECT_THAT(mistake("constraints = [\"answer.sustaind\"]\n" + vary(kUnits, "values = [1, 2]")),
              HasSubstr("sweep.toml:4: constraints: unknown figure 'answer.sustaind'; nearest: 'answer.sustained'"));
  EXPECT_THAT(mistake(vary(kUnits, "values = [1, 2]") + "[baseline]\n\"host.computation_unts\" = 1\n"),
              HasSubstr("does not vary; nearest: 'host.computation_units'"));
}

TEST_F(SweepTest, RefusesEmptyAndContradictoryGrids) {
  EXPECT_THAT(mistake(""), HasSubstr("vary: nothing varies"));
  EXPECT_THAT(mistake(vary(kUnits, "values = []")), HasSubstr("the grid is empty"));
  EXPECT_THAT(mistake(vary(kUnits, "from = 5\nto = 2\nstep = 1")), HasSubstr("the range is empty: from 5 to 2"));
  EXPECT_THAT(mistake(vary(kUnits, "from = 1\nto = 2\nstep = 1\ncount = 4")), HasSubstr("contradict each other"));
  EXPECT_THAT(mistake(vary(kUnits, "from = 1\nto = 2")), HasSubstr("a range needs a step, a factor or a count"));
  EXPECT_THAT(mistake(vary(kUnits, "from = 1\nto = 2\nstep = 0.5")), HasSubstr("whole numbers"));
  EXPECT_THAT(mistake(vary(kUnits, "values = [1]\nfrom = 1\nto = 2")), HasSubstr("contradict each other: give one"));
  EXPECT_THAT(mistake(vary(kUnits, "")), HasSubstr("nothing to vary it over"));
  EXPECT_THAT(mistake(vary(kUnits, "values = [2, 2]")), HasSubstr("the value 2 stands there twice"));
  EXPECT_THAT(mistake(vary(kUnits, "values = [1, 2]") + vary(kUnits, "values = [3, 4]")), HasSubstr("two of them are"));
  EXPECT_THAT(mistake("set.host.computation_units = 2\n" + vary(kUnits, "values = [1, 2]")),
              HasSubstr("host.computation_units: set and vary 'host.computation_units' contradict each other"));
  EXPECT_THAT(mistake(vary(kUnits, "values = [1, 2]") + "[baseline]\n\"host.computation_units\" = 3\n"),
              HasSubstr("3 is not among the values that vary: 1, 2"));
  EXPECT_THAT(mistake("mode = \"random\"\n" + vary(kUnits, "values = [1, 2]")),
              HasSubstr("points: required key is missing"));
  EXPECT_THAT(mistake(vary(kUnits, "values = [1, 2]"), ""), HasSubstr("objective: nothing counts"));
  EXPECT_THAT(mistake(vary("host.link_mbit_per_s", "from = 1\nto = 12000\nstep = 1") +
                      vary("host.sustained_mflops", "from = 1\nto = 12000\nstep = 1") +
                      vary("host.clock_hz", "from = 1001\nto = 13000\nstep = 1")),
              HasSubstr("the grid has more than 1000000000000 points"));
}

TEST_F(SweepTest, SaysEverythingThatIsWrongAtOnce) {
  const std::string said = mistake(vary("host.nonsense_here", "values = [1]") + vary(kUnits, "values = [0]"),
                                   "[[objective]]\npath = \"answer.nonsense\"\nsense = \"most\"\n");
  EXPECT_THAT(said, AllOf(HasSubstr("host.nonsense_here"), HasSubstr("0 is out of range"), HasSubstr("answer.nonsense"),
                          HasSubstr("'most' is not accepted")));
}

TEST_F(SweepTest, NamesTheNearestOfAllKeysOfASweep) {
  const std::string good = vary(kUnits, "values = [1, 2]");
  EXPECT_THAT(mistake("contraints = [\"answer.sustained\"]\n" + good),
              HasSubstr("sweep.toml:4: contraints: unknown key 'contraints'; nearest known: 'constraints'"));
  EXPECT_THAT(mistake("foo = 3\n" + good),
              AllOf(HasSubstr("sweep.toml:4: foo: unknown key 'foo'; known here: "), HasSubstr("'machine'"),
                    HasSubstr("'scene'"), HasSubstr("'constraints'"), HasSubstr("'set'"), HasSubstr("'baseline'"),
                    HasSubstr("'objective'")));
  EXPECT_THAT(mistake(good + "[basline]\nx = 1\n"), HasSubstr("nearest known: 'baseline'"));
}

TEST_F(SweepTest, RefusesFiguresThatCannotBeCompared) {
  const std::string good = vary(kUnits, "values = [1, 2]");
  const auto wants = [](const std::string& path) {
    return fmt::format("[[objective]]\npath = \"{}\"\nsense = \"maximise\"\n", path);
  };
  EXPECT_THAT(mistake(good, wants("answer.bottleneck.unit")),
              HasSubstr("sweep.toml:8: objective[0].path: 'answer.bottleneck.unit' is text, no number"));
  EXPECT_THAT(mistake(good, wants("images[0].error")), HasSubstr("is a table, no number"));
  EXPECT_THAT(mistake(good, wants("machine.host.preset")), HasSubstr("'machine.host.preset' is no number"));
  EXPECT_EQ(mistake(good, wants("answer.sustained")), "");
  EXPECT_THAT(mistake("reference = false\n" + good, wants("max(images[].error.rmse_level)")),
              HasSubstr("with reference = false no error is measured"));
  EXPECT_THAT(mistake("constraints = [\"answer.headroom\"]\n" + good),
              HasSubstr("sweep.toml:4: constraints: 'answer.headroom' is no truth that could stand alone"));
  EXPECT_EQ(mistake("constraints = [\"answer.sustained\", \"answer.headroom > 0\"]\n" + good), "");
  EXPECT_THAT(mistake("constraints = [\"answer.bottleneck.unit = 1\"]\n" + good), HasSubstr("is text, no number"));
}

const char* const kCurves =
    "[[vary]]\nname = \"loader\"\nvariant = [ { name = \"one\", curve = \"c\", set = { loader.kind = \"sequencer\", "
    "loader.when = \"retrace\" } }, { name = \"two\", set = { loader.kind = \"mc68000\", loader.when = \"frame\" } } "
    "]\n";

TEST_F(SweepTest, FiguresMayHaveNamesAndStandBesideTheObjectives) {
  const Sweep sweep = read(vary(kUnits, "values = [1, 2]") +
                               "[[column]]\npath = \"answer.headroom\"\n[[column]]\npath = \"budgets[x].used\"\nname = "
                               "\"x\"\noptional = true\n",
                           "[[objective]]\npath = \"images[0].error.rmse_level\"\nname = \"RMSE\"\nsense = "
                           "\"minimise\"\nscale = \"log\"\n");
  EXPECT_EQ(sweep.objectives.at(0).name, "RMSE");
  EXPECT_TRUE(sweep.objectives.at(0).logarithmic);
  ASSERT_EQ(sweep.further.size(), 2U);
  EXPECT_EQ(sweep.further[0].path, "answer.headroom");
  EXPECT_EQ(sweep.further[0].unit, "fraction");
  EXPECT_EQ(sweep.further[1].name, "x");
  EXPECT_FALSE(sweep.written_further[0].optional);
  EXPECT_TRUE(sweep.written_further[1].optional);
  EXPECT_EQ(sweep.written_further[1].line, 10);
}

TEST_F(SweepTest, NamesWhatIsWrongWithAColumn) {
  const auto said = [&](const std::string& column) {
    return mistake(vary(kUnits, "values = [1, 2]") + "[[column]]\n" + column);
  };
  EXPECT_EQ(said("path = \"answer.headroom\"\n"), "");
  EXPECT_THAT(said("path = \"answer.headrom\"\n"),
              HasSubstr("sweep.toml:8: column[0].path: unknown figure 'answer.headrom'; nearest: 'answer.headroom'"));
  EXPECT_THAT(said("path = \"answer.frame_rate_hz\"\n"), HasSubstr("column[0].path: stands there twice"));
  EXPECT_THAT(said("path = \"machine.host.links_availabel\"\n"), HasSubstr("nearest known: 'host.links_available'"));
  EXPECT_THAT(said("path = \"answer.bottleneck.unit\"\n"), HasSubstr("is text, no number"));
  EXPECT_THAT(said("name = \"x\"\n"), HasSubstr("column[0].path: required key is missing"));
  EXPECT_THAT(said("path = \"answer.headroom\"\nnme = \"x\"\n"), HasSubstr("nearest known: 'column[0].name'"));
  EXPECT_THAT(
      said("path = \"answer.headroom\"\nname = \"x\"\n[[column]]\npath = \"answer.torn_frames\"\nname = \"x\"\n"),
      HasSubstr("sweep.toml:12: column[1].name: 'x' is another figure's name"));
  EXPECT_THAT(mistake("[[colum]]\npath = \"answer.headroom\"\n" + vary(kUnits, "values = [1, 2]")),
              HasSubstr("unknown key 'colum'; nearest known: 'column'"));
}

TEST_F(SweepTest, AxesMayBeGiven) {
  const std::string two =
      vary(kUnits, "values = [4, 8]") + vary("decision_unit.topology", "values = [\"tree\", \"pipeline\"]");
  const Sweep sweep = read("given = [\"decision_unit.topology\"]\n" + two);
  EXPECT_FALSE(sweep.axes.at(0).given);
  EXPECT_TRUE(sweep.axes.at(1).given);
  EXPECT_THAT(
      mistake("given = [\"decision_unit.topolgy\"]\n" + two),
      HasSubstr("sweep.toml:4: given: 'decision_unit.topolgy' does not vary; nearest: 'decision_unit.topology'"));
  EXPECT_THAT(mistake("given = [\"decision_unit.topology\", \"decision_unit.topology\"]\n" + two),
              HasSubstr("given: 'decision_unit.topology' stands there twice"));
  EXPECT_THAT(mistake("given = [\"host.computation_units\", \"decision_unit.topology\"]\n" + two),
              HasSubstr("sweep.toml:4: given: everything that varies is given"));
  EXPECT_THAT(mistake("given = 3\n" + two), HasSubstr("wrong type: expected text, or a list of texts"));
}

// One that names no curve is one by itself, where another does.
TEST_F(SweepTest, VariantsMayBePointsOfACurve) {
  const Vary axis = read(kCurves).axes.at(0);
  EXPECT_EQ(axis.choices.at(0).curve, "c");
  EXPECT_EQ(axis.choices.at(1).curve, "two");
  std::string none = kCurves;
  none.replace(none.find("curve = \"c\", "), 13, "");
  EXPECT_EQ(read(none).axes.at(0).choices.at(1).curve, "");
  std::string wrong = kCurves;
  wrong.replace(wrong.find("curve = \"c\""), 11, "curve = 3");
  EXPECT_THAT(mistake(wrong),
              HasSubstr("vary[0].variant[0].curve: unknown key; a variant has a name and a curve, texts"));
}

// Once, and not also that the axis has no start.
TEST_F(SweepTest, SaysOnceWhatIsWrongWithABaseline) {
  const std::string said = mistake(vary(kUnits, "values = [2, 4]") + "[baseline]\n\"host.computation_units\" = 3\n");
  EXPECT_THAT(said, HasSubstr("3 is not among the values that vary: 2, 4"));
  EXPECT_THAT(said, testing::Not(HasSubstr("has no value for")));
}

TEST_F(SweepTest, SaysHowElementsAreWrittenAndWhatIsTooLarge) {
  const auto set = [&](const std::string& argument) {
    try {
      read_sweep(written(vary(kUnits, "values = [1, 2]")), {argument});
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(set("object.0.segments=3"), HasSubstr("an element of a list is written 'object[0].segments'"));
  EXPECT_THAT(set("host.processors_per_unit=99999999999999999999"),
              HasSubstr("99999999999999999999 is out of range: it does not fit 64 bits"));
}

TEST_F(SweepTest, NamesMachinesAndScenesThatAreNotThere) {
  const std::string file = folder_ + "/lost.toml";
  std::ofstream(file) << "schema = 1\nmachine = \"none.toml\"\nscene = \"nor_this.toml\"\n" << kObjective;
  try {
    read_sweep(file);
    ADD_FAILURE() << "read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("none.toml: no such file"), HasSubstr("nor_this.toml: no such file")));
  }
}

TEST(Constraint, ComparesAFigure) {
  const auto met = [](const std::string& text, const std::optional<double>& figure) {
    return meets(std::get<Constraint>(parse_constraint(text)), figure);
  };
  EXPECT_TRUE(met("answer.sustained", 1.0));
  EXPECT_FALSE(met("answer.sustained", 0.0));
  EXPECT_TRUE(met("answer.sustained = false", 0.0));
  EXPECT_TRUE(met("answer.headroom >= 0.1", 0.1));
  EXPECT_FALSE(met("answer.headroom > 0.1", 0.1));
  EXPECT_TRUE(met("answer.headroom<=0.1", 0.1));
  EXPECT_FALSE(met("answer.headroom != 2", 2.0));
  EXPECT_TRUE(met("sum(logic[unit=pins].count) < 5", 4.0));
  EXPECT_FALSE(met("answer.headroom < 5", std::nullopt));
  EXPECT_THAT(std::get<std::string>(parse_constraint("answer.headroom < big")), HasSubstr("'big', which is no number"));
  EXPECT_THAT(std::get<std::string>(parse_constraint("sum(memories[].bits) < 5")), HasSubstr("unknown figure"));
}

}  // namespace
}  // namespace rastertlm::explore
