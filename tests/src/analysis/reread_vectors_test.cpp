// Do the files alone give the picture? A program that shares nothing with the model recomputes every pixel of
// decision.csv from the loading RAMs' words, and every pixel of rgb.csv from decision.csv and the tables. And does it
// notice a single wrong digit?
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "tests/src/analysis/vectors_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;

class RereadVectorsTest : public VectorsTest {
 protected:
  void same(const std::string& machine, const std::string& scene, const std::vector<std::string>& set = {},
            const std::vector<std::string>& more = {}) {
    const Outcome written = vectors(machine, scene, set, more);
    ASSERT_EQ(written.exit_code, 0) << written.err;
    const Outcome read = reread();
    EXPECT_EQ(read.exit_code, 0) << read.err;
    EXPECT_THAT(read.out, HasSubstr("decision.csv and rgb.csv are what the words and tables give"));
  }
};

// Two lights, three materials; the sphere is behind the triangle that cuts it.
const std::string kRichScene = R"(schema = 1
background = [10, 20, 200]
[camera]
eye = [0.0, -10.0, 2.0]
target = [0.0, 0.0, 0.0]
[[light]]
towards = [0.5, -0.6, 1.0]
intensity = [0.6, 0.5, 0.4]
[[light]]
towards = [-1.0, -0.2, -0.3]
intensity = [0.1, 0.5, 0.6]
[[material]]
name = "glaze"
colour = [0.9, 0.5, 0.2]
[[material]]
name = "slate"
colour = [0.3, 0.4, 0.6]
specular = 0.2
exponent = 5
[[material]]
name = "clay"
exponent = 50
[[object]]
type = "uv_sphere"
material = "slate"
radius = 2.0
slices = 12
stacks = 8
[[object]]
type = "triangles"
material = "clay"
two_sided = true
positions = [[-3.0, -3.0, -1.0], [3.0, 1.0, -1.0], [0.0, 0.0, 2.5]]
)";

TEST_F(RereadVectorsTest, TeapotFrame0) {
  same(kShippedMachine, kShippedTeapot);
  EXPECT_EQ(number("frame"), 0U);
  EXPECT_EQ(number("edge_fraction_bits"), 5U) << "all on screen";
}

TEST_F(RereadVectorsTest, TeapotLater) {
  same(kShippedMachine, kShippedTeapot, {}, {"--frame", "5"});
  EXPECT_EQ(number("frame"), 5U);
  EXPECT_EQ(number("animation_frame"), 5U);
}

TEST_F(RereadVectorsTest, OtherWidths) {
  same(kShippedMachine, kShippedTeapot, {"object_processor.word_bits=28", "object_processor.normal_bits=10"});
  EXPECT_EQ(number("normal_fraction_bits"), 26U);
  EXPECT_EQ(text_of("parked_ep0.hex"), "0000000\n0000000\nfffffff\n");
}

TEST_F(RereadVectorsTest, Pipeline) { same(kShippedMachine, kShippedTeapot, {"decision_unit.topology=pipeline"}); }

// Some of the hosts are late, and loading RAMs are copied ready or not: boards show two frames at once.
TEST_F(RereadVectorsTest, TornPicture) {
  same(kShippedMachine, kShippedTeapot, {"host.sustained_mflops=1.33", "host.swap=unconditional"}, {"--frame", "1"});
  EXPECT_GT(number("words_ahead"), 0U);
  EXPECT_THAT(text_of("README.md"), HasSubstr("This picture is torn"));
}

