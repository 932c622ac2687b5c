// Every parameter of the machine's and the scene's tables moves something: a picture or a figure of the report, where a
// suitable scene gives it a chance. What is exempt by its declaration moves nothing.
#include <map>
#include <regex>
#include <set>

#include "src/base/digest.h"
#include "src/config/presets.h"
#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

using parameter::Kind;
using parameter::Parameter;
using parameter::Table;
using Settings = std::vector<std::string>;

enum class Effect { moves, refused };  // refused: this machine does without, and says so

// A setting that changes a parameter, in a scene and beside other settings where it can move something.
struct Change {
  std::string scene = "turning";
  Settings set = {};
  Settings change = {};
  Effect effect = Effect::moves;
};

// Every path of a table and of the elements of its lists: "light[0].towards".
void add_paths(const Table& table, const std::string& prefix, std::map<std::string, Parameter>& paths) {
  for (const Parameter& p : table.parameters()) paths.emplace(prefix + p.path, p);
  for (const parameter::List& list : table.lists()) add_paths(list.example(), prefix + list.path + "[0].", paths);
}

std::map<std::string, Parameter> paths_of(const std::string& name) {
  std::map<std::string, Parameter> paths;
  for (const auto& [title, table] : run::described_tables())
    if (title == name) add_paths(table, "", paths);
  return paths;
}

// Another value than the default: the next integer, a real a quarter larger, the other choice.
std::string other_value(const Parameter& p) {
  switch (p.kind) {
    case Kind::integer:
      return std::to_string(std::get<std::int64_t>(p.default_value) + 1);
    case Kind::real: {
      const double value = std::get<double>(p.default_value);
      return std::to_string(value == 0.0 ? 1.0 : 1.25 * value);
    }
    case Kind::boolean:
      return std::get<bool>(p.default_value) ? "false" : "true";
    case Kind::choice:
      for (const std::string& choice : p.choices)
        if (choice != std::get<std::string>(p.default_value)) return choice;
      return "";
    default:
      return "";
  }
}

// Whether a declaration leaves room for another value.
bool has_one_value(const Parameter& p) {
  if (p.kind == Kind::choice) return p.choices.size() == 1;
  return p.kind == Kind::integer && p.range && p.range->minimum == p.range->maximum;
}

