#include "modules/pixel_unit/pixel_shader.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "modules/pixel_unit/angular_form.h"
#include "modules/pixel_unit/light_sum.h"
#include "modules/pixel_unit/normal_steps.h"
#include "modules/pixel_unit/quotient_form.h"
#include "src/base/fixed_point.h"

namespace rastertlm::pixel_unit {
namespace {

constexpr double kFullScale = 255.0;

// Adds what passed since it was made.
class Charge {
 public:
  Charge(geometry::OperationCounts& to, std::uint64_t& angles)
      : to_(to), angles_(angles), before_(geometry::operation_counts), angles_before_(angle_functions) {}
  ~Charge() {
    to_ += geometry::operation_counts - before_;
    angles_ += angle_functions - angles_before_;
  }
  Charge(const Charge&) = delete;
  Charge& operator=(const Charge&) = delete;

 private:
  geometry::OperationCounts& to_;
  std::uint64_t& angles_;
  geometry::OperationCounts before_;
  std::uint64_t angles_before_;
};

std::uint32_t level_of(double level) {
  return static_cast<std::uint32_t>(round_half_up(std::clamp(level, 0.0, kFullScale)));
}

}  // namespace

// Without its number type.
class PixelShader::Engine {
 public:
  virtual ~Engine() = default;
  virtual void set_lights(std::vector<geometry::LightSource> lights, bool viewer_at_eye) = 0;
  virtual bool needs_positions() const = 0;
  // Dot products of a pixel, and other numbers of a triangle's lights, where they are not the frame's.
  virtual std::size_t vectors() const = 0;
  virtual std::size_t constants() const = 0;
  virtual void set_up(const PixelTriangle& triangle) = 0;
  virtual void shade(const span_unit::Span& span, std::vector<glm::dvec3>& levels) = 0;
  ShaderCounters counters;
};

template <class T>
class PixelShader::EngineOf : public PixelShader::Engine {
 public:
  EngineOf(const ShaderSettings& settings, std::vector<geometry::Reflectance> surfaces,
           const geometry::LightingRules& rules)
      : settings_(settings), surfaces_(std::move(surfaces)), rules_(rules) {}

  void set_lights(std::vector<geometry::LightSource> lights, bool viewer_at_eye) override {
    lights_ = std::move(lights);
    needs_.perspective = settings_.attributes == set_up::Attributes::perspective;
    viewer_at_eye_ = viewer_at_eye && needs_.perspective;
    needs_.positions =
        viewer_at_eye_ || std::any_of(lights_.begin(), lights_.end(), [](const auto& l) { return l.at_point; });
    lit_.clear();
    for (const geometry::Reflectance& surface : surfaces_) lit_.push_back(lit_surface(surface, lights_, rules_));
    see_lights(lights_, rules_.model, vector_of<T>({0, 0, 0}), vector_of<T>({0, 0, 1}), seen_);
    note_vectors();
  }
  bool needs_positions() const override { return needs_.positions; }
  std::size_t vectors() const override { return vectors_.size(); }
  std::size_t constants() const override { return needs_.positions ? seen_.light_viewer.size() : 0; }

  void set_up(const PixelTriangle& triangle) override {
    const Charge charge(counters.set_up, counters.set_up_angles);
    ++counters.triangles;
    material_ = triangle.material;
    fraction_bits_ = triangle.fraction_bits;
    origin_ = triangle.corners[0].at;
    const bool angular = settings_.method == ShadingMethod::angular;
    AttributePlanes<T> planes;
    if (!angular || needs_.positions) planes = attribute_planes<T>(triangle, needs_);
    if (settings_.method == ShadingMethod::phong)
      return normals_.set_up(planes, needs_, lights_, rules_.model, viewer_at_eye_,
                             needs_.positions ? nullptr : &seen_);
    if (needs_.positions) see_from_centre(planes);
    if (angular) return angles_.set_up(triangle, vectors_);
    if (settings_.method == ShadingMethod::duff) return quotients_.set_up(planes.normal, vectors_);
    if (!series_.set_up(planes.normal, planes.centre_x, planes.centre_y, vectors_)) ++counters.vanishing;
  }

