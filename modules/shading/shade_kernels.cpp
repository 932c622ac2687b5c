#include "modules/shading/shade_kernels.h"

namespace rastertlm::shading {

ShadeTotals shade_baseline(const ShadeRequest& request);
ShadeTotals shade_avx2(const ShadeRequest& request);
ShadeTotals shade_avx512(const ShadeRequest& request);

ShadeKernel shade_kernel(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return shade_avx512;
    case VectorVariant::avx2:
      return shade_avx2;
    default:
      return shade_baseline;
  }
}

}  // namespace rastertlm::shading
