#include "src/run/background_warning.h"

#include <fmt/format.h>

#include <algorithm>

namespace rastertlm::run {

void warn_of_background(Result& result) {
  const auto empty = std::find_if(result.frames.begin(), result.frames.end(),
                                  [](const FrameFigures& frame) { return frame.covered_pixels == 0; });
  if (empty == result.frames.end()) return;
  result.warnings.push_back(
      empty->facing == 0
          ? fmt::format("frame {} shows nothing but the background: no triangle of the scene that faces the viewer "
                        "is in view, nor any solid",
                        empty->frame)
          : fmt::format("frame {} shows nothing but the background, although {} triangles face the viewer",
                        empty->frame, empty->facing));
}

}  // namespace rastertlm::run
