#include "src/reference/highlight_centres.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace rastertlm::reference {
namespace {

// On the triangle p + u e1 + v e2, likewise its normals.
class Surface {
 public:
  Surface(const std::array<glm::dvec3, 3>& positions, const std::array<glm::dvec3, 3>& normals,
          const geometry::Light& light, bool viewer_at_eye)
      : positions_(positions), normals_(normals), light_(light), viewer_at_eye_(viewer_at_eye) {}

  struct Seen {
    glm::dvec3 normal, light, viewer;  // unit
    glm::dvec3 off() const { return glm::cross(normal, glm::normalize(light + viewer)); }
    bool faces() const { return glm::dot(normal, light) > 0 && glm::dot(normal, viewer) > 0; }
  };
  Seen at(double u, double v) const {
    const glm::dvec3 position = mix(positions_, u, v), normal = mix(normals_, u, v);
    return {glm::normalize(normal),
            light_.kind == geometry::LightKind::point ? glm::normalize(light_.vector - position) : light_.vector,
            viewer_at_eye_ ? glm::normalize(-position) : glm::dvec3(0, 0, 1)};
  }

 private:
  static glm::dvec3 mix(const std::array<glm::dvec3, 3>& of, double u, double v) {
    return of[0] + u * (of[1] - of[0]) + v * (of[2] - of[0]);
  }
  const std::array<glm::dvec3, 3>& positions_;
  const std::array<glm::dvec3, 3>& normals_;
  const geometry::Light& light_;
  bool viewer_at_eye_;
};

struct Point {
  double u, v;
};

// Gauss and Newton from a point of a grid; whether it ends at a centre inside.
bool leads_to_centre(const Surface& surface, Point from) {
  constexpr int kSteps = 30;
  constexpr double kDifference = 1e-6, kExact = 1e-9, kEdge = 1e-9, kFar = 2.0;
  auto [u, v] = from;
  for (int step = 0; step < kSteps; ++step) {
    const glm::dvec3 off = surface.at(u, v).off();
    if (!(glm::length(off) < kFar)) return false;  // no number
    if (glm::length(off) < kExact) return u >= -kEdge && v >= -kEdge && u + v <= 1 + kEdge && surface.at(u, v).faces();
    const glm::dvec3 du = (surface.at(u + kDifference, v).off() - off) / kDifference;
    const glm::dvec3 dv = (surface.at(u, v + kDifference).off() - off) / kDifference;
    const double a = glm::dot(du, du), b = glm::dot(du, dv), c = glm::dot(dv, dv);
    const double determinant = a * c - b * b;
    if (!(determinant > 1e-18 * a * c)) return false;
    const double p = glm::dot(du, off), q = glm::dot(dv, off);
    u -= (c * p - b * q) / determinant;
    v -= (a * q - b * p) / determinant;
    if (std::fabs(u) > kFar || std::fabs(v) > kFar) return false;
  }
  return false;
}

bool has_centre(const Surface& surface) {
  constexpr int kGrid = 6;
  for (int i = 0; i <= kGrid; i += 2)
    for (int j = 0; i + j <= kGrid; j += 2)
      if (leads_to_centre(surface, {static_cast<double>(i) / kGrid, static_cast<double>(j) / kGrid})) return true;
  return false;
}

}  // namespace

std::vector<HighlightCentre> highlight_centres(const geometry::Mesh& mesh, const glm::dmat4& object_to_eye,
                                               const glm::dmat3& normal_to_eye, std::span<const geometry::Light> lights,
                                               bool viewer_at_eye) {
  std::vector<HighlightCentre> centres;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<glm::dvec3, 3> positions, normals;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = mesh.triangles[t][i];
      positions[i] = glm::dvec3(object_to_eye * glm::dvec4(mesh.positions[corner], 1.0));
      normals[i] = normal_to_eye * mesh.normals[corner];
    }
    for (std::size_t l = 0; l < lights.size(); ++l)
      if (has_centre(Surface(positions, normals, lights[l], viewer_at_eye))) centres.push_back({t, l});
  }
  return centres;
}

}  // namespace rastertlm::reference
