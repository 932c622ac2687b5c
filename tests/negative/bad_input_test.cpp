// Bad input: exit code 2, a sentence that says what is wrong and where, and nothing written.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class BadInputTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("machine.toml", kSmallMachine);
    write("scene.toml", one_triangle());
  }
  // Renders both and expects that it is refused with all of the texts.
  void refused(const std::vector<std::string>& texts, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"render", machine_, scene_, "--out", "o"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::set<std::string> before = names();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err << outcome.out;
    EXPECT_THAT(outcome.out, IsEmpty());
    for (const std::string& text : texts) EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_EQ(names(), before) << "nothing is written";
  }
  void scene_refused(const std::string& objects, const std::vector<std::string>& texts) {
    write("scene.toml", kSceneHead + objects);
    refused(texts);
  }
  void mesh_refused(const std::string& name, const std::string& mesh, const std::vector<std::string>& texts) {
    write(name, mesh);
    scene_refused("[[object]]\ntype = \"mesh\"\nmaterial = \"clay\"\nfile = \"" + name + "\"\n", texts);
  }

  std::string machine_ = "machine.toml";
  std::string scene_ = "scene.toml";
};

TEST_F(BadInputTest, MissingFiles) {
  machine_ = "none.toml";
  scene_ = "neither.toml";
  refused({"none.toml: ", "neither.toml: ", "no such file"});  // both at once
}

TEST_F(BadInputTest, EmptyFile) {
  write("scene.toml", "# nothing\n");
  refused({"scene.toml: is empty"});
}

TEST_F(BadInputTest, Directory) {
  scene_ = ".";
  refused({"is a directory"});
}

TEST_F(BadInputTest, NotToml) {
  write("machine.toml", "schema = 1\nvideo = [\n");
  refused({"machine.toml:"});
}

TEST_F(BadInputTest, WrongType) {
  write("machine.toml", "schema = 1\nplatform = \"imogene\"\n[video]\ncolumns = \"wide\"\n");
  refused({"machine.toml:4: video.columns: ", "wide"});
}

TEST_F(BadInputTest, UnknownKeyNamesTheNearest) {
  write("machine.toml", "schema = 1\nplatform = \"imogene\"\n[video]\ncolums = 512\n");
  refused({"machine.toml:4: ", "unknown key 'video.colums'", "columns"});
}

TEST_F(BadInputTest, ValueOutOfRange) {
  write("machine.toml", "schema = 1\nplatform = \"imogene\"\n[video]\nrefresh_hz = -50.0\n");
  refused({"machine.toml:4: video.refresh_hz: ", "-50"});
}

TEST_F(BadInputTest, LoopsAndMemoriesThatNobodyKnows) {
  write("machine.toml",
        std::string(kSmallMachine) + "[loader]\nkind = \"mc68000\"\n[loader.dot]\npreset = \"add_l_mov_w\"\n");
  refused({"machine.toml:", "loader.dot.preset: unknown preset 'add_l_mov_w'", "'add_l_move_l', 'add_l_move_w'",
           "nearest: 'add_l_move_w'"});
  write("machine.toml", kSmallMachine);
  refused({"--set: loader.specular.preset: unknown preset 'add_l_move_w'", "'move_l_add_l_12_mhz'"},
          {"--set", "loader.specular.preset=add_l_move_w"});
  refused({"shading.preset: unknown preset 'cy7c162_30'", "'cy7c162_25', 'cy7c162_35'"},
          {"--set", "shading.preset=cy7c162_30"});
}

TEST_F(BadInputTest, RatesOfLoadersThatAreZeroOrNegative) {
  for (const char* key : {"loader.dot.clock_mhz", "loader.dot.body_cycles", "loader.diffuse.clock_mhz",
                          "loader.specular.clock_mhz", "loader.specular.right_cycles", "loader.specular.up_cycles"})
    for (const char* value : {"0", "0.0", "-1.0", "nan"}) refused({key}, {"--set", std::string(key) + '=' + value});
  for (const char* setting : {"loader.dot.loop_cycles=-1.0", "loader.diffuse.cycles=-0.5", "loader.dot.unroll=-1",
                              "loader.dot.units=0", "loader.specular.units=-2", "shading.table_access_ns=-1.0"})
    refused({std::string(setting).substr(0, std::string(setting).find('='))}, {"--set", setting});
  refused({"loader.sequencer_clock_ns"}, {"--set", "loader.kind=sequencer", "--set", "loader.sequencer_clock_ns=0"});
}

