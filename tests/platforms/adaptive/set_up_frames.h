// The triangles of an adaptive machine's frames as the set-up processor hands them on, for tests that look at each.
#pragma once

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "modules/host/set_up_work.h"
#include "platforms/adaptive/machine.h"
#include "src/run/inputs.h"

namespace rastertlm::test {

inline run::Inputs adaptive_inputs(const std::vector<std::string>& overrides) {
  const std::string source = RASTERTLM_SOURCE_DIR;
  return run::read_inputs(source + "/configs/machines/adaptive.toml",
                          source + "/configs/scenes/teapot_four_lights.toml", overrides);
}

struct SetUpFrame {
  std::vector<set_up::ColourTriangle> triangles;
  host::SetUpCounts counts;
};

inline std::vector<SetUpFrame> set_up_frames(const run::Inputs& inputs, const std::vector<std::int64_t>& numbers) {
  const auto& machine = std::get<adaptive::Machine>(inputs.content->machine);
  const scene::Scene& scene = *inputs.content->scene;
  host::ResidentScene resident;
  for (const scene::Object& object : scene.objects) resident.objects.push_back({&object.mesh, object.two_sided, true});
  std::vector<geometry::Reflectance> surfaces;
  for (const scene::Material& m : scene.materials)
    surfaces.push_back({m.ambient * m.colour, m.diffuse * m.colour, glm::dvec3(m.specular), m.exponent});
  host::SetUpWork work(resident, machine.set_up, machine.set_up_format(), surfaces,
                       {geometry::Model::blinn, scene.specular_gate, scene.ambient_light});
  std::vector<SetUpFrame> frames;
  for (const std::int64_t number : numbers) {
    work.begin_frame(scene::pose(scene, number, machine.viewport().columns, machine.viewport().lines),
                     scene.camera.projection == scene::ProjectionKind::perspective);
    SetUpFrame& frame = frames.emplace_back();
    while (work.next()) frame.triangles.insert(frame.triangles.end(), work.coloured().begin(), work.coloured().end());
    frame.counts = work.counts();
  }
  return frames;
}

}  // namespace rastertlm::test
