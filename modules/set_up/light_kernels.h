// Light at several points of a surface at once, by directional lights and seen from infinitely far: what
// geometry::illumination gives, to the last bit (tested). Compiled for several instruction sets; which one is used is
// chosen at run time (src/base/vector_variant.h). The sources of the kernels include this header and nothing that other
// code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/base/vector_variant.h"

namespace rastertlm::set_up {

inline constexpr std::size_t kLightLanes = 8;  // points

// A light and a surface: products of coefficient and intensity, a channel.
struct LightOnSurface {
  double towards[3] = {};  // unit, to the light
  double half[3] = {};     // unit, between it and the viewer: Blinn
  double diffuse[3] = {};
  double specular[3] = {};
};

struct LightRequest {
  double ambient[3] = {};
  const LightOnSurface* lights = nullptr;
  std::size_t count = 0;  // of them
  int exponent = 1;
  bool phong = false;  // reflection instead of `half`; the viewer is at z
  bool gate = false;   // nothing shines where it is not lit
  bool clamp = true;   // levels to 0..255
};

struct alignas(64) LitPoints {
  double normal[3][kLightLanes];  // given, of any length
  double levels[3][kLightLanes];
  std::uint32_t clamped[3];     // a bit a point: a channel that was out of range
  std::uint32_t not_finite[3];  // that was no number: black
};

struct LightKernels {
  // `lit`, `shines`: for each light, a bit a point.
  void (*light)(const LightRequest& request, LitPoints& points, std::uint8_t* lit, std::uint8_t* shines);
};

const LightKernels& light_kernels(VectorVariant variant);

}  // namespace rastertlm::set_up