TEST_F(BadInputTest, LoadersThatHaveNothingToShare) {
  write("machine.toml", std::string(kSmallMachine) + "[loader.dot]\nunits = 2049\n[loader.diffuse]\nunits = 17\n");
  refused({"loader.dot.units: 2049 loaders cannot share 2048 entries",
           "loader.diffuse.units: 17 loaders cannot share 16 "
           "materials"});
}

TEST_F(BadInputTest, KeysOfALoaderThatTheMachineDoesNotHave) {
  write("machine.toml", std::string(kSmallMachine) + "[loader]\nwhen = \"frame\"\non_overrun = \"show\"\n");
  refused({"loader.on_overrun: does not apply", "loader.when", "'retrace'", "'frame'"});
  write("machine.toml",
        std::string(kSmallMachine) + "[loader]\nkind = \"sequencer\"\n[loader.dot]\npreset = \"add_l_move_w\"\n");
  refused({"loader.dot.preset: does not apply", "loader.kind", "'mc68000'", "'sequencer'"});
  write("machine.toml", kSmallMachine);
  refused({"loader.on_overrun", "'refuse', 'show'"},
          {"--set", "loader.when=retrace", "--set", "loader.on_overrun=draw"});
}

TEST_F(BadInputTest, ColumnsAndLines) {
  for (const char* key : {"video.columns", "video.lines"})
    for (const char* value : {"0", "-1", "16385", "99999999999999999999"})
      refused({key}, {"--set", std::string(key) + '=' + value});
}

constexpr const char* kVideo = "schema = 1\nplatform = \"imogene\"\n[video]\n";

TEST_F(BadInputTest, RatesThatAreNegativeZeroOrNoNumber) {
  const std::vector<std::pair<const char*, const char*>> keys{{"refresh_hz", "0.01"}, {"pixel_clock_ns", "0.1"}};
  for (const auto& [key, least] : keys)
    for (const char* value : {"-50.0", "0.0", "-0.0", "nan", "inf"}) {
      write("machine.toml", std::string(kVideo) + key + " = " + value + "\n");
      const bool is_number = value[0] != 'n' && value[0] != 'i';
      refused({std::string("machine.toml:4: video.") + key + ": ", is_number ? least : "not a finite number"});
    }
  write("machine.toml", std::string(kVideo) + "vertical_retrace_us = -1.0\n");
  refused({"machine.toml:4: video.vertical_retrace_us: ", "-1"});
  write("machine.toml",
        "schema = 1\nplatform = \"imogene\"\n[object_processor]\nadder_ns_per_bit = -4.0\nword_bits = 0\n");
  refused({"machine.toml:4: object_processor.adder_ns_per_bit: ", "machine.toml:5: object_processor.word_bits: ", "8"});
}

TEST_F(BadInputTest, ARetraceLongerThanTheFrame) {
  write("machine.toml", std::string(kVideo) + "columns = 64\nlines = 48\nvertical_retrace_us = 20001.0\n");
  refused(
      {"machine.toml:6: video.vertical_retrace_us: a retrace of 20001 us (333350 pixel clocks) is not shorter than "
       "the frame of 333333 pixel clocks at 50 Hz"});
  // The paper's retrace at a rate that leaves no time for it.
  refused({"video.vertical_retrace_us: a retrace of 600 us"},
          {"--set", "video.refresh_hz=1000", "--set", "video.vertical_retrace_us=600", "--set",
           "video.pixel_clock_ns=1e6"});
}

