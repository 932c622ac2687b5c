// Is the snapped picture that of exact integers, sample by sample?
#include <gtest/gtest.h>

#include <cmath>

#include "src/reference/renderer.h"
#include "tests/src/reference/exact_cover.h"
#include "tests/src/reference/pictures.h"

namespace rastertlm::reference {
namespace {

using testing_support::add_flat_triangle;
using testing_support::covers_exactly;
using testing_support::Found;
using testing_support::Picture;
using testing_support::Random;

// Triangles within the guard band, given in pixels: snapped, covered and interpolated with exact integers.
class NaiveSnapped {
 public:
  NaiveSnapped(const scene::Mesh& mesh, const RenderOptions& options) : mesh_(mesh) {
    const int fine = options.grids.on_screen.fraction_bits;
    bool within = true;
    for (const glm::dvec3& p : mesh.positions) {
      const double x = std::floor(std::ldexp(p.x, fine) + 0.5);
      const double y = std::floor(std::ldexp(-p.y, fine) + 0.5);
      within = within && x >= 0 && y >= 0 && x <= std::ldexp(static_cast<double>(options.columns) - 1, fine) &&
               y <= std::ldexp(static_cast<double>(options.lines) - 1, fine);
    }
    q_ = within ? fine : options.grids.guarded.fraction_bits;
  }
  int q() const { return q_; }

  Found at(std::int64_t x, std::int64_t y) const {
    Found found;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      std::array<Point<std::int64_t>, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& p = mesh_.positions[mesh_.triangles[t][i]];
        corners[i] = {static_cast<std::int64_t>(std::floor(std::ldexp(p.x, q_) + 0.5)),
                      static_cast<std::int64_t>(std::floor(std::ldexp(-p.y, q_) + 0.5))};
      }
      if (testing_support::doubled_area(corners) >= 0 || !covers_exactly(corners, x << q_, y << q_)) continue;
      found.add(static_cast<std::uint32_t>(t + 1), depth(t, corners, x << q_, y << q_));
    }
    return found;
  }

 private:
  // Area of the triangle with corner i replaced by the sample, over the whole.
  double depth(std::size_t t, const std::array<Point<std::int64_t>, 3>& corners, std::int64_t x, std::int64_t y) const {
    double z = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      auto part = corners;
      part[i] = {x, y};
      const double weight = static_cast<double>(testing_support::doubled_area(part)) /
                            static_cast<double>(testing_support::doubled_area(corners));
      z += weight * mesh_.positions[mesh_.triangles[t][i]].z / -100.0;
    }
    return z;
  }

  const scene::Mesh& mesh_;
  int q_ = 0;
};

// Positions avoid halves of a grid step, where a rounding error of the projection would decide.
void add_soup(scene::Mesh& mesh, Random& random, double low, double high, int triangles) {
  const auto position = [&]() -> glm::dvec3 {
    const auto sixteenth = [&] {
      return static_cast<double>(
                 random.whole(static_cast<std::int64_t>(low) * 16, static_cast<std::int64_t>(high) * 16)) /
                 16 +
             1e-4;
    };
    const double x = sixteenth();
    const double y = sixteenth();
    return {x, -y, random.between(-90, -10)};
  };
  for (int t = 0; t < triangles; ++t) {
    const glm::dvec3 a = position();
    const glm::dvec3 b = position();
    add_flat_triangle(mesh, {a, b, position()});
  }
}

void expect_the_snapped_picture(Picture& p, const scene::Mesh& mesh, int wanted_q) {
  const NaiveSnapped naive(mesh, p.options);
  ASSERT_EQ(naive.q(), wanted_q);
  const frame::ExactFrame out = p.render_as(Reference::snapped);
  for (std::size_t pixel = 0; pixel < out.pixels(); ++pixel) {
    const Found found =
        naive.at(static_cast<std::int64_t>(pixel % out.columns), static_cast<std::int64_t>(pixel / out.columns));
    ASSERT_EQ(out.coverage[pixel], found.coverage) << "pixel " << pixel;
    ASSERT_EQ(out.object[pixel] != 0, found.coverage != 0);
    if (found.coverage == 0) continue;
    ASSERT_NEAR(out.depth[pixel], found.depth, 1e-12);
    ASSERT_EQ(out.object[pixel], found.nearest.value_or(out.object[pixel])) << "pixel " << pixel;
  }
}

TEST(SnappedRenderer, IsTheNaivePictureOfExactIntegers) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    Picture p(28, 24, 5);
    p.look_at_pixels();
    scene::Mesh& mesh = p.add_object();
    add_soup(mesh, random, 0, 22, 30);
    expect_the_snapped_picture(p, mesh, 5);
  }
}

TEST(SnappedRenderer, IsTheNaivePictureInTheGuardBand) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    Picture p(24, 24, 5);
    p.options.grids.guarded.fraction_bits = 3;  // as on a larger screen
    p.look_at_pixels();
    scene::Mesh& mesh = p.add_object();
    add_soup(mesh, random, -11, 33, 30);
    expect_the_snapped_picture(p, mesh, 3);
  }
}

}  // namespace
}  // namespace rastertlm::reference
