#include "modules/span_unit/line_kernels.h"

namespace rastertlm::span_unit {

extern const LineKernels line_kernels_baseline;
extern const LineKernels line_kernels_avx2;
extern const LineKernels line_kernels_avx512;

const LineKernels& line_kernels(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return line_kernels_avx512;
    case VectorVariant::avx2:
      return line_kernels_avx2;
    default:
      return line_kernels_baseline;
  }
}

}  // namespace rastertlm::span_unit