TEST_F(BadInputTest, APixelClockThatLeavesNoBlanking) {
  write("machine.toml", std::string(kVideo) + "pixel_clock_ns = 75.0\n");
  refused(
      {"machine.toml:4: video.pixel_clock_ns: a pixel clock of 75 ns leaves 505 clocks for a line of 512 pixels, and "
       "no horizontal blanking; at most 73.86 ns would leave some"});
  // Some blanking, and not enough to start a line: 523 - 512 clocks for nine, and for twice nine.
  refused({"video.pixel_clock_ns: the line start takes 18 pixel clocks (interlaced: two lines' work), and horizontal "
           "blanking has 11"},
          {"--set", "video.pixel_clock_ns=60", "--set", "video.refresh_hz=60", "--set", "video.interlaced=true",
           "--set", "video.lines=1024"});
}

TEST_F(BadInputTest, AnInterlacedScreenOfOddLines) {
  write("machine.toml", std::string(kVideo) + "interlaced = true\nlines = 511\n");
  refused({"machine.toml:5: video.lines: is 511; an interlaced picture has as many odd lines as even ones"});
  write("machine.toml", std::string(kVideo) + "interlaced = 1\n");
  refused({"machine.toml:4: video.interlaced: ", "true or false"});
}

TEST_F(BadInputTest, UnknownPresetsNameTheKnownOnes) {
  write("machine.toml", std::string(kVideo) + "preset = \"vga\"\n[object_processor]\npreset = \"fpga\"\n");
  refused(
      {"machine.toml:4: video.preset: unknown preset 'vga'; known presets of 'video': '1024_interlaced_50', '512_50', "
       "'512_60', '720p_60', 'vga_60'",
       "machine.toml:6: object_processor.preset: unknown preset 'fpga'; known presets of 'object_processor': "
       "'small_fpga', 'standard_cell_1991', 'xcv300_6'"});
  refused({"--set: video.preset: unknown preset 'pal'"}, {"--set", "video.preset=pal"});
}

TEST_F(BadInputTest, EverythingThatIsWrongIsSaidAtOnce) {
  write("machine.toml", "schema = 1\nplatform = \"imogene\"\n[video]\ncolumns = 0\nlines = 0\n");
  write("scene.toml", one_triangle() + "[camera]\nvertical_fov_deg = 900.0\nfra = 3.0\n");
  refused({"machine.toml:4: video.columns", "machine.toml:5: video.lines", "camera.vertical_fov_deg", "camera.fra"});
}

TEST_F(BadInputTest, AnotherPlatformOrSchema) {
  write("machine.toml", "schema = 1\nplatform = \"imogen\"\n");
  refused({"machine.toml:2: platform: ", "imogene"});
  write("machine.toml", "schema = 9\nplatform = \"imogene\"\n");
  refused({"machine.toml:1: schema: ", "9"});
}

TEST_F(BadInputTest, MoreLinksThanATransputerHas) {
  write("machine.toml", "schema = 1\nplatform = \"imogene\"\n[host]\npreset = \"t800_20\"\nlinks = 6\n");
  refused({"machine.toml:5: host.links: is 6, and the host processor t800_20 has 4 serial links"});
}

TEST_F(BadInputTest, RatesOfAHostThatAreNotAboveZero) {
  for (const char* key : {"host.clock_hz", "host.sustained_mflops", "host.link_mbit_per_s", "host.link_bits_per_byte",
                          "host.bus_cycles_per_word", "host.bus_bits"})
    for (const char* value : {"0", "-20"}) refused({key, value}, {"--set", std::string(key) + '=' + value});
  refused({"host.instruction.add", "-1"}, {"--set", "host.cost=instructions", "--set", "host.instruction.add=-1.0"});
}

TEST_F(BadInputTest, PresetThatIsUnknownNamesThoseThatAre) {
  write("machine.toml", "schema = 1\nplatform = \"imogene\"\n[host]\npreset = \"t900\"\n");
  refused({"machine.toml:4: host.preset: unknown preset 't900'",
           "'soft_core', 'sparcstation_20', 't800_20', 't800_30', 't805_30', 't9000'", "nearest: 't9000'"});
}

