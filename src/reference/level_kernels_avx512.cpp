#define RASTERTLM_KERNELS level_kernels_avx512
#include "src/reference/level_kernels_body.inc"
