#include "src/run/highlight_recall.h"

#include <algorithm>
#include <vector>

#include "modules/set_up/highlight_classifier.h"
#include "src/reference/highlight_centres.h"

namespace rastertlm::run {

void add_highlight_recall(const quadratic::Machine& machine, const scene::Scene& scene, const scene::Pose& pose,
                          HighlightFigures& figures) {
  if (!machine.set_up.classifies()) return;
  const bool viewer_at_eye = scene.camera.projection == scene::ProjectionKind::perspective &&
                             machine.set_up.attributes == set_up::Attributes::perspective;
  std::vector<geometry::LightSource> lights;
  for (const geometry::Light& light : pose.lights)
    lights.push_back({light.kind == geometry::LightKind::point, light.vector, light.intensity, light.intensity});
  std::vector<geometry::Reflectance> surfaces;
  for (const scene::Material& material : scene.materials)
    surfaces.push_back({{}, {}, glm::dvec3(material.specular), material.exponent});
  std::uint64_t centres = 0, found = 0, potentially = 0, holding = 0;
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Mesh& mesh = scene.objects[o].mesh;
    set_up::HighlightClassifier classifier(mesh, surfaces);
    const auto& marks = classifier.classify(pose.object_to_eye[o], {lights, viewer_at_eye}, 0);
    std::vector<bool> holds(mesh.triangles.size());
    for (const reference::HighlightCentre& centre :
         reference::highlight_centres(mesh, pose.object_to_eye[o], pose.normal_to_eye[o], pose.lights, viewer_at_eye)) {
      if (!surfaces[mesh.material[centre.triangle]].shines()) continue;
      ++centres;
      found += marks[centre.triangle] == set_up::Highlighted::potentially ? 1 : 0;
      holds[centre.triangle] = true;
    }
    for (std::size_t t = 0; t < marks.size(); ++t) {
      potentially += marks[t] == set_up::Highlighted::potentially ? 1 : 0;
      holding += marks[t] == set_up::Highlighted::potentially && holds[t] ? 1 : 0;
    }
  }
  figures.true_centres = centres;
  if (centres > 0) figures.recall = static_cast<double>(found) / static_cast<double>(centres);
  if (potentially > 0) figures.precision = static_cast<double>(holding) / static_cast<double>(potentially);
}

}  // namespace rastertlm::run
