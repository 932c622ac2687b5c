// The microprogram of the elementary processors as a file.
#pragma once

#include "src/analysis/vector_files.h"

namespace rastertlm::analysis {

// microprogram.csv: a row a cycle of the frame start, the line start and a pixel, for an adder of `slices` slices.
// Throws OutputError.
void write_microprogram(unsigned slices, VectorFiles& files);

}  // namespace rastertlm::analysis
