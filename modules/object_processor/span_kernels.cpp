#include "modules/object_processor/span_kernels.h"

namespace rastertlm::object_processor {

extern const SpanKernels span_kernels_baseline;
extern const SpanKernels span_kernels_avx2;
extern const SpanKernels span_kernels_avx512;

const SpanKernels& span_kernels(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return span_kernels_avx512;
    case VectorVariant::avx2:
      return span_kernels_avx2;
    default:
      return span_kernels_baseline;
  }
}

}  // namespace rastertlm::object_processor
