// How long must the words of a quadric processor be? What formats do to depth, outline and normal of spheres and of
// general ellipsoids, in parallel projection on 512 x 512, a unit of depth being a pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

#include "modules/object_processor/prenormaliser.h"
#include "modules/set_up/quadric_set_up.h"
#include "tests/modules/set_up/solid_comparison.h"

namespace rastertlm::set_up {
namespace {

using quadric_processor::Scaling;

constexpr double kUnit = 32768;  // depth words a unit of depth

QuadricFormat words_of(int word_bits, int fraction_bits, int root_bits, int guard_bits, Scaling scaling) {
  QuadricFormat format{{}, {24, 512, 512, EdgeForm::snapped}};
  format.parameters.word_bits = word_bits;
  format.parameters.fraction_bits = fraction_bits;
  format.parameters.root_integer_bits = root_bits;
  format.parameters.root_guard_bits = guard_bits;
  format.parameters.scaling = scaling;
  return format;
}

// Of all solids of a kind.
struct Errors {
  double depth = 0;   // units, where both are covered
  double inside = 0;  // the same where the ray is half of the solid's depth and more inside
  double apart = 0;   // pixels from the outline to the farthest pixel that is missing or too many
  int missing = 0, extra = 0;
  int normal = 0;          // of a component of 12 bits, in its last place, where `inside` is
  std::int64_t width = 0;  // the widest word that was needed
};

// Pixels to look at.
struct Window {
  std::uint32_t left = 0, top = 0, right = 511, bottom = 511;
};

// Pixels from (x, y) to the outline d = 0, along the gradient: no less than the distance.
double pixels_to_outline(const geometry::SecondOrderForm<double>& d, double x, double y) {
  const double gx = 2 * d.xx * x + d.xy * y + d.x, gy = 2 * d.yy * y + d.xy * x + d.y;
  const double slope = std::hypot(gx, gy);
  const double ux = gx / slope, uy = gy / slope;
  const double c = d.at(x, y);
  // c + slope t + curve t^2 = 0; the smaller root, where there is one.
  const double curve = d.xx * ux * ux + d.yy * uy * uy + d.xy * ux * uy;
  const double under = slope * slope - 4 * curve * c;
  return under < 0 ? slope / (2 * std::abs(curve)) : 2 * std::abs(c) / (slope + std::sqrt(under));
}

// The component of 12 bits, signed, that is farthest from the exact normal's by the same shift.
int twelve_bits_off(const std::array<std::uint32_t, 3>& shown, const glm::dvec3& exact) {
  static const object_processor::Prenormaliser prenormaliser{object_processor::ObjectProcessorParameters{}};
  const glm::dvec3 vector = vector_of(shown, 24);
  const double length = glm::length(vector);
  const double place = std::ldexp(1.0, static_cast<int>(prenormaliser.shift_of(shown)));
  double off = 0;
  for (int i = 0; i < 3; ++i)
    off = std::max(off, std::abs(std::floor(vector[i] / place) - std::floor(exact[i] * length / place)));
  return static_cast<int>(off);
}

// The root in the middle of the outline, where it is largest.
double deepest_of(const geometry::SecondOrderForm<double>& d) {
  const double under = 4 * d.xx * d.yy - d.xy * d.xy;
  const double x = (d.xy * d.y - 2 * d.yy * d.x) / under, y = (d.xy * d.x - 2 * d.xx * d.y) / under;
  return std::sqrt(d.at(x, y));
}

void measure_pixels(const PlacedSolid& solid, const View& view, const QuadricFormat& format, const QuadricWords& words,
                    const Window& window, Errors& errors) {
  const auto form = geometry::screen_quadric<double>(solid.quadric, view.screen_to_eye);
  const auto near = static_cast<double>(near_depth(format.words));
  const double range = static_cast<double>(far_depth(format.words)) - near;
  const QuadricPixelLogic logic(format.parameters, 24, {near_depth(format.words), far_depth(format.words)});
  const double deepest = deepest_of(form.discriminant);
  for (std::uint32_t y = window.top; y <= window.bottom; ++y)
    for (std::uint32_t x = window.left; x <= window.right; ++x) {
      const double d = form.discriminant.at(x, y);
      const QuadricPixel pixel = logic(words, quadric_processor::pixel_words(words, x, y, format.parameters, 24));
      if (pixel.covered != (d >= 0)) {
        ++(pixel.covered ? errors.extra : errors.missing);
        errors.apart = std::max(errors.apart, pixels_to_outline(form.discriminant, x, y));
      }
      if (!pixel.covered || d < 0) continue;
      const double exact = near + range * (form.middle.at(x, y) - std::sqrt(d));
      const double off = std::abs(static_cast<double>(pixel.depth) - exact) / kUnit;
      errors.depth = std::max(errors.depth, off);
      if (std::sqrt(d) < deepest / 2) continue;
      errors.inside = std::max(errors.inside, off);
      errors.normal = std::max(
          errors.normal, twelve_bits_off(pixel.normal, glm::normalize(geometry::quadric_normal(
                                                           form, geometry::QuadricHit::Surface::near_root, x, y))));
    }
}

// In the width that is named, where the format's words are too narrow.
void measure(const PlacedSolid& solid, QuadricFormat format, Errors& errors, const Window& window = {}) {
  const View view = parallel_view(format);
  QuadricSetUp result = set_up_quadric<double>(solid.quadric, solid.planes, 0, view.screen_to_eye, format);
  if (result.problem.key == "quadric_processor.word_bits") {
    format.parameters.word_bits = result.problem.width;
    result = set_up_quadric<double>(solid.quadric, solid.planes, 0, view.screen_to_eye, format);
  }
  ASSERT_EQ(result.outcome, QuadricOutcome::drawn) << result.problem.key << ' ' << result.problem.message;
  errors.width = std::max(errors.width, format.parameters.word_bits);
  EXPECT_EQ(compare(solid, view, format, result, 7).wrong, "");  // within the bounds of that very solid
  measure_pixels(solid, view, format, result.words, window, errors);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 random_;
};

constexpr int kRounds = 12;

// R = 240 near the middle; with `on_grid`, the middle on 1/32 of a pixel.
Errors spheres(const QuadricFormat& format, bool on_grid) {
  Random random(3);
  Errors errors;
  for (int round = 0; round < kRounds; ++round) {
    glm::dvec3 at(random.uniform(240, 272), random.uniform(240, 272), -256);
    if (on_grid) at = glm::round(at * 32.0) / 32.0;
    measure(ball(at, glm::dvec3(240 - random.uniform(0, 1))), format, errors);
  }
  return errors;
}

// Half axes of 0.1 to 0.3 of the screen, turned anyhow.
Errors ellipsoids(const QuadricFormat& format) {
  Random random(2);
  Errors errors;
  for (int round = 0; round < kRounds; ++round) {
    glm::dmat4 place =
        glm::translate(glm::dmat4(1.0), glm::dvec3(random.uniform(200, 312), random.uniform(200, 312), -256));
    place = glm::rotate(place, random.uniform(0, 6),
                        glm::normalize(glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), 0.3)));
    const auto half_axis = [&] { return random.uniform(51.2, 153.6); };
    place = glm::scale(place, glm::dvec3(half_axis(), half_axis(), half_axis()));
    measure(placed_solid(kSolidShapes[0], place), format, errors);
  }
  return errors;
}

