// The inner loop of quadric boards: what a processor makes of a line's pixels, compiled for several instruction sets.
// All give the same words, those of QuadricPixelLogic. The sources of the kernels include this header and nothing that
// other code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/base/vector_variant.h"

namespace rastertlm::quadric_processor {

inline constexpr std::size_t kRayCaps = 6;

// A word along the line, moved to the top of 64 bits: there the wrap of the word is that of the machine's integers.
struct RayPlane {
  std::uint64_t start = 0;  // at the first column
  std::uint64_t step = 0;
};

// Of a cap, in the order of quadric_words.h.
enum class RayCapKeeps : std::uint8_t { everything, beyond, before, side };
enum class RayKind : std::uint8_t { between, outside, all };

struct RayRequest {
  // The discriminant at the first column, its first difference to the next, and the second difference; at the top of 64
  // bits.
  std::uint64_t value = 0;
  std::uint64_t difference = 0;
  std::uint64_t second_difference = 0;
  unsigned word_bits = 48;
  // The root: its radicand is the word, at most `largest`, moved down or up by bits; at most 48 bits of it.
  std::uint64_t largest = 0;
  unsigned radicand_down = 0;
  unsigned radicand_up = 0;
  bool half_unit = true;
  int root_shift = 0;  // from a root's last place to depth words: -31..31
  // Depths, plane_bits each.
  unsigned plane_bits = 40;
  RayPlane middle;
  std::size_t caps = 0;
  RayPlane cap[kRayCaps];
  RayCapKeeps keeps[kRayCaps] = {};
  RayKind kind = RayKind::between;
  std::int64_t near = 0;
  std::int64_t far = 0;
  std::uint32_t nothing = 0;  // the depth where it does not cover
  std::size_t count = 0;      // columns
  // Written, with room for kRaySpare more: as frame::SolidSpan has them; faces are the caps, and then the near plane.
  std::uint32_t* depth = nullptr;
  std::uint32_t* root = nullptr;
  std::uint8_t* surface = nullptr;
  // A bit a column, set where it covers; room for kRaySpare bits more.
  std::uint8_t* seen = nullptr;
};
inline constexpr std::size_t kRaySpare = 16;  // whoever reads them does so by vectors, too
inline constexpr std::uint8_t kNearPlaneFace = kRayCaps;

// Returns how many columns are covered.
using RayKernel = std::uint64_t (*)(const RayRequest& request);

RayKernel ray_kernel(VectorVariant variant);

}  // namespace rastertlm::quadric_processor
