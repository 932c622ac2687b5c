#include "src/reference/regions.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace rastertlm::reference {
namespace {

using frame::ExactFrame;
using frame::Region;

class Marker {
 public:
  Marker(ExactFrame& picture, const SurfaceEnds& surface_ends, const SurfaceEnds& hides_itself)
      : picture_(picture), surface_ends_(surface_ends), hides_itself_(hides_itself), silhouette_(picture.pixels(), 0) {}

  void find_edges() {
    for (std::size_t line = 0; line < picture_.lines; ++line)
      for (std::size_t column = 0; column < picture_.columns; ++column) {
        const std::size_t pixel = line * picture_.columns + column;
        if (column + 1 < picture_.columns)
          between(pixel, 1, frame::kEdgeToTheRight, column > 0 && column + 2 < picture_.columns);
        if (line + 1 < picture_.lines)
          between(pixel, picture_.columns, frame::kEdgeBelow, line > 0 && line + 2 < picture_.lines);
      }
  }

  bool is_silhouette(std::size_t column, std::size_t line) const {
    const std::size_t last_line = line + 1 < picture_.lines ? line + 1 : line;
    const std::size_t last_column = column + 1 < picture_.columns ? column + 1 : column;
    for (std::size_t y = line > 0 ? line - 1 : 0; y <= last_line; ++y)
      for (std::size_t x = column > 0 ? column - 1 : 0; x <= last_column; ++x)
        if (silhouette_[y * picture_.columns + x] != 0) return true;
    return false;
  }

 private:
  void between(std::size_t pixel, std::size_t step, std::uint8_t edge, bool has_outer_neighbours) {
    const std::vector<std::uint32_t>& object = picture_.object;
    const std::size_t next = pixel + step;
    if (object[pixel] == object[next]) {
      if (object[pixel] != 0 && hides_itself_ && hides_itself_(pixel, next)) silhouette_[pixel] = silhouette_[next] = 1;
      return;
    }
    if (object[pixel] == 0 || object[next] == 0 || surface_ends_(pixel, next)) {
      silhouette_[pixel] = silhouette_[next] = 1;
    } else if (has_outer_neighbours && object[pixel - step] == object[pixel] && object[next] == object[next + step]) {
      picture_.edges[pixel] |= edge;
    }
  }

  ExactFrame& picture_;
  const SurfaceEnds& surface_ends_;
  const SurfaceEnds& hides_itself_;
  std::vector<std::uint8_t> silhouette_;  // beside the edge itself
};

}  // namespace

void mark_regions(ExactFrame& picture, std::span<const float> specular_levels, const SurfaceEnds& surface_ends,
                  const SurfaceEnds& hides_itself) {
  if (specular_levels.size() != picture.pixels())
    throw std::invalid_argument("mark_regions: the specular levels are not of the picture");
  Marker marker(picture, surface_ends, hides_itself);
  marker.find_edges();
  for (std::size_t line = 0; line < picture.lines; ++line)
    for (std::size_t column = 0; column < picture.columns; ++column) {
      const std::size_t pixel = line * picture.columns + column;
      Region& region = picture.region[pixel];
      region = picture.object[pixel] == 0 ? Region::none : Region::inside;
      if (region == Region::inside && specular_levels[pixel] >= kHighlightLevels) region = Region::highlights;
      if (marker.is_silhouette(column, line)) region = Region::silhouettes;
    }
}

}  // namespace rastertlm::reference
