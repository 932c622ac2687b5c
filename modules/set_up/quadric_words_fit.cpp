// The words of a solid whose place on the screen and whose scale are known.
#include <algorithm>
#include <array>
#include <cmath>

#include "modules/set_up/quadric_fitter.h"

namespace rastertlm::set_up::detail {

using quadric_processor::kMultiplierInteger;

namespace {

constexpr double kSteep = 64;            // depths from near to far a pixel
constexpr double kSideError = 1.0 / 64;  // pixels

}  // namespace

template <class T>
void QuadricFitter<T>::fit_discriminant() {
  const double factor = std::ldexp(1.0, 2 * result_.scale);
  result_.words.discriminant = anchored_second_order(scaled(discriminant_, T(factor)), result_.anchor,
                                                     static_cast<unsigned>(parameters_.word_bits));
  if (result_.words.part == RayPart::all) return;
  result_.words.root_shift = depth_fraction_ - read_fraction() - result_.scale;
  // Rounding may add to where the discriminant is positive; it is largest where it was.
  const double error = discriminant_error(screen_);
  if (outline_) positive_ = outline_->box(T(error / factor), screen_);
  seen_ = common_box<T>(positive_, bounds_);
}

// The root of the largest discriminant on a box, with what rounding may add, in depth words.
template <class T>
double QuadricFitter<T>::largest_root_of(const T& discriminant, const PixelBox& box) const {
  const double most =
      std::max(0.0, std::ldexp(geometry::plain(discriminant), 2 * result_.scale)) + discriminant_error(box);
  geometry::charge_integer<T>(6, 0);
  const double root =
      geometry::plain(geometry::square_root(T(std::ldexp(most, -static_cast<int>(parameters_.fraction_bits)))));
  return std::ldexp(std::min(std::ldexp(root, read_fraction()) + 2, largest_root()), result_.words.root_shift);
}

template <class T>
void QuadricFitter<T>::fit_middle() {
  const LinearForm<T> form = in_depth_words(form_.middle);
  const double size = geometry::plain(range_in(form, positive_).largest_magnitude()) +
                      largest_root_of(positive_most_, positive_) +
                      linear_error(farthest<T>(result_.anchor, positive_)) + 1;
  geometry::charge_integer<T>(3, 0);
  need_plane_bits(signed_bits(size), "depth");
  result_.words.middle =
      plane_words(anchored_plane(form, result_.anchor), static_cast<unsigned>(parameters_.plane_bits));
}

// All by one factor: so large that no component leaves its word where the solid is seen, nor a constant the multiplier.
template <class T>
void QuadricFitter<T>::fit_normals() {
  const double root = largest_root_of(seen_most_, seen_);  // in depth words
  const double last_place = std::ldexp(1.0 / depth_range_, result_.words.root_shift);
  const auto fraction = static_cast<int>(parameters_.multiplier_bits) - static_cast<int>(kMultiplierInteger);
  T size(0.0), largest_k(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const T k = magnitude(form_.normal_of_root[i]);
    const T most = range_in(form_.normal[i], seen_).largest_magnitude() + k * T(root / depth_range_);
    if (size < most) size = most;
    if (largest_k < k) largest_k = k;
  }
  // Of E half a unit, and half a unit a pixel of each slope; of k s half a unit of k a place of the root; its product
  // is cut off.
  const double places = std::ldexp(root, -result_.words.root_shift);
  const double rounding = linear_error(farthest<T>(result_.anchor, seen_)) + std::ldexp(places, -fraction - 1) + 2;
  const double limit = std::max(largest_of(format_.words.word_bits) - rounding, 1.0);
  T factor = size == T(0.0) ? T(0.0) : T(limit) / size;
  const T most_factor(std::ldexp(largest_of(parameters_.multiplier_bits), -fraction) / last_place);
  if (most_factor < factor * largest_k) factor = most_factor / largest_k;
  const auto mask = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(format_.words.word_bits)));
  for (std::size_t i = 0; i < 3; ++i) {
    const IntegerPlane plane = anchored_plane(scaled(form_.normal[i], factor), result_.anchor);
    result_.words.normal[i] = {static_cast<std::uint32_t>(plane.a) & mask, static_cast<std::uint32_t>(plane.b) & mask,
                               static_cast<std::uint32_t>(plane.c - plane.b) & mask};
    const T k = form_.normal_of_root[i] * factor * T(std::ldexp(last_place, fraction));
    result_.words.normal_of_root[i] = static_cast<std::int32_t>(geometry::to_integer(k));
  }
}

