// Every parameter of the quadratic machine moves something, the picture or a figure of the report, or is refused.
#include <map>

#include "platforms/quadratic/machine.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

using parameter::Kind;
using parameter::Parameter;
using Settings = std::vector<std::string>;

const std::string kQuadratic = RASTERTLM_SOURCE_DIR "/configs/machines/quadratic.toml";
const std::string kAdaptiveMachine = RASTERTLM_SOURCE_DIR "/configs/machines/adaptive.toml";
const std::string kSphere = RASTERTLM_SOURCE_DIR "/configs/scenes/sphere_168.toml";
const Settings kSmall{"video.columns=64", "video.lines=64"};

// The report and the picture, or what was wrong.
std::string outcome(Settings settings, const std::string& machine = kQuadratic) {
  settings.insert(settings.begin(), kSmall.begin(), kSmall.end());
  return in_child([&]() -> std::string {
    try {
      const run::Inputs inputs = run::read_inputs(machine, kSphere, settings);
      std::vector<frame::Frame> shown;
      run::Options options;
      options.reference = false;
      run::Result result =
          run::simulate(inputs, options, [&](const run::FramePixels& pixels) { shown.push_back(pixels.shown); });
      result.config_digest.clear();  // moves with everything
      return simulation::packed(result, shown);
    } catch (const InputError& error) {
      return "refused: " + std::string(error.what());
    }
  });
}

std::string next_value(const Parameter& p) {
  switch (p.kind) {
    case Kind::integer:
      return std::to_string(std::get<std::int64_t>(p.get()) + 1);
    case Kind::real:
      return std::to_string(1.25 * std::get<double>(p.get()));
    case Kind::boolean:
      return std::get<bool>(p.get()) ? "false" : "true";
    case Kind::choice:
      for (const std::string& choice : p.choices)
        if (choice != std::get<std::string>(p.get())) return choice;
      return "";
    default:
      return "";
  }
}

struct Change {
  Settings beside;
  Settings change;
  bool refused = false;
};

const std::map<std::string, Change>& special_changes() {
  static const Settings kAdaptive{"set_up.method=quadratic_adaptive"};
  static const Settings kInstructions{"host.cost=instructions"};
  static const std::map<std::string, Change> changes{
      {"host.preset", {{}, {"host.preset=t9000"}}},
      {"video.preset", {{}, {"video.preset=vga_60"}}},
      {"video.interlaced", {{}, {"video.interlaced=true"}, true}},
      {"video.refresh_hz", {{}, {"video.refresh_hz=40.0"}}},
      {"host.bus_bits", {{}, {"host.bus_bits=16"}}},
      {"frame_store.preset", {{}, {"frame_store.preset=dram_100"}}},
      {"frame_store.buffers", {{}, {"frame_store.buffers=1"}}},
      {"frame_store.width_bits", {{}, {"frame_store.width_bits=96"}}},
      {"set_up.method", {{}, {"set_up.method=gouraud"}}},
      {"set_up.arithmetic", {{}, {"set_up.arithmetic=fixed", "set_up.fixed_fraction_bits=16"}}},
      {"set_up.fixed_fraction_bits",
       {{"set_up.arithmetic=fixed", "set_up.fixed_fraction_bits=24"}, {"set_up.fixed_fraction_bits=16"}}},
      {"highlight_test.threshold_levels", {kAdaptive, {"highlight_test.threshold_levels=40.0"}}},
      {"highlight_test.points", {kAdaptive, {"highlight_test.points=points"}}},
      {"highlight_test.depth_limit", {kAdaptive, {"highlight_test.depth_limit=0"}}},
      {"subdivision.coverage",
       {{"set_up.method=quadratic_adaptive", "set_up.snap_bits=0", "highlight_test.threshold_levels=0.0"},
        {"subdivision.coverage=snapped"}}},
      {"span_unit.depth_bits", {{}, {"span_unit.depth_bits=22"}}},
      {"span_unit.depth_fraction_bits", {{}, {"span_unit.depth_fraction_bits=7"}}},
      {"span_unit.prestep_bits", {{"span_unit.start_edge=prestep"}, {"span_unit.prestep_bits=1"}}},
      {"software.preset", {{}, {"software.preset=t800_20"}}},
      {"software.frame_us", {{}, {"software.frame_us=5.0"}}},
      {"software.triangle_us", {{}, {"software.triangle_us=5.0"}}},
      {"software.light_us", {{}, {"software.light_us=5.0"}}},
      {"span_unit.share", {{"span_unit.units=2"}, {"span_unit.share=triangles"}}},
  };
  return changes;
}

