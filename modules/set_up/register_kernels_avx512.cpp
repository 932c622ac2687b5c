#define RASTERTLM_KERNELS register_kernels_avx512
#include "modules/set_up/register_kernels_body.inc"
