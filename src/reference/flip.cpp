#include "src/reference/flip.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "src/base/mathematics.h"
#include "src/reference/colour.h"

namespace rastertlm::reference {
namespace {

// Contrast sensitivity (the paper's table 1): the filter of a channel is the sum of a sqrt(pi/b) exp(-pi^2 x^2 / b), x
// in degrees, normalised to one.
struct SensitivityTerm {
  double a;
  double b;
};
constexpr SensitivityTerm kLuminance{1.0, 0.0047};
constexpr SensitivityTerm kRedGreen{1.0, 0.0053};
constexpr SensitivityTerm kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

constexpr double kColourExponent = 0.7;    // qc
constexpr double kColourKnee = 0.4;        // pc, of the largest difference
constexpr double kColourKneeValue = 0.95;  // pt
constexpr double kFeatureWidth = 0.082;    // w, degrees
constexpr double kFeatureExponent = 0.5;   // qf

struct Size {
  std::size_t columns;
  std::size_t lines;
  std::size_t pixels() const { return columns * lines; }
};

using Plane = std::vector<double>;
using Kernel = std::vector<double>;  // 2 radius + 1 weights

// Luminance Y and the opponent colours Cx (red-green) and Cz (blue-yellow).
struct Opponent {
  Plane y;
  Plane cx;
  Plane cz;
};

Opponent opponent_of(const Size& size, std::span<const double> levels) {
  const Triple& white = white_point();
  Opponent planes{Plane(size.pixels()), Plane(size.pixels()), Plane(size.pixels())};
  for (std::size_t i = 0; i < size.pixels(); ++i) {
    const Triple xyz =
        xyz_of_linear({linear_light(levels[3 * i]), linear_light(levels[3 * i + 1]), linear_light(levels[3 * i + 2])});
    const double y = xyz.y / white.y;
    planes.y[i] = 116.0 * y - 16.0;
    planes.cx[i] = 500.0 * (xyz.x / white.x - y);
    planes.cz[i] = 200.0 * (y - xyz.z / white.z);
  }
  return planes;
}

// Convolution along lines; `padded` is room for one line.
void along_lines(const Size& size, const Plane& from, const Kernel& kernel, Plane& to) {
  const std::size_t radius = kernel.size() / 2;
  std::vector<double> padded(size.columns + 2 * radius);
  to.assign(size.pixels(), 0.0);
  for (std::size_t line = 0; line < size.lines; ++line) {
    const double* row = from.data() + line * size.columns;
    double* out = to.data() + line * size.columns;
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, size.columns, padded.data() + radius);
    std::fill_n(padded.data() + radius + size.columns, radius, row[size.columns - 1]);
    for (std::size_t k = 0; k < kernel.size(); ++k)
      for (std::size_t column = 0; column < size.columns; ++column) out[column] += kernel[k] * padded[column + k];
  }
}

void along_columns(const Size& size, const Plane& from, const Kernel& kernel, Plane& to) {
  const std::size_t radius = kernel.size() / 2;
  to.assign(size.pixels(), 0.0);
  for (std::size_t line = 0; line < size.lines; ++line) {
    double* out = to.data() + line * size.columns;
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const std::size_t read = line + k < radius ? 0 : std::min(line + k - radius, size.lines - 1);
      const double* row = from.data() + read * size.columns;
      for (std::size_t column = 0; column < size.columns; ++column) out[column] += kernel[k] * row[column];
    }
  }
}

Plane convolved(const Size& size, const Plane& from, const Kernel& across, const Kernel& down) {
  Plane between;
  Plane to;
  along_lines(size, from, across, between);
  along_columns(size, between, down, to);
  return to;
}

// exp(-x^2 / (2 deviation^2)) at x = -radius .. radius; x and deviation in pixels.
Kernel gaussian(double deviation, int radius) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x)
    kernel.push_back(mathematics::exp(-static_cast<double>(x) * x / (2.0 * deviation * deviation)));
  return kernel;
}

double sum_of(const Kernel& kernel) {
  double sum = 0.0;
  for (const double weight : kernel) sum += weight;
  return sum;
}

