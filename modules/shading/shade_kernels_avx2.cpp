#define RASTERTLM_KERNELS shade_kernels_avx2
#include "modules/shading/shade_kernels_body.inc"
