#define RASTERTLM_RAY_KERNEL ray_kernel_avx512
#include "modules/quadric_processor/ray_kernels_body.inc"
