#define RASTERTLM_KERNELS triangle_kernels_baseline
#include "modules/set_up/triangle_kernels_body.inc"
