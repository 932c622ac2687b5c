// What a quadric processor makes of a pixel's words: the root, the interval logic of entry and exit, depth and normal.
// One pixel at a time and step by step: what every faster form must equal.
#pragma once

#include <array>
#include <cstdint>

#include "modules/quadric_processor/parameters.h"
#include "modules/quadric_processor/quadric_words.h"
#include "src/base/fixed_point.h"

namespace rastertlm::quadric_processor {

// Depth words between which a solid is seen: the near and the far plane.
struct DepthRange {
  std::int64_t near = 0;
  std::int64_t far = 0;
};

// Which surface the ray enters the solid by.
enum class Surface : std::uint8_t { near_root, far_root, near_plane, cap };  // cap: cap + i is cap i

struct QuadricPixel {
  bool covered = false;
  std::uint32_t depth = 0;  // near..far
  Surface surface = Surface::near_plane;
  std::uint8_t cap = 0;
  std::array<std::uint32_t, 3> normal{};  // words as of an EP1, before pre-normalisation
};

// The words of a pixel, as the elementary processors show them.
struct PixelWords {
  std::uint64_t discriminant = 0;  // word_bits
  std::int64_t middle = 0;         // plane_bits, sign extended, as the caps
  std::array<std::int64_t, kMostCaps> caps{};
  std::array<std::uint32_t, 3> normal{};
};

// Two's complement of `bits` in 64.
constexpr std::int64_t sign_extended(std::uint64_t word, unsigned bits) {
  return static_cast<std::int64_t>(word << (64 - bits)) >> (64 - bits);
}
constexpr std::int64_t plane_at(const PlaneWords& plane, std::uint64_t x, std::uint64_t y, unsigned bits) {
  return sign_extended(plane.a * x + plane.b * (y + 1) + plane.c, bits);
}

// The root of a discriminant that is not negative, in units of its last place; a word beyond the extractor's largest
// has the largest root.
std::uint64_t root_of(std::uint64_t discriminant, const object_processor::RootFormat& format);

// `root` in depth words.
constexpr std::int64_t shifted_root(std::uint64_t root, std::int32_t shift) {
  return static_cast<std::int64_t>(shift >= 0 ? root << shift : root >> -shift);
}

PixelWords pixel_words(const QuadricWords& words, std::uint32_t x, std::uint32_t y, const QuadricParameters& parameters,
                       unsigned normal_word_bits);

class QuadricPixelLogic {
 public:
  // `depth_bits`: of the depth and normal words of the machine.
  QuadricPixelLogic(const QuadricParameters& parameters, unsigned depth_bits, DepthRange range)
      : parameters_(parameters), root_(parameters.root()), depth_bits_(depth_bits), range_(range) {}

  QuadricPixel operator()(const QuadricWords& words, const PixelWords& pixel) const;

 private:
  // Where a ray comes into the solid.
  struct Entry {
    std::int64_t depth;
    Surface surface = Surface::near_plane;
    std::uint8_t cap = 0;
  };
  struct Ray;
  Ray cut(const QuadricWords& words, const PixelWords& pixel) const;
  std::array<std::uint32_t, 3> normal(const QuadricWords& words, const PixelWords& pixel, std::uint64_t root,
                                      const Entry& entry) const;

  QuadricParameters parameters_;
  object_processor::RootFormat root_;
  unsigned depth_bits_;
  DepthRange range_;
};

}  // namespace rastertlm::quadric_processor
