#define RASTERTLM_KERNELS span_kernels_avx512
#include "modules/object_processor/span_kernels_body.inc"
