// Random solids before an eye that looks down -z, near 1, far 20, and families of them that are hard to show.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "src/analysis/measurement.h"
#include "src/geometry/projection.h"
#include "src/parameter/table.h"

namespace rastertlm::analysis {

struct SolidView {
  geometry::Viewport viewport;
  bool perspective = true;
  glm::dmat4 screen_to_eye{1.0};
};
// What is 8 wide at a distance of 6 fills the screen's columns.
SolidView solid_view(bool perspective, const geometry::Viewport& viewport);

struct EyeQuadric {  // in eye space
  glm::dmat4 quadric{1.0};
  std::vector<glm::dvec4> planes;
};

class SolidFamily {
 public:
  void declare(parameter::Table& table);

  // A solid as a function of its size, which is 1 for what the family draws.
  class Drawn {
   public:
    EyeQuadric at(double size) const;

   private:
    friend class SolidFamily;
    glm::dmat4 quadric_{1.0};  // in the solid's own space
    std::vector<glm::dvec4> planes_;
    glm::dmat4 place_{1.0};
  };
  Drawn draw(const SolidView& view, Numbers& numbers) const;
  // Each is grown until one of its words is as large as its width holds.
  bool near_wrap() const { return family_ == Family::wrap; }

 private:
  enum class Family { any, near, sphere, thin, axis, cap, saddle, wrap };
  void place_sphere(const SolidView& view, Drawn& drawn, Numbers& numbers) const;
  static void place_thin(Drawn& drawn, Numbers& numbers);
  static void place_along_ray(const SolidView& view, Drawn& drawn, Numbers& numbers);
  static void cut_along_ray(const SolidView& view, Drawn& drawn, Numbers& numbers);
  static void place_saddle(const SolidView& view, Drawn& drawn, Numbers& numbers);

  Family family_ = Family::any;
  double least_pixels_ = 0.5;
  double most_pixels_ = 1e4;
};

}  // namespace rastertlm::analysis
