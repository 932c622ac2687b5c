// The declarations of a scene file: complete, and bound to the right members.
#include "src/scene/description.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>

namespace rastertlm::scene {
namespace {

using parameter::List;
using parameter::Parameter;
using parameter::Table;

void for_each(const Table& table, const std::string& prefix,
              const std::function<void(const std::string&, const Parameter&)>& visit) {
  for (const Parameter& p : table.parameters()) visit(prefix + p.path, p);
  for (const List& list : table.lists()) for_each(list.example(), prefix + list.path + ".", visit);
}

TEST(SceneDescription, HasEveryKeyOfTheFile) {
  SceneDescription d;
  std::set<std::string> paths;
  for_each(parameter::view(d), "", [&](const std::string& path, const Parameter&) { paths.insert(path); });
  const std::set<std::string> expected{"schema",
                                       "background",
                                       "ambient_light",
                                       "lighting.model",
                                       "lighting.specular_gate",
                                       "camera.projection",
                                       "camera.eye",
                                       "camera.target",
                                       "camera.up",
                                       "camera.vertical_fov_deg",
                                       "camera.height",
                                       "camera.near",
                                       "camera.far",
                                       "camera.animation.type",
                                       "camera.animation.axis",
                                       "camera.animation.centre",
                                       "camera.animation.deg_per_frame",
                                       "camera.animation.key.frame",
                                       "camera.animation.key.translate",
                                       "camera.animation.key.rotate_deg",
                                       "light.type",
                                       "light.towards",
                                       "light.position",
                                       "light.intensity",
                                       "material.name",
                                       "material.colour",
                                       "material.ambient",
                                       "material.diffuse",
                                       "material.specular",
                                       "material.exponent",
                                       "object.type",
                                       "object.material",
                                       "object.translate",
                                       "object.rotate_deg",
                                       "object.scale",
                                       "object.two_sided",
                                       "object.segments",
                                       "object.patches",
                                       "object.radius",
                                       "object.slices",
                                       "object.stacks",
                                       "object.file",
                                       "object.positions",
                                       "object.normals",
                                       "object.indices",
                                       "object.radii",
                                       "object.height",
                                       "object.sheets",
                                       "object.waist",
                                       "object.capped",
                                       "object.squares",
                                       "object.products",
                                       "object.linear",
                                       "object.constant",
                                       "object.plane.normal",
                                       "object.plane.distance",
                                       "object.animation.type",
                                       "object.animation.axis",
                                       "object.animation.centre",
                                       "object.animation.deg_per_frame",
                                       "object.animation.key.frame",
                                       "object.animation.key.translate",
                                       "object.animation.key.rotate_deg"};
  EXPECT_EQ(paths, expected);
}

TEST(SceneDescription, SaysWhatEveryKeyMoves) {
  SceneDescription d;
  for_each(parameter::view(d), "", [](const std::string& path, const Parameter& p) {
    EXPECT_FALSE(p.about.description.empty()) << path;
    EXPECT_FALSE(p.about.moves.empty()) << path;
    EXPECT_EQ(p.about.moves.rfind("nothing", 0) == 0, p.about.exempt) << path;
  });
}

TEST(SceneDescription, ConditionsNameAChoiceAndItsValues) {
  SceneDescription d;
  std::size_t conditions = 0;
  std::function<void(const Table&)> visit = [&](const Table& table) {
    for (const Parameter& p : table.parameters()) {
      if (!p.about.only_when) continue;
      ++conditions;
      const Parameter* chooser = table.find(p.about.only_when->path);
      ASSERT_NE(chooser, nullptr) << p.path;
      for (const std::string& value : p.about.only_when->values)
        EXPECT_NE(std::find(chooser->choices.begin(), chooser->choices.end(), value), chooser->choices.end()) << p.path;
    }
    for (const List& list : table.lists()) visit(list.example());
  };
  visit(parameter::view(d));
  EXPECT_EQ(conditions, 2U + 2U + 10U + 9U + 3U + 3U);  // camera, light, object, solids, both lists of animations
}

TEST(SceneDescription, WritesThroughToItsMembers) {
  SceneDescription d;
  Table root = parameter::view(d);
  root.find("lighting.model")->set(std::string("phong"));
  root.find("camera.height")->set(12.5);
  EXPECT_EQ(d.model, LightingModel::phong);
  EXPECT_EQ(d.camera.height, 12.5);
  for (const List& list : root.lists()) {
    if (list.path != "object") continue;
    Table object = list.append();
    object.find("type")->set(std::string("uv_sphere"));
    object.find("stacks")->set(std::int64_t{9});
    Table animation = object.lists().at(0).append();
    animation.find("type")->set(std::string("keys"));
    animation.lists().at(0).append().find("frame")->set(7.0);
  }
  ASSERT_EQ(d.objects.size(), 1U);
  EXPECT_EQ(d.objects[0].kind, ObjectKind::uv_sphere);
  EXPECT_EQ(d.objects[0].stacks, 9);
  ASSERT_EQ(d.objects[0].animation.size(), 1U);
  EXPECT_EQ(d.objects[0].animation[0].kind, AnimationKind::keys);
  EXPECT_EQ(d.objects[0].animation[0].keys.at(0).frame, 7.0);
}

TEST(SceneDescription, DefaultsLieInTheirRanges) {
  SceneDescription d;
  for_each(parameter::view(d), "", [](const std::string& path, const Parameter& p) {
    if (!p.range) return;
    const auto inside = [&](double v) {
      EXPECT_GE(v, p.range->minimum) << path;
      EXPECT_LE(v, p.range->maximum) << path;
      if (p.range->above_minimum) {
        EXPECT_NE(v, p.range->minimum) << path;
      }
    };
    if (const auto* real = std::get_if<double>(&p.default_value)) inside(*real);
    if (const auto* integer = std::get_if<std::int64_t>(&p.default_value)) inside(static_cast<double>(*integer));
    if (const auto* triple = std::get_if<parameter::Triple>(&p.default_value))
      for (const double v : *triple) inside(v);
  });
}

}  // namespace
}  // namespace rastertlm::scene
