// A host that draws by itself: what a frame's triangles and pixels ask of a program, by shading method, counted by the
// code of set-up and lighting; and what that takes on a computer, by a few figures that are fitted to published times.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "modules/host/resident_scene.h"
#include "modules/host/set_up_work.h"
#include "modules/set_up/point_lighting.h"
#include "modules/span_unit/parameters.h"
#include "src/base/shading_method.h"
#include "src/geometry/counted.h"
#include "src/geometry/lighting.h"
#include "src/geometry/pose.h"
#include "src/parameter/table.h"

namespace rastertlm::host {

// A computer that renders: every operation that is counted at one rate, and what a frame, a triangle, a pixel and a
// light take beside their operations.
struct SoftwareParameters {
  std::string preset = "pc_2000";
  double sustained_mflops = 51.2;
  double frame_us = 0.0;
  double triangle_us = 0.0;
  double pixel_ns = 1206.6;
  double light_us = 0.0;

  // Paths "software.preset" ...
  void declare(parameter::Table& table);
};

struct SoftwareWork {
  std::uint64_t triangles = 0;   // that are drawn: pieces of clipped ones, one by one
  std::uint64_t pixels = 0;      // of them on the screen, hidden ones included
  std::uint64_t lit_pixels = 0;  // of these: light evaluated there
  std::uint64_t lights = 0;      // at points: evaluations of the lighting equation, of each its lights
  geometry::OperationCounts operations;
  SoftwareWork& operator+=(const SoftwareWork& other);
};

double software_seconds(const SoftwareParameters& parameters, const SoftwareWork& work);

// How a scene is rendered, whoever does it.
struct Rendering {
  const ResidentScene& scene;
  set_up::SetUpParameters set_up;  // its method is not looked at
  SetUpFormat format;
  span_unit::SpanUnitParameters span_unit;
  std::vector<geometry::Reflectance> surfaces;
  geometry::LightingRules rules;
  bool viewer_at_eye = false;
};

// Programs are those of the papers: others are written for hardware.
bool has_software(ShadingMethod method);

// A frame, by
//   gouraud     light at three points, a plane for each colour; a pixel: three additions
//   quadratic   light at six, a quadratic each; a pixel: six additions
//   phong       planes of what is lit; a pixel: their steps, and light there, every pixel the way that it goes
//   highlight_subdivision, regular_subdivision
//               classification, search and cuts of the set-up; all parts as by gouraud
//   gouraud_phong
//               classification; as by phong what may hold a highlight, and highlight_test.rings of neighbours
// With depth: an addition and a comparison a pixel. Hidden pixels are shaded too, and the loop over a triangle's lines
// is the triangle's. Throws std::invalid_argument for other methods.
SoftwareWork software_work(const Rendering& rendering, ShadingMethod method, const geometry::Pose& pose);

}  // namespace rastertlm::host