void print(const char* format, const char* solid, const Errors& e) {
  std::cout << fmt::format(
      "{:<40} {:<20} {:>2} bits: depth {:8.4f} units, {:8.4f} inside; {:>5} px missing, {:>5} extra, "
      "{:9.2g} px from the outline; normal {:>3}\n",
      format, solid, e.width, e.depth, e.inside, e.missing, e.extra, e.apart, e.normal);
}

TEST(QuadricWords, TwentyFourBitsAreEnoughForASphereAndNotForAnEllipsoid) {
  const QuadricFormat narrow = words_of(24, 4, 9, 1, Scaling::fixed);
  const char* name = "4 fraction bits, root 9 + 1, fixed";
  const Errors grid = spheres(narrow, true), any = spheres(narrow, false), general = ellipsoids(narrow);
  print(name, "spheres on 1/32 px", grid);
  print(name, "spheres anywhere", any);
  print(name, "ellipsoids", general);
  // Of a sphere on the grid the constant alone is rounded, to 2^-5.
  EXPECT_EQ(grid.width, 24);
  EXPECT_LE(grid.depth, std::sqrt(0x1p-5) + 0x1p-2);
  EXPECT_LE(grid.inside, 0x1p-2 + 0x1p-5);
  EXPECT_LE(grid.apart, 0x1p-5 / (2 * 239) * 1.001);
  EXPECT_GT(grid.normal, 0);  // its shading wants more
  // Elsewhere its slopes are as well, to 2^-5 a pixel.
  EXPECT_EQ(any.width, 24);
  EXPECT_LE(any.apart, 0.05);
  // 20 to 66 units and 3 to 54 pixels of an ellipsoid, where its constants are not anchored; here they are.
  EXPECT_EQ(general.width, 24);
  EXPECT_GT(general.depth, 10);
  EXPECT_GT(general.apart, 1);
  EXPECT_GT(general.missing + general.extra, 1000);
}