// Each field is a picture of its own of every second line, with words of its own.
TEST_F(RereadVectorsTest, Fields) {
  write("machine.toml", kSmallMachine);
  write("scene.toml", kRichScene + "[[object.animation]]\ntype = \"spin\"\ndeg_per_frame = 20.0\n");
  const std::vector<std::string> interlaced{"video.interlaced=true", "host.processors_per_unit=64", "shading.lights=2"};
  std::set<std::string> pictures;
  for (const char* field : {"0", "1"}) {
    same("machine.toml", "scene.toml", interlaced, {"--frame", "1", "--field", field});
    EXPECT_EQ(number("field"), std::stoul(field));
    EXPECT_EQ(number("animation_frame"), 2 + std::stoul(field)) << "the animation goes on a field at a time";
    std::size_t rows = 0;
    for_each_row("decision.csv", [&](const std::vector<std::string>& row) {
      EXPECT_EQ(std::stoul(row[0]), 2 * (rows++ / 64) + std::stoul(field));
    });
    EXPECT_EQ(rows, 64U * 24U);
    EXPECT_THAT(text_of("README.md"), HasSubstr(std::string("field ") + field));
    pictures.insert(text_of("index.csv"));
  }
  EXPECT_EQ(pictures.size(), 2U);
}

// The camera so near that triangles leave the screen and the depth range: clipped to the guard band, in pieces.
TEST_F(RereadVectorsTest, ClippedToTheGuardBand) {
  same(kShippedMachine, kShippedTeapot, {"camera.eye=[0.0, -3.5, 2.2]"});
  EXPECT_EQ(number("edge_fraction_bits"), 3U);
}

TEST_F(RereadVectorsTest, SmallMachineWithEverythingElseDifferent) {
  write("machine.toml", kSmallMachine);
  write("scene.toml", kRichScene);
  const std::vector<std::string> room{"host.processors_per_unit=64", "shading.lights=2"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), room.begin(), room.end());
    return more;
  };
  same("machine.toml", "scene.toml", room);
  same("machine.toml", "scene.toml", with({"shading.arithmetic=literal", "shading.specular_tables=3"}));
  same("machine.toml", "scene.toml", with({"shading.level_bits=5", "shading.materials=3", "shading.lights=3"}));
  same("machine.toml", "scene.toml", with({"object_processor.edges=scaled", "object_processor.word_bits=20"}));
  same("machine.toml", "scene.toml", with({"object_processor.word_bits=32", "object_processor.normal_bits=16"}));
  same("machine.toml", "scene.toml",
       with({"shading.normaliser_address_bits=9", "shading.normaliser_output_bits=10",
             "shading.dot_table_address_bits=10", "shading.dot_table_output_bits=9", "shading.index_bits=7"}));
}

// The same triangle three times: depths are equal everywhere, and the lowest processor number is seen. Objects 1, 2, 3
// stand on boards 0, 1, 2.
TEST_F(RereadVectorsTest, EqualDepthKeepsTheLowerProcessorNumber) {
  const std::string triangle =
      "[[object]]\ntype = \"triangles\"\nmaterial = \"clay\"\ntwo_sided = true\n"
      "positions = [[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 3.0]]\n";
  write("machine.toml", kSmallMachine);
  write("scene.toml", kSceneHead + triangle + triangle + triangle);
  same("machine.toml", "scene.toml");
  EXPECT_EQ(number("processors_with_object"), 3U);
  std::set<std::string> objects;
  for_each_row("decision.csv", [&](const std::vector<std::string>& row) { objects.insert(row[2]); });
  EXPECT_EQ(objects, (std::set<std::string>{"0", "1"}));
}

// ----- A wrong digit -----

class WrongDigitTest : public RereadVectorsTest {
 protected:
  void SetUp() override {
    RereadVectorsTest::SetUp();
    write("machine.toml", kSmallMachine);
    write("scene.toml", kRichScene);
    same("machine.toml", "scene.toml", {"host.processors_per_unit=64", "shading.lights=2"});
  }

