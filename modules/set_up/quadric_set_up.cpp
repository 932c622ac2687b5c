#include "modules/set_up/quadric_set_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "modules/set_up/quadric_fitter.h"
#include "src/geometry/counted.h"
#include "src/geometry/quadric.h"

namespace rastertlm::set_up {

namespace detail {

namespace {

constexpr double kNearToZero = 0x1p-44;
// Of the squares that a discriminant is the difference of, the least that it must be somewhere: some 2^8 times what
// their rounding leaves of it.
constexpr double kLeastOfSquares = 0x1p-42;

// The largest power k of 4 with value 4^k <= limit; value and limit more than 0.
int largest_scale(double value, double limit) {
  int k = std::clamp((std::ilogb(limit) - std::ilogb(value)) / 2 + 1, -kMostScale, kMostScale);
  while (std::ldexp(value, 2 * k) > limit) --k;
  return k;
}

}  // namespace

template <class T>
QuadricSetUp QuadricFitter<T>::operator()(std::uint32_t material) {
  const auto park = [&] {
    result_.words = quadric_processor::parked_quadric(static_cast<unsigned>(parameters_.word_bits));
    result_.words.material = material;
  };
  try {
    if (const auto planes = static_cast<std::int64_t>(planes_.size()); planes > parameters_.caps) {
      constexpr auto kMost = static_cast<std::int64_t>(quadric_processor::kMostCaps);
      std::string message =
          fmt::format("is {}; a solid is cut by {} planes, its ends counted", parameters_.caps, planes);
      if (planes > kMost) message += fmt::format(", more than the {} that there can be", kMost);
      refuse("caps", planes > kMost ? 0 : planes, std::move(message));
    }
    for (const glm::dvec4& plane : planes_) caps_.push_back(geometry::screen_plane<T>(plane, screen_to_eye_));
    look_at_rays();
    if (!find_region()) {
      park();
      return result_;
    }
    choose_scale();
    fit_discriminant();
    if (result_.words.part != RayPart::all) {
      fit_middle();
      fit_normals();
    }
    fit_caps();
    if (plane_bits_ > parameters_.plane_bits)
      refuse_word("plane_bits", parameters_.plane_bits, plane_bits_, quadric_processor::kMostPlaneBits, widest_plane_);
  } catch (const Stop&) {
    result_.outcome = QuadricOutcome::refused;
    park();
    return result_;
  }
  result_.words.material = material;
  result_.outcome = QuadricOutcome::drawn;
  return result_;
}

// What counts as 0 beside products of the quadric with points of the screen: the largest that each coordinate can be
// there, and with it what the products add at most.
template <class T>
T QuadricFitter<T>::near_to_zero() const {
  T along(0.0), weight(0.0);
  const double corner[4] = {static_cast<double>(format_.words.columns), static_cast<double>(format_.words.lines), 1, 1};
  for (int row = 0; row < 4; ++row) {
    T sum(0.0);
    for (int column = 0; column < 4; ++column)
      sum = sum + magnitude(T(screen_to_eye_[column][row])) * T(corner[column]);
    if (row < 3)
      along = along + sum;
    else
      weight = sum;
  }
  T of_squares(0.0), of_lengths(0.0);
  const auto take = [](T& largest, double element) {
    const T size = magnitude(T(element));
    if (largest < size) largest = size;
  };
  for (int row = 0; row < 3; ++row) {
    take(of_lengths, quadric_[3][row]);
    for (int column = row; column < 3; ++column) take(of_squares, quadric_[column][row]);
  }
  return T(kNearToZero) * (of_squares * along * along + T(2.0) * of_lengths * along * weight +
                           magnitude(T(quadric_[3][3])) * weight * weight);
}

// Which part of a ray is inside, and the discriminant in its words' last place.
template <class T>
void QuadricFitter<T>::look_at_rays() {
  form_ = geometry::screen_quadric<T>(quadric_, screen_to_eye_);
  const T zero = near_to_zero();
  if (!(zero < magnitude(form_.a))) {
    result_.words.part = RayPart::all;
    look_along_rulings(zero);
    return;
  }
  result_.words.part = T(0.0) < form_.a ? RayPart::between : RayPart::outside;
  const double unit = std::ldexp(depth_range_, -depth_fraction_);
  discriminant_ = scaled(form_.discriminant, T(std::ldexp(unit * unit, static_cast<int>(parameters_.fraction_bits))));
}

// With a = 0 and L = 0 what is left of the quadric is P, negative inside.
template <class T>
void QuadricFitter<T>::look_along_rulings(const T& zero) {
  std::array<std::array<T, 4>, 4> screen;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      T sum(0.0);
      for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
          sum = sum + T(screen_to_eye_[row][i]) * T(quadric_[k][i]) * T(screen_to_eye_[column][k]);
      screen[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = sum;
    }
  const Range<T> slope = range_in(LinearForm<T>{screen[0][2], screen[1][2], screen[2][3]}, screen_);
  if (!(slope.largest_magnitude() < zero))
    refuse("", 0,
           "a solid is seen along its axis, or the eye is on its surface: depth is no root there; another view, or one "
           "turned by a little, can be drawn");
  const T minus(-1.0), minus_two(-2.0);
  discriminant_ = {minus * screen[0][0],     minus * screen[1][1],     minus_two * screen[0][1],
                   minus_two * screen[0][3], minus_two * screen[1][3], minus * screen[3][3]};
}

// The discriminant is l^2 - P / a: of a solid that is flat to the eye, or far too small, rounding leaves nothing of it.
template <class T>
void QuadricFitter<T>::refuse_what_rounding_hides() {
  const double unit = std::ldexp(depth_range_, -depth_fraction_);
  const T middle = range_in(form_.middle, screen_).largest_magnitude();
  const T squares = middle * middle * T(std::ldexp(unit * unit, static_cast<int>(parameters_.fraction_bits)));
  if (magnitude(on_screen_.most) < T(kLeastOfSquares) * squares)
    refuse("", 0,
           "a solid is so flat to the eye, or so small, that doubles do not hold where it is in front of itself; a "
           "thicker one, or a plane of triangles, can be drawn");
}

// Where it can be seen; false where nowhere.
template <class T>
bool QuadricFitter<T>::find_region() {
  const bool between = result_.words.part == RayPart::between;
  on_screen_ = range_in(discriminant_, screen_);
  if (between) refuse_what_rounding_hides();
  if (result_.words.part != RayPart::outside && on_screen_.most < T(0.0)) return false;
  if (between) outline_ = ellipse_of(discriminant_);
  positive_ = outline_ ? outline_->box(T(0.0), screen_) : screen_;
  bounds_ = screen_;
  Range<T> depth{T(0.0), T(1.0)};
  if (const auto around = bounding_quadric<T>(quadric_, planes_))
    if (const auto part = bounded_part(geometry::screen_quadric<T>(*around, screen_to_eye_), screen_)) {
      bounds_ = grown<T>(part->box, screen_);  // by more than rounding moves it
      depth = part->depth;
    }
  seen_ = common_box<T>(positive_, bounds_);
  if (seen_.empty()) return false;
  positive_most_ = on_screen_.most;
  if (outline_)
    positive_most_ = outline_->middle_in(positive_) ? outline_->at_middle : range_in(discriminant_, positive_).most;
  seen_most_ = seen_ == positive_ ? positive_most_ : range_in(discriminant_, seen_).most;
  if (between) {
    const double unit = std::ldexp(depth_range_, -depth_fraction_);
    const T most = seen_most_ * T(std::ldexp(1.0, -static_cast<int>(parameters_.fraction_bits)) / (unit * unit));
    if (most < T(0.0)) return false;
    const T root = geometry::square_root(most);
    const Range<T> middle = range_in(form_.middle, seen_);
    if (depth.least < middle.least - root) depth.least = middle.least - root;
    if (middle.most + root < depth.most) depth.most = middle.most + root;
  }
  result_.anchor = middle_of<T>(seen_);
  return !nothing_between<T>(caps_, seen_, depth);
}

// The scale with which neither the discriminant wraps anywhere on the screen nor a root is cut off that is seen: either
// it has a place, or even the largest one is before near and beyond far.
template <class T>
void QuadricFitter<T>::choose_scale() {
  const double error = discriminant_error(screen_) + 1;
  const double size = std::max(geometry::plain(on_screen_.largest_magnitude()), std::numeric_limits<double>::min());
  const double limit = largest_of(parameters_.word_bits) - error;
  geometry::charge_integer<T>(8, 0);
  if (limit < 1)
    refuse_word("word_bits", parameters_.word_bits, signed_bits(2 * error), quadric_processor::kMostWordBits,
                "the rounding of the discriminant");
  const int by_word = largest_scale(size, limit);
  const bool fixed = parameters_.scaling == quadric_processor::Scaling::fixed;
  if (result_.words.part == RayPart::all) {
    result_.scale = by_word;  // of the sign alone: fixed or not
    return;
  }
  if (fixed && by_word < 0)
    refuse_word("word_bits", parameters_.word_bits, signed_bits(size + error), quadric_processor::kMostWordBits,
                "the discriminant");
  const std::int64_t most_root_bits =
      std::min(quadric_processor::kMostRootIntegerBits, quadric_processor::kMostRootBits - parameters_.root_guard_bits);
  const int by_root = std::max(scale_of_root(), scale_beyond_depths());
  if (fixed && by_root < 0)
    refuse_word("root_integer_bits", parameters_.root_integer_bits, parameters_.root_integer_bits - by_root,
                most_root_bits, "the root");
  if (fixed) return;
  // A root's last place is at most a unit of depth.
  const int least = -read_fraction();
  if (by_word < least)
    refuse_word("word_bits", parameters_.word_bits, parameters_.word_bits + 2 * (least - by_word),
                quadric_processor::kMostWordBits, "the discriminant");
  if (by_root < least)
    refuse_word("root_integer_bits", parameters_.root_integer_bits, parameters_.root_integer_bits + least - by_root,
                most_root_bits, "the root");
  result_.scale = std::min({by_word, by_root, depth_fraction_ - read_fraction() + kMostShift});
}

template <class T>
int QuadricFitter<T>::scale_of_root() {
  const double most = geometry::plain(positive_most_);
  const auto largest = static_cast<double>(root_.largest_word());
  geometry::charge_integer<T>(4, 0);
  if (most <= 0) return kMostScale;
  return largest_scale(most, std::max(largest - discriminant_error(positive_), largest / 2));
}

template <class T>
int QuadricFitter<T>::scale_beyond_depths() {
  const Range<T> middle = range_in(in_depth_words(form_.middle), positive_);
  const double reach =
      std::max(geometry::plain(middle.most) - near_, near_ + depth_range_ - geometry::plain(middle.least)) +
      linear_error(farthest<T>(result_.anchor, positive_)) + 1;
  geometry::charge_integer<T>(4, 0);
  const double largest = std::ldexp(largest_root(), depth_fraction_ - read_fraction());
  int k = std::clamp(std::ilogb(largest) - std::ilogb(reach) + 1, -kMostScale, kMostScale);
  while (std::ldexp(largest, -k) <= reach) --k;
  return k;
}

}  // namespace detail

template <class T>
QuadricSetUp set_up_quadric(const glm::dmat4& quadric, std::span<const glm::dvec4> planes, std::uint32_t material,
                            const glm::dmat4& screen_to_eye, const QuadricFormat& format) {
  return detail::QuadricFitter<T>(quadric, planes, screen_to_eye, format)(material);
}

template QuadricSetUp set_up_quadric<double>(const glm::dmat4&, std::span<const glm::dvec4>, std::uint32_t,
                                             const glm::dmat4&, const QuadricFormat&);
template QuadricSetUp set_up_quadric<geometry::Counted<double>>(const glm::dmat4&, std::span<const glm::dvec4>,
                                                                std::uint32_t, const glm::dmat4&, const QuadricFormat&);

}  // namespace rastertlm::set_up
