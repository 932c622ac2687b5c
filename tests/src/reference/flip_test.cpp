// Is FLIP what its authors defined: by a slow formulation of its own, by their program's results, and by what is known?
#include "src/reference/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>

#include "tests/src/reference/flip_pictures.h"

namespace rastertlm::reference {
namespace {

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// The definition as the paper states it, step by step and pixel by pixel: filters of two dimensions, convolved as such,
// and the C library's functions. It shares nothing with what is tested.
namespace slow {

struct Colour {
  double v[3];
};

double curve(double level) {
  return level / 255 <= 0.04045 ? level / 255 / 12.92 : std::pow((level / 255 + 0.055) / 1.055, 2.4);
}

// From primaries and white: what each primary must be for their sum to be white.
Colour xyz(const Colour& rgb) {
  constexpr double kX[3] = {0.64, 0.30, 0.15};
  constexpr double kY[3] = {0.33, 0.60, 0.06};
  constexpr double kLuminance[3] = {0.21263901, 0.71516868, 0.07219232};
  Colour out{{0, 0, 0}};
  for (int p = 0; p < 3; ++p) {
    const double light = kLuminance[p] * rgb.v[p];
    out.v[0] += light * kX[p] / kY[p];
    out.v[1] += light;
    out.v[2] += light * (1 - kX[p] - kY[p]) / kY[p];
  }
  return out;
}

const Colour& white() {
  static const Colour w = xyz({{1, 1, 1}});
  return w;
}

// Cramer's rule on the columns xyz(red), xyz(green), xyz(blue).
Colour linear(const Colour& c) {
  const Colour m[3] = {xyz({{1, 0, 0}}), xyz({{0, 1, 0}}), xyz({{0, 0, 1}})};
  const auto determinant = [](const Colour& a, const Colour& b, const Colour& d) {
    return a.v[0] * (b.v[1] * d.v[2] - b.v[2] * d.v[1]) - b.v[0] * (a.v[1] * d.v[2] - a.v[2] * d.v[1]) +
           d.v[0] * (a.v[1] * b.v[2] - a.v[2] * b.v[1]);
  };
  const double all = determinant(m[0], m[1], m[2]);
  return {{determinant(c, m[1], m[2]) / all, determinant(m[0], c, m[2]) / all, determinant(m[0], m[1], c) / all}};
}

Colour hunt(const Colour& rgb) {
  double f[3];
  const Colour c = xyz(rgb);
  for (int i = 0; i < 3; ++i) {
    const double t = c.v[i] / white().v[i];
    f[i] = t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  }
  const double l = 116 * f[1] - 16;
  return {{l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])}};
}

double hyab(const Colour& a, const Colour& b) {
  return std::abs(a.v[0] - b.v[0]) + std::hypot(a.v[1] - b.v[1], a.v[2] - b.v[2]);
}

struct Filter {
  int radius;
  std::vector<double> weights;
  Filter(int r, const std::function<double(double, double)>& weight) : radius(r) {
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x) weights.push_back(weight(x, y));
    double positive = 0.0;
    double negative = 0.0;
    for (const double w : weights) (w > 0 ? positive : negative) += std::abs(w);
    for (double& w : weights) w /= w > 0 ? positive : negative;
  }
};

struct Image {
  int columns;
  int lines;
  std::vector<Colour> pixels;  // Y, Cx, Cz
  const Colour& at(int x, int y) const {
    const auto line = static_cast<std::size_t>(std::clamp(y, 0, lines - 1));
    const auto column = static_cast<std::size_t>(std::clamp(x, 0, columns - 1));
    return pixels[line * static_cast<std::size_t>(columns) + column];
  }
  double sum(const Filter& filter, int x, int y, const std::function<double(const Colour&)>& of) const {
    double total = 0.0;
    std::size_t i = 0;
    for (int dy = -filter.radius; dy <= filter.radius; ++dy)
      for (int dx = -filter.radius; dx <= filter.radius; ++dx) total += filter.weights[i++] * of(at(x + dx, y + dy));
    return total;
  }
};

Image opponent(const FlipPicture& picture) {
  Image image{picture.columns, picture.lines, {}};
  for (std::size_t i = 0; i < picture.levels.size(); i += 3) {
    const Colour c = xyz({{curve(picture.levels[i]), curve(picture.levels[i + 1]), curve(picture.levels[i + 2])}});
    const double x = c.v[0] / white().v[0];
    const double y = c.v[1] / white().v[1];
    const double z = c.v[2] / white().v[2];
    image.pixels.push_back({{116 * y - 16, 500 * (x - y), 200 * (y - z)}});
  }
  return image;
}

