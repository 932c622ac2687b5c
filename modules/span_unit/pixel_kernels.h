// The pixels of a span: what the registers of figure 6 show after 0, 1, 2 ... pixel steps, without stepping them.
// Compiled for several instruction sets; all give the same words; which one is used is chosen at run time
// (src/base/vector_variant.h). The sources of the kernels include this header and nothing that other code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/base/vector_variant.h"

namespace rastertlm::span_unit {

inline constexpr std::size_t kSparePixels = 32;  // what kernels may write behind the last

struct PixelRequest {
  struct Channel {
    std::uint64_t i = 0;            // at the first pixel
    std::uint64_t di = 0;           // to the second
    std::uint64_t pixel_pixel = 0;  // of di, a pixel
  };
  Channel colour[3];
  unsigned word_bits = 32;
  unsigned fraction_bits = 20;
  std::uint32_t depth = 0;  // register at the first pixel
  std::uint32_t depth_step = 0;
  unsigned depth_fraction_bits = 8;
  std::uint32_t depth_mask = 0;  // of the word that is compared
  std::size_t count = 0;
  // Written, kSparePixels more than `count` may be:
  std::uint32_t* levels = nullptr;  // red, green, blue from the low byte on
  std::uint32_t* depths = nullptr;
};

struct PixelKernels {
  void (*narrow)(const PixelRequest& request);  // words of up to 32 bits
  void (*wide)(const PixelRequest& request);    // any
};

const PixelKernels& pixel_kernels(VectorVariant variant);

}  // namespace rastertlm::span_unit
