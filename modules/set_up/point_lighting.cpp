#include "modules/set_up/point_lighting.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

namespace rastertlm::set_up {
namespace {

using geometry::operation_counts;
using geometry::OperationCounts;
using geometry::Vector3;
using Number = geometry::Counted<double>;

constexpr double kFullScale = 255.0;

template <class Body>
OperationCounts counted(const Body& body) {
  const OperationCounts before = operation_counts;
  body();
  return operation_counts - before;
}

template <class T>
Vector3<T> of(const glm::dvec3& v) {
  return {T(v.x), T(v.y), T(v.z)};
}

template <class T>
Vector3<T> mean(const Vector3<T>& a, const Vector3<T>& b) {
  return {(a.x + b.x) * T(0.5), (a.y + b.y) * T(0.5), (a.z + b.z) * T(0.5)};
}
template <class T>
Vector3<T> sum(const std::array<Vector3<T>, 3>& v, const std::array<T, 3>& w) {
  Vector3<T> result;
  for (int i = 0; i < 3; ++i) result[i] = v[0][i] * w[0] + v[1][i] * w[1] + v[2][i] * w[2];
  return result;
}

}  // namespace

LightingCounts& LightingCounts::operator+=(const LightingCounts& other) {
  evaluations += other.evaluations;
  clamped_knots += other.clamped_knots;
  not_finite += other.not_finite;
  return *this;
}

PointLighting::PointLighting(const SetUpParameters& parameters, std::vector<geometry::Reflectance> surfaces,
                             const geometry::LightingRules& rules, VectorVariant variant)
    : attributes_(parameters.attributes),
      clamp_(parameters.clamp_knots),
      surfaces_(std::move(surfaces)),
      rules_(rules),
      kernels_(light_kernels(variant)) {}

void PointLighting::set_lights(std::vector<geometry::LightSource> lights, bool viewer_at_eye) {
  const bool at_eye = viewer_at_eye && perspective();
  const bool same_kinds = lights.size() == lights_.size() && at_eye == viewer_at_eye_ &&
                          std::equal(lights.begin(), lights.end(), lights_.begin(),
                                     [](const auto& a, const auto& b) { return a.at_point == b.at_point; });
  lights_ = std::move(lights);
  viewer_at_eye_ = at_eye;
  needs_positions_ =
      viewer_at_eye_ || std::any_of(lights_.begin(), lights_.end(), [](const auto& l) { return l.at_point; });
  if (!same_kinds || way_costs_.empty()) find_costs();
  prepare_kernel();
}

LitPoint PointLighting::middle(const LitPoint& a, const LitPoint& b) {
  operations_ += middle_cost_;
  LitPoint point;
  point.at = {(a.at.x + b.at.x) >> 1, (a.at.y + b.at.y) >> 1};
  point.inverse_w = (a.inverse_w + b.inverse_w) * 0.5;
  if (!perspective()) {
    point.normal = mean<double>(a.normal, b.normal);
    if (needs_positions_) point.position = mean<double>(a.position, b.position);
    return point;
  }
  const double share = b.inverse_w / (a.inverse_w + b.inverse_w);
  point.normal = a.normal + share * (b.normal - a.normal);
  if (needs_positions_) point.position = a.position + share * (b.position - a.position);
  return point;
}

LitPoint PointLighting::inside(const std::array<const LitPoint*, 3>& corners, const std::array<double, 3>& weights) {
  operations_ += inside_cost_;
  std::array<double, 3> w = weights;
  LitPoint point;
  if (perspective()) {
    double total = 0.0;
    for (std::size_t i = 0; i < 3; ++i) total += w[i] *= corners[i]->inverse_w;
    for (double& one : w) one /= total;
    point.inverse_w = total;
  }
  point.normal = sum<double>({corners[0]->normal, corners[1]->normal, corners[2]->normal}, w);
  if (needs_positions_)
    point.position = sum<double>({corners[0]->position, corners[1]->position, corners[2]->position}, w);
  return point;
}

PointLighting::Levels PointLighting::levels(const LitPoint& point, std::size_t material) {
  ++counts_.evaluations;
  operations_ += point_cost_;
  const WayCosts* costs = way_costs_[material].data();
  const glm::dvec3 normal = geometry::normalised<double>(point.normal);
  const glm::dvec3 viewer = viewer_at_eye_ ? geometry::normalised<double>(-point.position) : glm::dvec3(0, 0, 1);
  const glm::dvec3 light = geometry::illumination<double>(
      surfaces_[material], lights_, rules_, normal, viewer, point.position,
      [&](bool is_lit, bool shines) { operations_ += (costs++)->of_light[(is_lit ? 2U : 0U) + (shines ? 1U : 0U)]; });
  Levels levels = kFullScale * light;
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(levels[c])) {
      ++counts_.not_finite;
      levels[c] = 0.0;
    }
    if (!clamp_) continue;
    const double clamped = std::clamp(levels[c], 0.0, kFullScale);
    counts_.clamped_knots += clamped != levels[c] ? 1 : 0;
    levels[c] = clamped;
  }
  return levels;
}

