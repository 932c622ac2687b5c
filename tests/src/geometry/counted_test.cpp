// Does a counted number compute as the plain one, and does it count what is written in the formulas?
#include "src/geometry/counted.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "src/geometry/frame_grid.h"
#include "src/geometry/lighting.h"

namespace rastertlm::geometry {
namespace {

using Number = Counted<double>;

template <class Work>
OperationCounts counted(Work&& work) {
  const OperationCounts before = operation_counts;
  work();
  return operation_counts - before;
}

OperationCounts counts(std::uint64_t add, std::uint64_t multiply, std::uint64_t divide = 0,
                       std::uint64_t square_root = 0, std::uint64_t compare = 0, std::uint64_t convert = 0) {
  OperationCounts c;
  c.add = add;
  c.multiply = multiply;
  c.divide = divide;
  c.square_root = square_root;
  c.compare = compare;
  c.convert = convert;
  return c;
}

const glm::dmat4 kMatrix = glm::perspectiveRH_ZO(0.5, 1.25, 1.0, 100.0);

TEST(Counted, EveryOperationCountsAsOne) {
  Number a = 3.0;
  const Number b = 4.0;
  EXPECT_EQ(counted([&] { a = a + b - b; }), counts(2, 0));
  EXPECT_EQ(counted([&] {
              a += b;
              a -= b;
            }),
            counts(2, 0));
  EXPECT_EQ(counted([&] { a = a * b / b; }), counts(0, 1, 1));
  EXPECT_EQ(counted([&] { a = -a; }), counts(0, 0));
  EXPECT_EQ(counted([&] { a = square_root(b); }), counts(0, 0, 0, 1));
  EXPECT_EQ(counted([&] { return a < b || a == b; }), counts(0, 0, 0, 0, a.value() < 4.0 ? 1 : 2));
  EXPECT_EQ(counted([&] { return to_integer(b); }), counts(0, 0, 0, 0, 0, 1));
  EXPECT_EQ(counted([&] { a = from_integer<Number>(7); }), counts(0, 0, 0, 0, 0, 1));
  EXPECT_EQ(a.value(), 7.0);
  EXPECT_EQ(counted([&] { charge_integer<Number>(3, 2); }).integer, 3U);
  EXPECT_EQ(counted([&] { charge_integer<double>(3, 2); }), OperationCounts{});
  EXPECT_EQ(counts(1, 2, 3, 4, 5, 6).flops(), 21U);
}

TEST(Counted, TheFormulasCostWhatTheySay) {
  // Four rows of three products and three sums.
  EXPECT_EQ(counted([] { transform_point<Number>(kMatrix, {1, 2, 3}); }), counts(12, 12));
  // Three rows of three products and two sums.
  EXPECT_EQ(counted([] { transform_normal<Number>(glm::dmat3(1.0), {1, 2, 3}); }), counts(6, 9));
  // 1/w; x and y: times 1/w, times half the screen, plus its middle; z times 1/w.
  ClipVertex<Number> vertex;
  vertex.position = {1.0, 2.0, 3.0, 4.0};
  vertex.normal = {0.0, 0.0, 1.0};
  EXPECT_EQ(counted([&] { to_screen(vertex, {512, 512}); }), counts(2, 5, 1));
  EXPECT_EQ(counted([&] { snap(to_screen(vertex, {512, 512}), 5); }), counts(2, 7, 1, 0, 0, 2));
  // N.N, N.N > 0, square root, reciprocal, three products.
  EXPECT_EQ(counted([&] { normalised(vertex.normal); }), counts(2, 6, 1, 1, 1));
  // x^4: two squares and one product with the result; x^5: one product more.
  EXPECT_EQ(counted([] { integer_power(Number(0.5), 4); }), counts(0, 3));
  EXPECT_EQ(counted([] { integer_power(Number(0.5), 5); }), counts(0, 4));
  // Near plane: distances are z itself; da - db, da / (..), then seven components of one difference, product and sum
  // each.
  ClipVertex<Number> other = vertex;
  other.position.z = -1.0;
  EXPECT_EQ(counted([&] { intersection(vertex, other, 0, ClipVolume{}); }), counts(15, 7, 1));
}

template <class T>
std::vector<double> flattened(const Polygon<T>& polygon) {
  std::vector<double> values;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    for (int k = 0; k < 4; ++k) values.push_back(plain(polygon.corners[i].position[k]));
    for (int k = 0; k < 3; ++k) values.push_back(plain(polygon.corners[i].normal[k]));
  }
  return values;
}

template <class T>
std::vector<double> pipeline(const std::array<glm::dvec3, 3>& points) {
  ClipTriangle<T> triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle[i].position = transform_point<T>(kMatrix, points[i]);
    triangle[i].normal = normalised(transform_normal<T>(glm::dmat3(1.0), points[i]));
  }
  const Viewport viewport{512, 384};
  const SnapGrids grids = snap_grids(512, 384, 24, -1).value();
  const bool guarded = needs_guard_band(triangle, grids.on_screen, viewport);
  const Polygon<T> polygon = clip_to_frame(triangle, frame_grid(grids, guarded, viewport));
  std::vector<double> values = flattened(polygon);
  values.push_back(guarded ? 1.0 : 0.0);
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const ScreenVertex<T> screen = to_screen(polygon.corners[i], viewport);
    const SnappedPoint point = snap(screen, grids.guarded.fraction_bits);
    for (const double v : {plain(screen.x), plain(screen.y), plain(screen.z), static_cast<double>(point.x),
                           static_cast<double>(point.y)})
      values.push_back(v);
  }
  const std::vector<LightSource> lights{{false, {0.6, 0, 0.8}, glm::dvec3(1.0), glm::dvec3(1.0)},
                                        {true, {1, 2, 3}, glm::dvec3(0.5), glm::dvec3(0.5)}};
  for (const Model model : {Model::blinn, Model::phong}) {
    const Vector3<T> light = illumination<T>({glm::dvec3(0.1), glm::dvec3(0.5), glm::dvec3(0.4), 20}, lights,
                                             {model, false, glm::dvec3(1.0)}, triangle[0].normal,
                                             {T(0.0), T(0.0), T(1.0)}, triangle[1].normal);
    for (int c = 0; c < 3; ++c) values.push_back(plain(light[c]));
  }
  return values;
}

double coordinate() { return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(-1000, 1001)) / 256.0; }

RC_GTEST_PROP(CountedProperty, ComputesWhatTheNumberComputes, ()) {
  std::array<glm::dvec3, 3> points;
  for (glm::dvec3& p : points) p = {coordinate(), coordinate(), -6.0 + 1.6 * coordinate()};
  const OperationCounts before = operation_counts;
  const std::vector<double> wanted = pipeline<double>(points);
  RC_ASSERT(operation_counts == before);
  RC_ASSERT(pipeline<Number>(points) == wanted);
  RC_ASSERT((operation_counts - before).flops() > 0U);
}

}  // namespace
}  // namespace rastertlm::geometry
