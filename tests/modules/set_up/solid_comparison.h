// Is what a quadric processor's words show the solid? Every pixel's words are decoded as the machine does it; what they
// show lies between the solid grown and the solid shrunk by the bounds of rounding (modules/set_up/solid_bounds.h).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/quadric_processor/quadric_pixel.h"
#include "modules/set_up/quadric_set_up.h"
#include "modules/set_up/solid_bounds.h"
#include "tests/modules/set_up/solids.h"

namespace rastertlm::set_up {

using quadric_processor::PixelWords;
using quadric_processor::QuadricPixel;
using quadric_processor::QuadricPixelLogic;
using quadric_processor::QuadricWords;
using quadric_processor::Surface;

// A unit of depth is a pixel: the box of the view is as deep as its words.
inline View parallel_view(const QuadricFormat& format) {
  const auto columns = static_cast<double>(format.words.columns), lines = static_cast<double>(format.words.lines);
  const double deep = std::ldexp(static_cast<double>(far_depth(format.words) - near_depth(format.words)),
                                 -format.depth_fraction_bits());
  const geometry::Viewport viewport{format.words.columns, format.words.lines};
  const glm::dmat4 clip = glm::orthoRH_ZO(-0.5, columns - 0.5, -0.5, lines - 0.5, 0.0, deep);
  return {viewport, glm::inverse(geometry::eye_to_screen(clip, viewport))};
}
inline PlacedSolid ball(const glm::dvec3& at, const glm::dvec3& radii) {
  return placed_solid(kSolidShapes[0], glm::scale(glm::translate(glm::dmat4(1.0), at), radii));
}

inline SolidBounds bounds_of(const PlacedSolid& solid, const View& view, const QuadricFormat& format,
                             const QuadricSetUp& result) {
  std::vector<geometry::ScreenPlane<double>> planes;
  planes.reserve(solid.planes.size());
  for (const glm::dvec4& plane : solid.planes)
    planes.push_back(geometry::screen_plane<double>(plane, view.screen_to_eye));
  return {geometry::screen_quadric<double>(solid.quadric, view.screen_to_eye), std::move(planes), format, result};
}

struct Seen {
  int covered = 0, uncertain = 0, normals = 0;
  std::string wrong;            // the first thing that is
  double depth = 0, angle = 0;  // largest errors, in depth words and radians
  double bound = 0;             // of depth, the largest that was possible where it is covered for certain

  void note(const char* what, double x, double y) {
    if (wrong.empty()) wrong = fmt::format("{} at {}, {}", what, x, y);
  }
};

inline glm::dvec3 vector_of(const std::array<std::uint32_t, 3>& words, int bits) {
  glm::dvec3 vector;
  for (int i = 0; i < 3; ++i)
    vector[i] = static_cast<double>(sign_extend(words[static_cast<std::size_t>(i)], static_cast<unsigned>(bits)));
  return vector;
}

// The angle between the normal shown and the exact one, beside its bound.
inline void check_normal(const SolidBounds& exact, const QuadricFormat& format, const QuadricPixel& pixel, double x,
                         double y, Seen& seen) {
  const glm::dvec3 shown = vector_of(pixel.normal, format.words.word_bits);
  const double off = exact.normal_error(x, y);
  const double length = glm::length(shown);
  const double apart =
      std::acos(std::clamp(glm::dot(shown / std::max(length, 1.0), exact.normal(pixel.surface, x, y)), -1.0, 1.0));
  if (off >= length) return;
  if (apart > std::asin(off / length) + 1e-7) seen.note("normal", x, y);
  ++seen.normals;
  seen.angle = std::max(seen.angle, apart);
}

inline Seen compare(const PlacedSolid& solid, const View& view, const QuadricFormat& format, const QuadricSetUp& result,
                    std::size_t step) {
  const SolidBounds exact = bounds_of(solid, view, format, result);
  const QuadricPixelLogic logic(format.parameters, static_cast<unsigned>(format.words.word_bits),
                                {near_depth(format.words), far_depth(format.words)});
  Seen seen;
  for (std::size_t line = 0; line < format.words.lines; line += step)
    for (std::size_t column = 0; column < format.words.columns; column += step) {
      const auto x = static_cast<double>(column), y = static_cast<double>(line);
      const PixelWords words = quadric_processor::pixel_words(result.words, static_cast<std::uint32_t>(column),
                                                              static_cast<std::uint32_t>(line), format.parameters,
                                                              static_cast<unsigned>(format.words.word_bits));
      const QuadricPixel pixel = logic(result.words, words);
      const auto grown = exact.first(x, y, 1.0), shrunk = exact.first(x, y, -1.0);
      if (grown.has_value() != shrunk.has_value()) ++seen.uncertain;
      if (shrunk && !pixel.covered) seen.note("missing", x, y);
      if (!pixel.covered) continue;
      if (!grown) {
        seen.note("more than there is", x, y);
        continue;
      }
      ++seen.covered;
      if (static_cast<double>(pixel.depth) < *grown - 1) seen.note("too near", x, y);
      if (shrunk && static_cast<double>(pixel.depth) > *shrunk + 1) seen.note("too far", x, y);
      if (shrunk) seen.bound = std::max(seen.bound, *shrunk - *grown);
      const auto real = exact.first(x, y, 0.0);
      if (!real) continue;  // normals may leave their words where rounding shows more than there is
      seen.depth = std::max(seen.depth, std::abs(static_cast<double>(pixel.depth) - *real));
      if (pixel.surface == Surface::near_root || pixel.surface == Surface::far_root)
        check_normal(exact, format, pixel, x, y, seen);
    }
  return seen;
}

}  // namespace rastertlm::set_up
