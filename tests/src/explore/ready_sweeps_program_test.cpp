// The sweeps of configs/sweeps, each on a small screen: they run whole, and say what their structure says.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/src/explore/explore_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;

class ReadySweepTest : public ExploreTest {
 protected:
  // The table of the sweep after a run on 64 x 48.
  explore::SweepTable table_of(const std::string& name) {
    const std::string file = std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps/" + name + ".toml";
    const Outcome outcome = run({"explore", "run", file, "--store", "s.sqlite", "--jobs", "2", "--set",
                                 "video.columns=64", "--set", "video.lines=48"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(run({"explore", "show", "s.sqlite"}).out, HasSubstr("Answer: "));
    explore::SweepTable found = table();
    std::size_t points = 1;
    for (const explore::Axis& axis : found.axes) points *= axis.values.size();
    EXPECT_EQ(found.rows.size(), points);
    EXPECT_FALSE(found.question.empty());
    EXPECT_TRUE(found.baseline.has_value());
    for (const explore::Row& row : found.rows) {
      EXPECT_EQ(row.state, explore::State::done) << row.number << ": " << row.error;
      for (const std::optional<double>& figure : row.figures) EXPECT_TRUE(figure.has_value()) << row.number;
    }
    return found;
  }
  // The figure of an objective or beside them, for the row with these values of the axes.
  static double figure(const explore::SweepTable& table, const std::string& objective,
                       const std::vector<std::string>& values) {
    for (const explore::Row& row : table.rows) {
      bool same = true;
      for (std::size_t axis = 0; axis < values.size(); ++axis)
        same = same && table.axes[axis].values[row.values[axis]] == values[axis];
      for (std::size_t i = 0; same && i < table.objectives.size(); ++i)
        if (table.objectives[i].path == objective) return row.figures[i].value();
      for (std::size_t i = 0; same && i < table.further.size(); ++i)
        if (table.further[i].path == objective) return row.further[i].value();
    }
    throw std::out_of_range(objective);
  }
};

// A pipeline's last of N processors is N - 1 stages behind the first; a tree has them all side by side.
TEST_F(ReadySweepTest, PipelineOrTree) {
  const explore::SweepTable table = table_of("pipeline_or_tree");
  const auto skew = [&](const char* topology, const std::string& processors) {
    return figure(table, "budgets[pipeline_skew].used", {topology, processors});
  };
  for (const int processors : {8, 32, 128, 512}) {
    const std::string now = std::to_string(processors);
    const std::string next = std::to_string(4 * processors);
    EXPECT_EQ(skew("pipeline", next) - skew("pipeline", now), 8.0 * 3.0 * processors);
    EXPECT_EQ(skew("tree", next), skew("tree", now));
  }
}

TEST_F(ReadySweepTest, Transputers) {
  const explore::SweepTable table = table_of("transputers");
  for (const std::string units : {"1", "2", "4", "6", "8", "12", "16"}) {
    EXPECT_EQ(figure(table, "machine.host.computation_units", {units, "t9000"}), std::stod(units));
    EXPECT_GE(figure(table, "answer.headroom", {units, "t800_30"}),
              figure(table, "answer.headroom", {units, "t800_20"}));
  }
  EXPECT_TRUE(std::any_of(table.rows.begin(), table.rows.end(), [](const explore::Row& row) { return row.allowed; }));
  EXPECT_TRUE(std::any_of(table.rows.begin(), table.rows.end(), [](const explore::Row& row) { return !row.allowed; }));
}

// Two banks of a table are twice the bits of one.
TEST_F(ReadySweepTest, Loaders) {
  const explore::SweepTable table = table_of("loaders");
  const std::string bits = "sum(memories[].total_bits)";
  const std::string late = "sum(images[].late_table_lines)";
  for (const std::string materials : {"4", "8", "16"}) {
    EXPECT_EQ(figure(table, late, {"68000s in the frame", materials}), 0.0);
    EXPECT_GT(figure(table, late, {"68000s in the retrace", materials}), 0.0);
    EXPECT_GT(figure(table, bits, {"68000s in the frame", materials}),
              figure(table, bits, {"68000s in the retrace", materials}));
    EXPECT_EQ(figure(table, bits, {"68000s in the frame", materials}),
              figure(table, bits, {"sequencer of 60 ns in the frame", materials}));
  }
}

// A sample of it, over all axes. Memories that only one axis moves are what its closed form says, so that what is left
// of a point's bits depends on nothing but words and normals; pins are those of depth, normals and material.
TEST_F(ReadySweepTest, WordLengths) {
  const std::string file = std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps/word_lengths.toml";
  const Outcome outcome = run({"explore", "run", file, "--store", "s.sqlite", "--jobs", "2", "--shard", "1/35", "--set",
                               "video.columns=64", "--set", "video.lines=48"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  explore::SweepTable found = table();
  std::erase_if(found.rows, [](const explore::Row& row) { return row.state != explore::State::done; });
  ASSERT_EQ(found.rows.size(), 50U);
  std::map<std::string, double> left;  // by word and normal
  for (const explore::Row& row : found.rows) {
    std::map<std::string, std::string> value;
    for (std::size_t axis = 0; axis < found.axes.size(); ++axis)
      value[found.axes[axis].path] = found.axes[axis].values[row.values[axis]];
    const auto number = [&](const std::string& axis) { return std::stoi(value.at(axis)); };
    int dot = 0, index = 0;
    ASSERT_EQ(std::sscanf(value.at("tables").c_str(), "dot %d, index %d", &dot, &index), 2);
    const int address = number("shading.normaliser_address_bits"), root = number("shading.normaliser_output_bits");
    constexpr int kMaterials = 16, kLevel = 8, kExponents = 14;
    const double rom = std::ldexp(root, address);
    const double dot_tables = 2 * 6 * std::ldexp(dot, dot);                      // two banks
    const double level_tables = 2 * 4 * kMaterials * std::ldexp(kLevel, index);  // likewise
    const double path_rom = kExponents * (std::ldexp(1.0, index) + std::ldexp(1, kLevel) - 1);
    const std::string key = value.at("object_processor.word_bits") + ' ' + value.at("object_processor.normal_bits");
    const double rest = row.figures.at(0).value() - rom - dot_tables - level_tables - path_rom;
    EXPECT_EQ(left.emplace(key, rest).first->second, rest) << key;
    const int material_bits = 4;
    EXPECT_EQ(row.figures.at(2).value() * 2,
              number("object_processor.word_bits") + 3 * number("object_processor.normal_bits") + material_bits);
  }
  EXPECT_EQ(left.size(), 12U);
}

TEST_F(ReadySweepTest, WordLengthsQuadratic) {
  const std::string file = std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps/word_lengths_quadratic.toml";
  const Outcome outcome = run({"explore", "run", file, "--store", "s.sqlite", "--jobs", "2", "--set",
                               "video.columns=64", "--set", "video.lines=48"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const explore::SweepTable found = table();
  ASSERT_EQ(found.rows.size(), 96U);
  const auto of = [&](const char* path, const char* scene, const char* words, const char* depth) {
    return figure(found, path, {scene, words, "4", depth});
  };
  for (const char* scene : {"sphere_168", "teapot_at_rest"}) {
    const char *bits = "sum(memories[].total_bits)", *error = "images[0].error.rmse_level";
    // Two buffers of the screen, and two sets of three depth registers.
    EXPECT_EQ(of(bits, scene, "20 of 32", "24") - of(bits, scene, "20 of 32", "12"), 12.0 * (2 * 64 * 48 + 2 * 3));
    EXPECT_GT(of(error, scene, "6 fraction bits of 16", "24"), of(error, scene, "20 of 32", "24"));
  }
}

TEST_F(ReadySweepTest, SpanUnits) {
  const explore::SweepTable table = table_of("span_units");
  for (const std::string units : {"1", "2", "4", "8"})
    for (const std::string preset : {"dram_100", "sram_25", "sram_15"}) {
      EXPECT_EQ(figure(table, "machine.span_unit.units", {units, preset, "4"}), std::stod(units));
      EXPECT_EQ(figure(table, "logic[frame store: data].count", {units, preset, "4"}), 4.0 * 64.0);
      EXPECT_GE(figure(table, "budgets[depth_complexity.drawing].available", {units, preset, "8"}),
                figure(table, "budgets[depth_complexity.drawing].available", {units, preset, "1"}));
    }
}

TEST_F(ReadySweepTest, Resolutions) {
  const explore::SweepTable table = table_of("resolutions");
  for (const std::string screen : {"512 x 512 at 50 Hz", "640 x 480 at 60 Hz", "1280 x 720 at 60 Hz"})
    EXPECT_GE(figure(table, "answer.headroom", {screen, "2", "28 bits"}),
              figure(table, "answer.headroom", {screen, "1", "28 bits"}));
}

// A sixteenth of it: every method on every scene, on the smaller screen with a slow host.
TEST_F(ReadySweepTest, ShadingMethods) {
  const std::string file = std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps/shading_methods.toml";
  const Outcome outcome = run({"explore", "run", file, "--store", "s.sqlite", "--jobs", "2", "--shard", "1/16"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  explore::SweepTable found = table();
  std::erase_if(found.rows, [](const explore::Row& row) { return row.state != explore::State::done; });
  ASSERT_EQ(found.rows.size(), 3 * found.axes.at(1).values.size());
  for (const explore::Row& row : found.rows)
    for (const std::optional<double>& one : row.further) EXPECT_TRUE(one.has_value()) << row.number;
  const auto of = [&](const char* figure_path, const std::string& method, const char* scene = "teapot_at_rest") {
    return figure(found, figure_path, {scene, method, "5", "256 x 256", "soft core"});
  };
  const auto error = [&](const std::string& method) { return of("images[0].error.rmse_level", method); };
  const auto host = [&](const std::string& method) { return of("budgets[set_up.frame].used", method); };
  EXPECT_LT(error("Phong"), error("Gouraud and Phong, 1 ring"));
  EXPECT_LT(error("Gouraud and Phong, 1 ring"), error("Gouraud"));
  EXPECT_LT(error("pseudo-Phong 2"), error("pseudo-Phong 1"));
  EXPECT_LT(error("regular 8 px, 1 ring"), error("regular 256 px, 1 ring"));
  EXPECT_LE(error("regular 32 px, 2 rings"), error("regular 32 px, no ring"));
  // Nothing is lit at corners; more parts, more light.
  EXPECT_LT(host("Phong"), host("Gouraud"));
  EXPECT_LT(host("Gouraud"), host("pseudo-Phong 1"));
  EXPECT_LT(host("regular 256 px, 1 ring"), host("regular 8 px, 1 ring"));
  EXPECT_LT(host("highlight 1.0"), host("highlight 0.05"));
  for (const char* scene : {"teapot_at_rest", "sphere_168", "sphere_690"}) {
    EXPECT_EQ(of("images[0].shaded_pixels", "Gouraud", scene), 0.0);
    EXPECT_EQ(of("images[0].lighting_evaluations", "Phong", scene), 0.0);
    EXPECT_EQ(of("images[0].facing", "Phong", scene), of("images[0].drawn_pieces", "Phong", scene));
    EXPECT_LT(of("images[0].facing", "pseudo-Phong 1", scene), of("images[0].drawn_pieces", "pseudo-Phong 1", scene));
  }
  // A curve a method, a point a threshold.
  std::map<std::string, int> curves;
  for (const std::string& curve : found.axes[1].curves) ++curves[curve];
  EXPECT_EQ(curves["regular subdivision, 1 ring"], 6);
  EXPECT_EQ(curves["highlight subdivision"], 5);
  EXPECT_EQ(curves["Phong"], 1);
}

// Of a sweep whose points are the screens' own: no --set for all.
TEST_F(ReadySweepTest, RegularSubdivision) {
  const std::string file = std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps/regular_subdivision.toml";
  const Outcome outcome = run({"explore", "run", file, "--store", "s.sqlite", "--jobs", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(run({"explore", "show", "s.sqlite"}).out, HasSubstr("Answer, given screen = 512 x 512: "));
  const explore::SweepTable found = table();
  ASSERT_EQ(found.rows.size(), 48U);
  const auto parts = [&](const char* area, const char* rings, const char* screen) {
    return figure(found, "images[0].drawn_pieces", {area, rings, screen});
  };
  for (const char* screen : {"256 x 256", "512 x 512"}) {
    EXPECT_GT(parts("8.0", "1", screen), parts("16.0", "1", screen));
    EXPECT_GT(parts("8.0", "2", screen), parts("8.0", "1", screen));
    EXPECT_LT(figure(found, "images[0].error.rmse_level", {"8.0", "1", screen}),
              figure(found, "images[0].error.rmse_level", {"64.0", "1", screen}));
  }
  // A quarter of the area on half the screen: the same parts, but for what the grid drops.
  EXPECT_NEAR(parts("8.0", "1", "256 x 256"), parts("32.0", "1", "512 x 512"), 0.01 * parts("32.0", "1", "512 x 512"));
}

// Finer triangles are missed less, and so are those of a lamp that is further away.
TEST_F(ReadySweepTest, HighlightRecall) {
  const std::string file = std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps/highlight_recall.toml";
  const Outcome outcome = run({"explore", "run", file, "--store", "s.sqlite", "--jobs", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const explore::SweepTable found = table();
  ASSERT_EQ(found.rows.size(), 20U);
  const auto recall = [&](const char* lamp, const char* sphere) {
    return figure(found, "mean(images[].highlight_recall)", {lamp, sphere});
  };
  EXPECT_EQ(recall("1.0625 radii", "12 x 8"), 0.0);
  EXPECT_EQ(recall("1.25 radii", "12 x 8"), 0.0);
  EXPECT_EQ(recall("1.25 radii", "96 x 64"), 1.0);
  EXPECT_GT(recall("1.0625 radii", "96 x 64"), recall("1.0625 radii", "24 x 16"));
  EXPECT_GT(recall("2 radii", "12 x 8"), 0.5);
  for (const char* sphere : {"8 x 5", "12 x 8", "24 x 16", "48 x 32", "96 x 64"})
    EXPECT_EQ(recall("5 radii", sphere), 1.0) << sphere;
}

// 003, tables 1 and 2: what the paper's computer takes, in milliseconds, beside the model's prediction.
struct PaperTime {
  const char* method;
  const char* screen;
  const char* figure;
  double paper_ms;
  bool fitted;
};
constexpr PaperTime kTable1[] = {
    {"Gouraud", "256 x 256", "software.gouraud", 480, true},
    {"Gouraud", "512 x 512", "software.gouraud", 957, true},
    {"Gouraud", "256 x 256", "software.phong", 3763, true},
    {"Gouraud", "512 x 512", "software.phong", 14630, true},
    {"highlight subdivision", "256 x 256", "software.highlight_subdivision", 881, false},
    {"highlight subdivision", "512 x 512", "software.highlight_subdivision", 1408, false},
    {"regular subdivision", "256 x 256", "software.regular_subdivision", 664, false},
    {"regular subdivision", "512 x 512", "software.regular_subdivision", 1632, false},
    {"Gouraud and Phong", "256 x 256", "software.gouraud_phong", 1104, false},
    {"Gouraud and Phong", "512 x 512", "software.gouraud_phong", 3436, false},
    {"Gouraud", "256 x 256", "frame.in_turn", 110, true},
    {"Gouraud", "512 x 512", "frame.in_turn", 183, true},
    {"highlight subdivision", "256 x 256", "frame.in_turn", 366, false},
    {"highlight subdivision", "512 x 512", "frame.in_turn", 450, false},
    {"regular subdivision", "256 x 256", "frame.in_turn", 177, false},
    {"regular subdivision", "512 x 512", "frame.in_turn", 387, false},
};

TEST_F(ReadySweepTest, SparcStation20) {
  const std::string file = std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps/sparcstation_20.toml";
  const Outcome outcome = run({"explore", "run", file, "--store", "s.sqlite", "--jobs", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const explore::SweepTable found = table();
  ASSERT_EQ(found.rows.size(), 8U);
  const auto ms = [&](const std::string& budget, const char* screen, const char* method) {
    return 1e-3 * figure(found, std::string("budgets[").append(budget).append("].used"), {screen, method});
  };
  for (const PaperTime& time : kTable1) {
    const double model = ms(time.figure, time.screen, time.method);
    std::printf("%-22s %s %-32s paper %6.0f ms, model %6.0f, ratio %.2f%s\n", time.method, time.screen, time.figure,
                time.paper_ms, model, model / time.paper_ms, time.fitted ? ", fitted" : "");
    EXPECT_NEAR(model / time.paper_ms, 1.0, time.fitted ? 0.01 : 0.3) << time.figure << ' ' << time.screen;
  }
  const char *small = "256 x 256", *large = "512 x 512";
  const char *gouraud = "Gouraud", *regular = "regular subdivision", *highlight = "highlight subdivision";
  const auto growth = [&](const char* budget, const char* method) {
    return ms(budget, large, method) / ms(budget, small, method);
  };
  // What the paper says of its times (section 4).
  EXPECT_GE(growth("software.phong", gouraud), 3.5);
  EXPECT_LE(growth("software.gouraud", gouraud), 2.6);
  EXPECT_LE(growth("software.regular_subdivision", regular), 2.6);
  EXPECT_LE(growth("software.highlight_subdivision", highlight), 2.6);
  for (const char* method : {gouraud, regular, highlight}) EXPECT_LE(growth("frame.in_turn", method), 2.6) << method;
  for (const char* screen : {small, large}) {
    const double twice = 2 * ms("software.gouraud", screen, gouraud);
    EXPECT_LT(ms("software.regular_subdivision", screen, regular), twice) << screen;
    EXPECT_LT(ms("software.highlight_subdivision", screen, highlight), twice) << screen;
  }
  EXPECT_LT(ms("software.regular_subdivision", small, regular), ms("software.highlight_subdivision", small, highlight));
  EXPECT_GT(ms("software.regular_subdivision", large, regular), ms("software.highlight_subdivision", large, highlight));
  EXPECT_LT(ms("frame.in_turn", small, regular), ms("frame.in_turn", small, highlight));
}

// The paper's lights are not known: of six choices the counts are of its order, one comes near, and none lets highlight
// subdivision depend on the size.
TEST_F(ReadySweepTest, SparcStation20Lights) {
  const std::string file = std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps/sparcstation_20_lights.toml";
  const Outcome outcome = run({"explore", "run", file, "--store", "s.sqlite", "--jobs", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const explore::SweepTable found = table();
  ASSERT_EQ(found.rows.size(), 24U);
  constexpr double kTriangles = 896;
  const auto mean = [&](const char* name, const char* screen, const char* method, const std::string& lights) {
    return figure(found, std::string("mean(images[].").append(name).append(")"), {screen, method, lights});
  };
  const auto total = [&](const char* screen, const char* method, const std::string& lights) {
    return kTriangles + mean("parts", screen, method, lights) - mean("divided", screen, method, lights);
  };
  const char *small = "256 x 256", *large = "512 x 512";
  const char *regular = "regular subdivision", *highlight = "highlight subdivision";
  for (const std::string& lights : found.axes[2].values) {
    const double potentially = mean("potentially_highlighted", small, regular, lights);
    const double treated = potentially + mean("highlight_neighbours", small, regular, lights);
    std::printf(
        "%-20s %5.1f potentially highlighted (paper 74.5), %5.1f with neighbours (288.4); regular %6.1f and "
        "%6.1f (1075.5, 1955.6), highlight %6.1f and %6.1f (1538)\n",
        lights.c_str(), potentially, treated, total(small, regular, lights), total(large, regular, lights),
        total(small, highlight, lights), total(large, highlight, lights));
    EXPECT_GT(total(large, regular, lights), 1.5 * total(small, regular, lights)) << lights;
    EXPECT_NEAR(total(large, highlight, lights), total(small, highlight, lights), 1.0) << lights;
    // Of the paper's order, whatever the lights.
    EXPECT_GT(potentially, 74.5 / 2) << lights;
    EXPECT_LT(potentially, 74.5 * 2) << lights;
  }
  const std::string ours = "right, in an arc";
  EXPECT_NEAR(mean("potentially_highlighted", small, regular, ours), 74.5, 0.05 * 74.5);
  EXPECT_NEAR(total(small, regular, ours), 1075.5, 0.05 * 1075.5);
  EXPECT_NEAR(total(large, regular, ours), 1955.6, 0.05 * 1955.6);
  EXPECT_NEAR(total(small, highlight, ours), 1538.0, 0.2 * 1538.0);
}

// A solid has the words of one processor, whatever its picture; a mesh 22 a triangle that faces the viewer.
TEST_F(ReadySweepTest, QuadricOrTriangles) {
  const explore::SweepTable table = table_of("quadric_or_triangles");
  const auto of = [&](const char* path, const char* sphere) { return figure(table, path, {sphere}); };
  const char *host = "budgets[host.update].used", *words = "images[0].words_sent";
  const char *error = "errors[sphere].worst.rmse_level", *missing = "errors[sphere].worst.covered_missing";
  EXPECT_EQ(of(words, "one quadric"), 31);
  EXPECT_EQ(of(words, "168 triangles"), 84 * 22);
  EXPECT_EQ(of(missing, "one quadric"), 0);
  EXPECT_EQ(of("modelled.quadric_processors.used", "one quadric"), 1);
  const std::vector<std::pair<const char*, double>> meshes{
      {"168 triangles", 168}, {"374 triangles", 374}, {"690 triangles", 690}, {"31,680 triangles", 31680}};
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    EXPECT_EQ(of("modelled.object_processors.used", meshes[i].first), meshes[i].second);
    EXPECT_GT(of(host, meshes[i].first), 10 * of(host, "one quadric"));
    if (i == 0) continue;
    EXPECT_GT(of(host, meshes[i].first), of(host, meshes[i - 1].first));
    EXPECT_LT(of(error, meshes[i].first), of(error, meshes[i - 1].first));
    EXPECT_LT(of(missing, meshes[i].first), of(missing, meshes[i - 1].first));
  }
  EXPECT_LT(of(error, "one quadric"), of(error, "690 triangles"));
}

// On a screen that is a power of two, as its units of depth have to be pixels.
TEST_F(ReadySweepTest, QuadricWords) {
  const std::string file = std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps/quadric_words.toml";
  const Outcome outcome = run({"explore", "run", file, "--store", "s.sqlite", "--jobs", "2", "--set",
                               "video.columns=128", "--set", "video.lines=128"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(run({"explore", "show", "s.sqlite"}).out, HasSubstr("Answer, given scene = sphere_quadric: "));
  const explore::SweepTable found = table();
  ASSERT_EQ(found.rows.size(), 84U);
  const auto of = [&](const char* path, const char* scene, const char* words, const char* scaling) {
    return figure(found, path, {scene, words, "6", scaling});
  };
  const char* psnr = "errors[ideal].worst.psnr_outline_db";
  const auto wrong = [&](const char* scene, const char* words, const char* scaling) {
    return of("errors[ideal].worst.covered_missing", scene, words, scaling) +
           of("errors[ideal].worst.covered_extra", scene, words, scaling);
  };
  const char *narrow = "4 fraction bits of 24", *wide = "12 of 48";
  EXPECT_GT(wrong("ellipsoid", narrow, "fixed"), 50);
  for (const char* scaling : {"fixed", "object"}) {
    EXPECT_LT(wrong("sphere_quadric", narrow, scaling), 10);
    EXPECT_GT(wrong("ellipsoid", narrow, scaling), wrong("ellipsoid", wide, scaling) + 2);
    for (const char* scene : {"sphere_quadric", "ellipsoid"}) {
      EXPECT_LE(wrong(scene, wide, scaling), 1);
      EXPECT_GT(of(psnr, scene, wide, scaling), 50);
      EXPECT_EQ(of("images[0].solids.refused", scene, wide, scaling), 0);
      // 24 bits more of a discriminant's six words, in two RAMs, and of the three that are kept, in 512 processors.
      EXPECT_GT(of("sum(memories[].total_bits)", scene, wide, scaling),
                of("sum(memories[].total_bits)", scene, narrow, scaling) + 512 * 24 * 15);
    }
  }
}

// Nobody adds one without a test above.
TEST_F(ReadySweepTest, AllAreTested) {
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(RASTERTLM_SOURCE_DIR) + "/configs/sweeps"))
    found.insert(entry.path().stem().string());
  EXPECT_EQ(found, (std::set<std::string>{"highlight_recall", "loaders", "pipeline_or_tree", "quadric_or_triangles",
                                          "quadric_words", "regular_subdivision", "resolutions", "shading_methods",
                                          "span_units", "sparcstation_20", "sparcstation_20_lights", "transputers",
                                          "word_lengths", "word_lengths_quadratic"}));
}

}  // namespace
}  // namespace rastertlm::test
