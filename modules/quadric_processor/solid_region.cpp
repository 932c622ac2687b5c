#include "modules/quadric_processor/solid_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rastertlm::quadric_processor {

namespace {

// What is found in doubles is widened by so many pixels; words of 60 bits at most and pixels below 2^14 leave doubles
// wrong by far less, but for roots that fall together, where the square root of the rounding counts.
constexpr double kSlack = 0.25;
constexpr double kRounding = 1e-13;  // of a discriminant, against its terms
// Values of words up to it are right in doubles to less than 1, their terms being up to 16 times as large.
constexpr int kExactBits = 48;

RealPlane difference(const RealPlane& left, const RealPlane& right, double more) {
  return {left.a - right.a, left.b - right.b, left.c - right.c + more};
}

// The plane of words, where none of its values on the screen's corners leaves the word: then none on the screen does.
std::optional<RealPlane> real_plane(const PlaneWords& words, unsigned bits, double columns, double lines) {
  const auto real = [bits](std::uint64_t word) { return static_cast<double>(sign_extended(word, bits)); };
  const RealPlane plane{real(words.a), real(words.b), real(words.b) + real(words.c)};
  const double limit = std::ldexp(1.0, static_cast<int>(bits) - 1);
  for (const double x : {0.0, columns - 1})
    for (const double y : {0.0, lines - 1})
      if (!(std::abs(plane.at(x, y)) < limit)) return std::nullopt;
  return plane;
}

// Roots of a t^2 + b t + c, ascending; one that is double within rounding counts.
struct Roots {
  std::array<double, 2> at{};
  std::size_t count = 0;
};
Roots real_roots(double a, double b, double c) {
  const double square = b * b;
  const double product = 4.0 * a * c;
  const double d = square - product;
  if (d < -kRounding * (square + std::abs(product))) return {};
  const double root = std::sqrt(std::max(d, 0.0));
  const double q = -0.5 * (b + std::copysign(root, b));
  Roots roots;
  if (a != 0.0) roots.at[roots.count++] = q / a;
  if (q != 0.0)
    roots.at[roots.count++] = c / q;
  else if (roots.count == 1)
    roots.at[roots.count++] = roots.at[0];
  if (roots.count == 2 && roots.at[1] < roots.at[0]) std::swap(roots.at[0], roots.at[1]);
  return roots;
}

// The conic of second-order words, and whether no value on the screen leaves the word.
std::optional<RealConic> real_conic(const SecondOrderWords& words, unsigned bits, double columns, double lines) {
  const auto real = [bits](std::uint64_t word) { return static_cast<double>(sign_extended(word, bits)); };
  const double a = real(words.two_a) / 2;
  const double b = real(words.two_b) / 2;
  const RealConic conic{a, b, real(words.c), real(words.d0) - a, real(words.dy) - b, real(words.v0)};
  const double limit = std::ldexp(1.0, static_cast<int>(bits) - 1) * (1.0 - 1e-9);
  const auto fits = [&](double x, double y) { return std::abs(conic.at(x, y)) < limit; };
  const double right = columns - 1;
  const double bottom = lines - 1;
  bool all = fits(0, 0) && fits(right, 0) && fits(0, bottom) && fits(right, bottom);
  const auto inside = [](double t, double end) { return t > 0.0 && t < end; };
  for (const double y : {0.0, bottom})
    if (const double x = -(conic.xy * y + conic.x) / (2 * conic.xx); inside(x, right)) all = all && fits(x, y);
  for (const double x : {0.0, right})
    if (const double y = -(conic.xy * x + conic.y) / (2 * conic.yy); inside(y, bottom)) all = all && fits(x, y);
  const double determinant = 4 * conic.xx * conic.yy - conic.xy * conic.xy;
  const double x = (conic.xy * conic.y - 2 * conic.yy * conic.x) / determinant;
  const double y = (conic.xy * conic.x - 2 * conic.xx * conic.y) / determinant;
  if (inside(x, right) && inside(y, bottom)) all = all && fits(x, y);
  return all ? std::optional(conic) : std::nullopt;
}

std::int32_t whole(double value, double lowest, double highest) {
  return static_cast<std::int32_t>(std::clamp(value, lowest, highest));
}

}  // namespace

