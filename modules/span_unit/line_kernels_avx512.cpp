#define RASTERTLM_KERNELS line_kernels_avx512
#include "modules/span_unit/line_kernels_body.inc"
