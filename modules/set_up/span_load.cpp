#include "modules/set_up/span_load.h"

#include <algorithm>
#include <cmath>

#include "modules/set_up/register_kernels.h"
#include "src/base/fixed_point.h"

namespace rastertlm::set_up {
namespace {

using geometry::SnappedPoint;
using span_unit::ColourWords;
using span_unit::EdgeWords;
using span_unit::HalfTriangle;
using span_unit::StartEdge;
using span_unit::StartEdgeRegisters;

using Number = geometry::Counted<double>;

// The first line or column at or after a coordinate.
std::int64_t first_sample(std::int64_t steps, int fraction_bits) {
  return (steps + (std::int64_t{1} << fraction_bits) - 1) >> fraction_bits;
}

// The word nearest to `value` * 2^fraction_bits, modulo 2^64. Large ones are whole numbers, and so are their
// remainders.
std::uint64_t to_word(double value, unsigned fraction_bits) {
  const double scaled = value * static_cast<double>(std::uint64_t{1} << fraction_bits);
  if (std::fabs(scaled) < 0x1p62) return static_cast<std::uint64_t>(round_half_up(scaled));
  if (!std::isfinite(scaled)) return 0;
  const double rest = std::fmod(scaled, 0x1p64);
  const auto magnitude = static_cast<std::uint64_t>(std::fabs(rest));
  return rest < 0 ? 0 - magnitude : magnitude;
}

// Not horizontal, `from` above `to`.
struct Edge {
  SnappedPoint from;
  SnappedPoint to;

