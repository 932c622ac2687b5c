#include "modules/host/software_renderer.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "modules/span_unit/span_unit.h"

namespace rastertlm::host {
namespace {

using geometry::OperationCounts;
using set_up::LitPoint;

OperationCounts times(OperationCounts each, std::uint64_t count) {
  for (std::uint64_t* one : {&each.add, &each.multiply, &each.divide, &each.square_root, &each.compare, &each.convert,
                             &each.integer, &each.integer_multiply})
    *one *= count;
  return each;
}

// Values that are stepped from pixel to pixel, and the depth test.
OperationCounts pixel_cost(std::uint64_t additions) {
  OperationCounts cost;
  cost.add = additions + 1;
  cost.compare = 1;
  return cost;
}

// Light at the pixels of triangles whose normals are linear between corners.
class PixelLighting {
 public:
  PixelLighting(const Rendering& rendering, const geometry::Pose& pose)
      : rendering_(rendering),
        pose_(pose),
        lighting_(rendering.set_up, rendering.surfaces, rendering.rules),
        // What points between corners cost by their weights is not what they cost step by step.
        between_(rendering.set_up, rendering.surfaces, rendering.rules),
        at_corners_(rendering.set_up, rendering.surfaces, rendering.rules) {
    std::vector<geometry::LightSource> lights;
    for (const geometry::Light& light : pose.lights)
      lights.push_back({light.kind == geometry::LightKind::point, light.vector, light.intensity, light.intensity});
    for (set_up::PointLighting* lighting : {&lighting_, &between_, &at_corners_})
      lighting->set_lights(lights, rendering.viewer_at_eye);
  }

  // Of a triangle that was clipped, what its corners see is taken for its pieces' corners.
  void choose(std::size_t object, std::size_t triangle) {
    const geometry::Mesh& mesh = *rendering_.scene.objects[object].mesh;
    material_ = mesh.material[triangle];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = mesh.triangles[triangle][i];
      const glm::dvec4 eye = pose_.object_to_eye[object] * glm::dvec4(mesh.positions[corner], 1.0);
      corners_[i].normal = pose_.normal_to_eye[object] * mesh.normals[corner];
      corners_[i].position = glm::dvec3(eye);
      corners_[i].inverse_w = 1.0 / (pose_.eye_to_clip * eye).w;
    }
  }

  // As the set-up for a method that lights corners does.
  void light_corners() {
    for (const LitPoint& corner : corners_) at_corners_.levels(corner, material_);
  }

  void light(const set_up::ColourTriangle& triangle, const span_unit::Span& span) {
    std::array<glm::dvec2, 3> at{};
    for (std::size_t i = 0; i < 3; ++i)
      at[i] = std::ldexp(1.0, -triangle.fraction_bits) *
              glm::dvec2(static_cast<double>(triangle.corners[i].x), static_cast<double>(triangle.corners[i].y));
    const glm::dvec2 b = at[1] - at[0];
    const glm::dvec2 c = at[2] - at[0];
    const double area = b.x * c.y - b.y * c.x;
    for (std::uint32_t pixel = 0; pixel < span.count; ++pixel) {
      const glm::dvec2 p = glm::dvec2(span.column + pixel, span.line) - at[0];
      const double second = (p.x * c.y - p.y * c.x) / area;
      const double third = (b.x * p.y - b.y * p.x) / area;
      lighting_.levels(
          between_.inside({&corners_[0], &corners_[1], &corners_[2]}, {1.0 - second - third, second, third}),
          material_);
    }
  }

  const OperationCounts& operations() const { return lighting_.operations(); }
  const OperationCounts& corner_operations() const { return at_corners_.operations(); }

