#include "src/run/inputs.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <utility>

#include "src/config/document.h"
#include "src/config/header.h"
#include "src/config/overrides.h"
#include "src/config/reader.h"
#include "src/config/writer.h"
#include "src/parameter/table.h"
#include "src/run/input_files.h"
#include "src/run/locate.h"
#include "src/scene/solids.h"

namespace rastertlm::run {
namespace {

constexpr std::int64_t kSchema = 1;
constexpr std::size_t kMostScenes = 64;  // kept: a sweep may vary a scene without end

std::string first_key(const std::string& path) { return path.substr(0, path.find_first_of(".[")); }

std::set<std::string> scene_keys() {
  scene::SceneDescription description;
  const parameter::Table table = parameter::view(description);
  std::set<std::string> keys;
  for (const parameter::Parameter& p : table.parameters())
    if (p.path != "schema") keys.insert(first_key(p.path));
  for (const parameter::List& list : table.lists()) keys.insert(first_key(list.path));
  return keys;
}

// Files that cannot be read at all are reported together too.
template <class Read>
void gather(Diagnostics& diagnostics, const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) diagnostics.add(diagnostic);
  }
}

}  // namespace

bool names_scene(const std::string& path) {
  static const std::set<std::string> keys = scene_keys();
  return keys.contains(first_key(path));
}

Inputs::Inputs(std::unique_ptr<Content> given) : content(std::move(given)) {}
Inputs::Inputs(Inputs&&) noexcept = default;
Inputs& Inputs::operator=(Inputs&&) noexcept = default;
Inputs::~Inputs() = default;

Inputs read_inputs(const std::string& machine_file, const std::string& scene_file,
                   const std::vector<std::string>& arguments) {
  Diagnostics diagnostics;
  const std::vector<config::Override> overrides = config::parse_overrides(arguments, diagnostics);
  InputFiles files;
  if (diagnostics.empty()) return files.read(machine_file, scene_file, overrides);
  gather(diagnostics, [&] { files.read(machine_file, scene_file, overrides); });
  throw InputError(diagnostics.list());
}

Inputs InputFiles::read(const std::string& machine_file, const std::string& scene_file,
                        const std::vector<config::Override>& overrides) {
  return read(machine_file, scene_file, overrides, true);
}

Inputs InputFiles::read_base(const std::string& machine_file, const std::string& scene_file,
                             const std::vector<config::Override>& overrides) {
  return read(machine_file, scene_file, overrides, false);
}

Inputs InputFiles::read_machine_alone(const std::string& machine_file, const std::vector<config::Override>& overrides) {
  auto content = std::make_unique<Inputs::Content>();
  content->machine_file = machine_file;
  Diagnostics diagnostics;
  gather(diagnostics, [&] { read_machine(overrides, true, *content, diagnostics); });
  diagnostics.throw_if_any();
  return Inputs(std::move(content));
}

Inputs InputFiles::read(const std::string& machine_file, const std::string& scene_file,
                        const std::vector<config::Override>& overrides, bool complete) {
  auto content = std::make_unique<Inputs::Content>();
  content->machine_file = machine_file;
  content->scene_file = scene_file;
  Diagnostics diagnostics;
  std::vector<config::Override> of_machine;
  std::vector<config::Override> of_scene;
  for (const config::Override& override : overrides)
    (names_scene(override.path) ? of_scene : of_machine).push_back(override);
  gather(diagnostics, [&] { read_machine(of_machine, complete, *content, diagnostics); });
  gather(diagnostics, [&] { read_scene(of_scene, *content, diagnostics); });
  diagnostics.throw_if_any();
  return Inputs(std::move(content));
}

const config::Document& InputFiles::document(const std::string& file) {
  const auto known = documents_.find(file);
  return known != documents_.end() ? known->second
                                   : documents_.emplace(file, config::Document::from_file(file)).first->second;
}

