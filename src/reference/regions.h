// The parts of an exact picture that errors are stated for, each by itself.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "src/frame/frame.h"

namespace rastertlm::reference {

// A highlight is where specular light adds so many levels to a channel, or more: an eighth of full scale.
inline constexpr double kHighlightLevels = 32.0;

// Whether the surfaces that two neighbouring pixels show end between them; asked where they show different objects.
using SurfaceEnds = std::function<bool(std::size_t pixel, std::size_t neighbour)>;

// Fills `region` and `edges` of a picture whose `object` is there.
// - Silhouettes: where of two pixels, beside or above each other, one alone is covered, or the surfaces end between
//   them, both and the eight pixels around each: a band of two pixels on either side of the edge.
// - Highlights: covered, and `specular_levels` (one a pixel, the largest of the channels) of kHighlightLevels and more.
// - Edges: two pixels of one triangle and then two of another, in a line or a column, on surfaces that go on.
// `hides_itself`, where there is one, says the same of two pixels of one object.
void mark_regions(frame::ExactFrame& picture, std::span<const float> specular_levels, const SurfaceEnds& surface_ends,
                  const SurfaceEnds& hides_itself = nullptr);

}  // namespace rastertlm::reference