 private:
  const Rendering& rendering_;
  const geometry::Pose& pose_;
  set_up::PointLighting lighting_;
  set_up::PointLighting between_;
  set_up::PointLighting at_corners_;
  std::array<LitPoint, 3> corners_{};
  std::size_t material_ = 0;
};

// Calls visit(object, triangle) where the next triangle of the set-up is that of the scene.
template <class Visit>
void each_triangle(const ResidentScene& scene, SetUpWork& work, const Visit& visit) {
  for (std::size_t object = 0; object < scene.objects.size(); ++object)
    for (std::size_t triangle = 0; triangle < scene.objects[object].mesh->triangles.size() && work.next(); ++triangle)
      visit(object, triangle);
}

}  // namespace

void SoftwareParameters::declare(parameter::Table& table) {
  using parameter::About;
  const std::string moves = "budgets software";
  table.text("software.preset", preset,
             About{"",
                   "Computer that draws the same frame in software, for comparison: sets the software keys that the "
                   "file does not.",
                   moves});
  table.real("software.sustained_mflops", sustained_mflops, {0.001, 1e9},
             About{"Mflop/s", "Sustained rate of the operations that are counted.", moves});
  table.real("software.frame_us", frame_us, {0.0, 1e9}, About{"us", "Of a frame beside its triangles.", moves});
  table.real("software.triangle_us", triangle_us, {0.0, 1e9},
             About{"us", "Of a triangle that is drawn, beside its operations: calls, loops over its lines.", moves});
  table.real("software.pixel_ns", pixel_ns, {0.0, 1e9},
             About{"ns", "Of a pixel beside its operations: the loop, and what it takes to store it.", moves});
}

double software_seconds(const SoftwareParameters& parameters, const SoftwareWork& work) {
  constexpr double kMicrosecond = 1e-6;
  constexpr double kNanosecond = 1e-9;
  return parameters.frame_us * kMicrosecond +
         static_cast<double>(work.triangles) * parameters.triangle_us * kMicrosecond +
         static_cast<double>(work.pixels) * parameters.pixel_ns * kNanosecond +
         static_cast<double>(work.operations.flops()) / (parameters.sustained_mflops * 1e6);
}

SoftwareWork software_work(const Rendering& rendering, ShadingMethod method, const geometry::Pose& pose) {
  const bool phong = method == ShadingMethod::phong;
  if (!phong && method != ShadingMethod::gouraud && method != ShadingMethod::quadratic)
    throw std::invalid_argument("no software for this shading method");
  set_up::SetUpParameters set_up = rendering.set_up;
  set_up.method = phong ? ShadingMethod::gouraud : method;  // planes of a normal are those of a colour
  SetUpWork triangles(rendering.scene, set_up, rendering.format, rendering.surfaces, rendering.rules);
  span_unit::SpanUnit spans(rendering.span_unit, static_cast<std::uint32_t>(rendering.format.viewport.columns),
                            static_cast<std::uint32_t>(rendering.format.viewport.lines));
  PixelLighting pixels(rendering, pose);
  SoftwareWork work;
  triangles.begin_frame(pose, rendering.viewer_at_eye);
  each_triangle(rendering.scene, triangles, [&](std::size_t object, std::size_t triangle) {
    work.operations += triangles.operations();
    if (phong) pixels.choose(object, triangle);
    for (const set_up::ColourTriangle& coloured : triangles.coloured()) {
      if (phong) pixels.light_corners();
      const span_unit::TriangleLoad load = set_up::span_load(coloured, rendering.format.span);
      if (load.count == 0) continue;
      ++work.triangles;
      for (const span_unit::Span& span : spans.draw(load).spans) {
        work.pixels += span.count;
        if (phong) pixels.light(coloured, span);
      }
    }
  });
  const std::uint64_t additions = method == ShadingMethod::quadratic ? 6 : 3;
  work.operations += times(pixel_cost(additions), work.pixels);
  // Corners are not lit where pixels are.
  if (phong) work.operations = work.operations - pixels.corner_operations();
  work.operations += pixels.operations();
  return work;
}

}  // namespace rastertlm::host