  static char other(char digit) {
    const std::string digits = "0123456789abcdef";
    return digits.at(digits.find(digit) ^ 8U);
  }
  // What the reader says when `changed` stands in the file; the file is put back.
  Outcome reread_with(const std::string& name, const std::string& changed) {
    const std::string text = text_of(name);
    write("out/" + name, changed);
    Outcome outcome = reread();
    write("out/" + name, text);
    return outcome;
  }
  // Of the words [first, last) of the file the highest (or lowest) digit is changed.
  Outcome reread_changed(const std::string& name, std::size_t first, std::size_t last, bool highest) {
    std::string text = text_of(name);
    const std::size_t width = text.find('\n') + 1;
    for (std::size_t word = first; word < last; ++word) {
      char& digit = text.at(word * width + (highest ? 0 : width - 2));
      digit = other(digit);
    }
    return reread_with(name, text);
  }
  // What the files of the processor begin with whose object most pixels show.
  std::string name_of_most_seen() const {
    std::map<std::string, int> pixels;
    for_each_row("decision.csv", [&](const std::vector<std::string>& row) { ++pixels[row[2]]; });
    pixels.erase("0");
    const auto most = std::max_element(pixels.begin(), pixels.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    std::string name;
    for_each_row("index.csv", [&](const std::vector<std::string>& row) {
      if (row[3] == most->first) name = "board" + row[0] + "_processor" + row[1];
    });
    return name;
  }
  // Halves the words of the file down to one whose change is noticed.
  void one_word_matters(const std::string& name, const std::string& noticed_in) {
    const std::string text = text_of(name);
    std::size_t first = 0;
    std::size_t last = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    while (last - first > 1) {
      const std::size_t middle = (first + last) / 2;
      (reread_changed(name, first, middle, false).exit_code == 0 ? first : last) = middle;
    }
    const Outcome outcome = reread_changed(name, first, last, false);
    EXPECT_EQ(outcome.exit_code, 1) << name;
    EXPECT_THAT(outcome.err, HasSubstr(noticed_in)) << name;
  }
};

TEST_F(WrongDigitTest, OfAWordIsNoticed) {
  const std::string name = name_of_most_seen();
  for (const char* ep : {"_ep0", "_ep1", "_ep2", "_ep3", "_ep4", "_ep5", "_ep6"}) {
    const Outcome outcome = reread_changed(name + ep + ".hex", 2, 3, true);  // C'
    EXPECT_EQ(outcome.exit_code, 1) << ep;
    EXPECT_THAT(outcome.err, HasSubstr("decision.csv has")) << ep;
  }
  const Outcome material = reread_changed(name + "_material.hex", 0, 1, false);
  EXPECT_EQ(material.exit_code, 1);
  EXPECT_THAT(material.err, HasSubstr("decision.csv has"));
  const Outcome parked = reread_changed("parked_ep0.hex", 2, 3, true);
  EXPECT_EQ(parked.exit_code, 0) << "one edge of -1 is enough: " << parked.err;
  EXPECT_EQ(reread_with(name + "_ep0.hex", "000000\n000000\n").exit_code, 1) << "a word too few";
}

TEST_F(WrongDigitTest, OfATableIsNoticed) {
  for (const char* name : {"light0_diffuse_dot_x", "light0_diffuse_dot_y", "light0_diffuse_dot_z",
                           "light0_specular_dot_z", "light1_diffuse_dot_x", "light0_diffuse_red", "light1_diffuse_blue",
                           "light0_specular_all", "light0_signs", "ambient", "background", "inverse_root_rom"})
    one_word_matters(std::string(name) + ".hex", "rgb.csv has");
}

TEST_F(WrongDigitTest, OfAnExpectedPixelIsNoticed) {
  for (const char* name : {"decision.csv", "rgb.csv", "index.csv"}) {
    std::string text = text_of(name);
    // In the index a digit of the hexadecimal word, which follows the meaning.
    const std::size_t from = name == std::string("index.csv") ? text.find("edge 1 B,") : text.size() / 2;
    const std::size_t digit = text.find_first_of("0123456789", text.find(',', from));
    text[digit] = text[digit] == '9' ? '8' : static_cast<char>(text[digit] + 1);
    const Outcome outcome = reread_with(name, text);
    EXPECT_EQ(outcome.exit_code, 1) << name;
    EXPECT_THAT(outcome.err, HasSubstr(name));
  }
  const std::string rows = text_of("rgb.csv");
  EXPECT_EQ(reread_with("rgb.csv", rows.substr(0, rows.size() / 2)).exit_code, 1);
  EXPECT_EQ(reread_with("rgb.csv", rows + "0,0,0,0,0\n").exit_code, 1);
  EXPECT_EQ(reread().exit_code, 0) << "everything was put back";
}

}  // namespace
}  // namespace rastertlm::test
