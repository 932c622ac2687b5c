#include "src/scene/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <type_traits>

#include "src/scene/solids.h"
#include "src/scene/view_check.h"

namespace rastertlm::scene {
namespace {

using parameter::Parameter;
using parameter::Table;

glm::dvec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }

// Every parameter of the table and of the elements of its lists, with its path from the root:
// "object[0].animation[1].axis".
void for_each(const Table& table, const std::string& prefix,
              const std::function<void(const std::string&, const Parameter&, const Table&)>& visit) {
  for (const Parameter& p : table.parameters()) visit(prefix + p.path, p, table);
  for (const parameter::List& list : table.lists())
    for (std::size_t i = 0; i < list.size(); ++i)
      for_each(list.element(i), fmt::format("{}{}[{}].", prefix, list.path, i), visit);
}

std::string number_problem(double value, const Parameter& p) {
  if (!std::isfinite(value)) return "is not a finite number";
  if (!p.range) return "";
  const bool above = p.range->above_minimum ? value > p.range->minimum : value >= p.range->minimum;
  if (above && value <= p.range->maximum) return "";
  return fmt::format("{} is out of range: {} {} to {}", value, p.range->above_minimum ? "above" : "from",
                     p.range->minimum, p.range->maximum);
}

void check_number(const std::string& path, double value, const Parameter& p, Problems& problems) {
  if (const std::string wrong = number_problem(value, p); !wrong.empty()) problems.add(path, wrong);
}

void check_numbers(const std::string& path, const Parameter& p, Problems& problems) {
  std::visit(
      [&](const auto& value) {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, double>) {
          check_number(path, value, p, problems);
        } else if constexpr (std::is_same_v<T, std::int64_t>) {
          check_number(path, static_cast<double>(value), p, problems);
        } else if constexpr (std::is_same_v<T, Triple>) {
          for (std::size_t i = 0; i < 3; ++i) check_number(fmt::format("{}[{}]", path, i), value[i], p, problems);
        } else if constexpr (std::is_same_v<T, std::vector<Triple>>) {
          for (std::size_t i = 0; i < value.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
              check_number(fmt::format("{}[{}][{}]", path, i, k), value[i][k], p, problems);
        }
      },
      p.get());
}

void check_camera(const CameraDescription& camera, Problems& problems) {
  const std::string wrong = what_is_wrong({vector(camera.eye), vector(camera.target), vector(camera.up)});
  if (!wrong.empty()) problems.add(wrong.find("eye") == 0 ? "camera.target" : "camera.up", wrong);
  if (camera.projection == ProjectionKind::perspective && !(camera.near > 0.0))
    problems.add("camera.near", fmt::format("{} must be above 0 in perspective", camera.near));
  if (!(camera.far > camera.near))
    problems.add("camera.far", fmt::format("{} must be beyond camera.near, {}", camera.far, camera.near));
}

void check_animation(const std::vector<AnimationDescription>& list, const std::string& owner, Problems& problems) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const AnimationDescription& animation = list[i];
    const std::string path = fmt::format("{}.animation[{}]", owner, i);
    if (animation.kind != AnimationKind::keys) {
      if (!has_length(animation.axis)) problems.add(path + ".axis", "has no length");
      if (!animation.keys.empty()) problems.add(path + ".key", "belongs to animations of type keys only");
      continue;
    }
    if (animation.keys.empty()) problems.add(path + ".key", "an animation of type keys needs at least one");
    for (std::size_t k = 1; k < animation.keys.size(); ++k)
      if (!(animation.keys[k].frame > animation.keys[k - 1].frame))
        problems.add(fmt::format("{}.key[{}].frame", path, k),
                     fmt::format("{} is not after the key before it, at {}", animation.keys[k].frame,
                                 animation.keys[k - 1].frame));
  }
}

void check_lights(const std::vector<LightDescription>& lights, Problems& problems) {
  if (lights.empty()) problems.add("light", "the scene has no light");
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].kind == LightKind::directional && !has_length(lights[i].towards))
      problems.add(fmt::format("light[{}].towards", i), "has no length");
}

