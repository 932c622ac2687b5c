#define RASTERTLM_KERNELS line_kernels_baseline
#include "modules/span_unit/line_kernels_body.inc"