// Sixteen fraction bits are enough for them, twenty with room to spare, in the width that the program names.
TEST(QuadricWords, TheWidthThatIsNamedHolds) {
  struct Row {
    const char* name;
    QuadricFormat format;
    double depth;  // units, at most
    double apart;  // pixels
  };
  const Row rows[] = {{"16 fraction bits, root 9 + 1, fixed", words_of(24, 16, 9, 1, Scaling::fixed), 0.27, 2e-4},
                      {"20 fraction bits, root 9 + 6, fixed", words_of(24, 20, 9, 6, Scaling::fixed), 0.02, 2e-5},
                      {"12 fraction bits, root 10 + 6, object", words_of(48, 12, 10, 6, Scaling::object), 0.1, 2e-4}};
  for (const Row& row : rows) {
    const Errors sphere = spheres(row.format, false), general = ellipsoids(row.format);
    print(row.name, "spheres anywhere", sphere);
    print(row.name, "ellipsoids", general);
    for (const Errors& errors : {sphere, general}) {
      EXPECT_GT(errors.width, 24);
      EXPECT_LE(errors.width, row.format.parameters.scaling == Scaling::object ? 48 : 42);
      EXPECT_LE(errors.depth, row.depth);
      EXPECT_LE(errors.apart, row.apart);
    }
  }
}

// Of spheres of this radius anywhere on the screen.
Errors small_spheres(const QuadricFormat& format, double radius) {
  Random random(5);
  Errors errors;
  for (int round = 0; round < 4 * kRounds; ++round) {
    const auto place = [&] { return radius < 200 ? random.uniform(radius, 511 - radius) : random.uniform(240, 272); };
    const double x = place(), y = place();
    const auto low = [&](double at) { return static_cast<std::uint32_t>(std::max(0.0, at - radius - 2)); };
    const auto high = [&](double at) { return static_cast<std::uint32_t>(std::min(511.0, at + radius + 2)); };
    measure(ball({x, y, -256}, glm::dvec3(radius)), format, errors, {low(x), low(511 - y), high(x), high(511 - y)});
  }
  return errors;
}

// The root is off by a quarter of a unit, of a normal as long as the radius. A scale makes the root as long as the
// extractor, whatever the radius.
TEST(QuadricWords, NormalsWantGuardBitsOrAScale) {
  struct Row {
    const char* name;
    QuadricFormat format;
  };
  const auto rows =
      std::to_array<Row>({{"4 fraction bits of 24, root 9 + 1, fixed", words_of(24, 4, 9, 1, Scaling::fixed)},
                          {"12 of 48, root 10 + 6, fixed", words_of(48, 12, 10, 6, Scaling::fixed)},
                          {"12 of 48, root 10 + 6, object", words_of(48, 12, 10, 6, Scaling::object)}});
  for (const Row& row : rows) {
    const bool narrow = row.format.parameters.word_bits == 24;
    const bool fixed = row.format.parameters.scaling == Scaling::fixed;
    std::cout << fmt::format("{:<42}", row.name);
    for (const double radius : {240.0, 60.0, 20.0, 10.0, 5.0, 2.0, 1.0}) {
      const int normal = small_spheres(row.format, radius).normal;
      std::cout << fmt::format(" R {:>3}: {:>3}", radius, normal);
      // Half a place of the root, and what rounding adds at half the radius inside, of 2^-5 or 2^-13 of a place; a
      // place of the 12 bits more.
      const double root = fixed ? (narrow ? 0.25 + 0x1p-5 / radius : 0x1p-7 + 0x1p-13 / radius) : 0.0;
      EXPECT_LE(normal, 2048 * root / radius + (narrow ? 2 : 1)) << row.name << ' ' << radius;
      if (narrow && radius >= 10 && radius <= 60) {
        EXPECT_GE(normal, 2048 * 0.125 / radius) << radius;
      }
      if (!narrow && radius >= 20) {
        EXPECT_LE(normal, 1) << row.name << ' ' << radius;
      }
    }
    std::cout << '\n';
  }
}

}  // namespace
}  // namespace rastertlm::set_up
