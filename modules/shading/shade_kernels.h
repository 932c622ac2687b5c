// The inner loop of the deferred shading processor, compiled for several instruction sets. All give the same levels and
// counts; which one is used is chosen at run time (src/base/vector_variant.h). The sources of the kernels include this
// header and nothing that other code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/base/vector_variant.h"

namespace rastertlm::shading {

// A light as the kernel reads it. The dot-product tables are ramps (checked), so their entries are computed from the
// light's words: faster than to look them up, and the same.
struct ShadeLight {
  std::uint16_t word[2][3] = {};  // of N.L and N.H
  std::uint16_t flip[2][3] = {};  // all ones where the component is negative
  // By material and index, a byte a channel. The first light's diffuse word holds the ambient level as well, and its
  // highest byte is not 0 where the two saturate.
  const std::uint32_t* diffuse = nullptr;
  const std::uint32_t* specular = nullptr;
};

struct ShadeRequest {
  // `count` pixels, and 64 to spare.
  const std::uint16_t* normal[3] = {};
  const std::uint8_t* material = nullptr;
  const std::uint32_t* object = nullptr;  // 0: nobody is seen
  std::size_t count = 0;
  std::uint8_t* rgb = nullptr;  // 3 a pixel, no more

  const std::uint16_t* root = nullptr;  // the inverse root ROM, and a word to spare
  const ShadeLight* lights = nullptr;
  std::size_t light_count = 0;
  const std::uint32_t* ambient = nullptr;  // by material
  std::uint32_t last_material = 0;
  std::uint32_t background = 0;
  std::uint32_t short_limit = 0;  // squares below it: the normal is short
  unsigned magnitude_bits = 11;   // of a component; 11 at most
  unsigned root_shift = 10;       // squares to ROM address
  unsigned product_lift = 4;      // (2 m + 1) << lift times root, its high 16 bits: the normalised component
  unsigned entry_lift = 4;        // the same with a component and a light's word: the partial product
  std::uint16_t component_limit = 2047;
  std::int16_t full_scale = 4095;  // of a dot product in half units
  unsigned index_shift = 2;        // to an index of the level tables
  unsigned index_bits = 10;
};

struct ShadeTotals {
  std::uint64_t pixels = 0;
  std::uint64_t zero_normals = 0;
  std::uint64_t short_normals = 0;
  std::uint64_t saturated_pixels = 0;
  std::uint32_t largest_material = 0;  // above last_material: the levels mean nothing
};

using ShadeKernel = ShadeTotals (*)(const ShadeRequest& request);
ShadeKernel shade_kernel(VectorVariant variant);

}  // namespace rastertlm::shading
