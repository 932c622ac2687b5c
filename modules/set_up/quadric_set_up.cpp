#include "modules/set_up/quadric_set_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "modules/set_up/quadric_region.h"
#include "src/geometry/counted.h"
#include "src/geometry/quadric.h"

namespace rastertlm::set_up {

using geometry::LinearForm;
using geometry::ScreenPlane;
using geometry::ScreenQuadric;
using geometry::SecondOrderForm;
using quadric_processor::CapKeeps;
using quadric_processor::kMultiplierInteger;
using quadric_processor::QuadricWords;
using quadric_processor::RayPart;

namespace {

constexpr double kNearToZero = 0x1p-44;
constexpr double kSteep = 64;            // depths from near to far a pixel
constexpr double kSideError = 1.0 / 64;  // pixels
constexpr int kMostShift = 31;           // of a root, in the words of a slot
constexpr int kMostScale = 200;

// Bits of a two's complement word that holds integers up to this magnitude.
std::int64_t signed_bits(double largest) { return std::ilogb(std::max(largest, 1.0)) + 2; }
double largest_of(std::int64_t bits) { return std::ldexp(1.0, static_cast<int>(bits) - 1) - 1; }

// The largest power k of 4 with value 4^k <= limit; value and limit more than 0.
int largest_scale(double value, double limit) {
  int k = std::clamp((std::ilogb(limit) - std::ilogb(value)) / 2 + 1, -kMostScale, kMostScale);
  while (std::ldexp(value, 2 * k) > limit) --k;
  return k;
}

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
  bool find_region();
  void choose_scale();
  int scale_of_root();
  int scale_beyond_depths();
  void fit_discriminant();
  double root_in(const PixelBox& box) const;
  void fit_middle();
  void fit_normals();
  void fit_caps();
  CapKeeps fit_cap(const ScreenPlane<T>& cap, quadric_processor::PlaneWords& words);
  void fit_side(const LinearForm<T>& form, const PixelBox& box, double off, quadric_processor::PlaneWords& words);
  std::array<std::uint32_t, 3> cap_normal(const glm::dvec4& plane) const;

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
  void refuse_word(const char* key, std::int64_t bits, std::int64_t needed, const char* what) {
    refuse(key, needed, fmt::format("is {}; {} of a solid needs {} bits here", bits, what, needed));
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
  PixelBox positive_;                   // where it can be 0 or more, or the whole screen
  PixelBox bounds_;                     // of what planes leave of the solid, or the whole screen
  PixelBox seen_;                       // both
  QuadricSetUp result_;
};

template <class T>
QuadricSetUp QuadricFitter<T>::operator()(std::uint32_t material) {
  const auto park = [&] {
    result_.words = quadric_processor::parked_quadric(static_cast<unsigned>(parameters_.word_bits));
    result_.words.material = material;
  };
  try {
    if (static_cast<std::int64_t>(planes_.size()) > parameters_.caps)
      refuse("caps", static_cast<std::int64_t>(planes_.size()),
             fmt::format("is {}; a solid is cut by {} planes", parameters_.caps, planes_.size()));
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

// Where it can be seen; false where nowhere.
template <class T>
bool QuadricFitter<T>::find_region() {
  const bool between = result_.words.part == RayPart::between;
  on_screen_ = range_in(discriminant_, screen_);
  if (result_.words.part != RayPart::outside && on_screen_.most < T(0.0)) return false;
  if (between) outline_ = ellipse_of(discriminant_);
  positive_ = outline_ ? outline_->box(T(0.0), screen_) : screen_;
  bounds_ = screen_;
  Range<T> depth{T(0.0), T(1.0)};
  if (const auto around = bounding_quadric<T>(quadric_, planes_))
    if (const auto part = bounded_part(geometry::screen_quadric<T>(*around, screen_to_eye_), screen_)) {
      bounds_ = part->box;
      depth = part->depth;
    }
  seen_ = common_box<T>(positive_, bounds_);
  if (seen_.empty()) return false;
  if (between) {
    const double unit = std::ldexp(depth_range_, -depth_fraction_);
    const T most = range_in(discriminant_, seen_).most *
                   T(std::ldexp(1.0, -static_cast<int>(parameters_.fraction_bits)) / (unit * unit));
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
    refuse_word("word_bits", parameters_.word_bits, signed_bits(2 * error), "the rounding of the discriminant");
  const int by_word = largest_scale(size, limit);
  const bool fixed = parameters_.scaling == quadric_processor::Scaling::fixed;
  if (result_.words.part == RayPart::all) {
    result_.scale = by_word;  // of the sign alone: fixed or not
    return;
  }
  if (fixed && by_word < 0)
    refuse_word("word_bits", parameters_.word_bits, signed_bits(size + error), "the discriminant");
  const int by_root = std::max(scale_of_root(), scale_beyond_depths());
  if (fixed && by_root < 0)
    refuse_word("root_integer_bits", parameters_.root_integer_bits, parameters_.root_integer_bits - by_root,
                "the root");
  if (fixed) return;
  // A root's last place is at most a unit of depth.
  const int least = -read_fraction();
  if (by_word < least)
    refuse_word("word_bits", parameters_.word_bits, parameters_.word_bits + 2 * (least - by_word), "the discriminant");
  if (by_root < least)
    refuse_word("root_integer_bits", parameters_.root_integer_bits, parameters_.root_integer_bits + least - by_root,
                "the root");
  result_.scale = std::min({by_word, by_root, depth_fraction_ - read_fraction() + kMostShift});
}

template <class T>
int QuadricFitter<T>::scale_of_root() {
  const double most = geometry::plain(range_in(discriminant_, positive_).most);
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

template <class T>
void QuadricFitter<T>::fit_discriminant() {
  const double factor = std::ldexp(1.0, 2 * result_.scale);
  result_.words.discriminant = anchored_second_order(scaled(discriminant_, T(factor)), result_.anchor,
                                                     static_cast<unsigned>(parameters_.word_bits));
  if (result_.words.part == RayPart::all) return;
  result_.words.root_shift = depth_fraction_ - read_fraction() - result_.scale;
  // Rounding may add to where the discriminant is positive.
  const double error = discriminant_error(screen_);
  if (outline_) positive_ = outline_->box(T(error / factor), screen_);
  seen_ = common_box<T>(positive_, bounds_);
}

// The largest root that can be on a box, in depth words.
template <class T>
double QuadricFitter<T>::root_in(const PixelBox& box) const {
  const double most = std::max(0.0, std::ldexp(geometry::plain(range_in(discriminant_, box).most), 2 * result_.scale)) +
                      discriminant_error(box);
  geometry::charge_integer<T>(6, 0);
  const double root =
      geometry::plain(geometry::square_root(T(std::ldexp(most, -static_cast<int>(parameters_.fraction_bits)))));
  return std::ldexp(std::min(std::ldexp(root, read_fraction()) + 2, largest_root()), result_.words.root_shift);
}

template <class T>
void QuadricFitter<T>::fit_middle() {
  const LinearForm<T> form = in_depth_words(form_.middle);
  const double size = geometry::plain(range_in(form, positive_).largest_magnitude()) + root_in(positive_) +
                      linear_error(farthest<T>(result_.anchor, positive_)) + 1;
  geometry::charge_integer<T>(3, 0);
  if (signed_bits(size) > parameters_.plane_bits)
    refuse_word("plane_bits", parameters_.plane_bits, signed_bits(size), "depth");
  result_.words.middle =
      plane_words(anchored_plane(form, result_.anchor), static_cast<unsigned>(parameters_.plane_bits));
}

// All by one factor: so large that no component leaves its word where the solid is seen, nor a constant the multiplier.
template <class T>
void QuadricFitter<T>::fit_normals() {
  const double root = root_in(seen_);  // in depth words
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
  if (steep < T(kSteep)) refuse_word("plane_bits", parameters_.plane_bits, signed_bits(size), "a cap");
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
    refuse_word("plane_bits", parameters_.plane_bits, needed, "a cap along the rays");
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

}  // namespace

template <class T>
QuadricSetUp set_up_quadric(const glm::dmat4& quadric, std::span<const glm::dvec4> planes, std::uint32_t material,
                            const glm::dmat4& screen_to_eye, const QuadricFormat& format) {
  return QuadricFitter<T>(quadric, planes, screen_to_eye, format)(material);
}

template QuadricSetUp set_up_quadric<double>(const glm::dmat4&, std::span<const glm::dvec4>, std::uint32_t,
                                             const glm::dmat4&, const QuadricFormat&);
template QuadricSetUp set_up_quadric<geometry::Counted<double>>(const glm::dmat4&, std::span<const glm::dvec4>,
                                                                std::uint32_t, const glm::dmat4&, const QuadricFormat&);

}  // namespace rastertlm::set_up
