#define RASTERTLM_KERNEL shade_avx512
#include "modules/shading/shade_kernels_body.h"