TEST_F(BadInputTest, InstructionsOfAHostThatIsChargedAtItsRate) {
  refused({"host.instruction.add", "host.cost is 'instructions'"}, {"--set", "host.instruction.add=9.0"});
}

TEST_F(BadInputTest, VertexThatIsNotFinite) {
  for (const char* number : {"nan", "inf", "-inf"})
    scene_refused("[[object]]\ntype = \"triangles\"\nmaterial = \"clay\"\npositions = [[0.0, 0.0, 0.0], [1.0, 0.0, " +
                      std::string(number) + "], [0.0, 0.0, 1.0]]\n",
                  {"scene.toml:9: object[0].positions", "finite"});
  mesh_refused("mesh.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", {"mesh.obj", "not finite"});
}

TEST_F(BadInputTest, FaceThatNamesNoVertex) {
  mesh_refused("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", {"mesh.obj", "range"});
  scene_refused(
      "[[object]]\ntype = \"triangles\"\nmaterial = \"clay\"\npositions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, "
      "0.0, 1.0]]\n"
      "indices = [[0, 1, 3]]\n",
      {"scene.toml", "object[0].indices"});
}

TEST_F(BadInputTest, MeshFileThatIsMissingEmptyOrNoMesh) {
  scene_refused("[[object]]\ntype = \"mesh\"\nmaterial = \"clay\"\nfile = \"none.obj\"\n",
                {"object[0].file", "none.obj"});
  mesh_refused("empty.obj", "", {"empty.obj"});
  mesh_refused("text.ply", "not a mesh\n", {"text.ply"});
}

TEST_F(BadInputTest, TrianglesOfZeroAreaOnly) {
  scene_refused(
      "[[object]]\ntype = \"triangles\"\nmaterial = \"clay\"\npositions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, "
      "0.0, 0.0]]\n",
      {"object[0]", "none of its 1 triangles has an area"});
  mesh_refused("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", {"none of its 1 triangles has an area"});
}

TEST_F(BadInputTest, NoObject) { scene_refused("", {"scene.toml", "object: the scene has no object"}); }

TEST_F(BadInputTest, MoreObjectsThanProcessors) {
  // A sphere of 12 x 8 has 2 * 12 * 7 triangles; the machine has 32 processors.
  scene_refused("[[object]]\ntype = \"uv_sphere\"\nmaterial = \"clay\"\nslices = 12\nstacks = 8\n", {"168", "32"});
}

TEST_F(BadInputTest, MoreObjectsThanProcessorsMayBeDropped) {
  write("scene.toml",
        std::string(kSceneHead) + "[[object]]\ntype = \"uv_sphere\"\nmaterial = \"clay\"\nslices = 12\nstacks = 8\n");
  const Outcome outcome = run({"render", "machine.toml", "scene.toml", "--out", "o", "--set", "host.overflow=drop"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(file_text(in_work("o/report.txt")),
              HasSubstr("168 made, 0 of them of zero area, 136 without a processor."));
}

// An animation may begin with nothing in view: it is shown, with a warning.
TEST_F(BadInputTest, SceneBehindTheCameraIsAWarning) {
  write("scene.toml", one_triangle() + "translate = [0.0, -100.0, 0.0]\n");
  const Outcome outcome = run({"render", "machine.toml", "scene.toml", "--out", "o"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Warning: frame 0 shows nothing but the background: no triangle of the scene that "
                                     "faces the viewer is in view"));
  EXPECT_THAT(file_text(in_work("o/report.txt")), HasSubstr("nothing but the background"));
}

TEST_F(BadInputTest, NoMaterialOfThatName) {
  scene_refused("[[object]]\ntype = \"teapot\"\nmaterial = \"glass\"\n", {"object[0].material", "glass"});
}

TEST_F(BadInputTest, OverridesOfUnknownKeysAndWrongTypes) {
  refused({"video.column"}, {"--set", "video.column=3"});
  refused({"video.columns"}, {"--set", "video.columns=wide"});
  refused({"light[3]"}, {"--set", "light[3].towards=[1,2,3]"});
}

}  // namespace
}  // namespace rastertlm::test
