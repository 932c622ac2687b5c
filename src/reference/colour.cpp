#include "src/reference/colour.h"

#include <cmath>

#include "src/base/mathematics.h"

namespace rastertlm::reference {
namespace {

// Rows of the matrix from linear sRGB to XYZ.
constexpr double kXyz[3][3] = {{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                               {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                               {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};

double cofactor(int row, int column) {
  const int r1 = (row + 1) % 3;
  const int r2 = (row + 2) % 3;
  const int c1 = (column + 1) % 3;
  const int c2 = (column + 2) % 3;
  return kXyz[r1][c1] * kXyz[r2][c2] - kXyz[r1][c2] * kXyz[r2][c1];
}

struct Inverse {
  double of[3][3];
  Inverse() {
    const double determinant = kXyz[0][0] * cofactor(0, 0) + kXyz[0][1] * cofactor(0, 1) + kXyz[0][2] * cofactor(0, 2);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) of[row][column] = cofactor(column, row) / determinant;
  }
};

Triple product(const double (&matrix)[3][3], const Triple& v) {
  return {matrix[0][0] * v.x + matrix[0][1] * v.y + matrix[0][2] * v.z,
          matrix[1][0] * v.x + matrix[1][1] * v.y + matrix[1][2] * v.z,
          matrix[2][0] * v.x + matrix[2][1] * v.y + matrix[2][2] * v.z};
}

// The cube root of CIE L*a*b*, straight near black.
double lab_curve(double t) {
  constexpr double kDelta = 6.0 / 29.0;
  if (t > kDelta * kDelta * kDelta) return mathematics::pow(t, 1.0 / 3.0);
  return t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

double chroma(double a, double b) { return std::sqrt(a * a + b * b); }

// Degrees, 0 <= h < 360; 0 for a colour without hue.
double hue(double a, double b) {
  if (a == 0.0 && b == 0.0) return 0.0;
  const double degrees = mathematics::atan2(b, a) * 180.0 / mathematics::kPi;
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}

// sqrt(c^7 / (c^7 + 25^7)).
double seventh_power_share(double c) {
  const double c7 = c * c * c * c * c * c * c;
  constexpr double k25To7 = 6103515625.0;
  return std::sqrt(c7 / (c7 + k25To7));
}

// From the first hue to the second, -180..180.
double hue_step(double h1, double h2, bool no_hue) {
  if (no_hue) return 0.0;
  double step = h2 - h1;
  if (step > 180.0) step -= 360.0;
  if (step < -180.0) step += 360.0;
  return step;
}

double mean_hue(double h1, double h2, bool no_hue) {
  if (no_hue) return h1 + h2;
  if (std::abs(h1 - h2) <= 180.0) return (h1 + h2) / 2.0;
  return (h1 + h2 < 360.0 ? h1 + h2 + 360.0 : h1 + h2 - 360.0) / 2.0;
}

double square(double x) { return x * x; }

}  // namespace

double linear_light(double level) {
  const double s = level / 255.0;
  return s <= 0.04045 ? s / 12.92 : mathematics::pow((s + 0.055) / 1.055, 2.4);
}

Triple xyz_of_linear(const Triple& rgb) { return product(kXyz, rgb); }

Triple linear_of_xyz(const Triple& xyz) {
  static const Inverse inverse;
  return product(inverse.of, xyz);
}

const Triple& white_point() {
  static const Triple white = xyz_of_linear({1.0, 1.0, 1.0});
  return white;
}

Lab lab_of_xyz(const Triple& xyz) {
  const Triple& white = white_point();
  const double x = lab_curve(xyz.x / white.x);
  const double y = lab_curve(xyz.y / white.y);
  const double z = lab_curve(xyz.z / white.z);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double ciede2000(const Lab& first, const Lab& second) {
  const double g = 0.5 * (1.0 - seventh_power_share((chroma(first.a, first.b) + chroma(second.a, second.b)) / 2.0));
  const double a1 = (1.0 + g) * first.a;
  const double a2 = (1.0 + g) * second.a;
  const double c1 = chroma(a1, first.b);
  const double c2 = chroma(a2, second.b);
  const double h1 = hue(a1, first.b);
  const double h2 = hue(a2, second.b);
  const bool no_hue = c1 * c2 == 0.0;
  const double dl = second.l - first.l;
  const double dc = c2 - c1;
  const double dh = 2.0 * std::sqrt(c1 * c2) * mathematics::sin_deg(hue_step(h1, h2, no_hue) / 2.0);
  const double l = (first.l + second.l) / 2.0;
  const double c = (c1 + c2) / 2.0;
  const double h = mean_hue(h1, h2, no_hue);
  const double t = 1.0 - 0.17 * mathematics::cos_deg(h - 30.0) + 0.24 * mathematics::cos_deg(2.0 * h) +
                   0.32 * mathematics::cos_deg(3.0 * h + 6.0) - 0.20 * mathematics::cos_deg(4.0 * h - 63.0);
  const double rotation = 30.0 * mathematics::exp(-square((h - 275.0) / 25.0));
  const double sl = 1.0 + 0.015 * square(l - 50.0) / std::sqrt(20.0 + square(l - 50.0));
  const double sc = 1.0 + 0.045 * c;
  const double sh = 1.0 + 0.015 * c * t;
  const double rt = -mathematics::sin_deg(2.0 * rotation) * 2.0 * seventh_power_share(c);
  const double squares = square(dl / sl) + square(dc / sc) + square(dh / sh) + rt * (dc / sc) * (dh / sh);
  return std::sqrt(squares > 0.0 ? squares : 0.0);  // rounding alone makes it negative
}

}  // namespace rastertlm::reference
