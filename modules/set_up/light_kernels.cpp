#include "modules/set_up/light_kernels.h"

namespace rastertlm::set_up {

extern const LightKernels light_kernels_baseline;
extern const LightKernels light_kernels_avx2;
extern const LightKernels light_kernels_avx512;

const LightKernels& light_kernels(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return light_kernels_avx512;
    case VectorVariant::avx2:
      return light_kernels_avx2;
    default:
      return light_kernels_baseline;
  }
}

}  // namespace rastertlm::set_up