template <class T>
void QuadricFitter<T>::fit_caps() {
  for (std::size_t i = 0; i < caps_.size(); ++i) {
    quadric_processor::CapWords& cap = result_.words.caps[i];
    cap.keeps = fit_cap(caps_[i], cap.plane);
    cap.normal = cap_normal(planes_[i]);
  }
}

// A plane so steep that its word would wrap is one along the rays, where depth is half way between near and far: less
// than half of 1/64 pixel from where it is at any other.
template <class T>
CapKeeps QuadricFitter<T>::fit_cap(const ScreenPlane<T>& cap, quadric_processor::PlaneWords& words) {
  using Keeps = typename ScreenPlane<T>::Keeps;
  const PixelBox& box = result_.words.part == RayPart::between ? positive_ : screen_;
  const auto turned = [](const LinearForm<T>& form) { return LinearForm<T>{-form.x, -form.y, -form.one}; };
  if (cap.keeps == Keeps::side) {
    fit_side(turned(cap.depth), box, 0.0, words);
    return CapKeeps::side;
  }
  const LinearForm<T> form = in_depth_words(cap.depth);
  const double size =
      geometry::plain(range_in(form, box).largest_magnitude()) + linear_error(farthest<T>(result_.anchor, box)) + 1;
  geometry::charge_integer<T>(3, 0);
  if (signed_bits(size) <= parameters_.plane_bits) {
    words = plane_words(anchored_plane(form, result_.anchor), static_cast<unsigned>(parameters_.plane_bits));
    return cap.keeps == Keeps::beyond ? CapKeeps::beyond : CapKeeps::before;
  }
  const T steep = geometry::square_root(cap.depth.x * cap.depth.x + cap.depth.y * cap.depth.y);
  if (steep < T(kSteep)) {
    need_plane_bits(signed_bits(size), "a cap");
    return CapKeeps::everything;
  }
  LinearForm<T> half = cap.keeps == Keeps::before ? cap.depth : turned(cap.depth);
  half.one = cap.keeps == Keeps::before ? half.one - T(0.5) : half.one + T(0.5);
  fit_side(half, box, geometry::plain(T(0.5) / steep), words);
  return CapKeeps::side;
}

// `form` is not negative where the solid remains. `off`: pixels by which it is off already.
template <class T>
void QuadricFitter<T>::fit_side(const LinearForm<T>& form, const PixelBox& box, double off,
                                quadric_processor::PlaneWords& words) {
  const double error = linear_error(farthest<T>(result_.anchor, box)) + 1;
  const Range<T> range = range_in(form, box);
  const T size = range.largest_magnitude();
  const double limit = largest_of(parameters_.plane_bits) - error;
  if (!(T(0.0) < size)) return;  // on the plane everywhere
  const T factor = T(limit) / size;
  const T slope = geometry::square_root(form.x * form.x + form.y * form.y) * factor;
  const bool crosses = range.least * factor < T(error) && T(-error) < range.most * factor;
  if (crosses && (T(kSideError - off) * slope < T(error))) {
    const double times = error / geometry::plain(T(kSideError - off) * slope);
    const auto needed = parameters_.plane_bits + std::ilogb(times) + 1;
    need_plane_bits(needed, "a cap along the rays");
  }
  words =
      plane_words(anchored_plane(scaled(form, factor), result_.anchor), static_cast<unsigned>(parameters_.plane_bits));
}

template <class T>
std::array<std::uint32_t, 3> QuadricFitter<T>::cap_normal(const glm::dvec4& plane) const {
  const T length = geometry::square_root(T(plane.x) * T(plane.x) + T(plane.y) * T(plane.y) + T(plane.z) * T(plane.z));
  const T factor = T(static_cast<double>(normal_unit(format_.words))) / length;
  const auto bits = static_cast<unsigned>(format_.words.word_bits);
  std::array<std::uint32_t, 3> words{};
  for (int i = 0; i < 3; ++i)
    words[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(wrap_unsigned(to_word(T(plane[i]) * factor), bits));
  return words;
}

template void QuadricFitter<double>::fit_discriminant();
template void QuadricFitter<double>::fit_middle();
template void QuadricFitter<double>::fit_normals();
template void QuadricFitter<double>::fit_caps();
template void QuadricFitter<geometry::Counted<double>>::fit_discriminant();
template void QuadricFitter<geometry::Counted<double>>::fit_middle();
template void QuadricFitter<geometry::Counted<double>>::fit_normals();
template void QuadricFitter<geometry::Counted<double>>::fit_caps();

}  // namespace rastertlm::set_up::detail
