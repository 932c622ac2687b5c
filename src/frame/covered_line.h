// A scan line as the spans that objects cover, before anybody looks at a pixel of it: what a board's line holds, for as
// long as its pixels are of no interest to anybody.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rastertlm::frame {

// A word along a line: a x + b (line + 1) + c, modulo 2^word_bits.
struct WordPlane {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t c = 0;
};

// What an object processor shows wherever it covers a pixel.
struct alignas(64) FragmentSource {
  WordPlane depth;
  WordPlane normal[3];
  std::uint32_t material = 0;
  std::uint32_t object = 0;  // observer: from 1
};

// Columns [begin, end), not empty, that an object covers.
struct CoveredSpan {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  const FragmentSource* source = nullptr;
};

// By what a ray comes into a solid: the quadric's near or far root, or a face of constant normal, face + its number.
namespace solid_surface {
inline constexpr std::uint8_t kNearRoot = 0;
inline constexpr std::uint8_t kFarRoot = 1;
inline constexpr std::uint8_t kFace = 2;
}  // namespace solid_surface
inline constexpr std::size_t kMostFaces = 7;

// What a quadric processor shows wherever it covers a pixel. Its normal is that of FragmentSource, at the middle of the
// ray, less (near root) or plus (far root) the root times a constant; its depth is no plane.
struct SolidSource {
  FragmentSource middle;
  std::int32_t normal_of_root[3] = {};
  std::uint32_t fraction_bits = 0;  // of these
  std::uint32_t face_normal[kMostFaces][3] = {};
};

// Columns [begin, end), not empty, that a solid may cover: depth, root and surface of each, from `begin` on. Where it
// does not, its depth is the word of nothing, all ones.
struct SolidSpan {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  const SolidSource* source = nullptr;
  const std::uint32_t* depth = nullptr;
  const std::uint32_t* root = nullptr;
  const std::uint8_t* surface = nullptr;
};

// Spans in the order of processor numbers; they are the board's. A board has either spans or solids.
struct CoveredLine {
  const CoveredSpan* spans = nullptr;
  std::size_t count = 0;
  std::uint64_t seen_pixels = 0;  // columns where an object is seen
  const SolidSpan* solids = nullptr;
  std::size_t solid_count = 0;
};

}  // namespace rastertlm::frame