SolidRegion::SolidRegion(const QuadricWords& words, const QuadricParameters& parameters, const DepthRange& range,
                         std::int32_t columns, std::int32_t lines)
    : columns_(columns), lines_{0, lines} {
  const double right = columns - 1;
  const double bottom = lines - 1;
  polygon_ = {{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
  const auto word_bits = static_cast<unsigned>(parameters.word_bits);
  const auto plane_bits = static_cast<unsigned>(parameters.plane_bits);
  const auto count = static_cast<std::size_t>(parameters.caps);
  const auto conic = real_conic(words.discriminant, word_bits, columns, lines);
  conic_bounds_ = conic && words.part != RayPart::outside;
  if (conic) {
    conic_ = *conic;
    conic_.one += std::max(1.0, std::ldexp(1.0, static_cast<int>(word_bits) - kExactBits));
  }

  std::array<RealPlane, kMostCaps> caps{};
  bool sound = true;
  for (std::size_t i = 0; i < count; ++i) {
    const auto plane = real_plane(words.caps[i].plane, plane_bits, columns, lines);
    sound = sound && (plane || words.caps[i].keeps == CapKeeps::everything);
    if (plane) caps[i] = *plane;
  }
  const auto middle = real_plane(words.middle, plane_bits, columns, lines);
  if (sound) bound_by_caps(words, caps, count, range);
  if (sound && middle && conic_bounds_ && words.part == RayPart::between) {
    const object_processor::RootFormat format = parameters.root();
    const double largest = std::clamp(largest_on_polygon(), 0.0, static_cast<double>(format.largest_word()));
    const double root =
        static_cast<double>(shifted_root(root_of(static_cast<std::uint64_t>(largest), format), words.root_shift));
    const double limit = std::ldexp(1.0, static_cast<int>(plane_bits) - 1);
    const auto fits = [&](double x, double y) { return std::abs(middle->at(x, y)) + root + 1.0 < limit; };
    if (fits(0, 0) && fits(right, 0) && fits(0, bottom) && fits(right, bottom))
      bound_by_roots(words, *middle, root + 2.0, caps, count, range);
  }
  find_lines(conic_bounds_);
}

// The ray is empty where a plane before which the solid remains lies before one beyond which it does.
void SolidRegion::bound_by_caps(const QuadricWords& words, const std::array<RealPlane, kMostCaps>& caps,
                                std::size_t count, const DepthRange& range) {
  const RealPlane near{0.0, 0.0, static_cast<double>(range.near)};
  const RealPlane far{0.0, 0.0, static_cast<double>(range.far)};
  for (std::size_t i = 0; i < count; ++i) {
    const CapKeeps keeps = words.caps[i].keeps;
    if (keeps == CapKeeps::side) keep(caps[i]);
    if (keeps == CapKeeps::before) keep(difference(caps[i], near, 1.0));
    if (keeps != CapKeeps::beyond) continue;
    keep(difference(far, caps[i], 1.0));
    for (std::size_t k = 0; k < count; ++k)
      if (words.caps[k].keeps == CapKeeps::before) keep(difference(caps[k], caps[i], 1.0));
  }
}

// So is it where all that lies between the roots, no farther than `root` from the middle, is cut away.
void SolidRegion::bound_by_roots(const QuadricWords& words, const RealPlane& middle, double root,
                                 const std::array<RealPlane, kMostCaps>& caps, std::size_t count,
                                 const DepthRange& range) {
  keep(difference(middle, {0.0, 0.0, static_cast<double>(range.near)}, root));
  keep(difference({0.0, 0.0, static_cast<double>(range.far)}, middle, root));
  for (std::size_t i = 0; i < count; ++i) {
    if (words.caps[i].keeps == CapKeeps::before) keep(difference(caps[i], middle, root));
    if (words.caps[i].keeps == CapKeeps::beyond) keep(difference(middle, caps[i], root));
  }
}

void SolidRegion::keep(const RealPlane& plane) {
  Polygon kept;
  bool cuts = false;
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const Point& from = polygon_[i];
    const Point& to = polygon_[(i + 1) % polygon_.size()];
    const double at_from = plane.at(from.x, from.y);
    const double at_to = plane.at(to.x, to.y);
    if (at_from >= 0.0)
      kept.push_back(from);
    else
      cuts = true;
    if ((at_from >= 0.0) == (at_to >= 0.0)) continue;
    const double t = at_from / (at_from - at_to);
    kept.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
  }
  if (!cuts) return;
  planes_.push_back(plane);
  polygon_ = std::move(kept);
}

// Within rounding: on the border counts.
bool SolidRegion::holds(const Point& point) const {
  if (!(point.x > -1.0 && point.x < columns_ && point.y > -1.0 && point.y < lines_.end)) return false;
  return std::all_of(planes_.begin(), planes_.end(), [&](const RealPlane& plane) {
    return plane.at(point.x, point.y) >= -(std::abs(plane.a) + std::abs(plane.b)) * kSlack;
  });
}

// The conic's: in the middle, or on the border.
double SolidRegion::largest_on_polygon() const {
  double largest = -std::numeric_limits<double>::infinity();
  const auto look = [&](double x, double y) { largest = std::max(largest, conic_.at(x, y)); };
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const Point& from = polygon_[i];
    const Point& to = polygon_[(i + 1) % polygon_.size()];
    look(from.x, from.y);
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    const double square = conic_.xx * dx * dx + conic_.yy * dy * dy + conic_.xy * dx * dy;
    const double slope = (2 * conic_.xx * from.x + conic_.xy * from.y + conic_.x) * dx +
                         (2 * conic_.yy * from.y + conic_.xy * from.x + conic_.y) * dy;
    if (const double t = -slope / (2 * square); t > 0.0 && t < 1.0) look(from.x + t * dx, from.y + t * dy);
  }
  const double determinant = 4 * conic_.xx * conic_.yy - conic_.xy * conic_.xy;
  const Point centre{(conic_.xy * conic_.y - 2 * conic_.yy * conic_.x) / determinant,
                     (conic_.xy * conic_.x - 2 * conic_.xx * conic_.y) / determinant};
  if (std::isfinite(centre.x) && std::isfinite(centre.y) && holds(centre)) look(centre.x, centre.y);
  return largest * (1.0 + 1e-9) + 1.0;
}

