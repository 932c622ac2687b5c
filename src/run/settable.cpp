#include <fmt/format.h>

#include <algorithm>

#include "src/base/errors.h"
#include "src/config/convert.h"
#include "src/config/presets.h"
#include "src/config/tree.h"
#include "src/config/unknown_key.h"
#include "src/config/value_text.h"
#include "src/run/input_files.h"
#include "src/run/inputs.h"

namespace rastertlm::run {
namespace {

constexpr std::string_view kPresetKey = ".preset";

std::string wrong_preset(const std::string& path, const std::string& name) {
  const std::string table = path.substr(0, path.size() - kPresetKey.size());
  const std::vector<std::string> names = config::Presets::compiled_in().names(table);
  if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) return {};
  const std::string near = nearest_word(name, names);
  return fmt::format("unknown preset '{}' of '{}'{}", name, table,
                     near.empty() ? "" : fmt::format("; nearest: '{}'", near));
}

std::string raw_text(const config::Raw& raw) {
  if (const auto* value = std::get_if<std::int64_t>(&raw.value)) return std::to_string(*value);
  if (const auto* value = std::get_if<double>(&raw.value)) return config::to_toml(*value);
  if (const auto* value = std::get_if<bool>(&raw.value)) return *value ? "true" : "false";
  if (const auto* value = std::get_if<std::string>(&raw.value)) return *value;
  if (const auto* list = std::get_if<config::RawList>(&raw.value)) {
    std::string text;
    for (const config::Raw& one : *list) text += (text.empty() ? "" : ", ") + raw_text(one);
    return '[' + text + ']';
  }
  return {};
}

}  // namespace

std::string plain_text(const parameter::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return config::to_toml(value);
}

config::Override override_of(const std::string& path, const config::Raw& value) {
  return {path, raw_text(value), value};
}

Settable::Settable(InputFiles& files, const std::string& machine_file, const std::string& scene_file,
                   const std::vector<config::Override>& overrides) {
  const Inputs inputs = files.read_base(machine_file, scene_file, overrides);
  machine_ = inputs.content->machine;
  description_ = inputs.content->description;
  machine_table_ = std::visit([](auto& machine) { return parameter::view(machine); }, machine_);
  scene_table_ = parameter::view(description_);
}

Settable::Checked Settable::check(const std::string& path, const config::Raw& value) { return find(path, &value); }
Settable::Checked Settable::check(const std::string& path) { return find(path, nullptr); }

Settable::Checked Settable::find(const std::string& path, const config::Raw* value) {
  config::Tree machine(machine_table_);
  config::Tree scene(scene_table_);
  config::Place place = machine.locate(path);
  if (place.kind != config::PlaceKind::parameter) {
    if (names_scene(path)) place = scene.locate(path);
    if (place.kind != config::PlaceKind::parameter) {
      Checked unknown{};
      unknown.mistake = config::unknown_key_message(path, place);
      return unknown;
    }
  }
  Checked checked{};
  const parameter::Parameter& parameter = *place.parameter;
  checked.unit = parameter.about.unit;
  checked.integer = parameter.kind == parameter::Kind::integer;
  checked.standing = plain_text(parameter.get());
  if (value == nullptr) return checked;
  const auto converted = config::convert(*value, parameter);
  if (const auto* mistake = std::get_if<config::Mistake>(&converted)) {
    checked.mistake = mistake->message;
    return checked;
  }
  checked.value = std::get<parameter::Value>(converted);
  checked.text = plain_text(checked.value);
  if (parameter.kind == parameter::Kind::text && path.ends_with(kPresetKey))
    checked.mistake = wrong_preset(path, checked.text);
  return checked;
}

}  // namespace rastertlm::run
