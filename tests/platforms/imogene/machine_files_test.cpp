// Do the machine files of configs/machines have the clocks of their screens, do pixels leave when those say, and does
// each show the teapot at its rate?
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

struct MachineFile {
  const char* name;
  std::uint64_t columns, lines, fields;
  double refresh_hz;
  std::uint64_t period_fs;
  std::uint64_t frame, line, retrace;  // pixel clocks; of a field where there are two
  std::uint64_t line_start;
  double adder_ns;
};

std::ostream& operator<<(std::ostream& out, const MachineFile& file) { return out << file.name; }

// 004: 20 ms of 60 ns and a retrace of 600 us. Interlaced: 683,761 = 512 x 1295 + 20,721. VGA: 800 x 525 clocks of
// 25.2 MHz. CEA-861: 1650 x 750 clocks of 74.25 MHz. Adders: 4 ns a bit; 1 and 0.25; 1 and 0.06. Line starts: 2 n + 5.
const MachineFile kFiles[] = {
    {"imogene", 512, 512, 1, 50, 60'000'000, 333'333, 631, 10'261, 9, 48},
    {"imogene_1024_interlaced", 1024, 1024, 2, 50, 29'250'000, 683'761, 1295, 20'721, 26, 24},
    {"vga_fpga", 640, 480, 1, 60, 39'682'540, 420'000, 800, 36'000, 7, 7},
    {"720p_fpga", 1280, 720, 1, 60, 13'468'013, 1'237'500, 1650, 49'500, 7, 2.68},
};

class MachineFileTest : public SimulationTest, public testing::WithParamInterface<MachineFile> {};

TEST_P(MachineFileTest, ShowsTheTeapotAtTheTimesOfItsScreen) {
  const MachineFile& file = GetParam();
  constexpr std::uint64_t kFrames = 2;
  const run::Result result = simulate(std::string(RASTERTLM_SOURCE_DIR "/configs/machines/") + file.name + ".toml",
                                      kTeapot, {.set = {}, .frames = kFrames, .pictures = false})
                                 .result;
  EXPECT_EQ(result.columns, file.columns);
  EXPECT_EQ(result.lines, file.lines);
  EXPECT_EQ(result.interlaced, file.fields == 2);
  // Clocks of the screen, in the cycles of the units, and in what is available.
  EXPECT_EQ(named(result.units, "video output").cycles, kFrames * file.fields * file.frame);
  EXPECT_EQ(result.deadlines.lines.available_cycles, file.line - file.columns);
  EXPECT_EQ(result.deadlines.retrace.available_cycles, file.retrace);
  EXPECT_DOUBLE_EQ(named(result.budgets, "line_start").used, static_cast<double>(file.line_start));
  EXPECT_EQ(result.deadlines.lines.worst.slack_cycles,
            static_cast<std::int64_t>(file.line - file.columns - file.line_start));
  EXPECT_NEAR(named(result.budgets, "adder_delay").used, file.adder_ns, 1e-9);
  EXPECT_NEAR(named(result.budgets, "adder_delay").available, static_cast<double>(file.period_fs) * 1e-6, 1e-6);

  // Whole clocks to the nearest picosecond: 1024 processors are ten levels of the tree, shading is ten registers.
  const auto picoseconds = [&](std::uint64_t clocks) { return (clocks * file.period_fs + 500) / 1000; };
  const std::uint64_t first = file.retrace + file.line - file.columns + 1 + 10 + 10;
  ASSERT_EQ(result.frames.size(), kFrames);
  for (std::uint64_t k = 0; k < kFrames; ++k) {
    EXPECT_EQ(result.frames[k].first_pixel_ps, picoseconds(file.fields * k * file.frame + first)) << k;
    const std::uint64_t last_field = (file.fields * (k + 1) - 1) * file.frame;
    const std::uint64_t last = last_field + first + (file.lines / file.fields - 1) * file.line + file.columns - 1;
    EXPECT_EQ(result.frames[k].last_pixel_ps, picoseconds(last)) << k;
  }

  // The rate of the screen, and a picture that is exact for its snapped vertices.
  EXPECT_TRUE(result.answer.sustained);
  EXPECT_DOUBLE_EQ(result.answer.required_rate_hz, file.refresh_hz);
  EXPECT_NEAR(result.answer.update_rate_hz, file.refresh_hz, 1e-4);
  for (const run::FrameFigures& frame : result.frames) {
    const reference::ErrorFigures& error = error_of(frame, "snapped");
    EXPECT_EQ(error.covered_missing, 0U);
    EXPECT_EQ(error.covered_extra, 0U);
    EXPECT_LE(error.max_level_same_object, 4);
  }
}

INSTANTIATE_TEST_SUITE_P(Imogene, MachineFileTest, testing::ValuesIn(kFiles),
                         [](const auto& file) { return "of_" + std::string(file.param.name); });

using PresetTest = SimulationTest;

// The paper's screen at 60 Hz: 333,333 = 512 x 627 + 12,309 clocks of 50 ns. A preset gives way to what a file says.
TEST_F(PresetTest, OfAScreenSetsWhatTheFileDoesNot) {
  const std::string text = "schema = 1\nplatform = \"imogene\"\n[video]\npreset = \"512_60\"\n";
  const run::Result sixty =
      simulate(written("m.toml", text), kTeapot, {.set = {}, .reference = false, .pictures = false}).result;
  EXPECT_EQ(named(sixty.units, "video output").cycles, 333'333U);
  EXPECT_EQ(sixty.deadlines.lines.available_cycles, 115U);
  EXPECT_EQ(sixty.deadlines.retrace.available_cycles, 12'309U);
  EXPECT_DOUBLE_EQ(sixty.answer.required_rate_hz, 60.0);
  const run::Result own = simulate(written("m.toml", text + "pixel_clock_ns = 60.0\n"), kTeapot,
                                   {.set = {}, .reference = false, .pictures = false})
                              .result;
  EXPECT_EQ(named(own.units, "video output").cycles, 277'778U);  // 512 x 523 + 10,002
  EXPECT_EQ(own.deadlines.lines.available_cycles, 11U);
  EXPECT_EQ(own.deadlines.lines.worst.slack_cycles, 2);
}

// What the same screens would ask of the adders of 1991: 48 ns are too slow for VGA, and 7 bits a slice would do.
TEST_F(PresetTest, OfTheAddersDecideWhatAScreenTakes) {
  const auto answer = [&](const char* video, const char* processors) {
    return simulate(written("m.toml", std::string("schema = 1\nplatform = \"imogene\"\n[video]\npreset = \"") + video +
                                          "\"\n[object_processor]\npreset = \"" + processors + "\"\n"),
                    kTeapot, {.set = {}, .reference = false, .pictures = false})
        .result;
  };
  const run::Result slow = answer("vga_60", "standard_cell_1991");
  EXPECT_FALSE(named(slow.budgets, "adder_delay").fits);
  EXPECT_FALSE(slow.answer.display_works);
  EXPECT_NE(named(slow.budgets, "adder_delay").source.find("3 slices of the 24-bit word"), std::string::npos)
      << named(slow.budgets, "adder_delay").source;
  EXPECT_TRUE(named(answer("vga_60", "xcv300_6").budgets, "adder_delay").fits);
  EXPECT_TRUE(named(answer("720p_60", "xcv300_6").budgets, "adder_delay").fits);  // 7 ns of 13.5
}

}  // namespace
}  // namespace rastertlm::test
