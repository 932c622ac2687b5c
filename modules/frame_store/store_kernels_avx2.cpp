#define RASTERTLM_KERNELS store_kernels_avx2
#include "modules/frame_store/store_kernels_body.inc"
