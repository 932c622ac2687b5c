// A sweep file as it is written, before the machines and scenes that it names are looked at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/errors.h"
#include "src/config/origins.h"
#include "src/config/raw.h"
#include "src/explore/sweep.h"
#include "src/parameter/table.h"

namespace rastertlm::explore {

// A key and a value for it, where the file says which keys there are.
struct Setting {
  std::string path;
  config::Raw value;
  int line = 0;
};

struct Variant {
  std::string name;
  std::vector<Setting> sets;
  int line = 0;
  std::string curve{};
};

enum class Spacing { linear, logarithmic };

struct VaryFile {
  std::string path;
  std::string name;
  double from = 0.0;
  double to = 0.0;
  double step = 0.0;
  double factor = 0.0;
  std::int64_t count = 0;
  Spacing spacing = Spacing::linear;
  // What no declaration knows:
  std::vector<config::Raw> values;
  bool has_values = false;
  std::vector<Variant> variants;
  int line = 0;

  void declare(parameter::Table& table);
};

struct ObjectiveFile {
  std::string path;
  std::string name;
  Sense sense = Sense::minimise;
  Spacing scale = Spacing::linear;
  bool optional = false;

  void declare(parameter::Table& table);
};

struct ColumnFile {
  std::string path;
  std::string name;
  bool optional = false;

  void declare(parameter::Table& table);
};

struct Word {
  std::string text;
  int line = 0;
};

struct SweepFile {
  std::int64_t schema = 1;
  std::string name;
  std::string question;
  Mode mode = Mode::grid;
  std::int64_t points = 0;
  std::int64_t seed = 1;
  std::int64_t frames = 1;
  bool reference = true;
  bool thumbnails = true;
  std::vector<VaryFile> vary;
  std::vector<ObjectiveFile> objectives;
  std::vector<ColumnFile> columns;
  // What no declaration knows:
  std::vector<Word> machines;
  std::vector<Word> scenes;
  std::vector<Word> constraints;
  std::vector<Word> given;
  std::vector<Setting> sets;
  std::vector<Setting> baseline;
  bool has_baseline = false;
  config::Origins origins;

  void declare(parameter::Table& table);
  // The line of a key, 0 where the file does not give it.
  int line_of(const std::string& key) const { return origins.of(key).line; }
  bool gives(const std::string& key) const { return origins.contains(key); }
};

// Throws InputError where the file cannot be read at all; everything else that is wrong goes to `diagnostics`.
SweepFile read_sweep_file(const std::string& file, Diagnostics& diagnostics);

}  // namespace rastertlm::explore
