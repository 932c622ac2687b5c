// Is what a quadric processor's words show the solid? Every pixel's words are decoded as the machine does it; what they
// show lies between the solid grown and the solid shrunk by the bounds of rounding.
//
// Bounds. The discriminant's word is off by dQ <= (k^2 + 2 k + 2) / 4 of its last place, k pixels from the anchor
// (anchored_words.h), hence coverage where |d| > dQ is certain, and the root is off by sqrt(d + dQ) - sqrt(d), which is
// sqrt(dQ) at the outline and dQ / (2 s) away from it; then by a place of the root's words. l and caps are off by
// (k + 1) / 2 depth words.
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

// The solid's forms in depth words, and how far rounding may move them.
class ExactSolid {
 public:
  ExactSolid(const PlacedSolid& solid, const View& view, const QuadricFormat& format, const QuadricSetUp& result)
      : form_(geometry::screen_quadric<double>(solid.quadric, view.screen_to_eye)),
        format_(format),
        result_(result),
        near_(static_cast<double>(near_depth(format.words))),
        range_(static_cast<double>(far_depth(format.words) - near_depth(format.words))) {
    for (const glm::dvec4& plane : solid.planes)
      planes_.push_back(geometry::screen_plane<double>(plane, view.screen_to_eye));
  }

  double pixels(double x, double y) const {
    return std::abs(x - static_cast<double>(result_.anchor.x)) + std::abs(y - static_cast<double>(result_.anchor.y));
  }
  // Square depth words a unit of the discriminant's last place.
  double last_place() const {
    return std::ldexp(
        1.0, 2 * (format_.depth_fraction_bits() - result_.scale) - static_cast<int>(format_.parameters.fraction_bits));
  }
  double middle(double x, double y) const { return near_ + range_ * form_.middle.at(x, y); }
  double discriminant(double x, double y) const { return range_ * range_ * form_.discriminant.at(x, y); }
  double discriminant_error(double x, double y) const {
    const double l = range_ * form_.middle.at(x, y);
    return second_order_error(pixels(x, y)) * last_place() +
           0x1p-46 * (l * l + range_ * range_ + std::abs(discriminant(x, y)));
  }
  double plane_error(double x, double y) const { return linear_error(pixels(x, y)) + 0x1p-20; }
  // Of a root that is read, beside its discriminant's: a place, or half of one, and what a shift drops.
  double root_error() const {
    const double place = std::ldexp(1.0, result_.words.root_shift);
    return place + (result_.words.root_shift < 0 ? 1.0 : 0.0);
  }
  // s within [first, second].
  std::pair<double, double> root(double x, double y) const {
    const double d = discriminant(x, y), off = discriminant_error(x, y);
    return {std::max(0.0, std::sqrt(std::max(0.0, d - off)) - root_error()),
            std::sqrt(std::max(0.0, d + off)) + root_error()};
  }

  // The first depth inside, of the solid itself (sign 0), or grown (1) or shrunk (-1) by all bounds.
  std::optional<double> first(double x, double y, double sign) const {
    using Keeps = geometry::ScreenPlane<double>::Keeps;
    const double off = plane_error(x, y);
    double from = near_, to = near_ + range_;
    for (const auto& plane : planes_) {
      const double at = plane.depth.at(x, y);
      const double slope = std::hypot(plane.depth.x, plane.depth.y);
      if (plane.keeps == Keeps::side) {
        if (at > sign * slope / 64) return std::nullopt;
        continue;
      }
      // What is steeper is one along the rays, 1/64 pixel from where it is at most.
      const double move = std::max(off, slope < 64 ? 0.0 : slope * range_ / 64);
      if (plane.keeps == Keeps::beyond) from = std::max(from, near_ + range_ * at - sign * move);
      if (plane.keeps == Keeps::before) to = std::min(to, near_ + range_ * at + sign * move);
    }
    const double d = discriminant(x, y) + (form_.a > 0 ? sign : -sign) * discriminant_error(x, y);
    const auto [least, most] = root(x, y);
    const double l = middle(x, y);
    if (form_.a > 0) {
      const double s = sign == 0 ? root_of(x, y) : sign > 0 ? most : least;
      from = std::max(from, l - s - sign * off);
      to = std::min(to, l + s + sign * off);
      return d < 0 || from > to ? std::nullopt : std::optional(from);
    }
    const double s = sign == 0 ? root_of(x, y) : sign > 0 ? least : most;
    if (from <= (d < 0 ? to : std::min(to, l - s + sign * off))) return from;
    from = std::max(from, l + s - sign * off);
    return d < 0 || from > to ? std::nullopt : std::optional(from);
  }

  glm::dvec3 normal(Surface surface, double x, double y) const {
    using geometry::QuadricHit;
    return glm::normalize(quadric_normal(
        form_, surface == Surface::far_root ? QuadricHit::Surface::far_root : QuadricHit::Surface::near_root, x, y));
  }
  double root_of(double x, double y) const { return std::sqrt(std::max(0.0, discriminant(x, y))); }

 private:
  geometry::ScreenQuadric<double> form_;
  std::vector<geometry::ScreenPlane<double>> planes_;
  const QuadricFormat& format_;
  const QuadricSetUp& result_;
  double near_, range_;
};

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

// The angle between the normal shown and the exact one, and its bound, in the words' unit: E and the product to words,
// k to half a place of it for each of the root's, and k times what the root is off.
inline void check_normal(const ExactSolid& exact, const QuadricFormat& format, const QuadricWords& words,
                         const QuadricPixel& pixel, double x, double y, Seen& seen) {
  const glm::dvec3 shown = vector_of(pixel.normal, format.words.word_bits);
  const auto fraction =
      static_cast<int>(format.parameters.multiplier_bits) - static_cast<int>(quadric_processor::kMultiplierInteger);
  glm::dvec3 k;
  for (int i = 0; i < 3; ++i)
    k[i] = std::abs(std::ldexp(words.normal_of_root[static_cast<std::size_t>(i)], -fraction)) +
           std::ldexp(1.0, -fraction - 1);
  const auto [least, most] = exact.root(x, y);
  const double s = exact.root_of(x, y);
  const double places = std::ldexp(std::max(most - s, s - least), -words.root_shift);
  const double rounding =
      linear_error(exact.pixels(x, y)) + std::ldexp(std::ldexp(most, -words.root_shift), -fraction - 1) + 1;
  const double off = glm::length(k) * places + std::sqrt(3.0) * rounding;
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
  const ExactSolid exact(solid, view, format, result);
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
        check_normal(exact, format, result.words, pixel, x, y, seen);
    }
  return seen;
}

}  // namespace rastertlm::set_up
