#define RASTERTLM_KERNEL shade_avx2
#include "modules/shading/shade_kernels_body.h"
