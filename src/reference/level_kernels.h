// Sums of the differences between displayed and exact levels. Compiled for several instruction sets; all give the same
// sums, and which one is used is chosen at run time (src/base/vector_variant.h). The sources of the kernels include
// this header and nothing that other code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/base/vector_variant.h"

namespace rastertlm::reference {

inline constexpr std::size_t kLevelGroup = 16;  // pixels that are summed together

// What a pixel is: its frame::Region in the lowest bits, and these.
inline constexpr std::uint32_t kInShown = 4;
inline constexpr std::uint32_t kInExact = 8;
inline constexpr std::uint32_t kSameObject = 16;
inline constexpr std::size_t kPixelKinds = 32;

// Of the pixels of one kind: of sums, one for each place in a group, so that vectors add in the order that is written.
struct alignas(64) KindSums {
  std::uint32_t squares[kLevelGroup];     // of integer differences, of all channels
  float largest_square[kLevelGroup];      // of one channel
  double unrounded_squares[kLevelGroup];  // of exact levels that are not rounded, all channels; a pixel's sum in float
  std::uint32_t pixels;
  std::uint32_t over_one;  // pixels with a channel that differs by more than one level
  std::uint32_t over_two;
};

inline constexpr std::size_t kMostGroups = 16384;  // at once: 3 * 255^2 each, and no sum overflows

// Exact levels as frame::ExactLevels has them: planes of a group.
struct LevelPlanes {
  std::size_t groups = 0;                       // of kLevelGroup pixels, kMostGroups at most
  const std::uint32_t* shown_object = nullptr;  // 0: not covered
  const std::uint32_t* exact_object = nullptr;
  const std::uint8_t* region = nullptr;
  const std::uint8_t* shown = nullptr;    // levels, 3 a pixel
  const std::uint8_t* rounded = nullptr;  // planes
  const float* residual = nullptr;        // planes: exact levels less rounded ones
};

// Of two frames, one after the other.
inline constexpr std::uint32_t kComparedNow = 4;
inline constexpr std::uint32_t kComparedBefore = 8;
inline constexpr std::uint32_t kStill = 16;

struct ChangePlanes {
  std::size_t groups = 0;               // of kLevelGroup pixels, kMostGroups at most
  const std::uint8_t* kind = nullptr;   // of each pixel: its region, kComparedNow and kComparedBefore
  const std::uint8_t* shown = nullptr;  // levels, 3 a pixel
  const std::uint8_t* exact = nullptr;  // planes, rounded
  const std::uint8_t* shown_before = nullptr;
  const std::uint8_t* exact_before = nullptr;
  std::int32_t most_moved = 0;  // levels, not negative: where no channel's exact level moved by more, a pixel is kStill
};

struct LevelKernels {
  // Adds to kPixelKinds sums. Groups that neither picture covers are passed over.
  void (*add)(const LevelPlanes& planes, KindSums* sums);
  // Adds to the sums of pixels that are still and compared in both frames: the difference is the change of displayed
  // minus exact level. Nothing is unrounded there.
  void (*add_changes)(const ChangePlanes& planes, KindSums* sums);
};

const LevelKernels& level_kernels(VectorVariant variant);

}  // namespace rastertlm::reference
