#define RASTERTLM_KERNELS light_kernels_baseline
#include "modules/set_up/light_kernels_body.inc"
