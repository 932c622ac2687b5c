#include "src/analysis/random_solids.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "src/geometry/quadric.h"

namespace rastertlm::analysis {
namespace {

constexpr double kDistance = 6.0, kWidth = 8.0, kNear = 1.0, kFar = 20.0;

struct Shape {
  glm::dvec4 diagonal;  // of x^2, y^2, z^2, 1
  double z_linear;      // 2 of them in the matrix
  bool capped;          // between z = -1 and z = 1
};
constexpr std::size_t kRound = 3;  // from here on about the z axis, with ends
const std::array<Shape, 8> kShapes{{
    {{1, 1, 1, -1}, 0, false},    // sphere
    {{1, 4, 9, -1}, 0, false},    // ellipsoid
    {{1, 2, 1, -2}, 0, true},     // the same, cut
    {{1, 1, 0, -1}, 0, true},     // cylinder
    {{1, 1, -1, 0}, 0, true},     // cone
    {{1, 1, 0, -1}, 0.5, true},   // paraboloid
    {{1, 1, -1, -0.2}, 0, true},  // hyperboloid of one sheet
    {{1, 1, -1, 0.2}, 0, true},   // of two
}};
constexpr std::size_t kOneSheet = 6;

double between_powers(double low, double high, Numbers& numbers) {
  return std::exp2(numbers.uniform(std::log2(low), std::log2(high)));
}

glm::dvec3 any_direction(Numbers& numbers) {
  const double z = numbers.uniform(-1, 1), angle = numbers.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

glm::dmat4 moved(const glm::dvec3& to) { return glm::translate(glm::dmat4(1.0), to); }
glm::dmat4 turned_anyhow(Numbers& numbers) {
  const double angle = numbers.uniform(0, 2 * std::numbers::pi);
  return glm::rotate(glm::dmat4(1.0), angle, any_direction(numbers));
}

// Where a ray of the screen is at a distance.
glm::dvec3 seen_place(Numbers& numbers) {
  const double x = numbers.uniform(-4, 4), y = numbers.uniform(-4, 4);
  return {x, y, numbers.uniform(-12, -2)};
}

// From the eye, through a place.
glm::dvec3 ray_through(const SolidView& view, const glm::dvec3& place) {
  return view.perspective ? glm::normalize(place) : glm::dvec3(0, 0, -1);
}

// The z axis onto `direction`.
glm::dmat4 turned_to(const glm::dvec3& direction) {
  const glm::dvec3 helper = std::fabs(direction.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, direction)), y = glm::cross(direction, x);
  return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(direction, 0), glm::dvec4(0, 0, 0, 1)};
}

// A direction at an angle from another, to any side.
glm::dvec3 tilted(const glm::dvec3& from, double angle, Numbers& numbers) {
  const double side = numbers.uniform(0, 2 * std::numbers::pi);
  const glm::dmat4 turn = turned_to(from);
  return std::cos(angle) * from +
         std::sin(angle) * (std::cos(side) * glm::dvec3(turn[0]) + std::sin(side) * glm::dvec3(turn[1]));
}

void take_shape(std::size_t i, glm::dmat4& quadric, std::vector<glm::dvec4>& planes) {
  const Shape& shape = kShapes.at(i);
  quadric = glm::dmat4(0.0);
  for (int k = 0; k < 4; ++k) quadric[k][k] = shape.diagonal[k];
  quadric[2][3] = quadric[3][2] = shape.z_linear;
  planes.clear();
  if (shape.capped) planes = {{0, 0, 1, -1}, {0, 0, -1, -1}};
}

}  // namespace

SolidView solid_view(bool perspective, const geometry::Viewport& viewport) {
  const double ratio = static_cast<double>(viewport.lines) / static_cast<double>(viewport.columns);
  const double side = kWidth / 2, at_near = side * kNear / kDistance;
  const glm::dmat4 clip = perspective
                              ? glm::frustumRH_ZO(-at_near, at_near, -at_near * ratio, at_near * ratio, kNear, kFar)
                              : glm::orthoRH_ZO(-side, side, -side * ratio, side * ratio, kNear, kFar);
  return {viewport, perspective, glm::inverse(geometry::eye_to_screen(clip, viewport))};
}

void SolidFamily::declare(parameter::Table& table) {
  table.choice("family", family_, {"any", "near", "sphere", "thin", "axis", "cap", "saddle", "wrap"},
               {"", "Which solids are drawn at random.", "the catalogue's figures"});
  table.real("least_pixels", least_pixels_, {0.01, 1e6},
             {"pixels", "Radius of the smallest sphere.", "the catalogue's figures"});
  table.real("most_pixels", most_pixels_, {0.01, 1e6},
             {"pixels", "Radius of the largest sphere.", "the catalogue's figures"});
}

EyeQuadric SolidFamily::Drawn::at(double size) const {
  const glm::dmat4 to_eye = glm::scale(place_, glm::dvec3(size));
  const glm::dmat4 product = geometry::quadric_in_eye_space(quadric_, to_eye);
  EyeQuadric result{0.5 * (product + glm::transpose(product)), {}};
  const glm::dmat4 back = glm::transpose(glm::inverse(to_eye));
  for (const glm::dvec4& plane : planes_) result.planes.push_back(back * plane);
  return result;
}

