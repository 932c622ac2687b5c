#include "src/scene/solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "src/scene/check.h"

namespace rastertlm::scene {
namespace {

glm::dvec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }

// x x^2 + y y^2 + z z^2 + linear z + constant.
glm::dmat4 upright(const glm::dvec3& squares, double linear, double constant) {
  glm::dmat4 q(0.0);
  for (int i = 0; i < 3; ++i) q[i][i] = squares[i];
  q[2][3] = q[3][2] = linear / 2;
  q[3][3] = constant;
  return q;
}

glm::dmat4 hyperboloid(const ObjectDescription& object) {
  const double half = object.height / 2, waist = object.waist * object.waist;
  const double radius = object.radius * object.radius;
  if (object.sheets == 1) return upright({1, 1, -(radius - waist) / (half * half)}, 0, -waist);
  const double slope = radius / (half * half - waist);
  return upright({1, 1, -slope}, 0, slope * waist);
}

glm::dmat4 polynomial(const ObjectDescription& object) {
  glm::dmat4 q(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = static_cast<int>(i), next = static_cast<int>((i + 1) % 3);
    q[k][k] = object.squares[i];
    q[k][next] = q[next][k] = object.products[i] / 2;
    q[k][3] = q[3][k] = object.linear[i] / 2;
  }
  q[3][3] = object.constant;
  return q;
}

glm::dmat4 matrix_of(const ObjectDescription& object) {
  const double radius = object.radius * object.radius, height = object.height;
  switch (object.kind) {
    case ObjectKind::sphere:
      return upright(glm::dvec3(1.0), 0, -radius);
    case ObjectKind::ellipsoid:
      return upright(1.0 / (vector(object.radii) * vector(object.radii)), 0, -1);
    case ObjectKind::cylinder:
      return upright({1, 1, 0}, 0, -radius);
    case ObjectKind::cone: {  // x^2 + y^2 - (radius / height)^2 (height - z)^2
      const double slope = radius / (height * height);
      return upright({1, 1, -slope}, 2 * slope * height, -radius);
    }
    case ObjectKind::paraboloid:  // x^2 + y^2 - radius^2 (1 - z / height)
      return upright({1, 1, 0}, radius / height, -radius);
    case ObjectKind::hyperboloid:
      return hyperboloid(object);
    default:
      return polynomial(object);
  }
}

double largest_element(const glm::dmat4& m) {
  double largest = 0.0;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, std::fabs(m[column][row]));
    }
  return largest;
}

// By a power of two, so that nothing is rounded: the largest element is in 1..2.
glm::dmat4 normalised(const glm::dmat4& m) {
  int exponent = 0;
  std::frexp(largest_element(m), &exponent);
  glm::dmat4 result;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) result[column][row] = std::ldexp(m[column][row], 1 - exponent);
  return result;
}

// Whether x^T Q x is below 0 anywhere, else what remains has no volume. By Sylvester's law of inertia that is where
// elimination with diagonal pivots meets one that is negative, or a zero one beside another number; the rows are scaled
// so that the diagonal is 1, which changes no sign, and less than a few roundings is 0.
bool has_volume(const glm::dmat4& quadric) {
  constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
  glm::dmat4 m = quadric;
  glm::dvec4 scale(1.0);
  for (int i = 0; i < 4; ++i) {
    if (m[i][i] < 0.0) return true;
    for (int k = 0; k < 4; ++k)
      if (m[i][i] == 0.0 && m[i][k] != 0.0) return true;
    if (m[i][i] > 0.0) scale[i] = 1.0 / std::sqrt(m[i][i]);
  }
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) m[i][k] *= scale[i] * scale[k];
  for (int done = 0; done < 4; ++done) {
    int pivot = done;
    for (int i = done; i < 4; ++i) {
      if (m[i][i] < -kRounding) return true;
      if (m[i][i] > m[pivot][pivot]) pivot = i;
    }
    if (m[pivot][pivot] <= kRounding) {
      for (int i = done; i < 4; ++i)
        for (int k = done; k < i; ++k)
          if (std::fabs(m[i][k]) > kRounding) return true;
      return false;
    }
    std::swap(m[done], m[pivot]);
    for (int i = 0; i < 4; ++i) std::swap(m[i][done], m[i][pivot]);
    for (int i = done + 1; i < 4; ++i)
      for (int k = done + 1; k < 4; ++k) m[i][k] -= m[i][done] * m[done][k] / m[done][done];
  }
  return false;
}

