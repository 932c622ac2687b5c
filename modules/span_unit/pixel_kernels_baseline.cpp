#define RASTERTLM_KERNELS pixel_kernels_baseline
#include "modules/span_unit/pixel_kernels_body.inc"