class ParameterTest : public SimulationTest {
 protected:
  void SetUp() override {
    SimulationTest::SetUp();
    const std::string still = R"([[object]]
type = "triangles"
two_sided = true
positions = [[-2.0, 1.0, -1.5], [2.0, 1.3, -1.0], [0.2, 0.8, 2.2]]
)";
    const std::string sphere = "[[object]]\ntype = \"uv_sphere\"\nmaterial = \"glaze\"\nradius = 1.5\n";
    const std::string keys = R"(type = "keys"
)";
    const auto key = [](const std::string& owner) {
      return "[[" + owner + ".key]]\nframe = 0\n[[" + owner + ".key]]\nframe = 4\ntranslate = [0.8, 0.0, 0.4]\n";
    };
    add("turning", scene_of(sphere + kSpin + still));
    add("sphere", scene_of(sphere + kSpin));
    add("plain sphere", scene_of("[[object]]\ntype = \"uv_sphere\"\nmaterial = \"glaze\"\n"));
    add("teapot", scene_of("[[object]]\ntype = \"teapot\"\nscale = [0.5, 0.5, 0.5]\n"));
    add("triangles", scene_of(still));
    add("cut sphere", scene_of("[[object]]\ntype = \"sphere\"\n[[object.plane]]\ndistance = 0.5\n"));
    add("solids",
        scene_of("[[object]]\ntype = \"cylinder\"\nmaterial = \"glaze\"\nheight = 1.6\nrotate_deg = [50.0, 20.0, "
                 "0.0]\n[[object.animation]]\ntype = \"spin\"\naxis = [1.0, 0.5, 0.0]\ndeg_per_frame = "
                 "7.0\n[[object]]\ntype = \"ellipsoid\"\nradii = [0.5, 1.2, 0.3]\nrotate_deg = [10.0, 40.0, 30.0]\n"));
    add("mesh", scene_of("[[object]]\ntype = \"mesh\"\nfile = \"one.obj\"\n"));
    add("object by keys", scene_of(sphere + "[[object.animation]]\n" + keys + key("object.animation")));
    add("camera turning",
        scene_of(still, std::string(kCamera) +
                            "[[camera.animation]]\ntype = \"orbit\"\naxis = [0.2, 0.0, 1.0]\ndeg_per_frame = 5.0\n"));
    add("camera by keys",
        scene_of(still, std::string(kCamera) + "[[camera.animation]]\n" + keys + key("camera.animation")));
    written("one.obj", "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nf 1 2 3\n");
    written("two.obj", "v -1 0 -1\nv 1 0 -1\nv 0 0 2\nf 1 2 3\n");
  }

  static Change by_instructions(const std::string& operation, const std::string& scene = "turning") {
    return {.scene = scene, .set = {"host.cost=instructions"}, .change = {"host.instruction." + operation + "=211.0"}};
  }

  // The machine's, where the next value in a turning scene does not do.
  static std::map<std::string, Change> special_machine_changes() {
    const Settings sequencer{"loader.kind=sequencer"};
    // One slow unit: its update takes several frames.
    const Settings late{"host.processors_per_unit=1024", "host.computation_units=1", "host.clock_hz=1000000",
                        "host.sustained_mflops=0.3"};
    return {
        {"host.instruction.add", by_instructions("add")},
        {"host.instruction.multiply", by_instructions("multiply")},
        {"host.instruction.divide", by_instructions("divide")},
        {"host.instruction.square_root", by_instructions("square_root", "camera turning")},
        {"host.instruction.compare", by_instructions("compare")},
        {"host.instruction.convert", by_instructions("convert")},
        {"host.instruction.integer", by_instructions("integer")},
        {"host.instruction.integer_multiply", by_instructions("integer_multiply")},
        {"host.instruction.operand", by_instructions("operand")},
        {"host.bus_bits", {.change = {"host.bus_bits=16"}}},
        {"host.links", {.change = {"host.links=3"}}},
        {"host.links_available", {.change = {"host.links_available=3"}, .effect = Effect::refused}},
        {"host.link_packet_bytes", {.set = {"host.link_packet_bits=20.0"}, .change = {"host.link_packet_bytes=4"}}},
        {"host.swap", {.set = late, .change = {"host.swap=unconditional"}}},
        {"object_processor.word_bits", {.change = {"object_processor.word_bits=25"}}},
        {"host.overflow",
         {.set = {"host.processors_per_unit=20", "host.overflow=drop"},
          .change = {"host.overflow=error"},
          .effect = Effect::refused}},
        {"shading.diffuse_fraction_bits", {.change = {"shading.diffuse_fraction_bits=0"}}},
        {"shading.dot_table_output_bits", {.change = {"shading.dot_table_output_bits=10"}}},
        {"shading.level_bits", {.change = {"shading.level_bits=7"}}},
        {"shading.specular_tables", {.change = {"shading.specular_tables=3"}}},
        {"shading.exponents", {.change = {"shading.exponents=[5, 20, 50]"}}},
        {"loader.materials", {.set = {"loader.diffuse.cycles=37.0"}, .change = {"loader.materials=all"}}},
        {"loader.on_overrun",
         {.scene = "camera turning",
          .set = {"loader.when=retrace", "loader.on_overrun=show"},
          .change = {"loader.on_overrun=refuse"},
          .effect = Effect::refused}},
        {"loader.sequencer_clock_ns", {.set = sequencer, .change = {"loader.sequencer_clock_ns=50.0"}}},
    };
  }

  static std::map<std::string, Change> world_changes() {
    return {
        {"background", {.change = {"background=[9.0, 0.0, 0.0]"}}},
        {"ambient_light", {.change = {"ambient_light=[0.5, 1.0, 1.0]"}}},
        {"lighting.model", {.change = {"lighting.model=phong"}, .effect = Effect::refused}},
        {"lighting.specular_gate", {.change = {"lighting.specular_gate=true"}, .effect = Effect::refused}},
        {"camera.projection", {.change = {"camera.projection=orthographic"}}},
        {"camera.eye", {.change = {"camera.eye=[1.0, -10.0, 0.0]"}}},
        {"camera.target", {.change = {"camera.target=[0.1, 0.0, 0.0]"}}},
        {"camera.up", {.change = {"camera.up=[0.2, 0.0, 1.0]"}}},
        {"camera.vertical_fov_deg", {.change = {"camera.vertical_fov_deg=40.0"}}},
        {"camera.height", {.set = {"camera.projection=orthographic"}, .change = {"camera.height=7.0"}}},
        {"camera.near", {.change = {"camera.near=2.0"}}},
        {"camera.far", {.change = {"camera.far=50.0"}}},
        {"light[0].type",
         {.change = {"light[0].type=point", "light[0].position=[9.0, -9.0, 9.0]"}, .effect = Effect::refused}},
        {"light[0].position",
         {.change = {"light[0].type=point", "light[0].position=[9.0, -9.0, 9.0]"}, .effect = Effect::refused}},
        {"light[0].towards", {.change = {"light[0].towards=[0.5, -0.6, 0.5]"}}},
        {"light[0].intensity", {.change = {"light[0].intensity=[1.0, 0.5, 1.0]"}}},
        {"material[0].colour", {.change = {"material[0].colour=[0.1, 0.5, 0.2]"}}},
        {"material[0].ambient", {.change = {"material[0].ambient=0.2"}}},
        {"material[0].diffuse", {.change = {"material[0].diffuse=0.4"}}},
        {"material[0].specular", {.change = {"material[0].specular=0.3"}}},
        {"material[0].exponent", {.change = {"material[0].exponent=50"}}},
    };
  }

  static std::map<std::string, Change> object_changes() {
    return {
        {"object[0].type", {.scene = "plain sphere", .change = {"object[0].type=teapot"}}},
        {"object[0].material", {.change = {"object[0].material=slate"}}},
        {"object[0].translate", {.change = {"object[0].translate=[0.3, 0.0, 0.0]"}}},
        {"object[0].rotate_deg", {.change = {"object[0].rotate_deg=[20.0, 0.0, 0.0]"}}},
        {"object[0].scale", {.change = {"object[0].scale=[1.2, 1.0, 1.0]"}}},
        {"object[0].two_sided", {.set = {"camera.near=10.0"}, .change = {"object[0].two_sided=true"}}},
        {"object[0].segments", {.scene = "teapot", .change = {"object[0].segments=3"}}},
        {"object[0].patches", {.scene = "teapot", .change = {"object[0].patches=32"}}},
        {"object[0].radius", {.change = {"object[0].radius=1.0"}}},
        {"object[0].slices", {.change = {"object[0].slices=9"}}},
        {"object[0].stacks", {.change = {"object[0].stacks=6"}}},
        {"object[0].file", {.scene = "mesh", .change = {"object[0].file=two.obj"}}},
        {"object[0].positions",
         {.scene = "triangles",
          .change = {"object[0].positions=[[-2.0, 1.0, -1.5], [2.0, 1.3, -1.0], [0.2, 0.8, 1.2]]"}}},
        {"object[0].normals",
         {.scene = "triangles",
          .change = {"object[0].normals=[[-0.5, -1.0, 0.0], [0.5, -1.0, 0.0], [0.0, -1.0, 0.5]]"}}},
        {"object[0].indices", {.scene = "triangles", .change = {"object[0].indices=[[0, 1, 2], [0, 2, 1]]"}}},
    };
  }

  // A change of type alone has an object without keys of its own.
  static std::map<std::string, Change> solid_changes() {
    std::map<std::string, Change> changes;
    const std::string processors = "quadric_processor.per_unit=1";
    const auto add = [&](const std::string& type, const std::string& key, const std::string& value) {
      const std::string path = "object[0]." + key;
      changes[path] = {
          .scene = "teapot", .set = {processors, "object[0].type=" + type}, .change = {path + '=' + value}};
    };
    add("ellipsoid", "radii", "[1.0, 2.0, 1.0]");
    add("cone", "height", "1.5");
    add("cone", "capped", "false");
    add("hyperboloid", "sheets", "2");
    add("hyperboloid", "waist", "0.6");
    add("quadric", "squares", "[1.0, 2.0, 1.0]");
    add("quadric", "products", "[0.5, 0.0, 0.0]");
    add("quadric", "linear", "[0.5, 0.0, 0.0]");
    add("quadric", "constant", "-2.0");
    for (const auto& [key, value] : {std::pair{"normal", "[1.0, -1.0, 0.0]"}, {"distance", "0.2"}}) {
      const std::string path = std::string("object[0].plane[0].").append(key);
      changes[path] = {.scene = "cut sphere", .set = {processors}, .change = {path + '=' + value}};
    }
    // A solid is a picture of its own, and takes no triangle.
    changes["object[0].type of a solid"] = {
        .scene = "plain sphere", .set = {processors}, .change = {"object[0].type=sphere"}};
    return changes;
  }

  // The quadric processors', in a scene of solids that turns.
  static std::map<std::string, Change> quadric_changes() {
    std::map<std::string, Change> changes;
    const auto add = [&](const std::string& key, const std::string& value, Settings set = {},
                         Effect effect = Effect::moves) {
      const std::string path = "quadric_processor." + key;
      set.push_back("quadric_processor.per_unit=2");
      changes[path] = {.scene = "solids", .set = std::move(set), .change = {path + '=' + value}, .effect = effect};
    };
    add("per_unit", "3");
    add("word_bits", "40");
    add("fraction_bits", "6");
    add("plane_bits", "38");
    add("slice_bits", "11");
    add("caps", "3");
    add("root_integer_bits", "9");
    add("root_guard_bits", "5");
    add("root_reading", "floor");
    add("multiplier_bits", "20");
    add("scaling", "fixed");
    add("alignment", "delay");
    add("output_cycles", "3");
    add("on_refusal", "error", {"quadric_processor.caps=1", "quadric_processor.on_refusal=drop"}, Effect::refused);
    return changes;
  }

  static std::map<std::string, Change> animation_changes() {
    std::map<std::string, Change> changes;
    for (const std::string owner : {"object", "camera"}) {
      const std::string path = owner + (owner == "camera" ? ".animation[0]." : "[0].animation[0].");
      const std::string turning = owner == "camera" ? "camera turning" : "sphere";
      const std::string by_keys = owner + " by keys";
      // A sphere that spins about itself looks another as it orbits; a camera that orbits, another as it spins.
      changes[path + "type"] = {.scene = turning,
                                .set = {path + "centre=[0.5, 0.0, 0.0]"},
                                .change = {path + (owner == "camera" ? "type=spin" : "type=orbit")}};
      if (owner == "object") changes[path + "type"].set.push_back("object[0].translate=[0.3, 0.0, 0.2]");
      changes[path + "axis"] = {.scene = turning, .change = {path + "axis=[0.0, 1.0, 0.5]"}};
      changes[path + "centre"] = {.scene = turning, .change = {path + "centre=[0.5, 0.0, 0.0]"}};
      changes[path + "deg_per_frame"] = {.scene = turning, .change = {path + "deg_per_frame=8.0"}};
      changes[path + "key[0].frame"] = {.scene = by_keys, .change = {path + "key[0].frame=1"}};
      changes[path + "key[0].translate"] = {.scene = by_keys, .change = {path + "key[0].translate=[0.2, 0.0, 0.0]"}};
      changes[path + "key[0].rotate_deg"] = {.scene = by_keys, .change = {path + "key[0].rotate_deg=[0.0, 4.0, 3.0]"}};
    }
    return changes;
  }

  // Everything that a run shows and reports of itself, but for the digests of its input and the formulas that name
  // settings; or what refuses it.
  const std::string& observed(const std::string& scene, const Settings& set) {
    std::string name = scene;
    for (const std::string& one : set) name += ' ' + one;
    const auto found = seen_.find(name);
    return found != seen_.end() ? found->second : seen_[name] = simulate_text(scene, set);
  }

  void expect_effect(const std::string& path, const Change& change) {
    SCOPED_TRACE(path);
    Settings changed = change.set;
    changed.insert(changed.end(), change.change.begin(), change.change.end());
    const std::string& before = observed(change.scene, change.set);
    const std::string& after = observed(change.scene, changed);
    EXPECT_FALSE(is_refusal(before)) << before;
    EXPECT_NE(before, after);
    EXPECT_EQ(is_refusal(after), change.effect == Effect::refused) << (is_refusal(after) ? after : "not refused");
  }

  static bool is_refusal(const std::string& text) { return text.starts_with("refused: "); }

 private:
  void add(const std::string& name, const std::string& text) {
    scenes_[name] = written("scene" + std::to_string(scenes_.size()) + ".toml", text);
  }

  std::string simulate_text(const std::string& scene, const Settings& set) const {
    Settings all{"video.columns=64", "video.lines=64"};
    all.insert(all.end(), set.begin(), set.end());
    try {
      return in_child([&] {
        const run::Inputs inputs = run::read_inputs(kMachine, scenes_.at(scene), all);
        std::vector<frame::Frame> shown;
        run::Result result = run::simulate(inputs, {3, false, false, false},
                                           [&](const run::FramePixels& pixels) { shown.push_back(pixels.shown); });
        result.config_digest = result.scene_digest = "";
        for (run::Budget& budget : result.budgets) budget.source.clear();
        return report::json_text({result, false}) + "with its pixels: " + sha256_hex(simulation::packed(result, shown));
      });
    } catch (const InputError& error) {
      return std::string("refused: ") + error.what();
    }
  }

  std::map<std::string, std::string> scenes_;
  std::map<std::string, std::string> seen_;
};

