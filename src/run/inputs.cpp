#include "src/run/inputs.h"

#include <filesystem>
#include <utility>

#include "src/config/document.h"
#include "src/config/header.h"
#include "src/config/overrides.h"
#include "src/config/reader.h"
#include "src/config/writer.h"
#include "src/parameter/table.h"
#include "src/run/locate.h"

namespace rastertlm::run {
namespace {

constexpr std::int64_t kSchema = 1;

std::string first_key(const std::string& path) { return path.substr(0, path.find_first_of(".[")); }

// The first keys of everything that a scene file may hold. --set gives a path of either file; where both might have it,
// the machine does.
bool names_scene(const std::string& path) {
  scene::SceneDescription description;
  const parameter::Table table = parameter::view(description);
  const std::string key = first_key(path);
  for (const parameter::Parameter& p : table.parameters())
    if (p.path != "schema" && first_key(p.path) == key) return true;
  for (const parameter::List& list : table.lists())
    if (first_key(list.path) == key) return true;
  return false;
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

void read_machine(const std::string& file, const std::vector<config::Override>& overrides, Inputs::Content& content,
                  Diagnostics& diagnostics) {
  const config::Document document = config::Document::from_file(file);
  const bool schema = config::check_schema(document, kSchema, diagnostics);
  const auto platform = config::choose_platform(document, overrides, {"imogene", "quadratic"}, diagnostics);
  if (!schema || !platform) return;
  if (*platform == "quadratic") content.machine = quadratic::Machine{};
  Diagnostics found;
  std::visit(
      [&](auto& machine) {
        parameter::Table table = parameter::view(machine);
        content.machine_origins = config::read(document, table, overrides, found);
        if (found.empty()) machine.check(found, file);
      },
      content.machine);
  for (const Diagnostic& diagnostic : found.list()) diagnostics.add(located(diagnostic, content.machine_origins, file));
}

void read_scene(const std::string& file, const std::vector<config::Override>& overrides, Inputs::Content& content,
                Diagnostics& diagnostics) {
  const config::Document document = config::Document::from_file(file);
  if (!config::check_schema(document, kSchema, diagnostics)) return;
  parameter::Table table = parameter::view(content.description);
  Diagnostics found;
  content.scene_origins = config::read(document, table, overrides, found);
  for (const Diagnostic& diagnostic : found.list()) diagnostics.add(diagnostic);
  if (!found.empty()) return;
  try {
    content.scene = scene::build_scene(content.description, file, std::filesystem::path(file).parent_path().string());
  } catch (const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics())
      diagnostics.add(located(diagnostic, content.scene_origins, file));
  }
}

}  // namespace

Inputs::Inputs(std::unique_ptr<Content> given) : content(std::move(given)) {}
Inputs::Inputs(Inputs&&) noexcept = default;
Inputs& Inputs::operator=(Inputs&&) noexcept = default;
Inputs::~Inputs() = default;

Inputs read_inputs(const std::string& machine_file, const std::string& scene_file,
                   const std::vector<std::string>& overrides) {
  auto content = std::make_unique<Inputs::Content>();
  content->machine_file = machine_file;
  content->scene_file = scene_file;
  Diagnostics diagnostics;
  std::vector<config::Override> of_machine;
  std::vector<config::Override> of_scene;
  for (config::Override& override : config::parse_overrides(overrides, diagnostics))
    (names_scene(override.path) ? of_scene : of_machine).push_back(std::move(override));
  gather(diagnostics, [&] { read_machine(machine_file, of_machine, *content, diagnostics); });
  gather(diagnostics, [&] { read_scene(scene_file, of_scene, *content, diagnostics); });
  diagnostics.throw_if_any();
  return Inputs(std::move(content));
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
  static scene::SceneDescription description;
  std::vector<std::pair<std::string, parameter::Table>> tables;
  tables.emplace_back("machine imogene", parameter::view(imogene_machine));
  tables.emplace_back("machine quadratic", parameter::view(quadratic_machine));
  tables.emplace_back("scene", parameter::view(description));
  return tables;
}

}  // namespace rastertlm::run
