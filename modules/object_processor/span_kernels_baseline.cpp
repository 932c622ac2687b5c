#define RASTERTLM_KERNELS span_kernels_baseline
#include "modules/object_processor/span_kernels_body.inc"
