// Are colours and their differences those that are published?
#include "src/reference/colour.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rastertlm::reference {
namespace {

struct Pair {
  Lab first;
  Lab second;
  double difference;
};

// Sharma, Wu and Dalal (2005), table 1: pairs at which wrong signs, quadrants and means of hues show.
constexpr Pair kPairs[] = {
    {{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
    {{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
    {{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
    {{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
    {{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
    {{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
    {{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
    {{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
    {{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

TEST(Ciede2000, SharmasPairs) {
  static_assert(sizeof(kPairs) / sizeof(kPairs[0]) == 34);
  // The table has four digits, so that half a digit is its own rounding.
  for (std::size_t i = 0; i < 34; ++i) {
    EXPECT_NEAR(ciede2000(kPairs[i].first, kPairs[i].second), kPairs[i].difference, 1e-4) << "pair " << i + 1;
    EXPECT_NEAR(ciede2000(kPairs[i].second, kPairs[i].first), kPairs[i].difference, 1e-4) << "pair " << i + 1;
  }
}

TEST(Colour, ThereAndBack) {
  for (const Triple& rgb : {Triple{0.2, 0.5, 0.9}, Triple{1, 0, 0}, Triple{0, 1, 0}, Triple{0, 0, 1}}) {
    const Triple back = linear_of_xyz(xyz_of_linear(rgb));
    EXPECT_NEAR(back.x, rgb.x, 1e-14);
    EXPECT_NEAR(back.y, rgb.y, 1e-14);
    EXPECT_NEAR(back.z, rgb.z, 1e-14);
  }
}

// IEC 61966-2-1 states the primaries and white to four digits: x = 0.64, y = 0.33 and so on.
TEST(Colour, PrimariesAndWhiteOfSrgb) {
  struct Primary {
    Triple rgb;
    double x;
    double y;
  };
  for (const Primary& p : {Primary{{1, 0, 0}, 0.64, 0.33}, Primary{{0, 1, 0}, 0.30, 0.60},
                           Primary{{0, 0, 1}, 0.15, 0.06}, Primary{{1, 1, 1}, 0.3127, 0.3290}}) {
    const Triple xyz = xyz_of_linear(p.rgb);
    const double sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, p.x, 5e-5);
    EXPECT_NEAR(xyz.y / sum, p.y, 5e-5);
  }
  EXPECT_NEAR(white_point().y, 1.0, 1e-15);
}

TEST(Colour, GreysHaveNoHueAndTheirLightnessIsKnown) {
  const auto grey = [](double level) {
    const double v = linear_light(level);
    return lab_of_xyz(xyz_of_linear({v, v, v}));
  };
  for (const double level : {0.0, 1.0, 10.0, 128.0, 255.0}) {
    EXPECT_NEAR(grey(level).a, 0.0, 1e-12);
    EXPECT_NEAR(grey(level).b, 0.0, 1e-12);
  }
  EXPECT_NEAR(grey(0).l, 0.0, 1e-12);
  EXPECT_NEAR(grey(255).l, 100.0, 1e-12);
  EXPECT_NEAR(grey(119).l, 50.034, 5e-3);                        // 116 (0.18447)^(1/3) - 16
  EXPECT_NEAR(grey(1).l, 24389.0 / 27.0 / 255.0 / 12.92, 1e-9);  // straight near black: 903.3 Y
}

}  // namespace
}  // namespace rastertlm::reference
