#define RASTERTLM_KERNELS shade_kernels_avx512
#include "modules/shading/shade_kernels_body.inc"
