// Phong's method: the normal is linear on the screen (in perspective: of the surface), made unit at every pixel, and
// the lighting equation is solved there with every light, wherever it is.
#pragma once

#include <vector>

#include "modules/pixel_unit/light_sum.h"

namespace rastertlm::pixel_unit {

template <class T>
class NormalSteps {
 public:
  // Of a triangle. `lights` and `constant` outlive it; `constant`: as seen from everywhere, null where that differs
  // from pixel to pixel.
  void set_up(const AttributePlanes<T>& planes, const PlaneNeeds& needs,
              const std::vector<geometry::LightSource>& lights, geometry::Model model, bool viewer_at_eye,
              const SeenLights<T>* constant) {
    planes_ = planes;
    needs_ = needs;
    lights_ = &lights;
    model_ = model;
    viewer_at_eye_ = viewer_at_eye;
    constant_ = constant;
  }
  void begin_line(const T& x, const T& y) {
    normal_ = value_at(planes_.normal, x, y);
    if (!needs_.positions) return;
    position_ = value_at(planes_.position, x, y);
    if (needs_.perspective) inverse_w_ = value_at(planes_.inverse_w, x, y);
  }
  void step() {
    normal_ = normal_ + planes_.normal.across;
    if (!needs_.positions) return;
    position_ = position_ + planes_.position.across;
    if (needs_.perspective) inverse_w_ += planes_.inverse_w.across;
  }
  void cosines(std::vector<T>& dots, std::vector<Cosines<T>>& cosines) {
    const T square = geometry::dot(normal_, normal_);
    const bool has_normal = square > T(0.0);
    Vector3<T> normal = normal_;
    if (has_normal) normal = scaled(normal_, T(1.0) / geometry::square_root(square));
    const SeenLights<T>* seen = constant_;
    if (seen == nullptr) {
      see();
      seen = &here_;
    }
    std::size_t k = 0;
    for (const Vector3<T>& vector : seen->towards) dots[k++] = geometry::dot(normal, vector);
    for (const Vector3<T>& vector : seen->highlight) dots[k++] = geometry::dot(normal, vector);
    cosines_from(dots, *seen, has_normal, cosines);
  }

 private:
  void see() {
    Vector3<T> position = position_;
    if (needs_.perspective) position = scaled(position_, T(1.0) / inverse_w_);
    const Vector3<T> viewer =
        viewer_at_eye_ ? geometry::normalised<T>(scaled(position, T(-1.0))) : vector_of<T>({0, 0, 1});
    see_lights(*lights_, model_, position, viewer, here_);
  }

  AttributePlanes<T> planes_;
  PlaneNeeds needs_;
  const std::vector<geometry::LightSource>* lights_ = nullptr;
  geometry::Model model_ = geometry::Model::blinn;
  bool viewer_at_eye_ = false;
  const SeenLights<T>* constant_ = nullptr;
  Vector3<T> normal_{};
  Vector3<T> position_{};
  T inverse_w_{};
  SeenLights<T> here_;
};

}  // namespace rastertlm::pixel_unit