void add_caps(const ObjectDescription& object, std::vector<glm::dvec4>& planes) {
  const bool ends = object.kind == ObjectKind::cylinder || object.kind == ObjectKind::cone ||
                    object.kind == ObjectKind::paraboloid || object.kind == ObjectKind::hyperboloid;
  if (!ends || !object.capped) return;
  const bool about_zero = object.kind == ObjectKind::hyperboloid;
  planes.emplace_back(0, 0, 1, about_zero ? -object.height / 2 : -object.height);
  planes.emplace_back(0, 0, -1, about_zero ? -object.height / 2 : 0);
}

void check_planes(const ObjectDescription& object, const std::string& path, Problems& problems) {
  if (!is_solid(object.kind)) {
    if (!object.planes.empty()) problems.add(path + ".plane", "belongs to solids only: sphere to quadric");
    return;
  }
  for (std::size_t i = 0; i < object.planes.size(); ++i)
    if (!has_length(object.planes[i].normal))
      problems.add(fmt::format("{}.plane[{}].normal", path, i), "has no length; one of its numbers must not be 0");
}

void check_hyperboloid(const ObjectDescription& object, const std::string& path, Problems& problems) {
  if (object.sheets == 1 && !(object.waist < object.radius))
    problems.add(path + ".waist",
                 fmt::format("{} must be below radius, {}, where there is one sheet", object.waist, object.radius));
  if (object.sheets == 2 && !(2 * object.waist < object.height))
    problems.add(path + ".waist", fmt::format("{} must be below {}, half of the height, where there are two sheets",
                                              object.waist, object.height / 2));
}

}  // namespace

bool is_solid(ObjectKind kind) { return kind >= ObjectKind::sphere; }

void check_solid(const ObjectDescription& object, const std::string& path, Problems& problems) {
  check_planes(object, path, problems);
  if (!is_solid(object.kind) || problems.mentions(path + '.')) return;
  if (object.kind == ObjectKind::hyperboloid) check_hyperboloid(object, path, problems);
  if (problems.mentions(path + '.')) return;
  const Triple none{0, 0, 0};
  if (object.kind == ObjectKind::quadric && object.squares == none && object.products == none) {
    problems.add(path + ".squares",
                 "a plane, not a quadric: squares and products are all 0, and one of them must not be");
    return;
  }
  const glm::dmat4 matrix = matrix_of(object);
  const double largest = largest_element(matrix);
  if (!(largest > 0.0) || std::isinf(largest))
    problems.add(path + ".type", "its lengths are too large or too small beside each other");
  else if (!has_volume(normalised(matrix)))
    problems.add(path + (object.kind == ObjectKind::quadric ? ".constant" : ".type"),
                 "nothing is inside: the polynomial must be below 0 somewhere");
}

Solid make_solid(const ObjectDescription& object) {
  Solid solid;
  solid.quadric = normalised(matrix_of(object));
  add_caps(object, solid.planes);
  for (const PlaneDescription& plane : object.planes) {
    const double length = glm::length(vector(plane.normal));
    solid.planes.emplace_back(vector(plane.normal) / length, -plane.distance / length);
  }
  return solid;
}

std::vector<Diagnostic> refuse_solids(const Scene& scene, const std::string& why) {
  std::vector<Diagnostic> refused;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].solid) refused.push_back({"", 0, fmt::format("object[{}].type", i), why});
  return refused;
}

}  // namespace rastertlm::scene
