#include "src/explore/point.h"

#include <fmt/format.h>

#include <utility>

#include "src/base/digest.h"
#include "src/base/errors.h"
#include "src/base/version.h"
#include "src/report/text_file.h"

namespace rastertlm::explore {
namespace {

std::string text_of(const std::vector<config::Override>& sets) {
  std::string text;
  for (const config::Override& set : sets) text += fmt::format("{}={}\n", set.path, set.text);
  return text;
}

}  // namespace

// A sweep gives its values as --set does; what is wrong with them is the sweep's.
InputError PointMaker::of_sweep(const InputError& error, const std::vector<std::size_t>& choices) const {
  std::vector<Diagnostic> diagnostics = error.diagnostics();
  for (Diagnostic& one : diagnostics) {
    if (one.file != "--set" || sweep_.asked.contains(one.key)) continue;
    one.file = sweep_.file;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      const Vary& axis = sweep_.axes[i];
      for (const config::Override& set : axis.choices.at(choices[i]).sets)
        if (set.path == one.key) one.line = axis.line;
    }
  }
  return InputError(std::move(diagnostics));
}

std::string PointMaker::key_of(const std::string& what) const {
  return sha256_hex(
      fmt::format("rastertlm {} result\n{}\n{} {}", kVersion, what, sweep_.frames, sweep_.reference ? 1 : 0));
}

const std::string& PointMaker::text_of(const std::string& file) {
  const auto known = texts_.find(file);
  return known != texts_.end() ? known->second
                               : texts_.emplace(file, report::read_text_file(file).value_or("")).first->second;
}

Point PointMaker::make(const std::vector<std::size_t>& choices) {
  std::string machine = sweep_.machines.front();
  std::string scene = sweep_.scenes.front();
  std::vector<config::Override> sets = sweep_.sets;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Vary& axis = sweep_.axes[i];
    const Choice& choice = axis.choices.at(choices[i]);
    if (axis.what == Vary::What::machine) machine = choice.file;
    if (axis.what == Vary::What::scene) scene = choice.file;
    sets.insert(sets.end(), choice.sets.begin(), choice.sets.end());
  }
  Point point;
  try {
    point.inputs = std::make_shared<run::Inputs>(files_.read(machine, scene, sets));
    if (sweep_.reference) point.exact = run::exact_needs(*point.inputs, sweep_.frames);
    point.config_digest = run::config_digest(*point.inputs);
    point.scene_digest = run::scene_digest(*point.inputs);
    point.key = key_of(point.config_digest + '\n' + point.scene_digest);
  } catch (const InputError& error) {
    point = Point{};
    point.error = of_sweep(error, choices).what();
    point.key = key_of(fmt::format("wrong\n{}\n{}\n{}", text_of(machine), text_of(scene), explore::text_of(sets)));
  }
  return point;
}

std::string PointMaker::sweep_digest() {
  std::string text =
      fmt::format("{}\n{}\n{} {} {} {} {}\n{}", sweep_.name, sweep_.question, static_cast<int>(sweep_.mode),
                  sweep_.points, sweep_.seed, sweep_.frames, sweep_.reference, explore::text_of(sweep_.sets));
  for (const std::string& file : sweep_.machines) text += sha256_hex(text_of(file));
  for (const std::string& file : sweep_.scenes) text += sha256_hex(text_of(file));
  for (const Vary& axis : sweep_.axes) {
    text += fmt::format("axis {} {} {}\n", axis.path, sweep_.baseline && axis.start ? *axis.start : 0, axis.given);
    for (const Choice& choice : axis.choices)
      text += fmt::format("{}\n{}\n{}", choice.text, choice.curve, explore::text_of(choice.sets));
  }
  for (const Objective& one : sweep_.objectives)
    text += fmt::format("{} {} {}\n{}\n", one.path, one.sense == Sense::minimise ? "minimise" : "maximise",
                        one.logarithmic, one.name);
  for (const FurtherFigure& one : sweep_.further) text += fmt::format("column {}\n{}\n", one.path, one.name);
  for (const Constraint& one : sweep_.constraints) text += one.text + '\n';
  return sha256_hex(text);
}

}  // namespace rastertlm::explore
