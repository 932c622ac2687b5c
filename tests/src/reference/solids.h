// Solids for the tests of the exact renderers: made by scene files, and told again by words of geometry.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "src/reference/renderer.h"
#include "src/scene/scene.h"
#include "tests/src/reference/pictures.h"

namespace rastertlm::reference::testing_support {

// What of a point must be 0 and less for it to be inside, in the solid's own space.
using Constraints = std::function<std::vector<double>(const glm::dvec3&)>;

struct KnownSolid {
  scene::ObjectDescription object;
  Constraints constraints;
};

inline double from_axis(const glm::dvec3& p) { return std::hypot(p.x, p.y); }

inline KnownSolid known_sphere(double radius) {
  KnownSolid known;
  known.object.kind = scene::ObjectKind::sphere;
  known.object.radius = radius;
  known.constraints = [radius](const glm::dvec3& p) { return std::vector{glm::length(p) - radius}; };
  return known;
}

inline KnownSolid known_ellipsoid(const glm::dvec3& radii) {
  KnownSolid known;
  known.object.kind = scene::ObjectKind::ellipsoid;
  known.object.radii = {radii.x, radii.y, radii.z};
  known.constraints = [radii](const glm::dvec3& p) { return std::vector{glm::length(p / radii) - 1.0}; };
  return known;
}

// Cylinder, cone and paraboloid: `round` of a height.
inline KnownSolid known_upright(scene::ObjectKind kind, double radius, double height, bool capped,
                                const std::function<double(double)>& square_of_round) {
  KnownSolid known;
  known.object.kind = kind;
  known.object.radius = radius;
  known.object.height = height;
  known.object.capped = capped;
  known.constraints = [=](const glm::dvec3& p) {
    std::vector<double> values{p.x * p.x + p.y * p.y - square_of_round(p.z)};
    if (capped) values.insert(values.end(), {p.z - height, -p.z});
    return values;
  };
  return known;
}

inline KnownSolid known_hyperboloid(double radius, double height, double waist, int sheets, bool capped) {
  KnownSolid known;
  known.object.kind = scene::ObjectKind::hyperboloid;
  known.object.radius = radius;
  known.object.height = height;
  known.object.waist = waist;
  known.object.sheets = sheets;
  known.object.capped = capped;
  known.constraints = [=](const glm::dvec3& p) {
    const double t = 2.0 * p.z / height, w = 2.0 * waist / height;
    const double square = sheets == 1 ? waist * waist + (radius * radius - waist * waist) * t * t
                                      : radius * radius * (t * t - w * w) / (1.0 - w * w);
    std::vector<double> values{p.x * p.x + p.y * p.y - square};
    if (capped) values.insert(values.end(), {p.z - height / 2, -p.z - height / 2});
    return values;
  };
  return known;
}

inline KnownSolid known_polynomial(const std::array<double, 10>& c) {
  KnownSolid known;
  known.object.kind = scene::ObjectKind::quadric;
  known.object.squares = {c[0], c[1], c[2]};
  known.object.products = {c[3], c[4], c[5]};
  known.object.linear = {c[6], c[7], c[8]};
  known.object.constant = c[9];
  known.constraints = [c](const glm::dvec3& p) {
    return std::vector{c[0] * p.x * p.x + c[1] * p.y * p.y + c[2] * p.z * p.z + c[3] * p.x * p.y + c[4] * p.y * p.z +
                       c[5] * p.z * p.x + c[6] * p.x + c[7] * p.y + c[8] * p.z + c[9]};
  };
  return known;
}

inline void cut(KnownSolid& known, const glm::dvec3& normal, double distance) {
  known.object.planes.push_back({{normal.x, normal.y, normal.z}, distance});
  known.constraints = [before = known.constraints, normal, distance](const glm::dvec3& p) {
    std::vector<double> values = before(p);
    values.push_back(glm::dot(normal, p) - distance);
    return values;
  };
}

// Of each kind one, capped or not.
inline std::vector<KnownSolid> one_of_each(Random& random, bool capped) {
  const auto length = [&] { return random.between(0.8, 2.0); };
  std::vector<KnownSolid> all{known_sphere(length()), known_ellipsoid({length(), length(), length()})};
  const double r = length(), h = length();
  using scene::ObjectKind;
  all.push_back(known_upright(ObjectKind::cylinder, r, h, capped, [=](double) { return r * r; }));
  all.push_back(
      known_upright(ObjectKind::cone, r, h, capped, [=](double z) { return r * r * (1 - z / h) * (1 - z / h); }));
  all.push_back(known_upright(ObjectKind::paraboloid, r, h, capped, [=](double z) { return r * r * (1 - z / h); }));
  all.push_back(known_hyperboloid(length(), 2 * length(), random.between(0.2, 0.7), 1, capped));
  all.push_back(known_hyperboloid(length(), 2 * length(), random.between(0.2, 0.7), 2, capped));
  std::array<double, 10> c{};
  for (double& one : c) one = random.between(-1, 1);
  c[0] = random.between(0.2, 1);
  c[9] = -1;
  all.push_back(known_polynomial(c));
  cut(all.back(), {random.between(-1, 1), random.between(-1, 1), 1}, random.between(-0.5, 0.5));
  return all;
}

inline scene::SceneDescription lit_scene(const scene::CameraDescription& camera) {
  scene::SceneDescription d;
  d.camera = camera;
  d.lights.resize(2);
  d.lights[0].towards = {0.3, -1.0, 0.6};
  d.lights[1].towards = {-0.8, -0.3, -0.2};
  d.lights[1].intensity = {0.4, 0.3, 0.5};
  d.materials.resize(1);
  d.materials[0].name = "glaze";
  d.materials[0].colour = {0.9, 0.5, 0.3};
  d.background = {3, 2, 1};
  return d;
}

inline RenderOptions options_of(Reference kind, std::size_t columns, std::size_t lines) {
  RenderOptions options;
  options.kind = kind;
  options.columns = columns;
  options.lines = lines;
  options.grids = geometry::snap_grids(columns, lines, 24, -1).value();
  return options;
}

}  // namespace rastertlm::reference::testing_support