std::vector<std::string> check_materials(const std::vector<MaterialDescription>& materials, Problems& problems) {
  std::map<std::string, std::size_t> first;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const std::string key = fmt::format("material[{}].name", i);
    if (materials[i].name.empty()) problems.add(key, "a material needs a name");
    const auto [entry, fresh] = first.try_emplace(materials[i].name, i);
    if (fresh) {
      names.push_back(materials[i].name);
    } else if (!materials[i].name.empty()) {
      problems.add(key, fmt::format("'{}' is the name of material[{}] already", materials[i].name, entry->second));
    }
  }
  return names;
}

void check_object(const ObjectDescription& object, const std::string& path, const std::vector<std::string>& materials,
                  Problems& problems) {
  for (std::size_t i = 0; i < 3; ++i)
    if (object.scale[i] == 0.0) problems.add(fmt::format("{}.scale[{}]", path, i), "0 makes the object flat");
  if (object.kind == ObjectKind::teapot && object.patches != 28 && object.patches != 32)
    problems.add(path + ".patches", fmt::format("{} is not accepted; accepted values: 28, 32", object.patches));
  if (object.kind == ObjectKind::mesh && object.file.empty()) problems.add(path + ".file", "a mesh needs a file");
  check_animation(object.animation, path, problems);
  check_solid(object, path, problems);
  if (object.material.empty()) {
    if (materials.empty() && object.kind != ObjectKind::mesh)
      problems.add(path + ".material", "the scene has no material");
    return;
  }
  if (std::find(materials.begin(), materials.end(), object.material) != materials.end()) return;
  const std::string near = nearest_word(object.material, materials);
  problems.add(path + ".material", fmt::format("there is no material '{}'{}", object.material,
                                               near.empty() ? "" : fmt::format("; nearest: '{}'", near)));
}

std::string text_of(const parameter::Value& value) {
  const auto triple = [](const auto& t) { return fmt::format("[{},{},{}]", t[0], t[1], t[2]); };
  return std::visit(
      [&](const auto& v) -> std::string {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, std::string>) {
          return fmt::format("{}:{}", v.size(), v);
        } else if constexpr (std::is_same_v<T, Triple>) {
          return triple(v);
        } else if constexpr (std::is_same_v<T, std::vector<std::int64_t>>) {
          std::string text;
          for (const std::int64_t n : v) text += fmt::format("{},", n);
          return text;
        } else if constexpr (std::is_same_v<T, std::vector<Triple>> || std::is_same_v<T, std::vector<IndexTriple>>) {
          std::string text;
          for (const auto& t : v) text += triple(t);
          return text;
        } else {
          return fmt::format("{}", v);
        }
      },
      value);
}

}  // namespace

bool has_length(const Triple& t) {
  const double length = glm::length(vector(t));
  return length > 1e-100 && length < 1e100;
}

void check(const SceneDescription& description, Problems& problems) {
  SceneDescription copy = description;  // a table is a view of something that can be written to
  for_each(parameter::view(copy), "", [&](const std::string& path, const Parameter& p, const Table& table) {
    if (table.applies(p)) check_numbers(path, p, problems);
  });
  if (!problems.mentions("camera.")) check_camera(description.camera, problems);
  check_animation(description.camera.animation, "camera", problems);
  check_lights(description.lights, problems);
  const std::vector<std::string> materials = check_materials(description.materials, problems);
  if (description.objects.empty()) problems.add("object", "the scene has no object");
  for (std::size_t i = 0; i < description.objects.size(); ++i)
    check_object(description.objects[i], fmt::format("object[{}]", i), materials, problems);
}

std::string canonical_text(const SceneDescription& description, const std::vector<std::string>& leave_out) {
  SceneDescription copy = description;
  std::string text;
  for_each(parameter::view(copy), "", [&](const std::string& path, const Parameter& p, const Table& table) {
    if (!table.applies(p) || std::find(leave_out.begin(), leave_out.end(), p.path) != leave_out.end()) return;
    text += fmt::format("{} = {}\n", path, text_of(p.get()));
  });
  return text;
}

}  // namespace rastertlm::scene
