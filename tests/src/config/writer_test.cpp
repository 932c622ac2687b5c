#include "src/config/writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "src/config/reader.h"
#include "src/config/value_text.h"
#include "tests/src/config/sample.h"

namespace rastertlm::config {
namespace {

using sample::Configuration;

Configuration read_back(const std::string& text) {
  Configuration configuration;
  parameter::Table table = parameter::view(configuration);
  Diagnostics diagnostics;
  read(Document::from_text(text, "again.toml"), table, {}, diagnostics, sample::presets());
  diagnostics.throw_if_any();
  return configuration;
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

bool same(const sample::Triple& a, const sample::Triple& b) {
  return bits(a[0]) == bits(b[0]) && bits(a[1]) == bits(b[1]) && bits(a[2]) == bits(b[2]);
}

bool same(const std::vector<sample::Turn>& a, const std::vector<sample::Turn>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const sample::Turn& x, const sample::Turn& y) {
    return bits(x.degrees) == bits(y.degrees) && same(x.axis, y.axis);
  });
}

// Field by field, without the tables under test; what does not apply is not written, and not compared.
bool same(const sample::Thing& a, const sample::Thing& b) {
  return a.shape == b.shape && a.name == b.name &&
         (a.shape != sample::Shape::ball || bits(a.radius) == bits(b.radius)) &&
         (a.shape != sample::Shape::mesh || a.file == b.file) && a.faces == b.faces && same(a.turns, b.turns) &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    [](const auto& x, const auto& y) { return same(x, y); });
}

bool same(const Configuration& a, const Configuration& b) {
  return a.mode == b.mode && a.columns == b.columns && bits(a.refresh) == bits(b.refresh) && a.preset == b.preset &&
         a.clock == b.clock && bits(a.rate) == bits(b.rate) && a.verbose == b.verbose &&
         (a.mode != sample::Mode::exact || a.seed == b.seed) && same(a.colour, b.colour) && a.widths == b.widths &&
         same(a.camera_turns, b.camera_turns) &&
         std::equal(a.things.begin(), a.things.end(), b.things.begin(), b.things.end(),
                    [](const auto& x, const auto& y) { return same(x, y); });
}

rc::Gen<double> finite() {
  return rc::gen::suchThat(
      rc::gen::oneOf(
          rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t b) { return std::bit_cast<double>(b); }),
          rc::gen::arbitrary<double>(), rc::gen::element(0.0, -0.0, 1.0, 1e16, 1e22, 5e-324, 0.1, -1e15)),
      [](double v) { return std::isfinite(v); });
}

std::string some_text() {
  static const std::vector<std::string> pieces{"a",    "\"",   "\\", "'", "\n", "\t", "#",      " ",
                                               "\x01", "\x7f", "é",  "𝄞", "[",  "=",  "\"\"\"", "\r"};
  std::string text;
  for (const std::string& piece : *rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(pieces)))
    text += piece;
  return text;
}

sample::Triple some_triple() { return {*finite(), *finite(), *finite()}; }

std::vector<sample::Turn> some_turns() {
  std::vector<sample::Turn> turns(*rc::gen::inRange<std::size_t>(0, 3));
  for (sample::Turn& turn : turns) turn = {*rc::gen::inRange(-3600, 3601) / 10.0, some_triple()};
  return turns;
}

Configuration some_configuration() {
  Configuration c;
  c.mode = *rc::gen::element(sample::Mode::fast, sample::Mode::exact);
  c.columns = *rc::gen::inRange(1, 16385);
  c.refresh = *rc::gen::inRange(1, 100001) / 100.0;
  c.preset = *rc::gen::element<std::string>("", "slow", "quick");
  c.clock = *rc::gen::inRange(1, 1000000001);
  c.rate = *finite();
  c.verbose = *rc::gen::arbitrary<bool>();
  c.seed = *rc::gen::inRange(0, 256);
  c.colour = {*rc::gen::inRange(0, 8) / 7.0, 0.0, 1.0};
  c.widths = *rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(1, 65));
  c.camera_turns = some_turns();
  c.things.resize(*rc::gen::inRange<std::size_t>(0, 4));
  for (sample::Thing& thing : c.things) {
    thing.shape = *rc::gen::element(sample::Shape::ball, sample::Shape::box, sample::Shape::mesh);
    thing.name = some_text();
    thing.radius = *rc::gen::inRange(1, 9999) / 10.0;
    thing.file = some_text();
    thing.points.resize(*rc::gen::inRange<std::size_t>(0, 8));
    for (auto& point : thing.points) point = some_triple();
    thing.faces.resize(*rc::gen::inRange<std::size_t>(0, 8));
    for (auto& face : thing.faces) face = {*rc::gen::arbitrary<std::int64_t>(), 0, 2};
    thing.turns = some_turns();
  }
  return c;
}

