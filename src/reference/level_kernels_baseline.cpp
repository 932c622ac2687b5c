#define RASTERTLM_KERNELS level_kernels_baseline
#include "src/reference/level_kernels_body.inc"