Kernel normalised(Kernel kernel) {
  const double sum = sum_of(kernel);
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

// Positive weights sum to 1, negative ones to -1.
Kernel normalised_by_sign(Kernel kernel) {
  double positive = 0.0;
  double negative = 0.0;
  for (const double weight : kernel) (weight > 0.0 ? positive : negative) += std::abs(weight);
  for (double& weight : kernel) weight /= weight > 0.0 ? positive : negative;
  return kernel;
}

// The standard deviation of a term, in degrees: exp(-pi^2 x^2 / b) = exp(-x^2 / (2 deviation^2)).
double deviation_of(const SensitivityTerm& term) { return std::sqrt(term.b / 2.0) / mathematics::kPi; }

// What the eye passes on at that distance.
Opponent seen(const Size& size, const Opponent& picture, double pixels_per_degree) {
  // All filters are as wide as the widest term needs.
  const int radius = static_cast<int>(std::ceil(3.0 * deviation_of(kBlueYellow[0]) * pixels_per_degree));
  const auto filter = [&](const SensitivityTerm& term) {
    return gaussian(deviation_of(term) * pixels_per_degree, radius);
  };
  const Kernel y = normalised(filter(kLuminance));
  const Kernel cx = normalised(filter(kRedGreen));
  Opponent out{convolved(size, picture.y, y, y), convolved(size, picture.cx, cx, cx), {}};
  // The sum of two Gaussians is not separable, each of them is: `share` is its part of the sum of all weights.
  Plane parts[2];
  double shares[2];
  for (int k = 0; k < 2; ++k) {
    const Kernel kernel = filter(kBlueYellow[k]);
    const double sum = sum_of(kernel);
    shares[k] = kBlueYellow[k].a * std::sqrt(mathematics::kPi / kBlueYellow[k].b) * sum * sum;
    const Kernel one = normalised(kernel);
    parts[k] = convolved(size, picture.cz, one, one);
  }
  const double all = shares[0] + shares[1];
  out.cz.resize(size.pixels());
  for (std::size_t i = 0; i < size.pixels(); ++i) out.cz[i] = (shares[0] * parts[0][i] + shares[1] * parts[1][i]) / all;
  return out;
}

// L*a*b* with Hunt's effect: colours count by their lightness.
Lab hunt_lab(const Triple& xyz) {
  Lab lab = lab_of_xyz(xyz);
  lab.a *= 0.01 * lab.l;
  lab.b *= 0.01 * lab.l;
  return lab;
}

Lab hunt_lab(double y, double cx, double cz) {
  const Triple& white = white_point();
  const double luminance = (y + 16.0) / 116.0;
  const Triple rgb =
      linear_of_xyz({(luminance + cx / 500.0) * white.x, luminance * white.y, (luminance - cz / 200.0) * white.z});
  const auto shown = [](double v) { return std::clamp(v, 0.0, 1.0); };
  return hunt_lab(xyz_of_linear({shown(rgb.x), shown(rgb.y), shown(rgb.z)}));
}

double hyab(const Lab& first, const Lab& second) {
  const double a = first.a - second.a;
  const double b = first.b - second.b;
  return std::abs(first.l - second.l) + std::sqrt(a * a + b * b);
}

Plane colour_difference(const Size& size, const Opponent& reference, const Opponent& test) {
  const double largest =
      mathematics::pow(hyab(hunt_lab(xyz_of_linear({0, 1, 0})), hunt_lab(xyz_of_linear({0, 0, 1}))), kColourExponent);
  const double knee = kColourKnee * largest;
  Plane out(size.pixels());
  for (std::size_t i = 0; i < size.pixels(); ++i) {
    const double d = mathematics::pow(
        hyab(hunt_lab(reference.y[i], reference.cx[i], reference.cz[i]), hunt_lab(test.y[i], test.cx[i], test.cz[i])),
        kColourExponent);
    out[i] = d < knee ? d * kColourKneeValue / knee
                      : kColourKneeValue + (d - knee) / (largest - knee) * (1.0 - kColourKneeValue);
  }
  return out;
}

// Lengths of the gradients: `edge` by the first derivative of a Gaussian, `point` by the second.
struct Features {
  Plane edge;
  Plane point;
};

Plane length_of(const Plane& x, const Plane& y) {
  Plane out(x.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
  return out;
}

Features features_of(const Size& size, const Opponent& picture, double pixels_per_degree) {
  const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const Kernel weights = gaussian(deviation, radius);
  Kernel first = weights;
  Kernel second = weights;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double x = static_cast<double>(i) - radius;
    first[i] *= -x;
    second[i] *= x * x / (deviation * deviation) - 1.0;
  }
  const Kernel smooth = normalised(weights);
  first = normalised_by_sign(first);
  second = normalised_by_sign(second);
  Plane y(size.pixels());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = (picture.y[i] + 16.0) / 116.0;
  return {length_of(convolved(size, y, first, smooth), convolved(size, y, smooth, first)),
          length_of(convolved(size, y, second, smooth), convolved(size, y, smooth, second))};
}

}  // namespace

std::vector<double> flip_map(std::size_t columns, std::size_t lines, std::span<const double> reference,
                             std::span<const double> test, double pixels_per_degree) {
  const Size size{columns, lines};
  if (size.pixels() == 0 || reference.size() != 3 * size.pixels() || test.size() != reference.size())
    throw std::invalid_argument("flip_map: the pictures have not the size that is stated");
  if (!(pixels_per_degree >= kLeastPixelsPerDegree && pixels_per_degree <= kMostPixelsPerDegree))
    throw std::invalid_argument("flip_map: pixels a degree out of range");
  const Opponent first = opponent_of(size, reference);
  const Opponent second = opponent_of(size, test);
  Plane difference =
      colour_difference(size, seen(size, first, pixels_per_degree), seen(size, second, pixels_per_degree));
  const Features in_first = features_of(size, first, pixels_per_degree);
  const Features in_second = features_of(size, second, pixels_per_degree);
  for (std::size_t i = 0; i < size.pixels(); ++i) {
    const double largest =
        std::max(std::abs(in_first.edge[i] - in_second.edge[i]), std::abs(in_first.point[i] - in_second.point[i]));
    const double feature = mathematics::pow(largest / std::sqrt(2.0), kFeatureExponent);
    difference[i] = mathematics::pow(difference[i], 1.0 - feature);
  }
  return difference;
}

}  // namespace rastertlm::reference
