#include "src/reference/renderer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/base/errors.h"
#include "src/geometry/lighting.h"
#include "src/reference/coverage.h"
#include "src/reference/pieces.h"

namespace rastertlm::reference {
namespace {

using geometry::LightSource;
using geometry::Reflectance;

// What is seen at a pixel, kept until every piece is drawn: only that is shaded.
struct Seen {
  std::uint32_t piece = 0;            // index + 1; 0 nothing
  std::uint32_t last_covered_by = 0;  // the last triangle that was counted
  std::array<double, 2> weights{};
};

double interpolated(double a, double b, double c, const std::array<double, 2>& weights) {
  return a + weights[0] * (b - a) + weights[1] * (c - a);
}

glm::dvec3 interpolated(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                        const std::array<double, 2>& weights) {
  return a + weights[0] * (b - a) + weights[1] * (c - a);
}

// Corner positions in the number type of the edge functions, and the distance of two samples.
Coverage<std::int64_t> snapped_coverage(const Piece& piece, int fraction_bits) {
  std::array<Point<std::int64_t>, 3> points;
  for (std::size_t i = 0; i < 3; ++i) points[i] = {piece.snapped[i].x, piece.snapped[i].y};
  return {points, std::int64_t{1} << fraction_bits};
}

Coverage<double> plain_coverage(const Piece& piece) {
  std::array<Point<double>, 3> points;
  for (std::size_t i = 0; i < 3; ++i) points[i] = {piece.corners[i].x, piece.corners[i].y};
  return {points, 1.0};
}

template <class N>
void draw(const Piece& piece, std::uint32_t index, const Coverage<N>& coverage, frame::ExactFrame& out,
          std::vector<Seen>& seen) {
  const auto& [a, b, c] = piece.corners;
  const Span lines = coverage.lines(out.lines);
  for (std::int64_t y = lines.begin; y < lines.end; ++y) {
    const Span span = coverage.span(y, out.columns);
    for (std::int64_t x = span.begin; x < span.end; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * out.columns + static_cast<std::size_t>(x);
      Seen& here = seen[pixel];
      if (here.last_covered_by != piece.object) ++out.coverage[pixel];
      here.last_covered_by = piece.object;
      const std::array<double, 2> weights = coverage.weights(x, y);
      const double depth = std::clamp(interpolated(a.z, b.z, c.z, weights), 0.0, 1.0);
      if (here.piece != 0 && !(depth < out.depth[pixel])) continue;
      here.piece = index + 1;
      here.weights = weights;
      out.depth[pixel] = depth;
      out.object[pixel] = piece.object;
    }
  }
}

class Shader {
 public:
  Shader(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options) : kind_(options.kind) {
    rules_ = {scene.model == scene::LightingModel::phong ? geometry::Model::phong : geometry::Model::blinn,
              scene.specular_gate, scene.ambient_light};
    viewer_at_eye_ = kind_ == Reference::true_model && scene.camera.projection == scene::ProjectionKind::perspective;
    for (const scene::Material& m : scene.materials)
      surfaces_.push_back({m.ambient * m.colour, m.diffuse * m.colour, glm::dvec3(m.specular), m.exponent});
    for (const scene::Light& light : pose.lights) {
      const bool at_point = light.kind == scene::LightKind::point;
      any_at_point_ = any_at_point_ || at_point;
      if (at_point && kind_ != Reference::true_model && !options.lights_at_points)
        throw InputError(Diagnostic{
            "", 0, "light.type", "a light at a point is not in the machine's model; only the true reference has it"});
      const double mean = (light.intensity.x + light.intensity.y + light.intensity.z) / 3.0;
      lights_.push_back(
          {at_point, light.vector, light.intensity, options.specular_mean ? glm::dvec3(mean) : light.intensity});
    }
  }

  // 0..255, not rounded.
  glm::dvec3 levels(const Piece& piece, const std::array<double, 2>& on_screen) const {
    glm::dvec3 viewer(0.0, 0.0, 1.0);
    glm::dvec3 position(0.0);
    std::array<double, 2> weights = on_screen;
    if (kind_ == Reference::true_model) weights = on_surface(piece, on_screen);
    if (kind_ == Reference::true_model || any_at_point_) {
      position = interpolated(piece.eye_positions[0], piece.eye_positions[1], piece.eye_positions[2], weights);
      if (viewer_at_eye_) viewer = geometry::normalised<double>(-position);
    }
    const auto& [a, b, c] = piece.corners;
    const glm::dvec3 normal = geometry::normalised<double>(interpolated(a.normal, b.normal, c.normal, weights));
    const glm::dvec3 light = geometry::illumination<double>(
        surfaces_[piece.material], std::span<const LightSource>(lights_), rules_, normal, viewer, position);
    return {std::clamp(255.0 * light.x, 0.0, 255.0), std::clamp(255.0 * light.y, 0.0, 255.0),
            std::clamp(255.0 * light.z, 0.0, 255.0)};
  }

 private:
  // Weights that are linear on the screen, made linear on the surface: each times 1/w of its corner.
  static std::array<double, 2> on_surface(const Piece& piece, const std::array<double, 2>& weights) {
    const double first = (1.0 - weights[0] - weights[1]) * piece.corners[0].inverse_w;
    const double second = weights[0] * piece.corners[1].inverse_w;
    const double third = weights[1] * piece.corners[2].inverse_w;
    const double sum = first + second + third;
    return {second / sum, third / sum};
  }

  Reference kind_;
  geometry::LightingRules rules_;
  bool viewer_at_eye_ = false;
  bool any_at_point_ = false;
  std::vector<Reflectance> surfaces_;
  std::vector<LightSource> lights_;
};

}  // namespace

std::string to_string(Reference reference) {
  switch (reference) {
    case Reference::ideal:
      return "ideal";
    case Reference::snapped:
      return "snapped";
    case Reference::true_model:
      return "true";
  }
  return "";
}

frame::ExactFrame render(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options) {
  const Shader shader(scene, pose, options);
  const Pieces drawn = pieces(scene, pose, options);
  frame::ExactFrame out;
  out.resize(options.columns, options.lines);
  std::vector<Seen> seen(out.pixels());
  for (std::size_t i = 0; i < drawn.list.size(); ++i) {
    const Piece& piece = drawn.list[i];
    const auto index = static_cast<std::uint32_t>(i);
    if (options.kind == Reference::snapped)
      draw(piece, index, snapped_coverage(piece, drawn.grid.grid.fraction_bits), out, seen);
    else
      draw(piece, index, plain_coverage(piece), out, seen);
  }
  for (std::size_t pixel = 0; pixel < out.pixels(); ++pixel) {
    const Seen& here = seen[pixel];
    const glm::dvec3 levels =
        here.piece == 0 ? scene.background : shader.levels(drawn.list[here.piece - 1], here.weights);
    for (int c = 0; c < 3; ++c) out.rgb[3 * pixel + static_cast<std::size_t>(c)] = levels[c];
  }
  return out;
}

}  // namespace rastertlm::reference
