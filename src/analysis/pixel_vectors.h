// What the display side answers, a pixel a row in raster order.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/shading/deferred_shader.h"
#include "src/analysis/vector_files.h"
#include "src/frame/frame.h"
#include "src/frame/scan_line.h"

namespace rastertlm::analysis {

// decision.csv: what leaves the decision unit, of the lines that have columns. A pixel that nothing covers has object
// 0, depth `background_depth` and zeros, which no unit looks at.
void write_decision(const std::vector<frame::FragmentLine>& lines, std::uint32_t background_depth, VectorFiles& files);

// rgb.csv: the levels that the display shows, of the lines field, field + fields, ...
void write_rgb(const frame::Frame& frame, std::size_t field, std::size_t fields, VectorFiles& files);

// Whether the tables that `shader` has in front give the frame's levels: not so where tables changed while it was
// shown.
bool tables_shade(const shading::DeferredShader& shader, const std::vector<frame::FragmentLine>& lines,
                  const frame::Frame& frame);

}  // namespace rastertlm::analysis
