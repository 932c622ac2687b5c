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
  if (parameters.linear()) {
    const LinearSolver<Number> shared(at.x2, at.y2, at.x3, at.y3);
    for (int c = 0; c < 3; ++c) shared.solve(1.0, 2.0, 3.0);
  } else {
    solve<Number, 3>(parameters.solver, at, {});
  }
  geometry::OperationCounts cost = geometry::operation_counts - before;
  if (parameters.arithmetic == SetUpArithmetic::fixed && !parameters.linear()) {
    // In integers; a division stays one.
    cost.integer += std::exchange(cost.add, 0) + std::exchange(cost.compare, 0);
    cost.integer_multiply += std::exchange(cost.multiply, 0);
  }
  return cost;
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
    : parameters_(parameters),
      lighting_(lighting),
      subdivision_(parameters, lighting),
      midpoints_(parameters.halvings, lighting),
      stitching_(lighting),
      solve_cost_(cost_of_solving(parameters)) {
  facing_cost_.integer = 6;
  facing_cost_.integer_multiply = 2;
  test_cost_.multiply = 15 + 4;  // the form at a point, three channels; where that is
  test_cost_.add = 15 + 3 + 2;
  test_cost_.compare = 3;
}

geometry::OperationCounts TriangleColourer::operations() const {
  geometry::OperationCounts all = operations_;
  all += lighting_.operations();
  all += subdivision_.operations();
  all += midpoints_.operations();
  all += stitching_.operations();
  return all;
}

TriangleColourer::Knot TriangleColourer::knot_of(const LitPoint& point, std::uint32_t material) {
  return {point, lighting_.levels(point, material)};
}

TriangleColourer::Knot TriangleColourer::between(const Knot& a, const Knot& b, std::uint32_t material) {
  return knot_of(lighting_.middle(a.point, b.point), material);
}

void TriangleColourer::begin_frame() {
  cuts_.clear();
  stitching_.begin_frame();
}

// Not counted here: it is coloured later.
void TriangleColourer::cut(const ColourRequest& request) {
  const ColourCounts before = counts_;
  bool turned = false;
  const bool dropped = is_dropped(request, turned);
  counts_ = before;
  if (dropped) return;
  stitching_.note(cuts_[request.object].emplace_back(cut_up(request, turned)));
}

bool TriangleColourer::is_dropped(const ColourRequest& request, bool& turned) {
  operations_ += facing_cost_;
  const std::int64_t area = geometry::doubled_area(request.corners[0].at, request.corners[1].at, request.corners[2].at);
  if (area == 0) {
    ++counts_.degenerate;
    return true;
  }
  turned = !geometry::faces_viewer(area);
  if (!turned || request.two_sided) return false;
  ++counts_.back_faces;
  return true;
}

void TriangleColourer::colour(const ColourRequest& request, std::vector<ColourTriangle>& out) {
  bool turned = false;
  if (is_dropped(request, turned)) return;
  if (request.by_pixels) {
    begin_triangle(request, request.depth, out);
    for (std::size_t i = 0; i < 3; ++i) out.back().corners[i] = request.corners[i].at;
    ++counts_.drawn;
    return;
  }
  if (parameters_.stitches()) return draw_stitched(request, turned, out);
  const bool cut = parameters_.subdivides() ? request.highlighted : parameters_.method == ShadingMethod::pseudo_phong;
  if (cut) return draw_parts(request, cut_up(request, turned).parts, out);
  light_knots(request, turned, knots_);
  begin_triangle(request, request.depth, out);
  split_or_draw(knots_, 0, out);
}

// Pieces of a triangle are told apart by their corners.
CutTriangle* TriangleColourer::find_cut(const ColourRequest& request) {
  const auto of_triangle = cuts_.find(request.object);
  if (of_triangle == cuts_.end()) return nullptr;
  for (CutTriangle& piece : of_triangle->second) {
    bool same = true;
    for (std::size_t i = 0; i < 3; ++i) same = same && piece.whole[i].point.at == request.corners[i].at;
    if (same) return &piece;
  }
  return nullptr;
}

void TriangleColourer::draw_stitched(const ColourRequest& request, bool turned, std::vector<ColourTriangle>& out) {
  CutTriangle whole;
  CutTriangle* cut = find_cut(request);
  if (cut == nullptr) {
    whole = lit_whole(request, turned);
    whole.parts.push_back(whole.whole);
    cut = &whole;
  }
  stitching_.stitch(*cut);
  draw_parts(request, cut->parts, out);
}

void TriangleColourer::begin_triangle(const ColourRequest& request, const std::array<double, 3>& depth,
                                      std::vector<ColourTriangle>& out) const {
  ColourTriangle& triangle = out.emplace_back();
  triangle.fraction_bits = parameters_.corner_bits();
  triangle.object = request.object;
  triangle.material = request.material;
  triangle.depth = depth;
}

