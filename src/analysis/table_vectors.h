// The memories of the shading processor as files.
#pragma once

#include "modules/shading/deferred_shader.h"
#include "src/analysis/vector_files.h"

namespace rastertlm::analysis {

// Every table of the bank in use, its registers, the inverse root ROM and the paths of the power ROM, one word a line
// in address order; and tables.csv, which says what each file is. `normal_bits`: of a word on the link. Throws
// OutputError.
void write_tables(const shading::DeferredShader& shader, unsigned normal_bits, VectorFiles& files);

}  // namespace rastertlm::analysis
