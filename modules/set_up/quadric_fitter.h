// The work of set_up_quadric, step by step. For quadric_set_up.cpp, which looks where the solid is and how large its
// words get, and quadric_words_fit.cpp, which makes them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "modules/set_up/quadric_region.h"
#include "modules/set_up/quadric_set_up.h"
#include "src/geometry/counted.h"
#include "src/geometry/quadric.h"

namespace rastertlm::set_up::detail {

using geometry::LinearForm;
using geometry::ScreenPlane;
using geometry::ScreenQuadric;
using geometry::SecondOrderForm;
using quadric_processor::CapKeeps;
using quadric_processor::RayPart;

inline constexpr int kMostShift = 31;  // of a root, in the words of a slot
inline constexpr int kMostScale = 200;

// Bits of a two's complement word that holds integers up to this magnitude.
inline std::int64_t signed_bits(double largest) { return std::ilogb(std::ceil(std::max(largest, 1.0))) + 2; }
inline double largest_of(std::int64_t bits) { return std::ldexp(1.0, static_cast<int>(bits) - 1) - 1; }

template <class T>
LinearForm<T> scaled(const LinearForm<T>& form, const T& factor) {
  return {form.x * factor, form.y * factor, form.one * factor};
}
template <class T>
SecondOrderForm<T> scaled(const SecondOrderForm<T>& form, const T& factor) {
  return {form.xx * factor, form.yy * factor, form.xy * factor, form.x * factor, form.y * factor, form.one * factor};
}

template <class T>
class QuadricFitter {
 public:
  QuadricFitter(const glm::dmat4& quadric, std::span<const glm::dvec4> planes, const glm::dmat4& screen_to_eye,
                const QuadricFormat& format)
      : quadric_(quadric),
        planes_(planes),
        screen_to_eye_(screen_to_eye),
        format_(format),
        parameters_(format.parameters),
        root_(format.parameters.root()),
        screen_(whole_screen(format.words.columns, format.words.lines)),
        depth_fraction_(format.depth_fraction_bits()),
        depth_range_(static_cast<double>(far_depth(format.words) - near_depth(format.words))),
        near_(static_cast<double>(near_depth(format.words))) {}

  QuadricSetUp operator()(std::uint32_t material);

 private:
  struct Stop {};  // refused

  T near_to_zero() const;
  void look_at_rays();
  void look_along_rulings(const T& zero);
  void refuse_what_rounding_hides();
  bool find_region();
  void choose_scale();
  int scale_of_root();
  int scale_beyond_depths();
  void fit_discriminant();
  double largest_root_of(const T& discriminant, const PixelBox& box) const;
  void fit_middle();
  void fit_normals();
  void fit_caps();
  CapKeeps fit_cap(const ScreenPlane<T>& cap, quadric_processor::PlaneWords& words);
  void fit_side(const LinearForm<T>& form, const PixelBox& box, double off, quadric_processor::PlaneWords& words);
  std::array<std::uint32_t, 3> cap_normal(const glm::dvec4& plane) const;

  // Depth and caps are of one width: the widest is named.
  void need_plane_bits(std::int64_t bits, const char* what) {
    if (bits <= plane_bits_) return;
    plane_bits_ = bits;
    widest_plane_ = what;
  }

  LinearForm<T> in_depth_words(const LinearForm<T>& form) const {
    return {form.x * T(depth_range_), form.y * T(depth_range_), form.one * T(depth_range_) + T(near_)};
  }
  // Of the discriminant's words, with the scale, on the farthest pixel of a box.
  double discriminant_error(const PixelBox& box) const { return second_order_error(farthest<T>(result_.anchor, box)); }
  double largest_root() const {
    return static_cast<double>(object_processor::square_root(root_.largest_word(), root_));
  }
  int read_fraction() const { return static_cast<int>(root_.read_fraction_bits()); }
  [[noreturn]] void refuse(const char* key, std::int64_t width, std::string message) {
    result_.problem = {key[0] == 0 ? "" : fmt::format("quadric_processor.{}", key), std::move(message), width};
    throw Stop{};
  }
  void refuse_word(const char* key, std::int64_t bits, std::int64_t needed, std::int64_t most, const char* what) {
    std::string message = fmt::format("is {}; {} of a solid needs {} bits here", bits, what, needed);
    if (needed > most) message += fmt::format(", more than the {} that there can be", most);
    refuse(key, needed > most ? 0 : needed, std::move(message));
  }

  const glm::dmat4& quadric_;
  std::span<const glm::dvec4> planes_;
  const glm::dmat4& screen_to_eye_;
  const QuadricFormat& format_;
  const quadric_processor::QuadricParameters& parameters_;
  object_processor::RootFormat root_;
  PixelBox screen_;
  int depth_fraction_;
  double depth_range_, near_;

  ScreenQuadric<T> form_;
  std::vector<ScreenPlane<T>> caps_;
  SecondOrderForm<T> discriminant_;     // in the words' last place, before the scale
  std::optional<Ellipse<T>> outline_;   // where it is one
  Range<T> on_screen_{T(0.0), T(0.0)};  // of it
  T positive_most_{};                   // of it where it is positive, and where the solid can be seen
  T seen_most_{};
  PixelBox positive_;            // where it can be 0 or more, or the whole screen
  PixelBox bounds_;              // of what planes leave of the solid, or the whole screen
  PixelBox seen_;                // both
  std::int64_t plane_bits_ = 0;  // that depth and caps need
  const char* widest_plane_ = "";
  QuadricSetUp result_;
};

}  // namespace rastertlm::set_up::detail