// Of which nothing is cut yet.
CutTriangle TriangleColourer::lit_whole(const ColourRequest& request, bool turned) {
  light_knots(request, turned, knots_);
  CutTriangle cut;
  cut.material = request.material;
  for (std::size_t i = 0; i < 3; ++i) cut.whole[i] = {knots_.point[i], knots_.levels[i], request.depth[i]};
  return cut;
}

CutTriangle TriangleColourer::cut_up(const ColourRequest& request, bool turned) {
  CutTriangle cut = lit_whole(request, turned);
  if (parameters_.method == ShadingMethod::pseudo_phong) {
    midpoints_.cut(cut.whole, request.material, cut.parts);
    counts_.splits += (cut.parts.size() - 1) / 3;
  } else if (parameters_.method == ShadingMethod::regular_subdivision) {
    subdivision_.regular(cut.whole, request.material, cut.parts);
  } else {
    subdivision_.highlight(cut.whole, request.material, cut.parts);
  }
  return cut;
}

void TriangleColourer::draw_parts(const ColourRequest& request, const std::vector<LitTriangle>& parts,
                                  std::vector<ColourTriangle>& out) {
  Knots of_part;
  for (const LitTriangle& part : parts) {
    for (std::size_t i = 0; i < 3; ++i) {
      of_part.point[i] = part[i].point;
      of_part.levels[i] = part[i].levels;
    }
    begin_triangle(request, {part[0].depth, part[1].depth, part[2].depth}, out);
    split_or_draw(of_part, 0, out);
  }
}

void TriangleColourer::light_knots(const ColourRequest& request, bool turned, Knots& knots) {
  auto& points = knots.point;
  for (std::size_t i = 0; i < 3; ++i) points[i] = request.corners[i];
  if (turned)
    for (std::size_t i = 0; i < 3; ++i) points[i].normal = -points[i].normal;
  const bool linear = parameters_.linear();
  if (request.lit != nullptr && linear && !turned) {
    std::copy(request.lit->begin(), request.lit->end(), knots.levels.begin());
    return;
  }
  if (!linear) {
    points[kMiddle12] = lighting_.middle(points[0], points[1]);
    points[kMiddle13] = lighting_.middle(points[0], points[2]);
    points[kMiddle23] = lighting_.middle(points[1], points[2]);
  }
  lighting_.levels({points.data(), linear ? 3 : kKnots}, request.material, knots.levels);
}

TriangleColourer::Knots TriangleColourer::together(const std::array<Knot, kKnots>& knots) {
  Knots all;
  for (std::size_t i = 0; i < kKnots; ++i) {
    all.point[i] = knots[i].point;
    all.levels[i] = knots[i].levels;
  }
  return all;
}

SnappedPoint TriangleColourer::child_corner(const SnappedPoint& exact) const {
  if (parameters_.child_coverage == ChildCoverage::parent) return exact;
  const int bits = parameters_.corner_bits() - static_cast<int>(parameters_.snap_bits);
  const auto moved = [bits](std::int64_t v) { return ((v + (std::int64_t{1} << bits) / 2) >> bits) << bits; };
  return {moved(exact.x), moved(exact.y)};
}

// The triangle's own coefficients; where they are too far off, those of its four children instead.
void TriangleColourer::split_or_draw(const Knots& knots, int level, std::vector<ColourTriangle>& out) {
  ColourTriangle& triangle = out.back();
  for (std::size_t i = 0; i < 3; ++i) triangle.corners[i] = knots.point[i].at;
  if (doubled_area(triangle.corners) == 0) {
    ++counts_.degenerate;
    out.pop_back();
    return;
  }
  if (is_low(triangle)) {
    ++counts_.flat_low;
    draw_flat(knots, triangle);
  } else if (parameters_.linear()) {
    solve_linear(knots, triangle);
  } else {
    solve_quadratic(knots, triangle);
    if (parameters_.method == ShadingMethod::quadratic_adaptive && is_to_split(knots, triangle)) {
      if (level < parameters_.test_depth_limit) return split(knots, level, out);
      ++counts_.at_limit;
    }
  }
  ++counts_.drawn;
}

