#define RASTERTLM_KERNELS pixel_kernels_avx512
#include "modules/span_unit/pixel_kernels_body.inc"
