#include "modules/set_up/triangle_colourer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/fixed_point.h"

namespace rastertlm::set_up {
namespace {

using geometry::SnappedPoint;
using Number = geometry::Counted<double>;

constexpr std::size_t kMiddle12 = 3, kMiddle13 = 4, kMiddle23 = 5;
constexpr std::int64_t kLowestShare = 64;  // a triangle lower than 1/64 pixel has no slopes

template <class T>
std::array<QuadraticForm<double>, 3> solve_in(Solver solver, const Offsets<double>& at,
                                              const std::array<SixColours<double>, 3>& colours) {
  std::array<SixColours<T>, 3> given;
  for (std::size_t c = 0; c < 3; ++c) {
    const SixColours<double>& from = colours[c];
    given[c] = {T(static_cast<T>(from.i1)),  T(static_cast<T>(from.i2)),  T(static_cast<T>(from.i3)),
                T(static_cast<T>(from.i12)), T(static_cast<T>(from.i13)), T(static_cast<T>(from.i23))};
  }
  const auto forms = solve<T>(
      solver, Offsets<T>{static_cast<T>(at.x2), static_cast<T>(at.y2), static_cast<T>(at.x3), static_cast<T>(at.y3)},
      given);
  std::array<QuadraticForm<double>, 3> result;
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = {as_double(forms[c].t0), as_double(forms[c].t1), as_double(forms[c].t2),
                 as_double(forms[c].t3), as_double(forms[c].t4), as_double(forms[c].t5)};
  return result;
}

std::array<QuadraticForm<double>, 3> solve_as(const SetUpParameters& parameters, const Offsets<double>& at,
                                              const std::array<SixColours<double>, 3>& colours) {
  const Solver solver = parameters.solver;
  if (parameters.arithmetic == SetUpArithmetic::double_precision) return solve_in<double>(solver, at, colours);
  if (parameters.arithmetic == SetUpArithmetic::single_precision) return solve_in<float>(solver, at, colours);
  switch (parameters.fixed_fraction_bits) {
    case 16:
      return solve_in<FixedNumber<16>>(solver, at, colours);
    case 24:
      return solve_in<FixedNumber<24>>(solver, at, colours);
    case 32:
      return solve_in<FixedNumber<32>>(solver, at, colours);
    case 40:
      return solve_in<FixedNumber<40>>(solver, at, colours);
    default:
      return solve_in<FixedNumber<48>>(solver, at, colours);
  }
}

geometry::OperationCounts cost_of_solving(const SetUpParameters& parameters) {
  const geometry::OperationCounts before = geometry::operation_counts;
  const Offsets<Number> at{3.0, 1.0, -2.0, 5.0};
  if (parameters.method == ShadingMethod::gouraud) {
    const BarycentricSolver<Number> shared(at.x2, at.y2, at.x3, at.y3);
    for (int c = 0; c < 3; ++c) shared.solve_linear(1.0, 2.0, 3.0);
  } else {
    solve<Number, 3>(parameters.solver, at, {});
  }
  return geometry::operation_counts - before;
}

std::int64_t doubled_area(const std::array<SnappedPoint, 3>& c) { return geometry::doubled_area(c[0], c[1], c[2]); }

}  // namespace

ColourCounts& ColourCounts::operator+=(const ColourCounts& other) {
  drawn += other.drawn;
  back_faces += other.back_faces;
  degenerate += other.degenerate;
  flat_low += other.flat_low;
  flat_undefined += other.flat_undefined;
  splits += other.splits;
  at_limit += other.at_limit;
  tests += other.tests;
  return *this;
}

TriangleColourer::TriangleColourer(const SetUpParameters& parameters, PointLighting& lighting)
    : parameters_(parameters), lighting_(lighting), solve_cost_(cost_of_solving(parameters)) {
  facing_cost_.integer = 6;
  facing_cost_.integer_multiply = 2;
  test_cost_.multiply = 15;  // the form at a point, three channels
  test_cost_.add = 15 + 3;
  test_cost_.compare = 3;
}

geometry::OperationCounts TriangleColourer::operations() const {
  geometry::OperationCounts all = operations_;
  all += lighting_.operations();
  return all;
}

TriangleColourer::Knot TriangleColourer::knot_of(const LitPoint& point, std::uint32_t material) {
  return {point, lighting_.levels(point, material)};
}

TriangleColourer::Knot TriangleColourer::between(const Knot& a, const Knot& b, std::uint32_t material) {
  return knot_of(lighting_.middle(a.point, b.point), material);
}

void TriangleColourer::colour(const ColourRequest& request, std::vector<ColourTriangle>& out) {
  operations_ += facing_cost_;
  std::array<SnappedPoint, 3> at;
  for (std::size_t i = 0; i < 3; ++i) at[i] = request.corners[i].at;
  const std::int64_t area = doubled_area(at);
  if (area == 0) {
    ++counts_.degenerate;
    return;
  }
  const bool turned = !geometry::faces_viewer(area);
  if (turned && !request.two_sided) {
    ++counts_.back_faces;
    return;
  }
  Knots knots;
  for (std::size_t i = 0; i < 3; ++i) {
    LitPoint point = request.corners[i];
    if (turned) point.normal = -point.normal;
    knots.knot[i] = knot_of(point, request.material);
  }
  ColourTriangle triangle;
  triangle.fraction_bits = parameters_.corner_bits();
  triangle.object = request.object;
  triangle.material = request.material;
  triangle.depth = request.depth;
  if (parameters_.method != ShadingMethod::gouraud) {
    knots.knot[kMiddle12] = between(knots.knot[0], knots.knot[1], request.material);
    knots.knot[kMiddle13] = between(knots.knot[0], knots.knot[2], request.material);
    knots.knot[kMiddle23] = between(knots.knot[1], knots.knot[2], request.material);
  }
  split_or_draw(knots, 0, request, triangle, out);
}

SnappedPoint TriangleColourer::child_corner(const SnappedPoint& exact) const {
  if (parameters_.child_coverage == ChildCoverage::parent) return exact;
  const int bits = parameters_.corner_bits() - static_cast<int>(parameters_.snap_bits);
  const auto moved = [bits](std::int64_t v) { return ((v + (std::int64_t{1} << bits) / 2) >> bits) << bits; };
  return {moved(exact.x), moved(exact.y)};
}

// The triangle's own coefficients; where they are too far off, those of its four children instead, which share the
// knots on their common edges.
void TriangleColourer::split_or_draw(const Knots& knots, int level, const ColourRequest& request,
                                     ColourTriangle triangle, std::vector<ColourTriangle>& out) {
  for (std::size_t i = 0; i < 3; ++i) triangle.corners[i] = knots.knot[i].point.at;
  if (doubled_area(triangle.corners) == 0) {
    ++counts_.degenerate;
    return;
  }
  if (is_low(triangle)) {
    ++counts_.flat_low;
    draw_flat(knots, triangle);
  } else if (parameters_.method == ShadingMethod::gouraud) {
    solve_linear(knots, triangle);
  } else {
    solve_quadratic(knots, triangle);
    if (parameters_.method == ShadingMethod::quadratic_adaptive && is_off(knots, triangle, request.material)) {
      if (level < parameters_.test_depth_limit) {
        ++counts_.splits;
        const auto middle_depth = [&](std::size_t a, std::size_t b) {
          return (triangle.depth[a] + triangle.depth[b]) * 0.5;
        };
        Knots with = knots;
        for (const std::size_t k : {kMiddle12, kMiddle13, kMiddle23})
          with.knot[k].point.at = child_corner(with.knot[k].point.at);
        const auto& [k1, k2, k3, k12, k13, k23] = with.knot;
        const std::uint32_t m = request.material;
        const Knot inner_1 = between(k12, k13, m), inner_2 = between(k12, k23, m), inner_3 = between(k13, k23, m);
        const double d12 = middle_depth(0, 1), d13 = middle_depth(0, 2), d23 = middle_depth(1, 2);
        const auto child = [&](const Knots& of_child, const std::array<double, 3>& depth) {
          ColourTriangle next = triangle;
          next.depth = depth;
          split_or_draw(of_child, level + 1, request, next, out);
        };
        child({{k1, k12, k13, between(k1, k12, m), between(k1, k13, m), inner_1}}, {triangle.depth[0], d12, d13});
        child({{k12, k2, k23, between(k12, k2, m), inner_2, between(k2, k23, m)}}, {d12, triangle.depth[1], d23});
        child({{k13, k23, k3, inner_3, between(k13, k3, m), between(k23, k3, m)}}, {d13, d23, triangle.depth[2]});
        child({{k12, k23, k13, inner_2, inner_1, inner_3}}, {d12, d23, d13});
        return;
      }
      ++counts_.at_limit;
    }
  }
  ++counts_.drawn;
  out.push_back(triangle);
}

bool TriangleColourer::is_off(const Knots& knots, const ColourTriangle& triangle, std::uint32_t material) {
  constexpr double kThird = 1.0 / 3.0, kMost = 2.0 / 3.0, kLeast = 1.0 / 6.0;
  if (is_off_at(knots, triangle, material, {kThird, kThird, kThird})) return true;
  if (parameters_.test_points == TestPoints::centroid) return false;
  return is_off_at(knots, triangle, material, {kMost, kLeast, kLeast}) ||
         is_off_at(knots, triangle, material, {kLeast, kMost, kLeast}) ||
         is_off_at(knots, triangle, material, {kLeast, kLeast, kMost});
}

bool TriangleColourer::is_off_at(const Knots& knots, const ColourTriangle& triangle, std::uint32_t material,
                                 const std::array<double, 3>& weights) {
  ++counts_.tests;
  operations_ += test_cost_;
  const LitPoint point = lighting_.inside({&knots.knot[0].point, &knots.knot[1].point, &knots.knot[2].point}, weights);
  const Levels levels = lighting_.levels(point, material);
  const double unit = std::ldexp(1.0, -triangle.fraction_bits);
  double x = 0.0;
  double y = 0.0;
  for (std::size_t i = 1; i < 3; ++i) {
    x += weights[i] * static_cast<double>(triangle.corners[i].x - triangle.corners[0].x) * unit;
    y += weights[i] * static_cast<double>(triangle.corners[i].y - triangle.corners[0].y) * unit;
  }
  for (int c = 0; c < 3; ++c)
    if (std::fabs(triangle.colour[static_cast<std::size_t>(c)].at(x, y) - levels[c]) >
        parameters_.test_threshold_levels)
      return true;
  return false;
}

bool TriangleColourer::is_low(const ColourTriangle& triangle) const {
  const auto [top, bottom] = std::minmax({triangle.corners[0].y, triangle.corners[1].y, triangle.corners[2].y});
  return (bottom - top) * kLowestShare < std::int64_t{1} << triangle.fraction_bits;
}

void TriangleColourer::draw_flat(const Knots& knots, ColourTriangle& triangle) const {
  const Levels mean = (knots.knot[0].levels + knots.knot[1].levels + knots.knot[2].levels) * (1.0 / 3.0);
  for (int c = 0; c < 3; ++c) {
    QuadraticForm<double> form;
    form.t0 = mean[c];
    triangle.colour[static_cast<std::size_t>(c)] = form;
  }
}

namespace {

Offsets<double> offsets_of(const ColourTriangle& triangle) {
  const double unit = std::ldexp(1.0, -triangle.fraction_bits);
  const auto& [a, b, c] = triangle.corners;
  const auto pixels = [unit](std::int64_t steps) { return static_cast<double>(steps) * unit; };
  return {pixels(b.x - a.x), pixels(b.y - a.y), pixels(c.x - a.x), pixels(c.y - a.y)};
}

}  // namespace

void TriangleColourer::solve_linear(const Knots& knots, ColourTriangle& triangle) {
  operations_ += solve_cost_;
  const Offsets<double> at = offsets_of(triangle);
  const BarycentricSolver<double> shared(at.x2, at.y2, at.x3, at.y3);
  for (int c = 0; c < 3; ++c)
    triangle.colour[static_cast<std::size_t>(c)] =
        shared.solve_linear(knots.knot[0].levels[c], knots.knot[1].levels[c], knots.knot[2].levels[c]);
}

void TriangleColourer::solve_quadratic(const Knots& knots, ColourTriangle& triangle) {
  operations_ += solve_cost_;
  std::array<SixColours<double>, 3> colours;
  for (int c = 0; c < 3; ++c) {
    const auto level = [&](std::size_t i) { return knots.knot[i].levels[c]; };
    colours[static_cast<std::size_t>(c)] = {level(0),         level(1),         level(2),
                                            level(kMiddle12), level(kMiddle13), level(kMiddle23)};
  }
  triangle.colour = solve_as(parameters_, offsets_of(triangle), colours);
  if (std::all_of(triangle.colour.begin(), triangle.colour.end(), is_defined<double>)) return;
  ++counts_.flat_undefined;
  draw_flat(knots, triangle);
}

}  // namespace rastertlm::set_up