// Children share the knots on their common edges.
void TriangleColourer::split(const Knots& knots, int level, std::vector<ColourTriangle>& out) {
  ++counts_.splits;
  const ColourTriangle parent = out.back();
  out.pop_back();
  Knots with = knots;
  for (const std::size_t k : {kMiddle12, kMiddle13, kMiddle23}) with.point[k].at = child_corner(with.point[k].at);
  const std::uint32_t m = parent.material;
  const Knot k1 = with.knot(0), k2 = with.knot(1), k3 = with.knot(2);
  const Knot k12 = with.knot(kMiddle12), k13 = with.knot(kMiddle13), k23 = with.knot(kMiddle23);
  const Knot inner_1 = between(k12, k13, m), inner_2 = between(k12, k23, m), inner_3 = between(k13, k23, m);
  const auto& [d1, d2, d3] = parent.depth;
  const double d12 = (d1 + d2) * 0.5, d13 = (d1 + d3) * 0.5, d23 = (d2 + d3) * 0.5;
  const auto child = [&](const std::array<Knot, kKnots>& of_child, const std::array<double, 3>& depth) {
    out.push_back(parent);
    out.back().depth = depth;
    split_or_draw(together(of_child), level + 1, out);
  };
  child({k1, k12, k13, between(k1, k12, m), between(k1, k13, m), inner_1}, {d1, d12, d13});
  child({k12, k2, k23, between(k12, k2, m), inner_2, between(k2, k23, m)}, {d12, d2, d23});
  child({k13, k23, k3, inner_3, between(k13, k3, m), between(k23, k3, m)}, {d13, d23, d3});
  child({k12, k23, k13, inner_2, inner_1, inner_3}, {d12, d23, d13});
}

bool TriangleColourer::is_to_split(const Knots& knots, const ColourTriangle& triangle) {
  if (parameters_.test_points == TestPoints::h1h2) return may_hold_highlight(knots, triangle.material);
  return is_off(knots, triangle, triangle.material);
}

// No light is evaluated for it. Corners, lights and viewer are in eye space.
bool TriangleColourer::may_hold_highlight(const Knots& knots, std::uint32_t material) {
  if (!lighting_.shines(material)) return false;
  const geometry::OperationCounts before = geometry::operation_counts;
  const bool at_eye = lighting_.viewer_at_eye();
  bool may_be = false;
  for (const geometry::LightSource& light : lighting_.lights()) {
    const HighlightSource source{light.at_point, light.vector, at_eye,
                                 at_eye ? glm::dvec3(0.0) : glm::dvec3(0.0, 0.0, 1.0)};
    std::array<std::uint8_t, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i) {
      const SurfacePoint<Number> corner = surface_point(knots.point[i]);
      sides[i] = highlight_sides<Number>(source, corner.position, corner.normal);
    }
    operations_.integer += 3;
    may_be = may_be_highlighted(sides[0], sides[1], sides[2]);
    if (may_be) break;
  }
  operations_ += geometry::operation_counts - before;
  return may_be;
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
  const LitPoint point = lighting_.inside({&knots.point[0], &knots.point[1], &knots.point[2]}, weights);
  const Levels levels = lighting_.levels(point, material);
  const double unit = 1.0 / static_cast<double>(std::int64_t{1} << triangle.fraction_bits);
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
  const Levels mean = (knots.levels[0] + knots.levels[1] + knots.levels[2]) * (1.0 / 3.0);
  for (int c = 0; c < 3; ++c) {
    QuadraticForm<double> form;
    form.t0 = mean[c];
    triangle.colour[static_cast<std::size_t>(c)] = form;
  }
}

namespace {

Offsets<double> offsets_of(const ColourTriangle& triangle) {
  const double unit = 1.0 / static_cast<double>(std::int64_t{1} << triangle.fraction_bits);
  const auto& [a, b, c] = triangle.corners;
  const auto pixels = [unit](std::int64_t steps) { return static_cast<double>(steps) * unit; };
  return {pixels(b.x - a.x), pixels(b.y - a.y), pixels(c.x - a.x), pixels(c.y - a.y)};
}

}  // namespace

void TriangleColourer::solve_linear(const Knots& knots, ColourTriangle& triangle) {
  operations_ += solve_cost_;
  const Offsets<double> at = offsets_of(triangle);
  const LinearSolver<double> shared(at.x2, at.y2, at.x3, at.y3);
  for (int c = 0; c < 3; ++c)
    triangle.colour[static_cast<std::size_t>(c)] =
        shared.solve(knots.levels[0][c], knots.levels[1][c], knots.levels[2][c]);
}

void TriangleColourer::solve_quadratic(const Knots& knots, ColourTriangle& triangle) {
  operations_ += solve_cost_;
  std::array<SixColours<double>, 3> colours;
  for (int c = 0; c < 3; ++c) {
    const auto level = [&](std::size_t i) { return knots.levels[i][c]; };
    colours[static_cast<std::size_t>(c)] = {level(0),         level(1),         level(2),
                                            level(kMiddle12), level(kMiddle13), level(kMiddle23)};
  }
  if (parameters_.arithmetic == SetUpArithmetic::double_precision)
    solve(parameters_.solver, offsets_of(triangle), colours, triangle.colour);
  else
    triangle.colour = solve_as(parameters_, offsets_of(triangle), colours);
  if (std::all_of(triangle.colour.begin(), triangle.colour.end(), is_defined<double>)) return;
  ++counts_.flat_undefined;
  draw_flat(knots, triangle);
}

}  // namespace rastertlm::set_up