// The highest and the lowest point of what is left of the polygon inside the conic are among its corners that are
// inside, where its edges meet the conic, and where the conic's tangent is level.
void SolidRegion::find_lines(bool by_conic) {
  double top = std::numeric_limits<double>::infinity();
  double bottom = -top;
  const auto take = [&](double y) {
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  };
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const Point& from = polygon_[i];
    const Point& to = polygon_[(i + 1) % polygon_.size()];
    if (!by_conic || conic_.at(from.x, from.y) >= 0.0) take(from.y);
    if (!by_conic) continue;
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    const Roots roots = real_roots(conic_.xx * dx * dx + conic_.yy * dy * dy + conic_.xy * dx * dy,
                                   (2 * conic_.xx * from.x + conic_.xy * from.y + conic_.x) * dx +
                                       (2 * conic_.yy * from.y + conic_.xy * from.x + conic_.y) * dy,
                                   conic_.at(from.x, from.y));
    for (std::size_t k = 0; k < roots.count; ++k)
      if (const double t = roots.at[k]; t > -1e-3 && t < 1.0 + 1e-3) take(from.y + std::clamp(t, 0.0, 1.0) * dy);
  }
  if (by_conic && conic_.xx != 0.0) {
    const Roots level = real_roots(conic_.xy * conic_.xy - 4 * conic_.xx * conic_.yy,
                                   2 * conic_.xy * conic_.x - 4 * conic_.xx * conic_.y,
                                   conic_.x * conic_.x - 4 * conic_.xx * conic_.one);
    for (std::size_t k = 0; k < level.count; ++k) {
      const double y = level.at[k];
      if (holds({-(conic_.xy * y + conic_.x) / (2 * conic_.xx), y})) take(y);
    }
  }
  if (std::isnan(top) || std::isnan(bottom)) return;
  const double end = lines_.end;
  if (top > bottom) {
    lines_ = {0, 0};
    return;
  }
  lines_ = {whole(std::floor(top - kSlack), 0.0, end), whole(std::ceil(bottom + kSlack) + 1.0, 0.0, end)};
}

LinePieces SolidRegion::columns(std::int32_t line) const {
  const double y = line;
  double from = 0.0;
  double to = columns_ - 1;
  for (const RealPlane& plane : planes_) {
    const double c = plane.b * y + plane.c;
    if (plane.a > 0.0)
      from = std::max(from, -c / plane.a - kSlack);
    else if (plane.a < 0.0)
      to = std::min(to, -c / plane.a + kSlack);
  }
  LinePieces pieces;
  const auto add = [&](double first, double last) {
    const double begin = std::floor(std::max(first - kSlack, from));
    const double end = std::ceil(std::min(last + kSlack, to)) + 1.0;
    if (begin < end) pieces.add({whole(begin, 0.0, columns_), whole(end, 0.0, columns_)});
  };
  if (!conic_bounds_) {
    add(from, to);
    return pieces;
  }
  const double b = conic_.xy * y + conic_.x;
  const double c = (conic_.yy * y + conic_.y) * y + conic_.one;
  const Roots roots = real_roots(conic_.xx, b, c);
  if (conic_.xx < 0.0) {
    if (roots.count == 2) add(roots.at[0], roots.at[1]);
  } else if (roots.count == 2 && conic_.xx > 0.0 && roots.at[1] - roots.at[0] > 4.0) {
    add(from, roots.at[0]);
    add(roots.at[1], to);
  } else {
    add(from, to);
  }
  return pieces;
}

}  // namespace rastertlm::quadric_processor