RC_GTEST_PROP(Writer, ReadingBackGivesTheSameValues, ()) {
  Configuration configuration = some_configuration();
  parameter::Table table = parameter::view(configuration);
  RC_ASSERT(same(read_back(resolved_text(table, Origins())), configuration));
  const std::string canonical = canonical_text(table);
  Configuration again = read_back(canonical);
  RC_ASSERT(same(again, configuration));
  parameter::Table table_again = parameter::view(again);
  RC_ASSERT(digest(table_again) == digest(table));
}

TEST(Writer, SaysWhereEachValueCameFrom) {
  Configuration configuration;
  parameter::Table table = parameter::view(configuration);
  Diagnostics diagnostics;
  const std::vector<Override> set = parse_overrides({"video.refresh_hz=60", "thing[0].turn[0].degrees=3"}, diagnostics);
  const Origins origins = read(
      Document::from_text("schema = 1\n[video]\ncolumns = 640\n[[thing]]\nname = 'x'\ntype = 'box'\n[[thing.turn]]\n",
                          "dir/m.toml"),
      table, set, diagnostics, sample::presets());
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(resolved_text(table, origins),
            R"(schema = 1  # dir/m.toml:1
mode = "fast"  # default

[video]
columns = 640  # dir/m.toml:3
refresh_hz = 60.0  # --set

[host]
preset = "slow"  # default
clock_hz = 100  # preset slow
rate = 0.5  # preset slow
verbose = false  # default
# seed has no meaning here: only where mode is 'exact'
widths = [8, 12]  # default

[camera]
colour = [0.25, 0.5, 1.0]  # default
turn = []

[[thing]]
type = "box"  # dir/m.toml:6
name = "x"  # dir/m.toml:5
# radius has no meaning here: only where type is 'ball'
# file has no meaning here: only where type is 'mesh'
points = []  # default
faces = []  # default

[[thing.turn]]
degrees = 3.0  # --set
axis = [0.0, 0.0, 1.0]  # default
)");
}

TEST(Writer, TheDigestIsOfTheValuesAlone) {
  const auto digest_of = [](const std::string& text, const std::vector<std::string>& arguments) {
    Configuration configuration;
    parameter::Table table = parameter::view(configuration);
    Diagnostics diagnostics;
    const std::vector<Override> set = parse_overrides(arguments, diagnostics);
    read(Document::from_text(text, "m.toml"), table, set, diagnostics, sample::presets());
    diagnostics.throw_if_any();
    return digest(table);
  };
  const std::string reference = digest_of("schema = 1\n[video]\ncolumns = 640\n", {});
  EXPECT_EQ(reference.size(), 64U);
  EXPECT_EQ(digest_of("# other\n\n[video]\ncolumns = 3\n", {"video.columns=640"}), reference);
  EXPECT_EQ(digest_of("video.columns = 640\nhost.rate = 0.5\n", {}), reference);
  EXPECT_NE(digest_of("video.columns = 641\n", {}), reference);
  EXPECT_NE(digest_of("video.columns = 640\nhost.preset = 'quick'\n", {}), reference);
}

TEST(Writer, ACommentCannotBreakOutOfItsLine) {
  Configuration configuration;
  parameter::Table table = parameter::view(configuration);
  Origins origins;
  origins.set("video.columns", {OriginKind::file, "bad\nname\xff = 3", 1});
  EXPECT_THAT(resolved_text(table, origins), testing::HasSubstr("columns = 512  # bad?name? = 3:1\n"));
  EXPECT_TRUE(
      same(read_back(resolved_text(table, origins)), read_back("schema = 1\nhost.clock_hz = 1\nhost.rate = 2.5\n")));
}

TEST(ValueText, PrintsRealsAsReals) {
  EXPECT_EQ(to_toml(1.0), "1.0");
  EXPECT_EQ(to_toml(-0.0), "-0.0");
  EXPECT_EQ(to_toml(0.1), "0.1");
  EXPECT_EQ(to_toml(1e300), "1e+300");
  EXPECT_EQ(to_toml(1.0 / 3.0), "0.3333333333333333");
}

TEST(ValueText, KnowsUtf8) {
  EXPECT_TRUE(is_utf8("plain, é, 𝄞"));
  for (const char* bad :
       {"\xff", "\xc3", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf0\x80\x80\x80", "a\x80"})
    EXPECT_FALSE(is_utf8(bad)) << testing::PrintToString(bad);
}

TEST(Origins, FilesAreRelativeToTheFileThatNamesThem) {
  EXPECT_EQ(resolve_path({OriginKind::file, "scenes/a.toml", 3}, "mesh/b.obj"), "scenes/mesh/b.obj");
  EXPECT_EQ(resolve_path({OriginKind::file, "scenes/a.toml", 3}, "../b.obj"), "b.obj");
  EXPECT_EQ(resolve_path({OriginKind::file, "a.toml", 3}, "b.obj"), "b.obj");
  EXPECT_EQ(resolve_path({OriginKind::file, "scenes/a.toml", 3}, "/m/b.obj"), "/m/b.obj");
  EXPECT_EQ(resolve_path({OriginKind::set, "", 0}, "mesh/b.obj"), "mesh/b.obj");
}

}  // namespace
}  // namespace rastertlm::config
