#include "modules/span_unit/pixel_kernels.h"

namespace rastertlm::span_unit {

extern const PixelKernels pixel_kernels_baseline;
extern const PixelKernels pixel_kernels_avx2;
extern const PixelKernels pixel_kernels_avx512;

const PixelKernels& pixel_kernels(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return pixel_kernels_avx512;
    case VectorVariant::avx2:
      return pixel_kernels_avx2;
    default:
      return pixel_kernels_baseline;
  }
}

}  // namespace rastertlm::span_unit