// The text of a section of report.json: "" where there is none.
std::string section_of(const std::string& json, const std::string& name) {
  const std::string line = "\n  \"";  // of a key of the whole
  const std::size_t begin = json.find(line + name + "\":");
  return begin == std::string::npos ? "" : json.substr(begin, json.find(line, begin + 1) - begin);
}

// "images[].torn" or "answer.update_rate_hz" in what a parameter moves is a key of report.json.
TEST_F(ParameterTest, TheFiguresThatItNamesAreInTheReport) {
  const Simulated simulated = simulate(kMachine, kTeapot, {.set = {"video.columns=64", "video.lines=64"}});
  const std::string json = report::json_text({simulated.result, false});
  const std::regex figure(R"(\b([a-z_]+)(\[\])?\.([a-z_]+))");
  std::size_t figures = 0;
  const std::map<std::string, Parameter> paths = paths_of("machine imogene");
  for (const auto& [path, p] : paths)
    for (std::sregex_iterator found(p.about.moves.begin(), p.about.moves.end(), figure), end; found != end; ++found) {
      if (paths.contains(found->str())) continue;  // another parameter
      EXPECT_NE(section_of(json, (*found)[1]).find('"' + found->str(3) + "\":"), std::string::npos)
          << path << " moves " << found->str();
      ++figures;
    }
  EXPECT_GT(figures, 15U);
}

