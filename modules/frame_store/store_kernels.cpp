#include "modules/frame_store/store_kernels.h"

namespace rastertlm::frame_store {

extern const StoreKernels store_kernels_baseline;
extern const StoreKernels store_kernels_avx2;
extern const StoreKernels store_kernels_avx512;

const StoreKernels& store_kernels(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return store_kernels_avx512;
    case VectorVariant::avx2:
      return store_kernels_avx2;
    default:
      return store_kernels_baseline;
  }
}

}  // namespace rastertlm::frame_store