class Flip {
 public:
  explicit Flip(double pixels_per_degree)
      : p_(pixels_per_degree),
        radius_(static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * p_))),
        y_(radius_, [&](double x, double y) { return term(1, 0.0047, x, y); }),
        cx_(radius_, [&](double x, double y) { return term(1, 0.0053, x, y); }),
        cz_(radius_, [&](double x, double y) { return term(34.1, 0.04, x, y) + term(13.5, 0.025, x, y); }),
        deviation_(0.041 * p_),
        feature_radius_(static_cast<int>(std::ceil(3 * deviation_))),
        edge_x_(feature_radius_, [&](double x, double y) { return -x * bell(x, y); }),
        edge_y_(feature_radius_, [&](double x, double y) { return -y * bell(x, y); }),
        point_x_(feature_radius_,
                 [&](double x, double y) { return (x * x / deviation_ / deviation_ - 1) * bell(x, y); }),
        point_y_(feature_radius_,
                 [&](double x, double y) { return (y * y / deviation_ / deviation_ - 1) * bell(x, y); }) {}

  double at(const Image& a, const Image& b, int x, int y) const {
    const double largest = std::pow(hyab(hunt({{0, 1, 0}}), hunt({{0, 0, 1}})), 0.7);
    const double d = std::pow(hyab(seen(a, x, y), seen(b, x, y)), 0.7);
    const double colour =
        d < 0.4 * largest ? 0.95 / (0.4 * largest) * d : 0.95 + (d - 0.4 * largest) / (largest - 0.4 * largest) * 0.05;
    const double edges = std::abs(length(a, edge_x_, edge_y_, x, y) - length(b, edge_x_, edge_y_, x, y));
    const double points = std::abs(length(a, point_x_, point_y_, x, y) - length(b, point_x_, point_y_, x, y));
    return std::pow(colour, 1 - std::sqrt(std::max(edges, points) / std::sqrt(2.0)));
  }

 private:
  static constexpr double kPi = 3.141592653589793;
  double term(double a, double b, double x, double y) const {
    return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * (x * x + y * y) / (p_ * p_) / b);
  }
  double bell(double x, double y) const { return std::exp(-(x * x + y * y) / (2 * deviation_ * deviation_)); }
  Colour seen(const Image& image, int x, int y) const {
    const double l = (image.sum(y_, x, y, [](const Colour& c) { return c.v[0]; }) + 16) / 116;
    const double cx = image.sum(cx_, x, y, [](const Colour& c) { return c.v[1]; });
    const double cz = image.sum(cz_, x, y, [](const Colour& c) { return c.v[2]; });
    Colour rgb = linear({{(l + cx / 500) * white().v[0], l * white().v[1], (l - cz / 200) * white().v[2]}});
    for (double& v : rgb.v) v = std::clamp(v, 0.0, 1.0);
    return hunt(rgb);
  }
  static double length(const Image& image, const Filter& fx, const Filter& fy, int x, int y) {
    const auto grey = [](const Colour& c) { return (c.v[0] + 16) / 116; };
    return std::hypot(image.sum(fx, x, y, grey), image.sum(fy, x, y, grey));
  }

  double p_;
  int radius_;
  Filter y_;
  Filter cx_;
  Filter cz_;
  double deviation_;
  int feature_radius_;
  Filter edge_x_;
  Filter edge_y_;
  Filter point_x_;
  Filter point_y_;
};

}  // namespace slow

std::vector<double> flip_of(const FlipPicture& a, const FlipPicture& b, double pixels_per_degree) {
  return flip_map(static_cast<std::size_t>(a.columns), static_cast<std::size_t>(a.lines), a.levels, b.levels,
                  pixels_per_degree);
}

// The primaries of the slow formulation are those of sRGB to eight digits, the others' to four: 1e-4 is what that
// makes.
TEST(Flip, EveryPixelIsThatOfTheDefinition) {
  for (const FlipPair& pair : flip_pairs(29, 23))
    for (const double pixels_per_degree : {5.0, 24.0, 67.0}) {
      const std::vector<double> map = flip_of(pair.reference, pair.test, pixels_per_degree);
      const slow::Flip flip(pixels_per_degree);
      const slow::Image a = slow::opponent(pair.reference);
      const slow::Image b = slow::opponent(pair.test);
      for (int y = 0; y < a.lines; y += 2)
        for (int x = 0; x < a.columns; x += 3)
          ASSERT_NEAR(map[static_cast<std::size_t>(y * a.columns + x)], flip.at(a, b, x, y), 1e-4)
              << pair.name << " at " << x << ", " << y << ", " << pixels_per_degree << " pixels a degree";
    }
}

