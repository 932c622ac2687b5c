#define RASTERTLM_RAY_KERNEL ray_kernel_baseline
#include "modules/quadric_processor/ray_kernels_body.inc"
