// The frames of the papers' spheres as the set-up processor computes them, for tests that look at every pixel.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "modules/host/set_up_work.h"
#include "modules/span_unit/span_unit.h"
#include "platforms/quadratic/machine.h"
#include "src/run/inputs.h"
#include "tests/support/span_pixels.h"

namespace rastertlm::test {

inline run::Inputs sphere_inputs(const std::string& mesh, const std::vector<std::string>& overrides) {
  const std::string source = RASTERTLM_SOURCE_DIR;
  return run::read_inputs(source + "/configs/machines/quadratic.toml",
                          source + "/configs/scenes/sphere_" + mesh + ".toml", overrides);
}

// Calls visit(work) for every triangle of the first frame's set-up, in the order of drawing.
inline void visit_triangles(const run::Inputs& inputs, const std::function<void(const host::SetUpWork&)>& visit) {
  const auto& machine = std::get<quadratic::Machine>(inputs.content->machine);
  const scene::Scene& scene = *inputs.content->scene;
  host::ResidentScene resident;
  for (const scene::Object& object : scene.objects) resident.objects.push_back({&object.mesh, false, false});
  std::vector<geometry::Reflectance> surfaces;
  for (const scene::Material& m : scene.materials)
    surfaces.push_back({m.ambient * m.colour, m.diffuse * m.colour, glm::dvec3(m.specular), m.exponent});
  host::SetUpWork work(resident, machine.set_up, machine.set_up_format(), surfaces,
                       {geometry::Model::phong, scene.specular_gate, scene.ambient_light});
  work.begin_frame(scene::pose(scene, 0, machine.viewport().columns, machine.viewport().lines), false);
  while (work.next()) visit(work);
}

// Calls visit(triangle, span, pixels) for every span of the first frame, in the order of drawing.
inline void visit_spans(
    const run::Inputs& inputs,
    const std::function<void(const set_up::ColourTriangle&, const span_unit::Span&, const SpanPixels&)>& visit) {
  const auto& machine = std::get<quadratic::Machine>(inputs.content->machine);
  span_unit::SpanUnit unit(machine.span_unit, static_cast<std::uint32_t>(machine.video.columns),
                           static_cast<std::uint32_t>(machine.video.lines));
  visit_triangles(inputs, [&](const host::SetUpWork& work) {
    for (const set_up::ColourTriangle& triangle : work.coloured())
      for (const span_unit::Span& span : unit.draw(set_up::span_load(triangle, machine.set_up_format().span)).spans)
        visit(triangle, span, pixels_of(span, span_unit::pixel_format(machine.span_unit)));
  });
}

// The colour that the triangle's coefficients have at a pixel, in double and not clamped.
inline double colour_at(const set_up::ColourTriangle& triangle, std::size_t channel, std::uint32_t column,
                        std::uint32_t line) {
  const double unit = std::ldexp(1.0, -triangle.fraction_bits);
  return triangle.colour[channel].at(column - static_cast<double>(triangle.corners[0].x) * unit,
                                     line - static_cast<double>(triangle.corners[0].y) * unit);
}

}  // namespace rastertlm::test
