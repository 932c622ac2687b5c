// The lighting equation, once for host and reference: templates over the number type T.
//   Blinn: I = Ka Ia + sum_i (Kd I_i (N.L) + Ks I_i (N.H)^E)      (004, section 5.3.1)
//   Phong: the last term is Ks I_i (R.V)^E, R the reflection of L about N.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "src/geometry/projection.h"

namespace rastertlm::geometry {

enum class Model { blinn, phong };

// What a surface makes of light, a colour channel: products of the material's coefficients and its colour.
struct Reflectance {
  glm::dvec3 ambient{0.0};   // Ka * colour
  glm::dvec3 diffuse{0.0};   // Kd * colour
  glm::dvec3 specular{0.0};  // Ks
  int exponent = 1;          // E
  // Whether it has highlights at all.
  bool shines() const { return specular.x > 0.0 || specular.y > 0.0 || specular.z > 0.0; }
};

struct LightSource {
  bool at_point = false;
  glm::dvec3 vector{0, 0, 1};  // unit and from the surface to the light, or where the light is
  glm::dvec3 diffuse_intensity{1.0};
  glm::dvec3 specular_intensity{1.0};  // apart, because hardware with one specular table sees the mean of the channels
};

struct LightingRules {
  Model model = Model::blinn;
  bool specular_gate = false;  // no specular where N.L <= 0
  glm::dvec3 ambient_light{1.0};
};

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Unit length; the zero vector stays zero.
template <class T>
Vector3<T> normalised(const Vector3<T>& v) {
  const T square = dot(v, v);
  if (!(square > T(0.0))) return v;
  const T scale = T(1.0) / square_root(square);
  return {v.x * scale, v.y * scale, v.z * scale};
}

// base^exponent by squaring: the same bits on every machine.
template <class T>
T integer_power(T base, int exponent) {
  T result = T(1.0);
  for (T square = base; exponent > 0; exponent >>= 1) {
    if ((exponent & 1) != 0) result = result * square;
    if (exponent > 1) square = square * square;
  }
  return result;
}

// Whoever wants to know which way the equation went is told, for every light in order, whether it lights the point and
// whether it shines on it; and, who has a function for it, what a light that shines adds, a channel.
struct Unobserved {
  void operator()(bool /*lit*/, bool /*shines*/) const {}
};

// Light leaving a point towards the viewer, a channel; 1 is full scale, not clamped. `normal` and `viewer` are unit (or
// zero: then only ambient light is left), `position` is used by lights at a point.
template <class T, class Observer = Unobserved>
Vector3<T> illumination(const Reflectance& surface, std::span<const LightSource> lights, const LightingRules& rules,
                        const Vector3<T>& normal, const Vector3<T>& viewer, const Vector3<T>& position,
                        const Observer& observer = {}) {
  Vector3<T> sum;
  for (int c = 0; c < 3; ++c) sum[c] = T(surface.ambient[c]) * T(rules.ambient_light[c]);
  for (const LightSource& light : lights) {
    Vector3<T> towards{T(light.vector.x), T(light.vector.y), T(light.vector.z)};
    if (light.at_point) towards = normalised<T>(towards - position);
    const T cosine = dot(normal, towards);
    T highlight = T(0.0);
    if (rules.model == Model::blinn) {
      highlight = dot(normal, normalised<T>(towards + viewer));
    } else {
      const T twice = T(2.0) * cosine;
      const Vector3<T> reflected{twice * normal.x - towards.x, twice * normal.y - towards.y,
                                 twice * normal.z - towards.z};
      const bool has_normal = dot(normal, normal) > T(0.0);
      highlight = has_normal ? dot(reflected, viewer) : T(0.0);
    }
    const bool lit = cosine > T(0.0);
    const bool shines = highlight > T(0.0) && (lit || !rules.specular_gate);
    observer(lit, shines);
    const T power = shines ? integer_power(highlight, surface.exponent) : T(0.0);
    for (int c = 0; c < 3; ++c) {
      if (lit) sum[c] += T(surface.diffuse[c]) * T(light.diffuse_intensity[c]) * cosine;
      if (shines) {
        const T shine = T(surface.specular[c]) * T(light.specular_intensity[c]) * power;
        if constexpr (requires { observer.shine(c, shine); }) observer.shine(c, shine);
        sum[c] += shine;
      }
    }
  }
  return sum;
}

}  // namespace rastertlm::geometry
