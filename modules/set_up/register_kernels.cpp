#include "modules/set_up/register_kernels.h"

namespace rastertlm::set_up {

extern const RegisterKernels register_kernels_baseline;
extern const RegisterKernels register_kernels_avx2;
extern const RegisterKernels register_kernels_avx512;

const RegisterKernels& register_kernels(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return register_kernels_avx512;
    case VectorVariant::avx2:
      return register_kernels_avx2;
    default:
      return register_kernels_baseline;
  }
}

}  // namespace rastertlm::set_up
