// Are the vectors those of the machine that is rendered, complete, and the same twice? Are their cycles the closed
// forms', worked by hand?
#include "src/analysis/vectors.h"

#include <gmock/gmock.h>

#include "src/base/digest.h"
#include "tests/platforms/imogene/simulation.h"
#include "tests/src/analysis/vectors_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;

class WholeVectorsTest : public VectorsTest {
 protected:
  void SetUp() override {
    VectorsTest::SetUp();
    write("machine.toml", kSmallMachine);
    write("scene.toml", one_triangle());
  }
  void write_vectors(const std::vector<std::string>& set = {}, const std::vector<std::string>& more = {}) const {
    const Outcome outcome = vectors("machine.toml", "scene.toml", set, more);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

TEST_F(WholeVectorsTest, AreWhatTheDisplayShows) {
  constexpr std::uint64_t kFrame = 2;
  write("scene.toml", one_triangle() + "[[object.animation]]\ntype = \"spin\"\ndeg_per_frame = 20.0\n");
  write_vectors({}, {"--frame", std::to_string(kFrame)});
  RunOptions options;
  options.frames = kFrame + 1;
  options.reference = false;
  const Simulated simulated = simulate(in_work("machine.toml"), in_work("scene.toml"), options);
  const frame::Frame& shown = simulated.shown.at(kFrame);
  std::size_t pixel = 0;
  for_each_row("decision.csv", [&](const std::vector<std::string>& row) {
    EXPECT_EQ(std::stoul(row[0]) * shown.columns + std::stoul(row[1]), pixel);
    EXPECT_EQ(std::stoul(row[2]), shown.object[pixel]);
    EXPECT_EQ(std::stoul(row[3]), shown.depth[pixel]);
    EXPECT_EQ(std::stoul(row[7]), shown.material[pixel]);
    ++pixel;
  });
  EXPECT_EQ(pixel, shown.pixels());
  pixel = 0;
  for_each_row("rgb.csv", [&](const std::vector<std::string>& row) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(std::stoi(row[2 + c]), shown.rgb[3 * pixel + c]) << pixel;
    ++pixel;
  });
  EXPECT_EQ(pixel, shown.pixels());
  EXPECT_EQ(number("animation_frame"), static_cast<std::uint64_t>(simulated.result.frames.at(kFrame).animation_frame));
  EXPECT_THAT(text_of("manifest.json"), HasSubstr(simulated.result.config_digest));
  EXPECT_THAT(text_of("manifest.json"), HasSubstr(simulated.result.scene_digest));
}

TEST_F(WholeVectorsTest, EveryFileIsListedWithItsDigest) {
  write_vectors();
  const std::string manifest = text_of("manifest.json");
  std::set<std::string> listed{"manifest.json"};
  const auto value_after = [&](const std::string& key, std::size_t& at) {
    at = manifest.find(key, at) + key.size();
    return manifest.substr(at, manifest.find_first_of("\",\n", at) - at);
  };
  for (std::size_t at = manifest.find("\"files\""); manifest.find("\"name\"", at) != std::string::npos;) {
    const std::string name = value_after("\"name\": \"", at);
    EXPECT_EQ(value_after("\"bytes\": ", at), std::to_string(text_of(name).size())) << name;
    EXPECT_EQ(value_after("\"sha256\": \"", at), sha256_hex(text_of(name))) << name;
    listed.insert(name);
  }
  EXPECT_EQ(names("out"), listed);
  for (const char* name : {"board0_processor0_ep0.hex",
                           "board0_processor0_ep6.hex",
                           "board0_processor0_material.hex",
                           "parked_ep6.hex",
                           "parked_material.hex",
                           "index.csv",
                           "microprogram.csv",
                           "decision.csv",
                           "rgb.csv",
                           "tables.csv",
                           "light0_diffuse_dot_x.hex",
                           "light0_specular_all.hex",
                           "light0_signs.hex",
                           "ambient.hex",
                           "background.hex",
                           "inverse_root_rom.hex",
                           "path_rom_exponent20.hex",
                           "README.md",
                           "config.resolved.toml",
                           "scene.resolved.toml"})
    EXPECT_EQ(listed.count(name), 1U) << name;
  EXPECT_EQ(listed.count("board1_processor8_ep0.hex"), 0U) << "one object, one processor";
}

TEST_F(WholeVectorsTest, AreTheSameTwice) {
  write_vectors();
  const std::string manifest = text_of("manifest.json");  // holds every file's digest
  write_vectors();
  EXPECT_EQ(text_of("manifest.json"), manifest);
  write_vectors({"background=[0, 0, 1]"});
  EXPECT_NE(text_of("manifest.json"), manifest);
}

// The paper's frame: 333,333 = 10,261 + 512 x 631 cycles, 119 of a line blanking. From a pixel's words one cycle of
// pre-normalisation, ten levels of a tree of 1024 or 1024 processors of a pipeline, ten cycles of shading.
TEST_F(WholeVectorsTest, CyclesAreTheClosedForms) {
  for (const auto& [topology, decision] : {std::pair{"tree", 10U}, std::pair{"pipeline", 1024U}}) {
    const Outcome outcome = vectors(kShippedMachine, "scene.toml", {std::string("decision_unit.topology=") + topology});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::uint64_t words = 10'261 + 119;
    const std::uint64_t last = 511 * 631 + 511;
    EXPECT_EQ(number("first_pixel_word_cycle"), words);
    EXPECT_EQ(number("last_pixel_word_cycle"), words + last);
    EXPECT_EQ(number("first_pixel_decision_cycle"), words + 1 + decision) << topology;
    EXPECT_EQ(number("last_pixel_decision_cycle"), words + 1 + decision + last) << topology;
    EXPECT_EQ(number("first_pixel_rgb_cycle"), words + 1 + decision + 10) << topology;
    EXPECT_EQ(number("last_pixel_rgb_cycle"), words + 1 + decision + 10 + last) << topology;
    EXPECT_EQ(number("skew_cycles"), topology == std::string("tree") ? 0U : 1023U);
  }
}

// 64 x 48 at a pixel clock that is no whole number of picoseconds: frame round(20 ms / 39.7217 ns) = 503,503; a line
// floor((503,503 - 15,105) / 48) = 10,174; what is left over joins the retrace: 503,503 - 48 x 10,174 = 15,151. 32
// processors are five levels, of two cycles each.
TEST_F(WholeVectorsTest, CyclesMoveWithTheirParameters) {
  write_vectors({"video.pixel_clock_ns=39.7217", "object_processor.prenormalisation_cycles=3",
                 "object_processor.comparator_cycles=2", "shading.latency.adders=7"},
                {"--frame", "3"});
  EXPECT_EQ(number("frame_cycles"), 503'503U);
  EXPECT_EQ(number("line_cycles"), 10'174U);
  EXPECT_EQ(number("vertical_retrace_cycles"), 15'151U);
  const std::uint64_t words = 15'151 + 10'174 - 64;
  EXPECT_EQ(number("first_pixel_word_cycle"), words);
  EXPECT_EQ(number("first_pixel_decision_cycle"), words + 3 + 5 * 2);
  EXPECT_EQ(number("first_pixel_rgb_cycle"), words + 3 + 5 * 2 + 4 + 3 + 1 + 7);
  EXPECT_EQ(number("last_pixel_rgb_cycle"), number("first_pixel_rgb_cycle") + 47 * 10'174 + 63);
}

// Fields of 24 lines at 60 ns: 333,333 clocks, a line floor((333,333 - 10,000) / 24) = 13,472, the retrace 333,333 - 24
// x 13,472 = 10,005. Both fields have the same cycles.
TEST_F(WholeVectorsTest, CyclesOfAFieldCountFromItsOwnRetrace) {
  for (const char* field : {"0", "1"}) {
    write_vectors({"video.interlaced=true"}, {"--frame", "1", "--field", field});
    EXPECT_EQ(number("line_cycles"), 13'472U);
    const std::uint64_t words = 10'005 + 13'472 - 64;
    EXPECT_EQ(number("first_pixel_word_cycle"), words);
    EXPECT_EQ(number("first_pixel_decision_cycle"), words + 1 + 5) << "a tree of 32";
    EXPECT_EQ(number("last_pixel_rgb_cycle"), words + 1 + 5 + 10 + 23 * 13'472 + 63);
  }
}

// 004, section 5.2.2: one listed line is one cycle.
TEST_F(WholeVectorsTest, TheMicroprogramIsThePublishedOne) {
  write_vectors();
  EXPECT_EQ(text_of("microprogram.csv"),
            "program,step,select,clear,ram,address,clocks\n"
            "frame_start,0,loading_ram,0,,,00\n"
            "frame_start,1,,0,read_loading,A,00\n"
            "frame_start,2,,0,write_backup,A,00\n"
            "frame_start,3,,0,read_loading,B,00\n"
            "frame_start,4,,0,write_backup,B,00\n"
            "frame_start,5,,0,read_loading,C,00\n"
            "frame_start,6,,0,write_backup,C,00\n"
            "frame_start,7,registers,0,,,00\n"
            "line_start,0,,1,,,00\n"
            "line_start,1,,0,read_backup,C,00\n"
            "line_start,2,,0,,,11\n"
            "line_start,3,,0,read_backup,B,00\n"
            "line_start,4,,0,,,01\n"
            "line_start,5,,0,,,10\n"
            "line_start,6,,0,write_backup,C,00\n"
            "line_start,7,,0,read_backup,A,00\n"
            "line_start,8,,0,,,01\n"
            "pixel,0,,0,,,11\n");
  EXPECT_EQ(number("frame_start_cycles"), 8U);
  EXPECT_EQ(number("line_start_cycles"), 9U);
  write_vectors({"object_processor.slice_bits=24"});
  EXPECT_THAT(text_of("microprogram.csv"), HasSubstr("line_start,6,,0,read_backup,A,0\npixel,0,,0,,,1\n"));
}

TEST_F(WholeVectorsTest, ThePageHasThisMachinesFigures) {
  write_vectors({"object_processor.word_bits=20"});
  const std::string page = text_of("README.md");
  for (const std::string& text : std::vector<std::string>{
           "4 boards of 8 triangle processors", "modulo 2^20", "reg [19:0] loading [0:2];", "1048575 (all ones)",
           "begins in cycle", std::to_string(number("first_pixel_decision_cycle")), "`centred` arithmetic"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_EQ(page.find("clock2"), std::string::npos);
  write_vectors({"ep1.carry_clock=clock2"});
  EXPECT_THAT(text_of("README.md"), HasSubstr("clock2"));
  write_vectors({"shading.arithmetic=literal"});
  EXPECT_THAT(text_of("README.md"), HasSubstr("`literal` arithmetic"));
}

TEST_F(WholeVectorsTest, OfSomeProcessorsAlone) {
  write("scene.toml",
        std::string(kSceneHead) +
            "[[object]]\ntype = \"uv_sphere\"\nmaterial = \"clay\"\nslices = 4\nstacks = 4\nradius = 3.0\n");
  write_vectors();
  const std::uint64_t all = number("processors_with_object");
  std::uint64_t between = 0;
  std::set<std::string> seen;
  for_each_row("index.csv", [&](const std::vector<std::string>& row) { seen.insert(row[1]); });
  for (const std::string& processor : seen)
    between += std::stoul(processor) >= 8 && std::stoul(processor) <= 15 ? 1 : 0;
  const std::string decision = text_of("decision.csv");
  write_vectors({}, {"--processors", "8-15"});
  EXPECT_EQ(number("processors_with_object"), all);
  EXPECT_EQ(number("processors_listed"), between);
  EXPECT_EQ(number("first_processor"), 8U);
  EXPECT_EQ(number("last_processor"), 15U);
  EXPECT_GT(between, 0U);
  EXPECT_LT(between, all);
  for (const std::string& name : names("out")) EXPECT_NE(name.rfind("board0_", 0), 0U) << name;
  EXPECT_THAT(text_of("README.md"), HasSubstr("the files of processors 8 to 15 alone"));
  EXPECT_EQ(text_of("decision.csv"), decision) << "the picture is the whole machine's";
}

// A machine that has quadric processors, too, and no use for them: the triangles' are as ever.
TEST_F(WholeVectorsTest, OfAMachineWithQuadricProcessors) {
  const std::string machine = RASTERTLM_SOURCE_DIR "/configs/machines/imogene_quadrics.toml";
  const std::vector<std::string> small{"video.columns=64", "video.lines=64"};
  const Outcome outcome = vectors(machine, kShippedTeapot, small);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(number("frame_start_cycles"), 8U);
  EXPECT_EQ(number("decision_cycles"), 11U);  // of 1536 processors
  EXPECT_EQ(reread().exit_code, 0);
  EXPECT_THAT(vectors(machine, kShippedTeapot, small, {"--processors", "1020-1024"}).err,
              HasSubstr("there is no processor 1024: the machine has 1024"));
  std::vector<std::string> late = small;
  late.emplace_back("quadric_processor.alignment=delay");
  const Outcome refused = vectors(machine, kShippedTeapot, late);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("quadric_processor.alignment: vectors knows no triangles that wait"));
}

}  // namespace
}  // namespace rastertlm::test
