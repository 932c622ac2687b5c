// The depth test along a span, compiled for several instruction sets; all give the same picture, and which one is used
// is chosen at run time (src/base/vector_variant.h). The sources of the kernels include this header and nothing that
// other code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/base/vector_variant.h"

namespace rastertlm::frame_store {

inline constexpr std::size_t kSparePixels = 32;  // behind the last pixel of a plane, and of a span

struct StoreRequest {
  const std::uint32_t* levels = nullptr;
  const std::uint32_t* depths = nullptr;
  std::size_t count = 0;
  std::uint32_t object = 0;
  std::uint32_t material = 0;
  bool test = true;   // strictly nearer wins; otherwise everything does
  bool ties = false;  // equal depth: the lower object wins; needs stored_objects
  std::uint32_t* stored_levels = nullptr;
  std::uint32_t* stored_depths = nullptr;
  std::uint32_t* stored_objects = nullptr;    // null: not kept
  std::uint32_t* stored_materials = nullptr;  // with objects
  std::uint64_t* won = nullptr;               // a bit a pixel, from the lowest on: whether it won; null: nobody asks
};

struct StoreKernels {
  // Returns how many pixels won.
  std::size_t (*draw)(const StoreRequest& request);
};

const StoreKernels& store_kernels(VectorVariant variant);

}  // namespace rastertlm::frame_store