// Means that version 1.6 of the authors' program (github.com/NVlabs/flip, commit 1eb247c) printed of these pictures as
// PNG files.
TEST(Flip, MeansAreThoseOfTheAuthorsProgram) {
  const std::vector<FlipPair> pairs = flip_pairs(160, 120);
  struct Mean {
    const char* name;
    double pixels_per_degree;
    double mean;
  };
  constexpr Mean kMeans[] = {
      {"noise and other noise", 20, 0.846187},
      {"noise and other noise", 67, 0.438392},
      {"noise and other noise", 120, 0.299208},
      {"ramps and darker ramps", 20, 0.377525},
      {"ramps and darker ramps", 67, 0.390124},
      {"ramps and darker ramps", 120, 0.400264},
      {"a disc and the same one pixel to the right", 20, 0.030644},
      {"a disc and the same one pixel to the right", 67, 0.039445},
      {"a disc and the same one pixel to the right", 120, 0.042603},
      {"checks and their complement", 20, 0.978905},
      {"checks and their complement", 67, 0.683894},
      {"checks and their complement", 120, 0.170315},
      {"a disc and the same in steps of eight levels", 20, 0.097468},
      {"a disc and the same in steps of eight levels", 67, 0.094636},
      {"a disc and the same in steps of eight levels", 120, 0.092758},
  };
  for (const Mean& wanted : kMeans) {
    const auto pair =
        std::find_if(pairs.begin(), pairs.end(), [&](const FlipPair& p) { return p.name == wanted.name; });
    ASSERT_NE(pair, pairs.end()) << wanted.name;
    EXPECT_NEAR(mean_of(flip_of(pair->reference, pair->test, wanted.pixels_per_degree)), wanted.mean, 1e-4)
        << wanted.name << ", " << wanted.pixels_per_degree << " pixels a degree";
  }
}

TEST(Flip, KnownEnds) {
  const FlipPicture black{16, 8, std::vector<double>(3 * 16 * 8, 0.0)};
  FlipPicture white = black;
  std::fill(white.levels.begin(), white.levels.end(), 255.0);
  for (const FlipPair& pair : flip_pairs(20, 16)) {
    const std::vector<double> same = flip_of(pair.reference, pair.reference, 67.0);
    EXPECT_EQ(*std::max_element(same.begin(), same.end()), 0.0) << pair.name;
    const std::vector<double> there = flip_of(pair.reference, pair.test, 67.0);
    EXPECT_EQ(there, flip_of(pair.test, pair.reference, 67.0)) << pair.name;
    EXPECT_GE(*std::min_element(there.begin(), there.end()), 0.0);
    EXPECT_LE(*std::max_element(there.begin(), there.end()), 1.0);
  }
  // Lightness alone differs, by 100, beside the largest difference, that of green and blue, here of their L*a*b* as it
  // is published to four digits.
  const double green_blue =
      87.7347 - 32.2970 +
      std::hypot(0.877347 * -86.1827 - 0.322970 * 79.1875, 0.877347 * 83.1793 - 0.322970 * -107.8602);
  const double share = std::pow(100.0 / green_blue, 0.7);
  ASSERT_GT(share, 0.4);
  for (const double v : flip_of(black, white, 67.0)) EXPECT_NEAR(v, 0.95 + 0.05 * (share - 0.4) / 0.6, 1e-5);
  // Green and blue are the farthest colours, and nothing else differs.
  FlipPicture green = black;
  FlipPicture blue = black;
  for (std::size_t i = 0; i < green.levels.size(); i += 3) green.levels[i + 1] = blue.levels[i + 2] = 255.0;
  for (const double v : flip_of(green, blue, 67.0)) EXPECT_NEAR(v, 1.0, 1e-9);
}

TEST(Flip, RefusesWhatItCannotCompare) {
  const std::vector<double> six(6, 0.0);
  const std::vector<double> three(3, 0.0);
  EXPECT_THROW(flip_map(2, 1, six, three), std::invalid_argument);
  EXPECT_THROW(flip_map(3, 1, six, six), std::invalid_argument);
  EXPECT_THROW(flip_map(0, 0, {}, {}), std::invalid_argument);
  for (const double bad : {0.0, 0.99, 1001.0, -67.0, std::nan("")})
    EXPECT_THROW(flip_map(2, 1, six, six, bad), std::invalid_argument) << bad;
  EXPECT_NO_THROW(flip_map(2, 1, six, six, 1000.0));
}

}  // namespace
}  // namespace rastertlm::reference