  void shade(const span_unit::Span& span, std::vector<glm::dvec3>& levels) override {
    levels.resize(span.count);
    if (span.count == 0) return;
    ++counters.lines;
    counters.pixels += span.count;
    if (settings_.method == ShadingMethod::phong) return run(normals_, span, levels);
    if (settings_.method == ShadingMethod::duff) return run(quotients_, span, levels);
    if (settings_.method == ShadingMethod::taylor) return run(series_, span, levels);
    run(angles_, span, levels);
  }

 private:
  // Constant vectors of dot products: those towards lights, then those that make highlights.
  void note_vectors() {
    vectors_ = seen_.towards;
    vectors_.insert(vectors_.end(), seen_.highlight.begin(), seen_.highlight.end());
    dots_.assign(std::max<std::size_t>(vectors_.size(), 1), T(0.0));
    cosines_.assign(lights_.size(), {T(0.0), T(0.0)});
  }

  void see_from_centre(const AttributePlanes<T>& planes) {
    Vector3<T> position = value_at(planes.position, planes.centre_x, planes.centre_y);
    if (needs_.perspective)
      position = scaled(position, T(1.0) / value_at(planes.inverse_w, planes.centre_x, planes.centre_y));
    const Vector3<T> viewer =
        viewer_at_eye_ ? geometry::normalised<T>(scaled(position, T(-1.0))) : vector_of<T>({0, 0, 1});
    see_lights(lights_, rules_.model, position, viewer, seen_);
    note_vectors();
  }

  template <class Steps>
  void run(Steps& steps, const span_unit::Span& span, std::vector<glm::dvec3>& levels) {
    {
      const Charge charge(counters.line, counters.line_angles);
      const double unit = 1.0 / static_cast<double>(std::int64_t{1} << fraction_bits_);
      const auto pixels = [&](std::uint32_t pixel, std::int64_t origin) {
        const std::int64_t position = static_cast<std::int64_t>(pixel) << fraction_bits_;
        geometry::charge_integer<T>(2, 0);
        return geometry::from_integer<T>(position - origin) * T(unit);
      };
      steps.begin_line(pixels(span.column, origin_.x), pixels(span.line, origin_.y));
    }
    const Charge charge(counters.pixel, counters.line_angles);
    for (std::uint32_t n = 0; n < span.count; ++n) {
      if (n > 0) steps.step();
      find_cosines(steps);
      const Vector3<T> light = light_sum(lit_[material_], cosines_);
      for (int c = 0; c < 3; ++c) {
        double level = geometry::plain(light[c] * T(kFullScale));
        if (!std::isfinite(level)) {
          ++counters.not_finite;
          level = 0.0;
        }
        levels[n][c] = level;
      }
    }
  }
  void find_cosines(NormalSteps<T>& steps) { steps.cosines(dots_, cosines_); }
  template <class Steps>
  void find_cosines(Steps& steps) {
    cosines_from(dots_, seen_, steps.dots(dots_), cosines_);
  }

