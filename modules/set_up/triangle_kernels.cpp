#include "modules/set_up/triangle_kernels.h"

namespace rastertlm::set_up {

extern const TriangleKernels triangle_kernels_baseline;
extern const TriangleKernels triangle_kernels_avx2;
extern const TriangleKernels triangle_kernels_avx512;

const TriangleKernels& triangle_kernels(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return triangle_kernels_avx512;
    case VectorVariant::avx2:
      return triangle_kernels_avx2;
    default:
      return triangle_kernels_baseline;
  }
}

}  // namespace rastertlm::set_up
