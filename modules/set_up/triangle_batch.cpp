#include "modules/set_up/triangle_batch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "src/base/fixed_point.h"

namespace rastertlm::set_up {

std::optional<FitRequest> fit_request(const geometry::SnapGrid& grid, const WordFormat& format) {
  if (format.edges != EdgeForm::snapped) return std::nullopt;
  const auto guard_x = static_cast<double>(grid.guard_x);
  const auto guard_y = static_cast<double>(grid.guard_y);
  FitRequest request;
  request.low_x = -guard_x;
  request.low_y = -guard_y;
  request.high_x = static_cast<double>(format.columns) - 1 + guard_x;
  request.high_y = static_cast<double>(format.lines) - 1 + guard_y;
  request.fraction_bits = grid.fraction_bits;
  const double steps = std::ldexp(1.0, grid.fraction_bits);
  if (2 * steps * std::max(request.high_x + guard_x, request.high_y + guard_y) > kMostDoubledSteps) return std::nullopt;
  request.last_x = (static_cast<double>(format.columns) - 1) * steps;
  request.last_y = (static_cast<double>(format.lines) - 1) * steps;
  request.near_word = static_cast<double>(near_depth(format));
  request.depth_range = static_cast<double>(far_depth(format) - near_depth(format));
  request.normal_unit = static_cast<double>(normal_unit(format));
  request.word_mask = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(format.word_bits)));
  return request;
}

TransformRequest transform_request(const glm::dmat4& object_to_clip, const glm::dmat3& normal_to_eye,
                                   const geometry::SnapGrid& on_screen, const geometry::Viewport& viewport) {
  return {glm::value_ptr(object_to_clip),           glm::value_ptr(normal_to_eye),
          static_cast<double>(viewport.columns),    static_cast<double>(viewport.lines),
          std::ldexp(1.0, on_screen.fraction_bits), kAllLanes};
}

// Word by word into their place: what is written in words must not soon be read in vectors.
void take_words(const FittedTriangles& fitted, std::size_t lane, object_processor::TriangleWords& words) {
  const auto linear = [&](std::size_t processor, LinearWords& into) {
    const std::uint32_t(*from)[kLanes] = fitted.words + object_processor::word_index(processor, 0);
    into.a = from[0][lane];
    into.b = from[1][lane];
    into.c = from[2][lane];
  };
  for (std::size_t edge = 0; edge < 3; ++edge) linear(object_processor::kEdge0 + edge, words.edges[edge]);
  linear(object_processor::kDepth, words.depth);
  for (std::size_t i = 0; i < 3; ++i) linear(object_processor::kNormalX + i, words.normals[i]);
}

}  // namespace rastertlm::set_up