  ShaderSettings settings_;
  std::vector<geometry::Reflectance> surfaces_;
  geometry::LightingRules rules_;
  std::vector<geometry::LightSource> lights_;
  bool viewer_at_eye_ = false;
  PlaneNeeds needs_;
  std::vector<LitSurface> lit_;
  SeenLights<T> seen_;  // of everywhere, or of the triangle's centre
  std::vector<Vector3<T>> vectors_;
  std::size_t material_ = 0;
  int fraction_bits_ = 0;
  geometry::SnappedPoint origin_;
  NormalSteps<T> normals_;
  Quotients<T> quotients_;
  Series<T> series_;
  AngularSteps<T> angles_;
  std::vector<T> dots_;
  std::vector<Cosines<T>> cosines_;
};

PixelShader::PixelShader(const ShaderSettings& settings, std::vector<geometry::Reflectance> surfaces,
                         const geometry::LightingRules& rules)
    : settings_(settings), surfaces_(surfaces), rules_(rules) {
  if (!shades_pixels(settings.method))
    throw std::invalid_argument(std::string(traits_of(settings.method).name) + " is no method of a pixel unit");
  if (settings.count)
    engine_ = std::make_unique<EngineOf<geometry::Counted<double>>>(settings, std::move(surfaces), rules);
  else
    engine_ = std::make_unique<EngineOf<double>>(settings, std::move(surfaces), rules);
}

PixelShader::~PixelShader() = default;
PixelShader::PixelShader(PixelShader&&) noexcept = default;
PixelShader& PixelShader::operator=(PixelShader&&) noexcept = default;

namespace {

// Like any other: no edge is level, nothing vanishes.
PixelTriangle usual_triangle() {
  PixelTriangle triangle;
  triangle.fraction_bits = 4;
  const geometry::SnappedPoint at[] = {{0, 0}, {16, 160}, {160, 80}};
  const glm::dvec3 normals[] = {{0.1, 0.0, 1.0}, {0.0, 0.1, 1.0}, {-0.1, -0.1, 1.0}};
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.corners[i].at = at[i];
    triangle.corners[i].normal = normals[i];
    triangle.corners[i].position = {0.1 * static_cast<double>(i), 0.0, -3.0};
  }
  return triangle;
}

}  // namespace

void PixelShader::set_lights(std::vector<geometry::LightSource> lights, bool viewer_at_eye) {
  EngineOf<geometry::Counted<double>> usual(settings_, surfaces_, rules_);
  usual.set_lights(lights, viewer_at_eye);
  usual.set_up(usual_triangle());
  set_up_cost_ = usual.counters.set_up;
  engine_->set_lights(std::move(lights), viewer_at_eye);
  set_up_words_ = count_words();
}

std::uint64_t PixelShader::count_words() const {
  constexpr std::uint64_t kPlane = 3, kForm = 6, kEdge = 11;  // upper end, slope, 1 / height, two normals, angle
  constexpr std::uint64_t kPlaceAndMaterial = 3;
  const std::uint64_t vectors = engine_->vectors();
  const bool seen_from_centre = engine_->needs_positions();
  switch (settings_.method) {
    case ShadingMethod::phong: {
      const std::uint64_t inverse_w = settings_.attributes == set_up::Attributes::perspective ? kPlane : 0;
      return kPlaceAndMaterial + 3 * kPlane + (seen_from_centre ? 3 * kPlane + inverse_w : 0);
    }
    case ShadingMethod::duff:
      return kPlaceAndMaterial + kForm + vectors * kPlane + engine_->constants();
    case ShadingMethod::taylor:
      return kPlaceAndMaterial + vectors * kForm + engine_->constants();
    default:
      return kPlaceAndMaterial + 3 * kEdge + (seen_from_centre ? 3 * vectors : 0) + engine_->constants();
  }
}

bool PixelShader::needs_positions() const { return engine_->needs_positions(); }
void PixelShader::set_up(const PixelTriangle& triangle) { engine_->set_up(triangle); }
void PixelShader::shade(const span_unit::Span& span, std::vector<glm::dvec3>& levels) { engine_->shade(span, levels); }

void PixelShader::shade(const span_unit::Span& span, std::vector<std::uint32_t>& levels) {
  engine_->shade(span, light_);
  levels.resize(light_.size());
  for (std::size_t n = 0; n < light_.size(); ++n)
    levels[n] = level_of(light_[n].x) | level_of(light_[n].y) << 8U | level_of(light_[n].z) << 16U;
}

const ShaderCounters& PixelShader::counters() const { return engine_->counters; }

}  // namespace rastertlm::pixel_unit
