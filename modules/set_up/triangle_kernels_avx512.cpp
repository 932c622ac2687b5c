#define RASTERTLM_KERNELS triangle_kernels_avx512
#include "modules/set_up/triangle_kernels_body.inc"