void PointLighting::prepare_kernel() {
  all_far_ = !needs_positions_;
  if (!all_far_) return;
  lit_.resize(lights_.size());
  shines_.resize(lights_.size());
  requests_.assign(surfaces_.size(), {});
  lights_on_surface_.assign(surfaces_.size() * lights_.size(), {});
  for (std::size_t m = 0; m < surfaces_.size(); ++m) {
    const geometry::Reflectance& surface = surfaces_[m];
    LightOnSurface* const lights = lights_on_surface_.data() + m * lights_.size();
    LightRequest& request = requests_[m];
    request.lights = lights;
    request.count = lights_.size();
    request.exponent = surface.exponent;
    request.phong = rules_.model == geometry::Model::phong;
    request.gate = rules_.specular_gate;
    request.clamp = clamp_;
    for (int c = 0; c < 3; ++c) request.ambient[c] = surface.ambient[c] * rules_.ambient_light[c];
    for (std::size_t l = 0; l < lights_.size(); ++l) {
      const glm::dvec3& towards = lights_[l].vector;
      const glm::dvec3 half = geometry::normalised<double>(towards + glm::dvec3(0, 0, 1));
      for (int c = 0; c < 3; ++c) {
        lights[l].towards[c] = towards[c];
        lights[l].half[c] = half[c];
        lights[l].diffuse[c] = surface.diffuse[c] * lights_[l].diffuse_intensity[c];
        lights[l].specular[c] = surface.specular[c] * lights_[l].specular_intensity[c];
      }
    }
  }
}

void PointLighting::levels(std::span<const LitPoint> points, std::size_t material, std::span<Levels> levels) {
  if (!all_far_) {
    for (std::size_t i = 0; i < points.size(); ++i) levels[i] = this->levels(points[i], material);
    return;
  }
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < kLightLanes; ++i)
      points_.normal[c][i] = points[std::min(i, points.size() - 1)].normal[c];
  kernels_.light(requests_[material], points_, lit_.data(), shines_.data());
  for (std::size_t i = 0; i < points.size(); ++i)
    levels[i] = {points_.levels[0][i], points_.levels[1][i], points_.levels[2][i]};
  count(points.size(), material);
}

// What the kernel has done for the first `points`.
void PointLighting::count(std::size_t points, std::size_t material) {
  const std::uint32_t these = (std::uint32_t{1} << points) - 1;
  // A count of ones is a call where nothing is known of the processor: most are none.
  const auto number = [these](std::uint32_t bits) {
    return (bits & these) == 0 ? 0 : static_cast<std::uint64_t>(std::popcount(bits & these));
  };
  counts_.evaluations += points;
  for (std::size_t c = 0; c < 3; ++c) {
    counts_.clamped_knots += number(points_.clamped[c]);
    counts_.not_finite += number(points_.not_finite[c]);
  }
  operations_ += point_cost_ * points;
  for (std::size_t l = 0; l < lights_.size(); ++l) {
    const auto& costs = way_costs_[material][l].of_light;
    const std::uint32_t a = lit_[l];
    const std::uint32_t b = shines_[l];
    const std::uint32_t ways[] = {~a & ~b, ~a & b, a & ~b, a & b};  // in the order of Way
    for (std::size_t way = 0; way < 4; ++way)
      if ((ways[way] & these) == these)
        operations_ += costs[way] * points;
      else if ((ways[way] & these) != 0)
        operations_ += costs[way] * number(ways[way]);
  }
}

// Of every way through the equation: the lights and viewers tried lead each way by one model or the other.
void PointLighting::find_costs() {
  const Vector3<Number> normal = of<Number>({0, 0, 1});
  const Vector3<Number> nowhere = of<Number>({0, 0, 0});
  const auto light = [&](const geometry::Reflectance& surface, std::span<const geometry::LightSource> lights,
                         const glm::dvec3& viewer, const auto& observer) {
    return counted([&] {
      geometry::illumination<Number>(surface, lights, rules_, normal, of<Number>(viewer), nowhere, observer);
    });
  };
  const OperationCounts ambient = light({}, {}, {0, 0, 1}, geometry::Unobserved{});
  point_cost_ = ambient;
  point_cost_ += counted([&] { geometry::normalised<Number>(normal); });
  if (viewer_at_eye_) point_cost_ += counted([&] { geometry::normalised<Number>(normal); });
  point_cost_.multiply += 3;  // full scale
  if (clamp_) point_cost_.compare += 6;
  const std::uint64_t values = needs_positions_ ? 6 : 3;
  middle_cost_ = {};
  inside_cost_ = {};
  middle_cost_.add = middle_cost_.multiply = values;
  middle_cost_.integer = 4;
  inside_cost_.multiply = 3 * values;
  inside_cost_.add = 2 * values;
  if (perspective()) {
    middle_cost_.add += values + 2;  // differences; 1 / w
    middle_cost_.multiply += 1;
    middle_cost_.divide += 1;
    inside_cost_.multiply += 3;
    inside_cost_.add += 2;
    inside_cost_.divide += 3;
  }
  const glm::dvec3 towards[] = {{0, 0, 1}, {0.9, 0, -0.1}, {0.1, 0, -2}};
  const glm::dvec3 viewers[] = {{0, 0, 1}, {0, 0, -2}, {-1, 0, 0}};
  way_costs_.assign(surfaces_.size(), std::vector<WayCosts>(lights_.size()));
  for (std::size_t m = 0; m < surfaces_.size(); ++m)
    for (std::size_t l = 0; l < lights_.size(); ++l)
      for (const glm::dvec3& vector : towards)
        for (const glm::dvec3& viewer : viewers) {
          geometry::LightSource source = lights_[l];
          source.vector = vector;
          std::size_t way = 0;
          const OperationCounts all = light(surfaces_[m], {&source, 1}, viewer, [&](bool is_lit, bool shines) {
            way = (is_lit ? 2U : 0U) + (shines ? 1U : 0U);
          });
          way_costs_[m][l].of_light[way] = all - ambient;
        }
}

}  // namespace rastertlm::set_up
