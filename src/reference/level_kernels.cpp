#include "src/reference/level_kernels.h"

namespace rastertlm::reference {

extern const LevelKernels level_kernels_baseline;
extern const LevelKernels level_kernels_avx2;
extern const LevelKernels level_kernels_avx512;

const LevelKernels& level_kernels(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::baseline:
      break;
    case VectorVariant::avx2:
      return level_kernels_avx2;
    case VectorVariant::avx512:
      return level_kernels_avx512;
  }
  return level_kernels_baseline;
}

}  // namespace rastertlm::reference
