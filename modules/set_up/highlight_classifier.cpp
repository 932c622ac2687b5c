#include "modules/set_up/highlight_classifier.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <tuple>

namespace rastertlm::set_up {
namespace {

using geometry::OperationCounts;
using geometry::Vector3;
using Number = geometry::Counted<double>;

template <class Body>
OperationCounts counted(const Body& body) {
  const OperationCounts before = geometry::operation_counts;
  body();
  return geometry::operation_counts - before;
}

// Rotation, translation and one scale: angles are the same in both spaces.
bool keeps_angles(const glm::dmat4& m) {
  constexpr double kRelative = 1e-9;
  const glm::dvec3 a(m[0]), b(m[1]), c(m[2]);
  const double size = glm::dot(a, a);
  const auto small = [&](double value) { return std::fabs(value) <= kRelative * size; };
  return small(glm::dot(a, b)) && small(glm::dot(b, c)) && small(glm::dot(c, a)) && small(glm::dot(b, b) - size) &&
         small(glm::dot(c, c) - size);
}

// The inverse of such a matrix: transposed, over the square of its scale. What is charged for it.
OperationCounts inverse_cost() {
  OperationCounts cost;
  cost.multiply = 3 + 9 + 9;
  cost.add = 2 + 6;
  cost.divide = 1;
  return cost;
}

}  // namespace

ClassifiedCounts& ClassifiedCounts::operator+=(const ClassifiedCounts& other) {
  tested += other.tested;
  potentially += other.potentially;
  neighbours += other.neighbours;
  return *this;
}

Neighbourhood::Neighbourhood(const geometry::Mesh& mesh) {
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    const glm::dvec3& p = mesh.positions[i];
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> distinct(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || key(order[i]) != key(order[i - 1])) ++positions_;
    distinct[order[i]] = positions_ - 1;
  }
  corners_.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) corners_.push_back({distinct[t[0]], distinct[t[1]], distinct[t[2]]});
}

void Neighbourhood::widen(std::int64_t rings, std::vector<Highlighted>& triangles) const {
  std::vector<bool> touched(positions_);
  for (std::int64_t ring = 0; ring < rings; ++ring) {
    for (std::size_t t = 0; t < corners_.size(); ++t)
      if (triangles[t] != Highlighted::no)
        for (const std::uint32_t corner : corners_[t]) touched[corner] = true;
    bool more = false;
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      if (triangles[t] != Highlighted::no) continue;
      const auto& corners = corners_[t];
      if (std::none_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return touched[c]; })) continue;
      triangles[t] = Highlighted::neighbour;
      more = true;
    }
    if (!more) return;
  }
}

std::vector<HighlightSource> highlight_sources(const EyeSources& sources, const glm::dmat4& from_eye) {
  const auto moved = [&](bool at_point, const glm::dvec3& v) {
    return glm::dvec3(from_eye * glm::dvec4(v, at_point ? 1.0 : 0.0));
  };
  std::vector<HighlightSource> result;
  for (const geometry::LightSource& light : sources.lights)
    result.push_back({light.at_point, moved(light.at_point, light.vector), sources.viewer_at_eye,
                      moved(sources.viewer_at_eye, sources.viewer_at_eye ? glm::dvec3(0.0) : glm::dvec3(0, 0, 1))});
  return result;
}

HighlightClassifier::HighlightClassifier(const geometry::Mesh& mesh, std::span<const geometry::Reflectance> surfaces)
    : mesh_(mesh), neighbourhood_(mesh), sides_(mesh.positions.size()) {
  shines_.reserve(mesh.triangles.size());
  for (const std::uint16_t material : mesh.material) shines_.push_back(surfaces[material].shines() ? 1 : 0);
}

const std::vector<Highlighted>& HighlightClassifier::classify(const glm::dmat4& object_to_eye,
                                                              const EyeSources& sources, std::int64_t rings) {
  operations_ = {};
  triangles_.assign(mesh_.triangles.size(), Highlighted::no);
  if (keeps_angles(object_to_eye)) {
    const auto moved = highlight_sources(sources, glm::inverse(object_to_eye));
    operations_ += inverse_cost();
    operations_ += counted([&] { geometry::transform_point<Number>(glm::dmat4(1.0), {}); }) * (moved.size() + 1);
    mark(moved, mesh_.positions, mesh_.normals);
  } else {
    const glm::dmat3 normal_to_eye = glm::transpose(glm::inverse(glm::dmat3(object_to_eye)));
    eye_positions_.clear();
    eye_normals_.clear();
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
      eye_positions_.emplace_back(object_to_eye * glm::dvec4(mesh_.positions[i], 1.0));
      eye_normals_.emplace_back(normal_to_eye * mesh_.normals[i]);
    }
    operations_ += counted([] {
                     geometry::transform_point<Number>(glm::dmat4(1.0), {});
                     geometry::transform_normal<Number>(glm::dmat3(1.0), {});
                   }) *
                   mesh_.positions.size();
    mark(highlight_sources(sources, glm::dmat4(1.0)), eye_positions_, eye_normals_);
  }
  counts_ = {mesh_.triangles.size(), 0, 0};
  neighbourhood_.widen(rings, triangles_);
  for (const Highlighted mark : triangles_) {
    counts_.potentially += mark == Highlighted::potentially ? 1 : 0;
    counts_.neighbours += mark == Highlighted::neighbour ? 1 : 0;
  }
  return triangles_;
}

// Vertices once a light, whoever shares them.
void HighlightClassifier::mark(std::span<const HighlightSource> sources, std::span<const glm::dvec3> positions,
                               std::span<const glm::dvec3> normals) {
  for (const HighlightSource& source : sources) {
    for (std::size_t i = 0; i < positions.size(); ++i)
      sides_[i] = highlight_sides<double>(source, positions[i], normals[i]);
    // Both behind or both not: the longer way through the test, charged for all.
    operations_ += counted([&] {
                     highlight_sides<Number>(source, Vector3<Number>(Number(0.5), Number(0.25), Number(0.0)),
                                             Vector3<Number>(Number(0.0), Number(0.0), Number(0.0)));
                   }) *
                   positions.size();
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto& corner = mesh_.triangles[t];
      if (shines_[t] != 0 && may_be_highlighted(sides_[corner[0]], sides_[corner[1]], sides_[corner[2]]))
        triangles_[t] = Highlighted::potentially;
    }
    OperationCounts together;
    together.integer = 3;
    operations_ += together * triangles_.size();
  }
}

}  // namespace rastertlm::set_up
