#include "modules/quadric_processor/ray_kernels.h"

namespace rastertlm::quadric_processor {

std::uint64_t ray_kernel_baseline(const RayRequest& request);
std::uint64_t ray_kernel_avx2(const RayRequest& request);
std::uint64_t ray_kernel_avx512(const RayRequest& request);

RayKernel ray_kernel(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx512:
      return ray_kernel_avx512;
    case VectorVariant::avx2:
      return ray_kernel_avx2;
    default:
      return ray_kernel_baseline;
  }
}

}  // namespace rastertlm::quadric_processor