// Of the adaptive machine, where they differ.
std::map<std::string, Change> adaptive_changes() {
  std::map<std::string, Change> changes = special_changes();
  const Settings cut{"subdivision.area_pixels=1.0"}, at_highlights{"set_up.method=highlight_subdivision"};
  changes["highlight_test.rings"] = {cut, {"highlight_test.rings=0"}};
  changes["highlight_test.refinements"] = {at_highlights, {"highlight_test.refinements=0"}};
  changes["subdivision.area_pixels"] = {{}, cut};
  changes["subdivision.intensity_error"] = {at_highlights, {"subdivision.intensity_error=0.001"}};
  changes["subdivision.depth_limit"] = {cut, {"subdivision.depth_limit=0"}};
  changes["subdivision.stitch"] = {cut, {"subdivision.stitch=true"}};
  for (const char* path : {"clock_ns", "cycles_per_pixel", "latency_cycles", "cycles_per_line", "load_cycles"}) {
    const std::string key = std::string("pixel_unit.") + path;
    changes[key] = {{"set_up.method=phong"}, {key + (key.ends_with("ns") ? "=62.5" : "=40")}};
  }
  return changes;
}

// How many were tried.
std::size_t every_parameter_moves_something(const std::string& title, const std::string& machine,
                                            const std::map<std::string, Change>& special) {
  std::size_t tried = 0;
  for (const auto& [name, table] : run::described_tables()) {
    if (name != title) continue;
    for (const Parameter& p : table.parameters()) {
      if (p.about.exempt) continue;
      Change change;
      if (const auto found = special.find(p.path); found != special.end())
        change = found->second;
      else if (p.about.only_when)
        change = {{p.about.only_when->path + '=' + p.about.only_when->values.front()}, {p.path + '=' + next_value(p)}};
      else
        change = {{}, {p.path + '=' + next_value(p)}};
      const std::string before = outcome(change.beside, machine);
      Settings changed = change.beside;
      changed.insert(changed.end(), change.change.begin(), change.change.end());
      const std::string after = outcome(changed, machine);
      ++tried;
      EXPECT_FALSE(before.starts_with("refused")) << p.path << ": " << before;
      EXPECT_EQ(after.starts_with("refused"), change.refused) << p.path << ": " << after.substr(0, 300);
      EXPECT_TRUE(before != after) << p.path << " moves nothing";
    }
  }
  return tried;
}

TEST(Parameters, OfTheQuadraticMachineMoveSomething) {
  EXPECT_GT(every_parameter_moves_something("machine quadratic", kQuadratic, special_changes()), 45U);
}
TEST(Parameters, OfTheAdaptiveMachineMoveSomething) {
  EXPECT_GT(every_parameter_moves_something("machine adaptive", kAdaptiveMachine, adaptive_changes()), 45U);
}

// Margins of 257 units on both sides of the depths of 512 x 512: 8 bits hold nothing between, 9 hold near behind far.
TEST(Parameters, DepthsThatAScreenHasNoRoomForAreRefused) {
  const auto refused = [](std::int64_t bits, std::int64_t fraction_bits) {
    quadratic::Machine machine;
    machine.span_unit.depth_bits = bits;
    machine.span_unit.depth_fraction_bits = fraction_bits;
    Diagnostics diagnostics;
    machine.check(diagnostics, "machine.toml");
    try {
      diagnostics.throw_if_any();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const std::int64_t bits : {8, 9})
    EXPECT_NE(refused(bits, 8).find("span_unit.depth_bits: " + std::to_string(bits) +
                                    " bits hold no depth on a screen of 512 x 512, whose margins are 257 units on both "
                                    "sides; at least 10 are accepted"),
              std::string::npos)
        << refused(bits, 8);
  EXPECT_EQ(refused(10, 8), "");
  // 2048 steps of half a unit, a quarter, an eighth.
  EXPECT_NE(refused(24, 0).find("at least 2 are accepted"), std::string::npos) << refused(24, 0);
  EXPECT_NE(refused(24, 1).find("span_unit.depth_fraction_bits"), std::string::npos);
  EXPECT_EQ(refused(24, 2), "");
}

TEST(Parameters, OfAPixelUnitMoveSomething) {
  const std::string adaptive = RASTERTLM_SOURCE_DIR "/configs/machines/adaptive.toml";
  const std::string before = outcome({"set_up.method=phong"}, adaptive);
  EXPECT_FALSE(before.starts_with("refused")) << before;
  std::size_t tried = 0;
  for (const auto& [title, table] : run::described_tables()) {
    if (title != "machine adaptive") continue;
    for (const Parameter& p : table.parameters()) {
      if (!p.path.starts_with("pixel_unit.")) continue;
      ++tried;
      const std::string after = outcome({"set_up.method=phong", p.path + '=' + next_value(p)}, adaptive);
      EXPECT_FALSE(after.starts_with("refused")) << after.substr(0, 300);
      EXPECT_TRUE(before != after) << p.path << " moves nothing";
    }
  }
  EXPECT_EQ(tried, 5U);
}

// Two runs, and every vector variant, give the same bytes.
TEST(Parameters, TheSameRunGivesTheSameBytes) {
  const std::string once = outcome({"set_up.method=quadratic_adaptive"});
  EXPECT_EQ(once, outcome({"set_up.method=quadratic_adaptive"}));
  for (const char* variant : {"baseline", "avx2"}) {
    ::setenv("RASTERTLM_VECTOR", variant, 1);
    EXPECT_EQ(once, outcome({"set_up.method=quadratic_adaptive"})) << variant;
  }
  ::unsetenv("RASTERTLM_VECTOR");
}

}  // namespace
}  // namespace rastertlm::test
