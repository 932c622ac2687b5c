// A small configuration that has every kind of parameter, for the tests of this folder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/config/presets.h"
#include "src/parameter/table.h"

namespace rastertlm::config::sample {

using parameter::IndexTriple;
using parameter::kAnyReal;
using parameter::Table;
using parameter::Triple;

enum class Shape { ball, box, mesh };
enum class Mode { fast, exact };

struct Turn {
  double degrees = 1.0;
  Triple axis{0, 0, 1};
  void declare(Table& table) {
    table.real("degrees", degrees, {-360.0, 360.0},
               {.unit = "degrees", .description = "Angle a frame.", .moves = "picture"});
    table.triple("axis", axis, {-kAnyReal, kAnyReal}, {.unit = "", .description = "Axis.", .moves = "picture"});
  }
};

struct Thing {
  Shape shape = Shape::ball;
  std::string name;
  double radius = 1.0;
  std::string file;
  std::vector<Triple> points;
  std::vector<IndexTriple> faces;
  std::vector<Turn> turns;
  void declare(Table& table) {
    table.choice("type", shape, {"ball", "box", "mesh"}, {.unit = "", .description = "Shape.", .moves = "picture"});
    table.text("name", name, {.unit = "", .description = "Name.", .moves = "", .required = true, .exempt = true});
    table.real("radius", radius, {0.0, 1000.0, true},
               {.unit = "metres",
                .description = "Radius.",
                .moves = "picture",
                .only_when = parameter::Condition{"type", {"ball"}}});
    table.text("file", file,
               {.unit = "",
                .description = "Mesh file.",
                .moves = "picture",
                .only_when = parameter::Condition{"type", {"mesh"}},
                .required = true});
    table.triples("points", points, {.unit = "", .description = "Points.", .moves = "picture"});
    table.index_triples("faces", faces, {.unit = "", .description = "Faces.", .moves = "picture"});
    table.list("turn", turns, "How it turns.");
  }
};

struct Configuration {
  std::int64_t schema = 1;
  Mode mode = Mode::fast;
  std::int64_t columns = 512;
  double refresh = 50.0;
  std::string preset = "slow";
  std::int64_t clock = 1;
  double rate = 2.5;
  bool verbose = false;
  std::int64_t seed = 0;
  Triple colour{0.25, 0.5, 1.0};
  std::vector<std::int64_t> widths{8, 12};
  std::vector<Turn> camera_turns;
  std::vector<Thing> things;
  void declare(Table& table) {
    table.integer("schema", schema, {1, 1}, {.unit = "", .description = "Schema.", .moves = "", .exempt = true});
    table.choice("mode", mode, {"fast", "exact"}, {.unit = "", .description = "Mode.", .moves = "error"});
    table.integer("video.columns", columns, {1, 16384},
                  {.unit = "pixels", .description = "Columns of the picture.", .moves = "picture"});
    table.real("video.refresh_hz", refresh, {0.0, 1000.0, true},
               {.unit = "Hz", .description = "Refresh rate.", .moves = "rate"});
    table.text("host.preset", preset, {.unit = "", .description = "Preset.", .moves = "rate"});
    table.integer("host.clock_hz", clock, {1, 1'000'000'000}, {.unit = "Hz", .description = "Clock.", .moves = "rate"});
    table.real("host.rate", rate, {-kAnyReal, kAnyReal}, {.unit = "", .description = "Rate | speed.", .moves = "rate"});
    table.boolean("host.verbose", verbose, {.unit = "", .description = "Talks.", .moves = "", .exempt = true});
    table.integer(
        "host.seed", seed, {0, 255},
        {.unit = "", .description = "Seed.", .moves = "picture", .only_when = parameter::Condition{"mode", {"exact"}}});
    table.triple("camera.colour", colour, {0.0, 1.0}, {.unit = "", .description = "Colour.", .moves = "picture"});
    table.integers("host.widths", widths, {1, 64}, {.unit = "bits", .description = "Widths.", .moves = "picture"});
    table.list("camera.turn", camera_turns, "How the camera turns.");
    table.list("thing", things, "What is seen.");
  }
};

inline Presets presets() {
  return Presets({{"host", {{"slow", "clock_hz = 100\nrate = 0.5\n"}, {"quick", "# fast\nclock_hz = 9_000\n"}}}});
}

}  // namespace rastertlm::config::sample
