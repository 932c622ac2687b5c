#define RASTERTLM_KERNELS store_kernels_baseline
#include "modules/frame_store/store_kernels_body.inc"
