// The inner loop of the deferred shading processor, compiled for several instruction sets. All give the same levels and
// counts; which one is used is chosen at run time (src/base/vector_variant.h). The sources of the kernels include this
// header and nothing that other code shares.
//
// Tables that are known to hold a straight line are not looked up but computed, because that is faster: partial
// products of the dot-product units, diffuse levels, and where the processor can, inverse roots. Whoever fills a
// request has compared every entry.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/base/vector_variant.h"

namespace rastertlm::shading {

inline constexpr std::size_t kKernelMaterials = 32;
inline constexpr std::size_t kRootExceptions = 4;

// A light as the kernel reads it.
struct ShadeLight {
  std::uint16_t word[2][3] = {};                       // of N.L and N.H
  std::uint16_t flip[2][3] = {};                       // all ones where the component is negative
  std::uint16_t diffuse[3][kKernelMaterials] = {};     // the constant of a channel's ramp, by material
  const std::uint8_t* specular[3] = {};                // a channel's table, and 3 bytes to spare; all the same: white
  std::uint16_t first_shining[kKernelMaterials] = {};  // by material, the first index whose specular level is not 0
};

// The inverse root ROM as arithmetic: round(scale / sqrt(address + 1/2)), at most `limit`, but for a few addresses.
struct RootArithmetic {
  bool usable = false;
  float scale = 0.0F;
  std::uint32_t limit = 0;
  std::uint32_t exceptions = 0;
  std::uint32_t address[kRootExceptions] = {};
  std::uint32_t root[kRootExceptions] = {};
};

struct ShadeRequest {
  // `count` pixels, and 64 to spare.
  const std::uint16_t* normal[3] = {};
  const std::uint8_t* material = nullptr;
  const std::uint32_t* object = nullptr;  // 0: nobody is seen
  std::size_t count = 0;
  std::uint8_t* rgb = nullptr;  // 3 a pixel, no more

  const std::uint16_t* root = nullptr;  // the inverse root ROM, and a word to spare
  RootArithmetic roots;
  const ShadeLight* lights = nullptr;  // at least one
  std::size_t light_count = 0;
  std::uint16_t ambient[3][kKernelMaterials] = {};
  std::uint32_t last_material = 0;
  std::uint16_t background[3] = {};
  std::uint32_t short_address = 0;  // ROM addresses below it: the normal is short
  unsigned magnitude_bits = 11;     // of a component; 11 at most
  unsigned root_shift = 10;         // squares to ROM address
  unsigned product_lift = 4;        // (2 m + 1) << lift times root, its high 16 bits: the normalised component
  unsigned entry_lift = 4;          // the same with a component and a light's word: the partial product
  std::uint16_t component_limit = 2047;
  std::int16_t full_scale = 4095;  // of a dot product in half units
  unsigned index_shift = 2;        // to an index of the level tables
  unsigned index_bits = 10;
  unsigned diffuse_lift = 0;  // ((2 index + 1) << lift) * constant, rounded, without its low 15 bits: the level
};

struct ShadeTotals {
  std::uint64_t pixels = 0;
  std::uint64_t zero_normals = 0;
  std::uint64_t short_normals = 0;
  std::uint64_t saturated_pixels = 0;
  std::uint32_t largest_material = 0;  // above last_material: the levels mean nothing
};

struct ShadeKernels {
  ShadeTotals (*shade)(const ShadeRequest& request);
  // Roots of addresses 0 .. count - 1 by arithmetic, exceptions left out; null where there is none. `out`: 16 words to
  // spare.
  void (*roots)(const RootArithmetic& arithmetic, std::uint32_t count, std::uint32_t* out);
};
const ShadeKernels& shade_kernels(VectorVariant variant);

}  // namespace rastertlm::shading
