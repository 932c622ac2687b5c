#define RASTERTLM_KERNEL shade_baseline
#include "modules/shading/shade_kernels_body.h"
