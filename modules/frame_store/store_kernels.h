// Spans into the frame store: their pixels from their registers, the depth test, and the screen's bytes. Compiled for
// several instruction sets; all give the same picture, and which one is used is chosen at run time
// (src/base/vector_variant.h). The sources of the kernels include this header and nothing that other code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/span_unit/span.h"
#include "src/base/vector_variant.h"

namespace rastertlm::frame_store {

inline constexpr std::size_t kSparePixels = 32;  // behind the last pixel of a plane, which kernels may touch

struct StoreRequest {
  const span_unit::Span* spans = nullptr;  // on the screen; those without pixels are passed over
  std::size_t count = 0;
  // Levels of the spans' pixels, span after span, as the plane has them; read up to kSparePixels behind the last. Null:
  // from the spans' registers.
  const std::uint32_t* given_levels = nullptr;
  span_unit::PixelFormat pixels;
  std::uint32_t object = 0;
  std::uint32_t material = 0;
  bool test = true;   // strictly nearer wins; otherwise everything does
  bool ties = false;  // equal depth: the lower object wins; needs objects
  // The picture's planes, `columns` words a line:
  std::size_t columns = 0;
  std::uint32_t* levels = nullptr;  // red, green, blue from the low byte on
  std::uint32_t* depths = nullptr;
  std::uint32_t* objects = nullptr;    // null: not kept
  std::uint32_t* materials = nullptr;  // with objects
  std::uint64_t* won = nullptr;        // of a single span: a bit a pixel, from the lowest on; null: not asked for
};

struct StoreKernels {
  // Returns how many pixels won.
  std::size_t (*draw)(const StoreRequest& request);
  void (*fill)(std::uint32_t* words, std::size_t count, std::uint32_t value);
  // Three bytes a pixel.
  void (*pack)(const std::uint32_t* levels, std::size_t count, std::uint8_t* rgb);
};

const StoreKernels& store_kernels(VectorVariant variant);

}  // namespace rastertlm::frame_store
