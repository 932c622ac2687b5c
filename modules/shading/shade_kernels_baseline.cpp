#define RASTERTLM_KERNELS shade_kernels_baseline
#include "modules/shading/shade_kernels_body.inc"