  EdgeWords words(std::int64_t line, int fraction_bits) const {
    const std::int64_t height = to.y - from.y;
    const std::int64_t width = to.x - from.x;
    const std::int64_t one = std::int64_t{1} << fraction_bits;
    EdgeWords words;
    words.divisor = height * one;
    words.step = floor_div(width, height);
    words.rest_step = (width - words.step * height) * one;
    const std::int64_t column = from.x * height + (line * one - from.y) * width;
    words.column = ceil_div(column, words.divisor);
    words.rest = words.column * words.divisor - column;
    return words;
  }
  template <class T>
  T slope() const {
    return geometry::from_integer<T>(to.x - from.x) / geometry::from_integer<T>(to.y - from.y);
  }
};

// Where registers start, about the form's origin, and how far they go sideways a line.
template <class T>
struct Start {
  T x;
  T y;
  T slope;
};

template <class T>
Start<T> start_of(const Edge& edge, const EdgeWords& words, std::int64_t line, const ColourTriangle& triangle,
                  const SpanFormat& format) {
  const T unit = T(1.0 / static_cast<double>(std::int64_t{1} << triangle.fraction_bits));
  const SnappedPoint& origin = triangle.corners[0];
  const std::int64_t one = std::int64_t{1} << triangle.fraction_bits;
  Start<T> start;
  start.y = geometry::from_integer<T>(line * one - origin.y) * unit;
  start.x = geometry::from_integer<T>(words.column * one - origin.x) * unit;
  geometry::charge_integer<T>(4, 0);
  if (format.start_edge == StartEdge::lattice) {
    start.slope = geometry::from_integer<T>(words.step);
  } else {
    start.x = start.x - geometry::from_integer<T>(words.rest) / geometry::from_integer<T>(words.divisor);
    start.slope = edge.slope<T>();
  }
  return start;
}

template <class T>
ColourWords colour_words(const QuadraticForm<double>& given, const Start<T>& at, unsigned fraction_bits) {
  const T t1(given.t1), t2(given.t2), t3(given.t3), t4(given.t4), t5(given.t5);
  const T a = at.slope;
  // By hand what QuadraticForm::at does, so that the sums are shared.
  const T gradient_x = t5 * at.x + t4 * at.y + t2;
  const T value = gradient_x * at.x + (t3 * at.y + t1) * at.y + T(given.t0);
  const T along_x = gradient_x + t5 * at.x;             // dI/dX
  const T along_y = t4 * at.x + (t3 + t3) * at.y + t1;  // dI/dY
  const T second = t5 * a * a + t4 * a + t3;
  ColourWords words;
  words.start = to_word(geometry::plain(value + T(0.5)), fraction_bits);
  words.pixel_step = to_word(geometry::plain(along_x + t5), fraction_bits);
  words.line_step = to_word(geometry::plain(along_x * a + along_y + second), fraction_bits);
  words.line_line = to_word(geometry::plain(second + second), fraction_bits);
  words.line_pixel = to_word(geometry::plain(t5 * a + t5 * a + t4), fraction_bits);
  words.pixel_pixel = to_word(geometry::plain(t5 + t5), fraction_bits);
  if constexpr (!std::is_arithmetic_v<T>) geometry::operation_counts.convert += 6;
  return words;
}

// The same where second differences are nothing.
template <class T>
ColourWords linear_words(const QuadraticForm<double>& given, const Start<T>& at, unsigned fraction_bits) {
  const T t1(given.t1), t2(given.t2);
  ColourWords words;
  words.start = to_word(geometry::plain(t2 * at.x + t1 * at.y + T(given.t0 + 0.5)), fraction_bits);
  words.pixel_step = to_word(given.t2, fraction_bits);
  words.line_step = to_word(geometry::plain(t2 * at.slope + t1), fraction_bits);
  if constexpr (!std::is_arithmetic_v<T>) geometry::operation_counts.convert += 3;
  return words;
}

bool is_linear(const ColourTriangle& triangle) {
  return std::all_of(triangle.colour.begin(), triangle.colour.end(),
                     [](const auto& form) { return form.t3 == 0.0 && form.t4 == 0.0 && form.t5 == 0.0; });
}

// Depth a pixel, along x and y.
template <class T>
struct Slopes {
  T x;
  T y;
};

template <class T>
Slopes<T> depth_slopes(const ColourTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const std::int64_t e1x = b.x - a.x, e1y = b.y - a.y, e2x = c.x - a.x, e2y = c.y - a.y;
  geometry::charge_integer<T>(5, 2);
  const T area = geometry::from_integer<T>(e1x * e2y - e2x * e1y);
  const T scale = T(static_cast<double>(std::int64_t{1} << triangle.fraction_bits)) / area;
  const T d1 = T(triangle.depth[1]) - T(triangle.depth[0]);
  const T d2 = T(triangle.depth[2]) - T(triangle.depth[0]);
  return {(d1 * geometry::from_integer<T>(e2y) - d2 * geometry::from_integer<T>(e1y)) * scale,
          (d2 * geometry::from_integer<T>(e1x) - d1 * geometry::from_integer<T>(e2x)) * scale};
}

template <class T>
void load_edge(const Edge& edge, std::int64_t line, int fraction_bits, HalfTriangle& half) {
  half.start = edge.words(line, fraction_bits);
  geometry::charge_integer<T>(8, 4);
}

template <class T>
void load_depth(const Start<T>& at, const ColourTriangle& triangle, const Slopes<T>& depth, const SpanFormat& format,
                StartEdgeRegisters& registers) {
  const auto word = [&](const T& value) { return to_word(geometry::plain(value), format.depth_fraction_bits); };
  put_words({word(depth.x * at.x + depth.y * at.y + T(triangle.depth[0])), word(depth.x * at.slope + depth.y),
             word(depth.x), 0, 0, 0},
            span_unit::kDepthSet, registers);
  if constexpr (!std::is_arithmetic_v<T>) geometry::operation_counts.convert += 3;
}

// One set after the other.
template <class T>
void load_registers(const Start<T>& at, const ColourTriangle& triangle, const Slopes<T>& depth,
                    const SpanFormat& format, bool linear, StartEdgeRegisters& registers) {
  for (std::size_t c = 0; c < span_unit::kChannels; ++c)
    put_words(linear ? linear_words<T>(triangle.colour[c], at, format.fraction_bits)
                     : colour_words<T>(triangle.colour[c], at, format.fraction_bits),
              c, registers);
  load_depth<T>(at, triangle, depth, format, registers);
}

// All sets at once: the same words.
void put_forms(const ColourTriangle& triangle, const Slopes<double>& depth, const SpanFormat& format,
               RegisterForms& forms) {
  for (std::size_t c = 0; c < span_unit::kChannels; ++c) {
    const QuadraticForm<double>& form = triangle.colour[c];
    forms.t0[c] = form.t0;
    forms.t1[c] = form.t1;
    forms.t2[c] = form.t2;
    forms.t3[c] = form.t3;
    forms.t4[c] = form.t4;
    forms.t5[c] = form.t5;
    forms.added[c] = 0.5;
    forms.scale[c] = static_cast<double>(std::uint64_t{1} << format.fraction_bits);
  }
  forms.t0[span_unit::kDepthSet] = triangle.depth[0];
  forms.t1[span_unit::kDepthSet] = depth.y;
  forms.t2[span_unit::kDepthSet] = depth.x;
  forms.t3[span_unit::kDepthSet] = forms.t4[span_unit::kDepthSet] = forms.t5[span_unit::kDepthSet] = 0.0;
  forms.added[span_unit::kDepthSet] = 0.0;
  forms.scale[span_unit::kDepthSet] = static_cast<double>(std::uint64_t{1} << format.depth_fraction_bits);
}

// Corners from the top down; where two are level, in any order.
std::array<SnappedPoint, 3> from_top(std::array<SnappedPoint, 3> corners) {
  if (corners[1].y < corners[0].y) std::swap(corners[0], corners[1]);
  if (corners[2].y < corners[1].y) std::swap(corners[1], corners[2]);
  if (corners[1].y < corners[0].y) std::swap(corners[0], corners[1]);
  return corners;
}

}  // namespace

span_unit::TriangleLoad span_load(const ColourTriangle& triangle, const SpanFormat& format) {
  span_unit::TriangleLoad load;
  put_span_load(triangle, format, load);
  return load;
}

namespace {

// Products need the signed number; sums go on without what has been lost.
bool slopes_wrap(const ColourTriangle& triangle, const Slopes<double>& depth, const SpanFormat& format) {
  const auto beyond = [](double value, unsigned fraction_bits, unsigned word_bits) {
    return !(std::fabs(value) < std::ldexp(0.5, static_cast<int>(word_bits - fraction_bits)));
  };
  if (beyond(depth.x, format.depth_fraction_bits, format.depth_bits + format.depth_fraction_bits)) return true;
  const double unit = 1.0 / static_cast<double>(std::int64_t{1} << triangle.fraction_bits);
  for (const QuadraticForm<double>& form : triangle.colour) {
    if (beyond(2 * form.t5, format.fraction_bits, format.word_bits)) return true;
    // dI is linear: its largest is at a corner.
    for (const geometry::SnappedPoint& corner : triangle.corners) {
      const double x = static_cast<double>(corner.x - triangle.corners[0].x) * unit;
      const double y = static_cast<double>(corner.y - triangle.corners[0].y) * unit;
      if (beyond(form.t2 + 2 * form.t5 * (x + 1) + form.t4 * y, format.fraction_bits, format.word_bits)) return true;
    }
  }
  return false;
}

}  // namespace

void put_span_load(const ColourTriangle& triangle, const SpanFormat& format, span_unit::TriangleLoad& load) {
  load.count = 0;
  load.object = triangle.object;
  load.shading = triangle.shading;
  load.material = triangle.material;
  const auto [top, middle, bottom] = from_top(triangle.corners);
  const int q = triangle.fraction_bits;
  const auto on_screen = [&](std::int64_t line) { return std::clamp<std::int64_t>(line, 0, format.lines); };
  const std::int64_t first = on_screen(first_sample(top.y, q));
  const std::int64_t second = on_screen(first_sample(middle.y, q));
  const std::int64_t end = on_screen(first_sample(bottom.y, q));
  if (first >= end) return;
  const Edge whole{top, bottom};
  // Twice the area, and where the middle corner lies of the long edge.
  const bool middle_left = (bottom.x - top.x) * (middle.y - top.y) - (middle.x - top.x) * (bottom.y - top.y) > 0;
  const bool linear = is_linear(triangle);
  const Slopes<double> depth = depth_slopes<double>(triangle);
  RegisterForms forms;
  if (!linear) put_forms(triangle, depth, format, forms);
  const RegisterKernels& kernels = register_kernels(format.variant);
  const auto load_start = [&](const Edge& edge, HalfTriangle& half) {
    load_edge<double>(edge, half.first_line, q, half);
    const Start<double> at = start_of<double>(edge, half.start, half.first_line, triangle, format);
    if (linear || !kernels.start(forms, at.x, at.y, at.slope, half.registers))
      load_registers<double>(at, triangle, depth, format, linear, half.registers);
  };
  load.second_goes_on = !middle_left;
  load.wraps = format.start_edge == StartEdge::prestep && slopes_wrap(triangle, depth, format);
  for (int lower = 0; lower < 2; ++lower) {
    HalfTriangle& half = load.halves[load.count];
    half.first_line = lower == 0 ? first : second;
    half.lines = (lower == 0 ? second : end) - half.first_line;
    if (half.lines <= 0) continue;
    const Edge edge = lower == 0 ? Edge{top, middle} : Edge{middle, bottom};
    const bool is_second = load.count == 1;
    if (middle_left || !is_second) load_start(middle_left ? edge : whole, half);
    if (!middle_left || !is_second) half.end = (middle_left ? whole : edge).words(half.first_line, q);
    ++load.count;
  }
}

namespace {

template <class Registers>
SpanLoadCosts costs_with(const Registers& load_set) {
  ColourTriangle triangle;
  triangle.corners = {SnappedPoint{0, 0}, SnappedPoint{0, 160}, SnappedPoint{160, 0}};
  triangle.fraction_bits = 4;
  const SpanFormat format;
  const Edge edge{{0, 0}, {0, 160}};
  SpanLoadCosts costs;
  geometry::OperationCounts before = geometry::operation_counts;
  geometry::charge_integer<Number>(12, 2);  // sorting, lines, the side of the middle corner
  const Slopes<Number> depth = depth_slopes<Number>(triangle);
  costs.triangle = geometry::operation_counts - before;
  before = geometry::operation_counts;
  HalfTriangle half;
  load_edge<Number>(edge, 0, triangle.fraction_bits, half);
  load_set(start_of<Number>(edge, half.start, 0, triangle, format), triangle, depth, format, half.registers);
  geometry::charge_integer<Number>(8, 4);  // the end edge
  costs.start = geometry::operation_counts - before;
  before = geometry::operation_counts;
  geometry::charge_integer<Number>(8, 4);
  costs.goes_on = geometry::operation_counts - before;
  return costs;
}

}  // namespace

SpanLoadCosts span_load_costs(bool linear) {
  return costs_with([linear](const Start<Number>& at, const ColourTriangle& triangle, const Slopes<Number>& depth,
                             const SpanFormat& format, StartEdgeRegisters& registers) {
    load_registers<Number>(at, triangle, depth, format, linear, registers);
  });
}

SpanLoadCosts depth_load_costs() {
  return costs_with([](const Start<Number>& at, const ColourTriangle& triangle, const Slopes<Number>& depth,
                       const SpanFormat& format,
                       StartEdgeRegisters& registers) { load_depth<Number>(at, triangle, depth, format, registers); });
}

geometry::OperationCounts cost_of(const span_unit::TriangleLoad& load, const SpanLoadCosts& costs) {
  geometry::OperationCounts counts = costs.triangle;
  if (load.count > 0) counts += costs.start;
  if (load.count == 2) counts += load.second_goes_on ? costs.goes_on : costs.start;
  return counts;
}

}  // namespace rastertlm::set_up
