#define RASTERTLM_KERNELS register_kernels_baseline
#include "modules/set_up/register_kernels_body.inc"
