// Colours as the eye tells them apart: display levels to CIE XYZ and L*a*b* under D65, and the difference CIEDE2000.
#pragma once

namespace rastertlm::reference {

// Three values of one colour: red, green, blue or X, Y, Z.
struct Triple {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

struct Lab {
  double l = 0.0;  // 0 black .. 100 white
  double a = 0.0;
  double b = 0.0;
};

// The sRGB curve (IEC 61966-2-1): a display level, 0..255, to linear light, 0..1.
double linear_light(double level);

// Linear sRGB to XYZ, white at Y = 1, and back: by the primaries and the white point of sRGB as fractions, which FLIP's
// authors use too.
Triple xyz_of_linear(const Triple& rgb);
Triple linear_of_xyz(const Triple& xyz);

// XYZ of linear (1, 1, 1): D65.
const Triple& white_point();

// CIE 15, under D65.
Lab lab_of_xyz(const Triple& xyz);

// CIEDE2000 with kL = kC = kH = 1: Sharma, Wu and Dalal, "The CIEDE2000 color-difference formula: implementation
// notes", Color Research and Application 30 (2005), equations 2 to 22.
double ciede2000(const Lab& first, const Lab& second);

}  // namespace rastertlm::reference