void InputFiles::read_machine(const std::vector<config::Override>& overrides, bool complete, Inputs::Content& content,
                              Diagnostics& diagnostics) {
  const std::string& file = content.machine_file;
  const config::Document& machine_file = document(file);
  const bool schema = config::check_schema(machine_file, kSchema, diagnostics);
  const auto platform =
      config::choose_platform(machine_file, overrides, {"imogene", "quadratic", "adaptive"}, diagnostics);
  if (!schema || !platform) return;
  if (*platform == "quadratic") content.machine = quadratic::Machine{};
  if (*platform == "adaptive") content.machine = adaptive::Machine{};
  Diagnostics found;
  std::visit(
      [&](auto& machine) {
        parameter::Table table = parameter::view(machine);
        content.machine_origins = config::read(machine_file, table, overrides, found);
        if (found.empty() && complete) machine.check(found, file);
      },
      content.machine);
  for (const Diagnostic& diagnostic : found.list()) diagnostics.add(located(diagnostic, content.machine_origins, file));
}

void InputFiles::read_scene(const std::vector<config::Override>& overrides, Inputs::Content& content,
                            Diagnostics& diagnostics) {
  const MadeScene* made = made_scene(content.scene_file, overrides, diagnostics);
  if (made == nullptr) return;
  content.description = made->description;
  content.scene_origins = made->origins;
  content.scene = made->scene;
}

const InputFiles::MadeScene* InputFiles::made_scene(const std::string& file,
                                                    const std::vector<config::Override>& overrides,
                                                    Diagnostics& diagnostics) {
  std::string key = file;
  for (const config::Override& override : overrides) key += fmt::format("\n{}={}", override.path, override.text);
  if (const auto known = scenes_.find(key); known != scenes_.end()) return &known->second;
  const config::Document& scene_file = document(file);
  if (!config::check_schema(scene_file, kSchema, diagnostics)) return nullptr;
  MadeScene made;
  parameter::Table table = parameter::view(made.description);
  Diagnostics found;
  made.origins = config::read(scene_file, table, overrides, found);
  for (const Diagnostic& diagnostic : found.list()) diagnostics.add(diagnostic);
  if (!found.empty()) return nullptr;
  try {
    made.scene = std::make_shared<const scene::Scene>(
        scene::build_scene(made.description, file, std::filesystem::path(file).parent_path().string()));
  } catch (const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) diagnostics.add(located(diagnostic, made.origins, file));
    return nullptr;
  }
  if (scenes_.size() >= kMostScenes) scenes_.clear();
  return &(scenes_[key] = std::move(made));
}

InputError Inputs::Content::located(const InputError& error) const {
  std::vector<Diagnostic> diagnostics;
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    const bool of_scene = names_scene(diagnostic.key);
    diagnostics.push_back(
        run::located(diagnostic, of_scene ? scene_origins : machine_origins, of_scene ? scene_file : machine_file));
  }
  return InputError(std::move(diagnostics));
}

const imogene::Machine& Inputs::Content::object_machine(const std::string& command) const {
  if (const auto* known = std::get_if<imogene::Machine>(&machine)) return *known;
  throw InputError({machine_file, 0, "platform", command + " knows the object machine alone: \"imogene\""});
}

void Inputs::Content::refuse_solids(const std::string& command) const {
  const std::vector<Diagnostic> refused = scene::refuse_solids(*scene, command + " knows triangles alone");
  if (!refused.empty()) throw located(InputError(refused));
}

std::string config_digest(const Inputs& inputs) {
  return std::visit(
      [&](auto& machine) {
        parameter::Table table = parameter::view(machine);
        return config::digest(table);
      },
      inputs.content->machine);
}

std::string scene_digest(const Inputs& inputs) { return inputs.content->scene->digest; }

std::string resolved_machine_toml(const Inputs& inputs) {
  return std::visit(
      [&](auto& machine) {
        parameter::Table table = parameter::view(machine);
        return config::resolved_text(table, inputs.content->machine_origins);
      },
      inputs.content->machine);
}

std::string resolved_scene_toml(const Inputs& inputs) {
  parameter::Table table = parameter::view(inputs.content->description);
  return config::resolved_text(table, inputs.content->scene_origins);
}

std::vector<std::pair<std::string, parameter::Table>> described_tables() {
  static imogene::Machine imogene_machine;
  static quadratic::Machine quadratic_machine;
  static adaptive::Machine adaptive_machine;
  static scene::SceneDescription description;
  std::vector<std::pair<std::string, parameter::Table>> tables;
  tables.emplace_back("machine imogene", parameter::view(imogene_machine));
  tables.emplace_back("machine quadratic", parameter::view(quadratic_machine));
  tables.emplace_back("machine adaptive", parameter::view(adaptive_machine));
  tables.emplace_back("scene", parameter::view(description));
  return tables;
}

}  // namespace rastertlm::run