SolidFamily::Drawn SolidFamily::draw(const SolidView& view, Numbers& numbers) const {
  Drawn drawn;
  take_shape(static_cast<std::size_t>(numbers.whole(0, kShapes.size() - 1)), drawn.quadric_, drawn.planes_);
  switch (family_) {
    case Family::sphere:
      place_sphere(view, drawn, numbers);
      return drawn;
    case Family::thin:
      place_thin(drawn, numbers);
      return drawn;
    case Family::axis:
      place_along_ray(view, drawn, numbers);
      return drawn;
    case Family::cap:
      cut_along_ray(view, drawn, numbers);
      return drawn;
    case Family::saddle:
      place_saddle(view, drawn, numbers);
      return drawn;
    default:
      break;
  }
  const bool near = family_ == Family::near;
  glm::dvec3 place = seen_place(numbers);
  if (near) place = {place.x / 4, place.y / 4, numbers.uniform(-3, 0.5)};
  glm::dvec3 sides;
  for (int i = 0; i < 3; ++i) sides[i] = numbers.uniform(0.5, 2);
  const double size = near ? between_powers(0.5, 8, numbers) : between_powers(0.125, 2.8, numbers);
  drawn.place_ = glm::scale(moved(place) * turned_anyhow(numbers), size * sides);
  return drawn;
}

// By the point of its surface that is seen, so that it is seen however large it is.
void SolidFamily::place_sphere(const SolidView& view, Drawn& drawn, Numbers& numbers) const {
  take_shape(0, drawn.quadric_, drawn.planes_);
  const glm::dvec3 place = seen_place(numbers);
  const double pixel = kWidth / static_cast<double>(view.viewport.columns);
  const double radius = pixel * between_powers(least_pixels_, most_pixels_, numbers);
  const glm::dvec3 outwards = tilted(-ray_through(view, place), numbers.uniform(0, 1.5), numbers);
  drawn.place_ = glm::scale(moved(place - radius * outwards), glm::dvec3(radius));
}

// Discs, rods and what is between: half axes of 1 to 1/10,000, or 100 times as long.
void SolidFamily::place_thin(Drawn& drawn, Numbers& numbers) {
  take_shape(static_cast<std::size_t>(numbers.whole(0, kRound)), drawn.quadric_, drawn.planes_);
  const double thin = between_powers(1e-4, 0.1, numbers), long_axis = between_powers(1, 100, numbers);
  const glm::dvec3 sides(thin, numbers.whole(0, 1) == 0 ? thin : 1.0, long_axis);
  const glm::dvec3 place = seen_place(numbers);
  drawn.place_ = glm::scale(moved(place) * turned_anyhow(numbers), sides);
}

// Along the axis a cylinder's and a paraboloid's a is 0: a millionth of a radian to a tenth off.
void SolidFamily::place_along_ray(const SolidView& view, Drawn& drawn, Numbers& numbers) {
  const auto last = static_cast<std::int64_t>(kShapes.size()) - 1;
  take_shape(static_cast<std::size_t>(numbers.whole(kRound, last)), drawn.quadric_, drawn.planes_);
  const glm::dvec3 place = seen_place(numbers);
  const glm::dvec3 axis = tilted(-ray_through(view, place), between_powers(1e-6, 0.1, numbers), numbers);
  const double size = between_powers(0.125, 2.8, numbers), length = between_powers(0.1, 4, numbers);
  drawn.place_ = glm::scale(moved(place) * turned_to(axis), glm::dvec3(size, size, size * length));
}

// A cut nearly along the ray through a solid's middle, and one across it.
void SolidFamily::cut_along_ray(const SolidView& view, Drawn& drawn, Numbers& numbers) {
  take_shape(static_cast<std::size_t>(numbers.whole(0, 1)), drawn.quadric_, drawn.planes_);
  const glm::dvec3 place = seen_place(numbers);
  const double size = between_powers(0.25, 2.8, numbers);
  drawn.place_ = glm::scale(moved(place) * turned_anyhow(numbers), glm::dvec3(size));
  const glm::dvec3 ray = ray_through(view, place);
  const glm::dvec3 across = tilted(ray, std::numbers::pi / 2, numbers);
  const double angle = between_powers(1e-10, 0.1, numbers) * (numbers.whole(0, 1) == 0 ? 1 : -1);
  const glm::dvec3 normal = glm::normalize(across + angle * ray);
  const glm::dvec4 plane(normal, -glm::dot(normal, place));
  drawn.planes_ = {glm::transpose(drawn.place_) * plane, glm::dvec4(0, 0, 1, -0.3)};
}

// Rays next to the asymptotic cone of a hyperboloid of one sheet: on either side of a = 0, where its outline opens.
void SolidFamily::place_saddle(const SolidView& view, Drawn& drawn, Numbers& numbers) {
  take_shape(kOneSheet, drawn.quadric_, drawn.planes_);
  if (numbers.whole(0, 1) == 0) drawn.planes_.clear();
  drawn.quadric_[3][3] = -between_powers(1e-4, 1, numbers);
  const glm::dvec3 place = seen_place(numbers);
  const double off = between_powers(1e-4, 0.5, numbers) * (numbers.whole(0, 1) == 0 ? 1 : -1);
  const glm::dvec3 axis = tilted(ray_through(view, place), std::numbers::pi / 4 + off, numbers);
  const double size = between_powers(0.25, 2.8, numbers);
  drawn.place_ = glm::scale(moved(place) * turned_to(axis), glm::dvec3(size));
}

}  // namespace rastertlm::analysis
