#include "modules/host/software_renderer.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "modules/pixel_unit/attribute_plane.h"
#include "modules/span_unit/span_unit.h"

namespace rastertlm::host {
namespace {

using geometry::OperationCounts;

// Values that are stepped from pixel to pixel, and the depth test.
OperationCounts pixel_cost(std::uint64_t additions) {
  OperationCounts cost;
  cost.add = additions + 1;
  cost.compare = 1;
  return cost;
}

// Of a pixel that is lit: its normal, and its position where light or viewer are at a point; in perspective both over
// w, which is stepped with them and divided by.
OperationCounts lit_pixel_cost(bool with_position, bool perspective) {
  const std::uint64_t values = with_position ? 6 : 3;
  OperationCounts cost = pixel_cost(values);
  if (!perspective) return cost;
  cost.add += 1;
  cost.divide = 1;
  cost.multiply = values;
  return cost;
}

std::uint64_t interpolated_additions(ShadingMethod method) { return method == ShadingMethod::quadratic ? 6 : 3; }

// Light at the pixels of triangles that are shaded one by one.
class PixelLighting {
 public:
  PixelLighting(const Rendering& rendering, const geometry::Pose& pose)
      : lighting_(rendering.set_up, rendering.surfaces, rendering.rules),
        // What points between corners cost by their weights is not what they cost step by step.
        between_(rendering.set_up, rendering.surfaces, rendering.rules) {
    std::vector<geometry::LightSource> lights;
    for (const geometry::Light& light : pose.lights)
      lights.push_back({light.kind == geometry::LightKind::point, light.vector, light.intensity, light.intensity});
    for (set_up::PointLighting* lighting : {&lighting_, &between_})
      lighting->set_lights(lights, rendering.viewer_at_eye);
    pixel_cost_ =
        lit_pixel_cost(lighting_.needs_positions(), rendering.set_up.attributes == set_up::Attributes::perspective);
  }

  void light(const pixel_unit::PixelTriangle& triangle, const span_unit::Span& span) {
    const auto& corners = triangle.corners;
    std::array<glm::dvec2, 3> at{};
    for (std::size_t i = 0; i < 3; ++i)
      at[i] = std::ldexp(1.0, -triangle.fraction_bits) *
              glm::dvec2(static_cast<double>(corners[i].at.x), static_cast<double>(corners[i].at.y));
    const glm::dvec2 b = at[1] - at[0];
    const glm::dvec2 c = at[2] - at[0];
    const double area = b.x * c.y - b.y * c.x;
    for (std::uint32_t pixel = 0; pixel < span.count; ++pixel) {
      const glm::dvec2 p = glm::dvec2(span.column + pixel, span.line) - at[0];
      const double second = (p.x * c.y - p.y * c.x) / area;
      const double third = (b.x * p.y - b.y * p.x) / area;
      lighting_.levels(between_.inside({&corners[0], &corners[1], &corners[2]}, {1.0 - second - third, second, third}),
                       triangle.material);
    }
  }

  // Of `pixels` that were lit.
  OperationCounts operations(std::uint64_t pixels) const {
    OperationCounts all = lighting_.operations();
    all += pixel_cost_ * pixels;
    return all;
  }

 private:
  set_up::PointLighting lighting_;
  set_up::PointLighting between_;
  OperationCounts pixel_cost_;
};

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
  table.real("software.light_us", light_us, {0.0, 1e9},
             About{"us", "Of a light at a point, beside its operations: calls, roots and powers of a library.", moves});
}

double software_seconds(const SoftwareParameters& parameters, const SoftwareWork& work) {
  constexpr double kMicrosecond = 1e-6;
  constexpr double kNanosecond = 1e-9;
  return parameters.frame_us * kMicrosecond +
         static_cast<double>(work.triangles) * parameters.triangle_us * kMicrosecond +
         static_cast<double>(work.pixels) * parameters.pixel_ns * kNanosecond +
         static_cast<double>(work.lights) * parameters.light_us * kMicrosecond +
         static_cast<double>(work.operations.flops()) / (parameters.sustained_mflops * 1e6);
}

bool has_software(ShadingMethod method) {
  switch (method) {
    case ShadingMethod::gouraud:
    case ShadingMethod::quadratic:
    case ShadingMethod::highlight_subdivision:
    case ShadingMethod::regular_subdivision:
    case ShadingMethod::gouraud_phong:
    case ShadingMethod::phong:
      return true;
    default:
      return false;
  }
}

SoftwareWork& SoftwareWork::operator+=(const SoftwareWork& other) {
  triangles += other.triangles;
  pixels += other.pixels;
  lit_pixels += other.lit_pixels;
  lights += other.lights;
  operations += other.operations;
  return *this;
}

SoftwareWork software_work(const Rendering& rendering, ShadingMethod method, const geometry::Pose& pose) {
  if (!has_software(method)) throw std::invalid_argument("no software for this shading method");
  set_up::SetUpParameters set_up = rendering.set_up;
  set_up.method = method;
  SetUpWork triangles(rendering.scene, set_up, rendering.format, rendering.surfaces, rendering.rules);
  span_unit::SpanUnit spans(rendering.span_unit, static_cast<std::uint32_t>(rendering.format.viewport.columns),
                            static_cast<std::uint32_t>(rendering.format.viewport.lines));
  PixelLighting pixels(rendering, pose);
  SoftwareWork work;
  triangles.begin_frame(pose, rendering.viewer_at_eye);
  while (triangles.next()) {
    work.operations += triangles.operations();
    for (const span_unit::TriangleLoad& load : triangles.loads()) {
      ++work.triangles;
      for (const span_unit::Span& span : spans.draw(load).spans) {
        work.pixels += span.count;
        if (load.shading == nullptr) continue;
        work.lit_pixels += span.count;
        pixels.light(*load.shading, span);
      }
    }
  }
  work.lights = (triangles.counts().lighting.evaluations + work.lit_pixels) * pose.lights.size();
  work.operations += pixel_cost(interpolated_additions(method)) * (work.pixels - work.lit_pixels);
  work.operations += pixels.operations(work.lit_pixels);
  return work;
}

}  // namespace rastertlm::host
