#include "src/analysis/hard_case.h"

#include <algorithm>
#include <filesystem>

#include "src/base/errors.h"
#include "src/config/document.h"
#include "src/config/header.h"
#include "src/config/reader.h"

namespace rastertlm::analysis {
namespace {

constexpr std::int64_t kSchema = 1;

parameter::About about(const char* unit, const char* description, std::vector<std::string> kinds) {
  return {unit, description, "the catalogue's figures", parameter::Condition{"kind", std::move(kinds)}};
}

HardCase read(const std::string& file, Diagnostics& diagnostics) {
  HardCase hard_case;
  hard_case.name = std::filesystem::path(file).stem().string();
  const config::Document document = config::Document::from_file(file);
  if (!config::check_schema(document, kSchema, diagnostics)) return hard_case;
  parameter::Table table = parameter::view(hard_case);
  config::read(document, table, {}, diagnostics);
  if (hard_case.bits_from > hard_case.bits_to)
    diagnostics.add({file, 0, "bits_from", "is above bits_to; a range from the fewest to the most bits is expected"});
  return hard_case;
}

}  // namespace

void HardCase::declare(parameter::Table& table) {
  const std::string differences = "forward_differences", solver = "quadratic_solver", coverage = "coverage";
  table.integer("schema", schema, {kSchema, kSchema}, {"", "Version of this file's form.", "", std::nullopt, true});
  table.text("stresses", stresses, {"", "What it stresses, one line.", "the printed table", std::nullopt, true});
  table.choice("kind", kind, {differences, "start_edge", solver, coverage, "linear_form"},
               {"", "The core that is measured.", "the catalogue's figures", std::nullopt, true});
  table.integer("tries", tries, {1, 100'000'000},
                about("", "Random inputs.", {differences, "start_edge", solver, "linear_form"}));
  table.integer("steps", steps, {1, 65536}, about("", "Steps of the longest path, lines and pixels.", {differences}));
  table.integer("bits_from", bits_from, {0, 30}, about("bits", "Fewest fraction bits tried.", {differences}));
  table.integer("bits_to", bits_to, {0, 30}, about("bits", "Most fraction bits tried.", {differences}));
  table.real("limit_levels", limit_levels, {0.0, 255.0, true},
             about("levels", "The most that a colour of this machine may be off on its screen.", {differences}));
  table.choice("family", family, {"well_shaped", "level", "near_level", "sliver"},
               about("", "Which triangles are drawn at random.", {solver}));
  table.real("size_pixels", size_pixels, {1e-6, 1e8}, about("pixels", "Longest side.", {solver}));
  table.real("aspect", aspect, {1.0, 1e8}, about("", "Of slivers: longest side by height.", {solver}));
  table.real("height_pixels", height_pixels, {0.0, 1e6, true},
             about("pixels", "Of edges that are almost level: |Y2|.", {solver}));
  table.choice("mesh", mesh, {"sphere", "fan", "lattice"}, about("", "What is drawn.", {coverage}));
  table.integer("slices", slices, {3, 4096}, about("", "Of the sphere, around; of the lattice, across.", {coverage}));
  table.integer("stacks", stacks, {2, 4096}, about("", "Of the sphere, from pole to pole.", {coverage}));
  table.integer("triangles", triangles, {3, 100'000}, about("", "Of the fan, around one vertex.", {coverage}));
}

HardCase read_hard_case(const std::string& file) {
  Diagnostics diagnostics;
  HardCase hard_case = read(file, diagnostics);
  diagnostics.throw_if_any();
  return hard_case;
}

std::vector<HardCase> read_hard_cases(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  if (files.empty()) throw InputError({folder, 0, "", "holds no case; a folder of .toml files is expected"});
  std::sort(files.begin(), files.end());
  Diagnostics diagnostics;
  std::vector<HardCase> cases;
  cases.reserve(files.size());
  for (const std::string& file : files) cases.push_back(read(file, diagnostics));
  diagnostics.throw_if_any();
  return cases;
}

}  // namespace rastertlm::analysis
