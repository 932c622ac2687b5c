// The kernels, compiled once for each instruction set into the table that RASTERTLM_KERNELS names. Where there is no
// AVX-512 the compiler's own vectors are used. Vectors may run over the end of an array into what it has to spare.
#include "modules/object_processor/span_kernels_band.h"
#include "modules/object_processor/span_kernels_draw.h"
#include "modules/object_processor/span_kernels_resolve.h"

namespace rastertlm::object_processor {

extern const SpanKernels RASTERTLM_KERNELS;
const SpanKernels RASTERTLM_KERNELS{band, fill_words, draw, resolve, prenormalise};

}  // namespace rastertlm::object_processor