// A name among the presets that are compiled in: each other one is a change. Without a preset the machine has the
// values of the default one, which the declarations repeat.
bool is_preset(const std::string& path) { return path.ends_with(".preset"); }

// Other instructions that take as long: the report's formulas alone name them, and figures stay.
const std::set<std::string> kSameTimes{"add_w_addx_w_move_w"};

TEST_F(ParameterTest, OfTheMachineMovesSomething) {
  std::map<std::string, Change> special = special_machine_changes();
  special.merge(quadric_changes());
  const std::map<std::string, Parameter> paths = paths_of("machine imogene");
  EXPECT_GT(paths.size(), 50U);
  for (const auto& [path, change] : special) EXPECT_TRUE(paths.contains(path)) << path << " is no parameter";
  for (const auto& [path, p] : paths) {
    if (p.about.exempt) {
      EXPECT_TRUE(has_one_value(p)) << path << " is exempt and can be changed: show that nothing moves";
      continue;
    }
    if (is_preset(path)) continue;
    const auto found = special.find(path);
    if (found != special.end()) {
      expect_effect(path, found->second);
      continue;
    }
    ASSERT_NE(other_value(p), "") << path;
    expect_effect(path, {.change = {path + '=' + other_value(p)}});
  }
}

TEST_F(ParameterTest, PresetMovesSomethingIfItIsAnother) {
  std::size_t presets = 0;
  for (const auto& [path, p] : paths_of("machine imogene")) {
    if (!is_preset(path)) continue;
    const std::string usual = std::get<std::string>(p.default_value);
    const std::string set = path + '=';
    for (const std::string& name : config::Presets::compiled_in().names(path.substr(0, path.rfind('.'))))
      if (name != usual && !kSameTimes.contains(name)) expect_effect(path, {.change = {set + name}});
    EXPECT_EQ(observed("turning", {}), observed("turning", {set + "\"\""})) << path;
    ++presets;
  }
  EXPECT_GE(presets, 5U);  // the host, the memory of the tables, and three loops
}

TEST_F(ParameterTest, OfTheSceneMovesSomething) {
  std::map<std::string, Change> changes = world_changes();
  changes.merge(object_changes());
  changes.merge(solid_changes());
  changes.merge(animation_changes());
  const std::map<std::string, Parameter> paths = paths_of("scene");
  for (const auto& [path, change] : changes) {
    EXPECT_TRUE(paths.contains(path) || path.ends_with(" of a solid")) << path << " is no parameter";
    expect_effect(path, change);
  }
  for (const auto& [path, p] : paths)
    if (!changes.contains(path)) {
      EXPECT_TRUE(p.about.exempt) << path << " is not shown to move anything";
    }
}

// schema has one value; a material may be called as one likes.
TEST_F(ParameterTest, OfTheSceneThatIsExemptMovesNothing) {
  for (const auto& [path, p] : paths_of("scene"))
    if (p.about.exempt) {
      EXPECT_TRUE(has_one_value(p) || path == "material[0].name") << path << ": show that nothing moves";
    }
  EXPECT_EQ(observed("sphere", {}), observed("sphere", {"material[0].name=enamel", "object[0].material=enamel"}));
}

}  // namespace
}  // namespace rastertlm::test
