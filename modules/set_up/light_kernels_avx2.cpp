#define RASTERTLM_KERNELS light_kernels_avx2
#include "modules/set_up/light_kernels_body.inc"
