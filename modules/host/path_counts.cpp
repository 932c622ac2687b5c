#include "modules/host/path_counts.h"

#include <optional>

#include "modules/host/corners.h"

namespace rastertlm::host {

namespace {

using geometry::operation_counts;
using geometry::OperationCounts;
using Number = geometry::Counted<double>;

template <class Body>
OperationCounts counted(const Body& body) {
  const OperationCounts before = operation_counts;
  body();
  return operation_counts - before;
}

// A small screen, only to have one: what is counted does not depend on it.
constexpr std::size_t kSide = 64;

OperationCounts fit(double x1, double y1, double x2, double y2) {
  const set_up::WordFormat format{24, kSide, kSide, set_up::EdgeForm::snapped};
  set_up::ScreenTriangle<Number> corners{};
  const double x[3] = {8.0, x1, x2};
  const double y[3] = {8.0, y1, y2};
  for (std::size_t i = 0; i < 3; ++i) corners[i] = {x[i], y[i], 0.5, 1.0, {0.0, 0.0, 1.0}};
  return counted([&] { set_up::set_up_triangle<Number>(corners, 0, false, {4, 0, 0}, format); });
}

}  // namespace

PathCounts count_paths() {
  PathCounts counts;
  counts.matrix = counted([] { matrix_product<Number>(glm::dmat4(1.0), glm::dmat4(1.0)); });
  counts.three_inside = counted([] {
    glm::dmat4 object_to_clip(1.0);
    object_to_clip[3] = {0.0, 0.0, 0.5, 1.0};  // the middle of the screen
    for (int i = 0; i < 3; ++i) {
      geometry::ScreenVertex<Number> screen{};
      on_screen(
          set_up::transform_vertex<Number>(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0), object_to_clip, glm::dmat3(1.0)),
          {4, 0, 0}, {kSide, kSide}, screen);
    }
  });
  counts.drawn = fit(8.0, 40.0, 40.0, 8.0);  // counter-clockwise, y down
  counts.back_face = fit(40.0, 8.0, 8.0, 40.0);
  counts.degenerate = fit(16.0, 16.0, 40.0, 40.0);
  return counts;
}

}  // namespace rastertlm::host
