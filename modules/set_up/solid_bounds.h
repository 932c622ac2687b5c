// How far from a solid what its words show can be: the solid grown and the solid shrunk by the bounds of rounding, and
// what its depth and its normal may be off at a pixel. For those who judge a machine: the hard cases and the tests.
//
// Bounds. The discriminant's word is off by dQ <= (k^2 + 2 k + 2) / 4 of its last place, k pixels from the anchor
// (anchored_words.h), hence coverage where |d| > dQ is certain, and the root is off by sqrt(d + dQ) - sqrt(d), which is
// sqrt(dQ) at the outline and dQ / (2 s) away from it; then by a place of the root's words. l and caps are off by
// (k + 1) / 2 depth words; a cap along the rays by 1/64 pixel. The host's own doubles add to each of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "modules/quadric_processor/quadric_pixel.h"
#include "modules/set_up/quadric_set_up.h"
#include "src/geometry/quadric.h"

namespace rastertlm::set_up {

// What the host's doubles may add before a form is rounded to words, on any pixel of the screen.
struct HostRounding {
  double discriminant = 0.0;   // square depth words
  double middle = 0.0;         // depth words
  std::vector<double> planes;  // depth words, one a plane
};

// The solid's forms in depth words, and how far rounding may move them.
class SolidBounds {
 public:
  // The forms are those of the solid that `result` draws, which has a root: its part is not `all`. Without `host`, some
  // 2^-46 of what a form is made of at the pixel. Format and result outlive it.
  SolidBounds(const geometry::ScreenQuadric<double>& form, std::vector<geometry::ScreenPlane<double>> planes,
              const QuadricFormat& format, const QuadricSetUp& result, std::optional<HostRounding> host = std::nullopt)
      : form_(form),
        planes_(std::move(planes)),
        format_(format),
        result_(result),
        host_(std::move(host)),
        near_(static_cast<double>(near_depth(format.words))),
        range_(static_cast<double>(far_depth(format.words) - near_depth(format.words))) {}

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
    const double words = second_order_error(pixels(x, y)) * last_place();
    if (host_) return words + host_->discriminant;
    const double l = range_ * form_.middle.at(x, y);
    return words + 0x1p-46 * (l * l + range_ * range_ + std::abs(discriminant(x, y)));
  }
  double middle_error(double x, double y) const {
    return linear_error(pixels(x, y)) + (host_ ? host_->middle : kOfDoubles);
  }
  double plane_error(std::size_t plane, double x, double y) const {
    return linear_error(pixels(x, y)) + (host_ ? host_->planes[plane] : kOfDoubles);
  }
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
    double from = near_, to = near_ + range_;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const geometry::ScreenPlane<double>& plane = planes_[i];
      const double at = plane.depth.at(x, y);
      const double slope = std::hypot(plane.depth.x, plane.depth.y);
      if (plane.keeps == Keeps::side) {
        if (at > sign * slope / 64) return std::nullopt;
        continue;
      }
      // What is steeper is one along the rays, 1/64 pixel from where it is at most.
      const double move = std::max(plane_error(i, x, y), slope < 64 ? 0.0 : slope * range_ / 64);
      if (plane.keeps == Keeps::beyond) from = std::max(from, near_ + range_ * at - sign * move);
      if (plane.keeps == Keeps::before) to = std::min(to, near_ + range_ * at + sign * move);
    }
    const double d = discriminant(x, y) + (form_.a > 0 ? sign : -sign) * discriminant_error(x, y);
    const auto [least, most] = root(x, y);
    const double l = middle(x, y), off = middle_error(x, y);
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

  // Of the surface that `pixel` shows, in depth words: the exact depth, and by how much the word may be off; that is
  // whole, a unit more.
  struct SurfaceDepth {
    double depth = 0.0, error = 0.0;
  };
  SurfaceDepth surface_depth(const quadric_processor::QuadricPixel& pixel, double x, double y) const {
    using quadric_processor::Surface;
    if (pixel.surface == Surface::near_plane) return {near_, 0.0};
    if (pixel.surface == Surface::cap)
      return {near_ + range_ * planes_.at(pixel.cap).depth.at(x, y), plane_error(pixel.cap, x, y) + 1};
    const auto [least, most] = root(x, y);
    const double s = root_of(x, y);
    return {pixel.surface == Surface::far_root ? middle(x, y) + s : middle(x, y) - s,
            std::max(most - s, s - least) + middle_error(x, y) + 1};
  }

  // Of the surface at a root, of length 1.
  glm::dvec3 normal(quadric_processor::Surface surface, double x, double y) const {
    using geometry::QuadricHit;
    return glm::normalize(quadric_normal(form_,
                                         surface == quadric_processor::Surface::far_root
                                             ? QuadricHit::Surface::far_root
                                             : QuadricHit::Surface::near_root,
                                         x, y));
  }
  // The length of what is wrong with the normal's words at a root, in their unit: E and the product to words, k to half
  // a place of it for each of the root's, and k times what the root is off.
  double normal_error(double x, double y) const {
    const auto fraction =
        static_cast<int>(format_.parameters.multiplier_bits) - static_cast<int>(quadric_processor::kMultiplierInteger);
    glm::dvec3 k;
    for (int i = 0; i < 3; ++i)
      k[i] = std::abs(std::ldexp(result_.words.normal_of_root[static_cast<std::size_t>(i)], -fraction)) +
             std::ldexp(1.0, -fraction - 1);
    const auto [least, most] = root(x, y);
    const double s = root_of(x, y);
    const double places = std::ldexp(std::max(most - s, s - least), -result_.words.root_shift);
    const double rounding =
        linear_error(pixels(x, y)) + std::ldexp(std::ldexp(most, -result_.words.root_shift), -fraction - 1) + 1;
    return glm::length(k) * places + std::sqrt(3.0) * rounding;
  }
  double root_of(double x, double y) const { return std::sqrt(std::max(0.0, discriminant(x, y))); }

 private:
  static constexpr double kOfDoubles = 0x1p-20;

  geometry::ScreenQuadric<double> form_;
  std::vector<geometry::ScreenPlane<double>> planes_;
  const QuadricFormat& format_;
  const QuadricSetUp& result_;
  std::optional<HostRounding> host_;
  double near_, range_;
};

}  // namespace rastertlm::set_up
