// Scenes of flat triangles on the screen, pixel by pixel, and machines in which but one thing takes time.
#pragma once

#include <random>
#include <vector>

#include "platforms/quadratic/quadratic.h"
#include "src/scene/scene.h"

namespace rastertlm::test {

// One world unit is one pixel; the picture's top left sample is at (0, 0), y down.
inline scene::Scene screen_scene(double lines) {
  scene::Scene scene;
  scene.camera.projection = scene::ProjectionKind::orthographic;
  scene.camera.eye = {0.0, 0.0, 100.0};
  scene.camera.target = {0.0, 0.0, 0.0};
  scene.camera.up = {0.0, 1.0, 0.0};
  scene.camera.height = lines;
  scene.camera.near = 1.0;
  scene.camera.far = 200.0;
  scene.materials.push_back({"grey", glm::dvec3(0.5), 0.1, 0.5, 0.4, 20});
  geometry::Light light;
  light.vector = {0, 0, 1};
  scene.lights.push_back(light);
  scene.objects.emplace_back();
  return scene;
}

struct ScreenPoint {
  double x, y;
};

// Counter-clockwise to the eye where the corners run clockwise with y down reversed: a, b, c as seen with y up.
inline void add_triangle(scene::Scene& scene, double columns, double lines, ScreenPoint a, ScreenPoint b, ScreenPoint c,
                         double nearer = 0.0) {
  geometry::Mesh& mesh = scene.objects[0].mesh;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const ScreenPoint& p : {a, b, c}) {
    mesh.positions.emplace_back(p.x + 0.5 - columns / 2, lines / 2 - 0.5 - p.y, nearer);
    mesh.normals.emplace_back(0, 0, 1);
  }
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (area < 0)
    mesh.triangles.push_back({first, first + 1, first + 2});
  else
    mesh.triangles.push_back({first, first + 2, first + 1});
  mesh.material.push_back(0);
}

// Covers columns 0 .. columns - 1 of lines first .. end - 1 by two triangles.
inline void add_rectangle(scene::Scene& scene, double columns, double lines, double first, double end,
                          double nearer = 0.0) {
  const double left = -0.5, right = columns - 0.5, top = first - 0.5, bottom = end - 0.5;
  add_triangle(scene, columns, lines, {left, top}, {right, top}, {left, bottom}, nearer);
  add_triangle(scene, columns, lines, {right, top}, {right, bottom}, {left, bottom}, nearer);
}

// Everything but the span unit takes next to no time.
inline quadratic::Machine span_unit_alone(std::int64_t columns, std::int64_t lines) {
  quadratic::Machine machine;
  machine.video.columns = columns;
  machine.video.lines = lines;
  machine.video.pixel_clock_ns = 5.0;
  machine.video.vertical_retrace_us = 100.0;
  machine.host.clock_hz = 10'000'000'000;
  machine.host.sustained_mflops = 1e6;
  machine.host.bus_cycles_per_word = 1;
  machine.frame_store.access_ns = 1.0;
  machine.frame_store.clear = false;
  machine.frame_store.swap = frame_store::Swap::completion;
  return machine;
}

}  // namespace rastertlm::test
