// What a sweep found: a row a point, a column a parameter that varies or a figure that counts. Read from a store;
// front, sensitivity, tables and pages are made from it. Knows no simulation and no file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rastertlm::explore {

// A parameter that varies: "host.computation_units" of the machine, "scene" for the scene.
struct Axis {
  std::string path;
  std::string unit;                   // empty: none
  std::vector<std::string> values;    // that points have, as in a machine file; in the sweep's order
  std::vector<std::string> curves{};  // a value each: of which curve it is a point; empty: the axis has none
  bool given = false;                 // not ours to choose: points are compared only where it is the same
};

enum class Sense { minimise, maximise };

// A figure of report.json, "answer.frame_rate_hz", "budgets[line_start].used", or of the machine itself,
// "machine.host.computation_units".
struct Objective {
  std::string path;
  std::string unit;
  Sense sense = Sense::minimise;
  std::string name{};        // that a reader knows it by; empty: made from the path
  bool logarithmic = false;  // how it is drawn
};

// A figure that is shown beside the objectives and counts for nothing.
struct FurtherFigure {
  std::string path;
  std::string unit;
  std::string name{};  // as an objective's
};

enum class State { waiting, done, failed };

struct Row {
  std::uint64_t number = 0;                      // of the point, from 0, in the sweep's order
  std::vector<std::size_t> values;               // an axis each: which of its values
  std::vector<std::optional<double>> figures;    // an objective each; none where the report has none, or null
  std::vector<std::optional<double>> further{};  // one each of the table's further figures
  State state = State::waiting;
  bool allowed = true;                  // every constraint is met; only such points are on the front
  std::string error;                    // failed: why
  std::string config_digest;            // of the resolved machine
  std::string scene_digest;             // of the resolved scene
  std::vector<std::uint8_t> thumbnail;  // PNG, 64 x 64; empty: none kept
};

struct SweepTable {
  std::string name;
  std::string question;  // that the sweep answers
  std::vector<Axis> axes;
  std::vector<Objective> objectives;
  std::vector<FurtherFigure> further;
  std::vector<std::string> constraints;  // as they were written
  std::vector<Row> rows;
  std::optional<std::size_t> baseline;  // row
};

}  // namespace rastertlm::explore
