// Light at points of triangles, and what it costs the host. Light is computed with plain numbers; which way the
// equation went at each light is noted, and charged as Counted numbers on that way were.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "modules/set_up/light_kernels.h"
#include "modules/set_up/parameters.h"
#include "src/geometry/counted.h"
#include "src/geometry/lighting.h"
#include "src/geometry/snapping.h"

namespace rastertlm::set_up {

// A point of a triangle: where it is on the screen, and what lights see of it. Normals need not be of unit length and
// are not made so: what is between two points is linear.
struct LitPoint {
  geometry::SnappedPoint at;  // in steps of the corners' grid
  double inverse_w = 1.0;
  glm::dvec3 normal{0, 0, 1};
  glm::dvec3 position{0.0};  // in eye space
};

struct LightingCounts {
  std::uint64_t evaluations = 0;
  std::uint64_t clamped_knots = 0;  // a channel brighter than full scale (or darker than black)
  std::uint64_t not_finite = 0;     // taken as black
  LightingCounts& operator+=(const LightingCounts& other);
};

class PointLighting {
 public:
  using Levels = glm::dvec3;  // 0..255 where knots are clamped

  PointLighting(const SetUpParameters& parameters, std::vector<geometry::Reflectance> surfaces,
                const geometry::LightingRules& rules, VectorVariant variant = vector_variant());
  // Of a frame, in eye space. `viewer_at_eye`: not infinitely far.
  void set_lights(std::vector<geometry::LightSource> lights, bool viewer_at_eye);
  bool needs_positions() const { return needs_positions_; }
  const std::vector<geometry::LightSource>& lights() const { return lights_; }
  bool viewer_at_eye() const { return viewer_at_eye_; }
  bool shines(std::size_t material) const { return surfaces_[material].shines(); }

  LitPoint middle(const LitPoint& a, const LitPoint& b);
  // `weights` of the corners, on the screen; they add up to 1.
  LitPoint inside(const std::array<const LitPoint*, 3>& corners, const std::array<double, 3>& weights);
  Levels levels(const LitPoint& point, std::size_t material);
  // The same of at most kLightLanes points of a surface.
  void levels(std::span<const LitPoint> points, std::size_t material, std::span<Levels> levels);

  const LightingCounts& counts() const { return counts_; }
  // Operations since the start of the run.
  const geometry::OperationCounts& operations() const { return operations_; }

 private:
  enum Way : std::size_t { unlit, shining_unlit, lit, shining };
  struct WayCosts {
    std::array<geometry::OperationCounts, 4> of_light;
  };
  void find_costs();
  void prepare_kernel();
  void count(std::size_t points, std::size_t material);
  bool perspective() const { return attributes_ == Attributes::perspective; }

  Attributes attributes_;
  bool clamp_;
  std::vector<geometry::Reflectance> surfaces_;
  geometry::LightingRules rules_;
  std::vector<geometry::LightSource> lights_;
  bool viewer_at_eye_ = false;
  bool needs_positions_ = false;
  LightingCounts counts_;
  geometry::OperationCounts operations_;
  geometry::OperationCounts point_cost_;  // normalisation, the viewer's direction, ambient light, scaling, clamping
  geometry::OperationCounts middle_cost_;
  geometry::OperationCounts inside_cost_;
  std::vector<std::vector<WayCosts>> way_costs_;  // by material and light

  // Points of a surface at once, where no light and no viewer is near.
  const LightKernels& kernels_;
  bool all_far_ = false;
  std::vector<LightRequest> requests_;             // by material
  std::vector<LightOnSurface> lights_on_surface_;  // by material and light
  LitPoints points_;
  std::vector<std::uint8_t> lit_, shines_;  // by light
};

}  // namespace rastertlm::set_up
