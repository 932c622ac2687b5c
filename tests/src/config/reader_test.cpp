#include "src/config/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

#include "tests/src/config/sample.h"

namespace rastertlm::config {
namespace {

using testing::ElementsAre;

struct Result {
  sample::Configuration configuration;
  Origins origins;
  std::vector<std::string> mistakes;
};

Result read_text(const std::string& text, const std::vector<std::string>& set = {}) {
  Result result;
  Diagnostics diagnostics;
  const std::vector<Override> overrides = parse_overrides(set, diagnostics);
  parameter::Table table = parameter::view(result.configuration);
  result.origins = read(Document::from_text(text, "m.toml"), table, overrides, diagnostics, sample::presets());
  for (const Diagnostic& diagnostic : diagnostics.list()) result.mistakes.push_back(to_string(diagnostic));
  return result;
}

std::vector<std::string> mistakes(const std::string& text, const std::vector<std::string>& set = {}) {
  return read_text(text, set).mistakes;
}

TEST(Reader, SetsEveryKind) {
  const Result r = read_text(
      "schema = 1\nmode = 'exact'\n[video]\ncolumns = 640\nrefresh_hz = 60\n[host]\npreset = ''\nclock_hz = 7\nverbose "
      "= true\nseed = 3\n"
      "widths = [1, 2, 3]\n[camera]\ncolour = [0, 0.5, 1]\n[[thing]]\nname = 'a'\ntype = 'mesh'\nfile = 'a.obj'\n"
      "points = [[0, 1, 2], [3.5, 4, 5]]\nfaces = [[0, 1, 1]]\n");
  EXPECT_THAT(r.mistakes, ElementsAre());
  EXPECT_EQ(r.configuration.mode, sample::Mode::exact);
  EXPECT_EQ(r.configuration.columns, 640);
  EXPECT_EQ(r.configuration.refresh, 60.0);
  EXPECT_EQ(r.configuration.clock, 7);
  EXPECT_TRUE(r.configuration.verbose);
  EXPECT_EQ(r.configuration.seed, 3);
  EXPECT_THAT(r.configuration.widths, ElementsAre(1, 2, 3));
  EXPECT_EQ(r.configuration.colour, (sample::Triple{0, 0.5, 1}));
  ASSERT_EQ(r.configuration.things.size(), 1U);
  EXPECT_EQ(r.configuration.things[0].shape, sample::Shape::mesh);
  EXPECT_EQ(r.configuration.things[0].file, "a.obj");
  EXPECT_THAT(r.configuration.things[0].points, ElementsAre(sample::Triple{0, 1, 2}, sample::Triple{3.5, 4, 5}));
  EXPECT_THAT(r.configuration.things[0].faces, ElementsAre(sample::IndexTriple{0, 1, 1}));
}

TEST(Reader, DefaultThenPresetThenFileThenSet) {
  const Result by_default = read_text("schema = 1\n");
  EXPECT_EQ(by_default.configuration.columns, 512);
  EXPECT_EQ(to_string(by_default.origins.of("video.columns")), "default");
  EXPECT_EQ(by_default.configuration.clock, 100);
  EXPECT_EQ(by_default.configuration.rate, 0.5);
  EXPECT_EQ(to_string(by_default.origins.of("host.clock_hz")), "preset slow");

  const Result by_file = read_text("[host]\nclock_hz = 7\n");
  EXPECT_EQ(by_file.configuration.clock, 7);
  EXPECT_EQ(to_string(by_file.origins.of("host.clock_hz")), "m.toml:2");
  EXPECT_EQ(by_file.configuration.rate, 0.5);

  const Result by_set = read_text("[host]\nclock_hz = 7\n", {"host.clock_hz=8", "host.clock_hz=9", "host.rate=1"});
  EXPECT_EQ(by_set.configuration.clock, 9);
  EXPECT_EQ(by_set.configuration.rate, 1.0);
  EXPECT_EQ(to_string(by_set.origins.of("host.clock_hz")), "--set");

  // The preset itself obeys the same order; what the one chosen does not set keeps its default.
  const Result other = read_text("[host]\npreset = 'quick'\n");
  EXPECT_EQ(other.configuration.clock, 9000);
  EXPECT_EQ(other.configuration.rate, 2.5);
  EXPECT_EQ(read_text("[host]\npreset = 'quick'\n", {"host.preset=slow"}).configuration.clock, 100);
  EXPECT_EQ(read_text("[host]\npreset = ''\n").configuration.clock, 1);
}

TEST(Reader, ListsTheKnownPresets) {
  EXPECT_THAT(
      mistakes("schema = 1\n[host]\npreset = 'quik'\n"),
      ElementsAre(
          "m.toml:3: host.preset: unknown preset 'quik'; known presets of 'host': 'quick', 'slow'; nearest: 'quick'"));
  EXPECT_THAT(mistakes("schema = 1\n", {"host.preset=zzzzzzzzz"}),
              ElementsAre("--set: host.preset: unknown preset 'zzzzzzzzz'; known presets of 'host': 'quick', 'slow'"));
}

// What another machine's table has may stand in a preset (that some machine has it is tested where all are known).
TEST(Reader, ChecksPresetsAsWell) {
  sample::Configuration configuration;
  parameter::Table table = parameter::view(configuration);
  Diagnostics diagnostics;
  read(Document::from_text("schema = 1\n", "m.toml"), table, {}, diagnostics,
       Presets({{"host", {{"slow", "\nclock_hz = 0\nclok = 3\n"}}}}));
  ASSERT_EQ(diagnostics.list().size(), 1U);
  EXPECT_EQ(to_string(diagnostics.list()[0]),
            "preset host/slow:2: host.clock_hz: 0 is out of range: it must be from 1 to 1000000000 Hz");
}

TEST(Reader, RefusesWrongTypes) {
  EXPECT_THAT(
      mistakes("[video]\ncolumns = 1.0\n"),
      ElementsAre(
          "m.toml:2: video.columns: wrong type: expected an integer, found the number 1.0; write 1 without a point"));
  EXPECT_THAT(mistakes("[video]\ncolumns = 1.5\n"),
              ElementsAre("m.toml:2: video.columns: wrong type: expected an integer, found the number 1.5"));
  EXPECT_THAT(mistakes("[video]\ncolumns = 'x'\n"),
              ElementsAre("m.toml:2: video.columns: wrong type: expected an integer, found the text \"x\""));
  EXPECT_THAT(mistakes("[video]\nrefresh_hz = true\n"),
              ElementsAre("m.toml:2: video.refresh_hz: wrong type: expected a number, found true"));
  EXPECT_THAT(mistakes("[host]\nverbose = 1\n"),
              ElementsAre("m.toml:2: host.verbose: wrong type: expected true or false, found the integer 1"));
  EXPECT_THAT(mistakes("[host]\npreset = 1\n"),
              ElementsAre("m.toml:2: host.preset: wrong type: expected text in quotes, found the integer 1"));
  EXPECT_THAT(mistakes("mode = 3\n"),
              ElementsAre("m.toml:1: mode: wrong type: expected text in quotes, found the integer 3"));
  EXPECT_THAT(mistakes("[host]\nwidths = 3\n"),
              ElementsAre("m.toml:2: host.widths: wrong type: expected a list of integers, found the integer 3"));
  EXPECT_THAT(mistakes("[host]\nwidths = [3, 'x']\n"),
              ElementsAre("m.toml:2: host.widths: element [1]: wrong type: expected an integer, found the text \"x\""));
  EXPECT_THAT(mistakes("[host]\nclock_hz = 1979-05-27\n"),
              ElementsAre("m.toml:2: host.clock_hz: wrong type: expected an integer, found a date or a time"));
}

TEST(Reader, RefusesWrongArity) {
  EXPECT_THAT(mistakes("[camera]\ncolour = [0, 1]\n"),
              ElementsAre("m.toml:2: camera.colour: expected three numbers, found 2"));
  EXPECT_THAT(mistakes("[camera]\ncolour = [0, 1, 0, 1]\n"),
              ElementsAre("m.toml:2: camera.colour: expected three numbers, found 4"));
  EXPECT_THAT(mistakes("[[thing]]\nname = 'x'\npoints = [[0, 0, 0], [1, 2]]\nfaces = [[0, 1, 2, 3]]\n"),
              ElementsAre("m.toml:3: thing[0].points: element [1]: expected three numbers, found 2",
                          "m.toml:4: thing[0].faces: element [0]: expected three integers, found 4"));
}

TEST(Reader, StatesTheRangeAndTheUnit) {
  EXPECT_THAT(mistakes("[video]\ncolumns = 0\n"),
              ElementsAre("m.toml:2: video.columns: 0 is out of range: it must be from 1 to 16384 pixels"));
  EXPECT_THAT(mistakes("[video]\ncolumns = 16385\n"),
              ElementsAre("m.toml:2: video.columns: 16385 is out of range: it must be from 1 to 16384 pixels"));
  EXPECT_THAT(mistakes("[video]\ncolumns = 16384\n"), ElementsAre());
  EXPECT_THAT(mistakes("[video]\nrefresh_hz = 0\n"),
              ElementsAre("m.toml:2: video.refresh_hz: 0 is out of range: it must be above 0 and at most 1000 Hz"));
  EXPECT_THAT(mistakes("[camera]\ncolour = [0, 1.25, 0]\n"),
              ElementsAre("m.toml:2: camera.colour: 1.25 is out of range: it must be from 0 to 1"));
  EXPECT_THAT(mistakes("[host]\nwidths = [8, 65]\n"),
              ElementsAre("m.toml:2: host.widths: element [1]: 65 is out of range: it must be from 1 to 64 bits"));
}

TEST(Reader, RefusesWhatIsNotFinite) {
  EXPECT_THAT(mistakes("[host]\nrate = nan\n"), ElementsAre("m.toml:2: host.rate: nan is not a finite number"));
  EXPECT_THAT(mistakes("[host]\nrate = -inf\n"), ElementsAre("m.toml:2: host.rate: -inf is not a finite number"));
  EXPECT_THAT(mistakes("[[thing]]\nname = 'x'\npoints = [[0, inf, 0]]\n"),
              ElementsAre("m.toml:3: thing[0].points: element [0]: inf is not a finite number"));
  EXPECT_THAT(mistakes("schema = 1\n", {"host.rate=nan"}), ElementsAre("--set: host.rate: nan is not a finite number"));
}

TEST(Reader, NamesTheNearestKnownKey) {
  EXPECT_THAT(mistakes("[video]\ncolums = 5\n"),
              ElementsAre("m.toml:2: video.colums: unknown key 'video.colums'; nearest known: 'video.columns'"));
  EXPECT_THAT(mistakes("[[thing]]\nname = 'x'\nradus = 5\n"),
              ElementsAre("m.toml:3: thing[0].radus: unknown key 'thing[0].radus'; nearest known: 'thing[0].radius'"));
  // The right key in the wrong table.
  EXPECT_THAT(mistakes("[host]\ncolumns = 5\n"),
              ElementsAre("m.toml:2: host.columns: unknown key 'host.columns'; nearest known: 'video.columns'"));
  // A key of a list's elements.
  EXPECT_THAT(mistakes("radius = 5\n"),
              ElementsAre("m.toml:1: radius: unknown key 'radius'; known of a list's elements: 'thing[].radius'"));
  // A table or a list by a wrong name is one mistake, whatever is in it.
  EXPECT_THAT(mistakes("[vidoe]\ncolumns = 5\nx = 6\n[vidoe.deep]\ny = 1\n"),
              ElementsAre("m.toml:1: vidoe: unknown key 'vidoe'; nearest known: 'video'"));
  EXPECT_THAT(mistakes("[[thng]]\nname = 'x'\n[[thng]]\nname = 'y'\n"),
              ElementsAre("m.toml:1: thng: unknown key 'thng'; nearest known: 'thing'"));
  // Nothing near.
  EXPECT_THAT(mistakes("[video]\nqqqqqqqqqqqqqqqqqqq = 5\n"),
              ElementsAre("m.toml:2: video.qqqqqqqqqqqqqqqqqqq: unknown key 'video.qqqqqqqqqqqqqqqqqqq'; known here: "
                          "'columns', 'refresh_hz'"));
  EXPECT_THAT(mistakes("\"video.columns\" = 5\n"),
              ElementsAre(testing::StartsWith("m.toml:1: \"video.columns\": unknown key")));
}

TEST(Reader, TellsTablesListsAndValuesApart) {
  EXPECT_THAT(mistakes("video = 3\n"),
              ElementsAre("m.toml:1: video: wrong type: 'video' is a table, [video], found the integer 3"));
  EXPECT_THAT(mistakes("[[video]]\ncolumns = 3\n[[video]]\n"),
              ElementsAre("m.toml:1: video: wrong type: 'video' is one table, [video], found a list of tables"));
  EXPECT_THAT(
      mistakes("[thing]\nname = 'x'\n"),
      ElementsAre("m.toml:1: thing: wrong type: 'thing' is a list of tables, each written [[thing]], found one table"));
  EXPECT_THAT(
      mistakes("thing = [1, 2]\n"),
      ElementsAre(
          "m.toml:1: thing: wrong type: 'thing' is a list of tables, each written [[thing]], found a list of 2"));
  EXPECT_THAT(mistakes("[video.columns]\nx = 1\n"),
              ElementsAre("m.toml:1: video.columns: wrong type: expected an integer, found a table"));
  EXPECT_THAT(mistakes("[[video.columns]]\nx = 1\n[[video.columns]]\n"),
              ElementsAre("m.toml:1: video.columns: wrong type: expected an integer, found a list of tables"));
}

TEST(Reader, ListsTheAcceptedValues) {
  EXPECT_THAT(
      mistakes("mode = 'exat'\n"),
      ElementsAre("m.toml:1: mode: 'exat' is not accepted; accepted values: 'fast', 'exact'; nearest: 'exact'"));
  EXPECT_THAT(mistakes("mode = 'somethingelse'\n"),
              ElementsAre("m.toml:1: mode: 'somethingelse' is not accepted; accepted values: 'fast', 'exact'"));
}

TEST(Reader, SaysWhichTypeAKeyBelongsTo) {
  EXPECT_THAT(
      mistakes("[[thing]]\nradius = 2\nname = 'x'\ntype = 'box'\n"),
      ElementsAre(
          "m.toml:2: thing[0].radius: does not apply: it belongs only where type is 'ball', and here it is 'box'"));
  // The choice may come later, from the default, or from the command line.
  EXPECT_THAT(
      mistakes("[host]\nseed = 2\n"),
      ElementsAre("m.toml:2: host.seed: does not apply: it belongs only where mode is 'exact', and here it is 'fast'"));
  EXPECT_THAT(mistakes("[host]\nseed = 2\n", {"mode=exact"}), ElementsAre());
  EXPECT_THAT(
      mistakes("schema = 1\n", {"host.seed=2"}),
      ElementsAre("--set: host.seed: does not apply: it belongs only where mode is 'exact', and here it is 'fast'"));
  // A choice that was refused explains itself; what hangs on it is not judged.
  EXPECT_THAT(mistakes("mode = 'x'\n[host]\nseed = 2\n"),
              ElementsAre("m.toml:1: mode: 'x' is not accepted; accepted values: 'fast', 'exact'"));
}

TEST(Reader, MissesRequiredKeys) {
  EXPECT_THAT(mistakes("schema = 1\n[[thing]]\ntype = 'mesh'\n"),
              ElementsAre("m.toml:2: thing[0].name: required key is missing: Name.",
                          "m.toml:2: thing[0].file: required key is missing: Mesh file."));
  EXPECT_THAT(mistakes("schema = 1\n[[thing]]\n", {"thing[0].name=x"}), ElementsAre());
  EXPECT_THAT(mistakes("schema = 1\n[[thing]]\nname = 3\n"),
              ElementsAre("m.toml:3: thing[0].name: wrong type: expected text in quotes, found the integer 3"));
}

TEST(Reader, ReportsEverythingInTheOrderOfTheFile) {
  EXPECT_THAT(
      mistakes("[video]\ncolumns = 0\nzz_lines = 3\n[[thing]]\ntype = 'box'\nradius = 1\n[[thing]]\nname = "
               "'b'\n[[thing.turn]]\n"
               "degrees = 720\n[host]\nrate = 'x'\n",
               {"video.refresh_hz=0", "host.rat=1"}),
      ElementsAre(testing::HasSubstr("m.toml:2: video.columns: 0 is out of range"),
                  testing::HasSubstr("m.toml:3: video.zz_lines: unknown key"),
                  testing::HasSubstr("m.toml:4: thing[0].name: required"),
                  testing::HasSubstr("m.toml:6: thing[0].radius: does not apply"),
                  "m.toml:10: thing[1].turn[0].degrees: 720 is out of range: it must be from -360 to 360 degrees",
                  testing::HasSubstr("m.toml:12: host.rate: wrong type"),
                  testing::HasSubstr("--set: video.refresh_hz: 0 is out of range"),
                  "--set: host.rat: unknown key 'host.rat'; nearest known: 'host.rate'"));
}

TEST(Reader, ReadsNestedLists) {
  const Result r = read_text(
      "[[thing]]\nname = 'a'\n[[thing.turn]]\ndegrees = 1\n[[thing.turn]]\ndegrees = 2\naxis = [1, 0, "
      "0]\n[[thing]]\nname = 'b'\n"
      "[[thing]]\nname = 'c'\nturn = [{degrees = 5}]\n[[camera.turn]]\ndegrees = 9\n");
  EXPECT_THAT(r.mistakes, ElementsAre());
  ASSERT_EQ(r.configuration.things.size(), 3U);
  ASSERT_EQ(r.configuration.things[0].turns.size(), 2U);
  EXPECT_EQ(r.configuration.things[0].turns[1].degrees, 2.0);
  EXPECT_EQ(r.configuration.things[0].turns[1].axis, (sample::Triple{1, 0, 0}));
  EXPECT_EQ(r.configuration.things[1].name, "b");
  EXPECT_TRUE(r.configuration.things[1].turns.empty());
  ASSERT_EQ(r.configuration.things[2].turns.size(), 1U);
  EXPECT_EQ(r.configuration.things[2].turns[0].degrees, 5.0);
  ASSERT_EQ(r.configuration.camera_turns.size(), 1U);
  EXPECT_EQ(r.configuration.camera_turns[0].degrees, 9.0);
  EXPECT_EQ(to_string(r.origins.of("thing[0].turn[1].axis")), "m.toml:7");
}

TEST(Reader, AFilesListReplacesTheDefaultOne) {
  for (const auto& [text, size] : std::vector<std::pair<std::string, std::size_t>>{
           {"schema = 1\n", 2}, {"[[camera.turn]]\ndegrees = 4\n", 1}, {"[camera]\nturn = []\n", 0}}) {
    sample::Configuration configuration;
    configuration.camera_turns.resize(2);
    parameter::Table table = parameter::view(configuration);
    Diagnostics diagnostics;
    read(Document::from_text(text, "m.toml"), table, {}, diagnostics, sample::presets());
    EXPECT_TRUE(diagnostics.empty());
    EXPECT_EQ(configuration.camera_turns.size(), size) << text;
  }
}

TEST(Reader, SetsElementsOfListsFromTheCommandLine) {
  const std::string text = "[[thing]]\nname = 'a'\n[[thing.turn]]\n[[thing]]\nname = 'b'\n";
  const Result r = read_text(text, {"thing[0].turn[0].axis=[0, 1, 0.5]", "thing[1].name=it is b", "thing[1].radius=3",
                                    "host.widths=[9]", "host.verbose=true"});
  EXPECT_THAT(r.mistakes, ElementsAre());
  EXPECT_EQ(r.configuration.things[0].turns[0].axis, (sample::Triple{0, 1, 0.5}));
  EXPECT_EQ(r.configuration.things[1].name, "it is b");
  EXPECT_EQ(r.configuration.things[1].radius, 3.0);
  EXPECT_THAT(r.configuration.widths, ElementsAre(9));
  EXPECT_TRUE(r.configuration.verbose);
  EXPECT_THAT(mistakes(text, {"thing[2].name=x"}),
              ElementsAre("--set: thing[2].name: there is no such element: 'thing' has 2, counted from 0"));
  EXPECT_THAT(
      mistakes(text, {"thing[0].turn[1].degrees=1"}),
      ElementsAre("--set: thing[0].turn[1].degrees: there is no such element: 'thing[0].turn' has 1, counted from 0"));
  EXPECT_THAT(mistakes(text, {"thing=1"}),
              ElementsAre("--set: thing: is a list of tables: name an element and a key, as in thing[0].key=value"));
  EXPECT_THAT(mistakes(text, {"thing[0]=1"}),
              ElementsAre("--set: thing[0]: is an element of a list: name a key of it, as in thing[0].key=value"));
  EXPECT_THAT(mistakes(text, {"video=1"}),
              ElementsAre("--set: video: is a table: name a key of it, as in video.key=value"));
  EXPECT_THAT(mistakes(text, {"thing[x].name=1", "thing[99999999999999999999].name=1", "thing[-1].name=1"}).size(), 3U);
}

TEST(Reader, TakesTextWithoutQuotesFromTheCommandLine) {
  const std::string text = "[[thing]]\nname = 'a'\n";
  for (const auto& [given, name] : std::vector<std::pair<std::string, std::string>>{{"plain", "plain"},
                                                                                    {"\"in quotes\"", "in quotes"},
                                                                                    {"'12'", "12"},
                                                                                    {"12", "12"},
                                                                                    {"true", "true"},
                                                                                    {"1.50", "1.50"},
                                                                                    {"a=b", "a=b"},
                                                                                    {"", ""}})
    EXPECT_EQ(read_text(text, {"thing[0].name=" + given}).configuration.things[0].name, name);
  EXPECT_THAT(mistakes(text, {"video.columns=abc"}),
              ElementsAre("--set: video.columns: wrong type: expected an integer, found the text \"abc\""));
  EXPECT_THAT(mistakes(text, {"host.widths=[1, 2"}), ElementsAre("--set: host.widths: '[1, 2' is not a valid value"));
  EXPECT_THAT(mistakes(text, {"nothing"}), ElementsAre("--set: 'nothing' is not of the form path=value"));
  EXPECT_THAT(mistakes(text, {"=3"}), ElementsAre("--set: '=3' is not of the form path=value"));
  EXPECT_THAT(mistakes(text, {"thing[0].name=\xff"}),
              ElementsAre("--set: thing[0].name: the value is not valid UTF-8"));
}

RC_GTEST_PROP(ReaderFuzz, AnyKeysAndValuesAreReadOrRefused, ()) {
  static const std::vector<std::string> words{"thing",   "video",  "host",   "preset", "camera", "turn", "name",
                                              "columns", "colour", "widths", "mode",   "points", "seed", "type",
                                              "axis",    "zzz",    "[0]",    "[1]",    "[",      "]"};
  static const std::vector<std::string> values{
      "1",           "0",  "1.0",  "nan", "true",     "'fast'",  "[]",      "[1]",        "[0, 1, 0]",
      "[[1, 2, 3]]", "{}", "[{}]", "''",  "[[[[]]]]", "[1, {}]", "'quick'", "1979-05-27", "9223372036854775807"};
  const auto word = rc::gen::elementOf(words);
  const auto key_word =
      rc::gen::elementOf(std::vector<std::string>(words.begin(), words.end() - 4));  // TOML takes these bare
  std::string text;
  const int lines = *rc::gen::inRange(1, 8);
  for (int i = 0; i < lines; ++i) {
    std::string key = *key_word;
    for (int depth = *rc::gen::inRange(0, 3); depth > 0; --depth) {
      key += '.';
      key += *key_word;
    }
    switch (*rc::gen::inRange(0, 4)) {
      case 0:
        text += "[" + key + "]\n";
        break;
      case 1:
        text += "[[" + key + "]]\n";
        break;
      default:
        text += key + " = " + *rc::gen::elementOf(values) + "\n";
    }
  }
  std::vector<std::string> set;
  const int count = *rc::gen::inRange(0, 3);
  set.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) set.push_back(*word + *word + "." + *word + "=" + *rc::gen::elementOf(values));
  try {
    for (const std::string& mistake : mistakes(text, set)) RC_ASSERT(mistake.find('\n') == std::string::npos);
  } catch (const InputError& error) {
    RC_ASSERT(error.diagnostics().size() == 1U);  // of the document: not TOML
  }
}

}  // namespace
}  // namespace rastertlm::config
