#include "modules/shading/shade_kernels.h"

namespace rastertlm::shading {

extern const ShadeKernels shade_kernels_baseline;
extern const ShadeKernels shade_kernels_avx2;
extern const ShadeKernels shade_kernels_avx512;

const ShadeKernels& shade_kernels(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return shade_kernels_avx512;
    case VectorVariant::avx2:
      return shade_kernels_avx2;
    default:
      return shade_kernels_baseline;
  }
}

}  // namespace rastertlm::shading
