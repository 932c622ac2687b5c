// Set-up of eight triangles at a time, for the triangles that nearly all are: wholly on the screen, their slopes within
// the words. The same words as triangle_set_up.h to the last bit (tested); what is not of this kind is left to it.
// Compiled for several instruction sets; which one is used is chosen at run time (src/base/vector_variant.h). The
// sources of the kernels include this header and nothing that other code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/base/vector_variant.h"

namespace rastertlm::set_up {

inline constexpr std::size_t kLanes = 8;  // triangles
inline constexpr unsigned kAllLanes = (1U << kLanes) - 1;

// Corners in object space: by corner, component and triangle.
struct alignas(64) ObjectCorners {
  double position[3][3][kLanes];
  double normal[3][3][kLanes];
};

// Corners on the screen, as geometry::ScreenVertex: pixels, depth 0..1, normals in eye space.
struct alignas(64) ScreenCorners {
  double x[3][kLanes];
  double y[3][kLanes];
  double z[3][kLanes];
  double inverse_w[3][kLanes];
  double normal[3][3][kLanes];
};

struct TransformRequest {
  const double* object_to_clip = nullptr;  // 4 x 4, by column
  const double* normal_to_eye = nullptr;   // 3 x 3, by column
  double columns = 0;
  double lines = 0;
  double grid = 0;     // steps a pixel: 2^q of the fine grid
  unsigned lanes = 0;  // to be transformed; the others stay
};

struct FitRequest {
  double low_x = 0, high_x = 0;  // corners are moved into the guard band
  double low_y = 0, high_y = 0;
  int fraction_bits = 0;          // q of the frame's grid
  double last_x = 0, last_y = 0;  // outermost samples, in steps of the grid
  double near_word = 0, depth_range = 0;
  double normal_unit = 0;
  std::uint32_t word_mask = 0;
};

struct alignas(64) FittedTriangles {
  std::uint32_t words[21][kLanes];  // in the order of a processor's coefficients; of drawn ones
  unsigned drawn = 0;               // a bit a lane
  unsigned turned_away = 0;         // have an area, but do not face the viewer
  unsigned left = 0;                // to be set up one by one: neither of the others means anything for them
};                                  // the rest have no area, or no position

struct TriangleKernels {
  // The lanes, of those asked for, whose corners all lie within the depth range and the samples of the screen; what is
  // written for others means nothing.
  unsigned (*transform)(const TransformRequest&, const ObjectCorners&, ScreenCorners&);
  void (*fit)(const FitRequest&, const ScreenCorners&, FittedTriangles&);
};

const TriangleKernels& triangle_kernels(VectorVariant variant);

// Corners and anchors in steps of the grid up to here (doubled), and slopes and values up to those below, keep every
// sum within the 53 bits of a double. Coarser frames than this take any screen; `fit` leaves triangles with more to
// triangle_set_up.h, and nobody asks it for a screen beyond.
inline constexpr double kMostDoubledSteps = 0x1p21;
inline constexpr double kMostSlope = 0x1p28;
inline constexpr double kMostValue = 0x1p49;

}  // namespace rastertlm::set_up
