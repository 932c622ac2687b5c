// The pixel unit's arithmetic: shades the pixels of a triangle's spans one by one, where a span unit interpolates
// colours. Which pixels, and at which depth, is the span unit's.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "modules/pixel_unit/attribute_plane.h"
#include "modules/set_up/parameters.h"
#include "modules/span_unit/span.h"
#include "src/base/shading_method.h"
#include "src/geometry/counted.h"
#include "src/geometry/lighting.h"

namespace rastertlm::pixel_unit {

struct ShaderSettings {
  ShadingMethod method = ShadingMethod::phong;  // or duff, taylor, angular
  set_up::Attributes attributes = set_up::Attributes::linear;
  bool count = true;  // operations; the pixels are the same without
};

struct ShaderCounters {
  std::uint64_t triangles = 0;
  std::uint64_t lines = 0;  // with a pixel
  std::uint64_t pixels = 0;
  std::uint64_t not_finite = 0;  // colours of a channel that were no numbers: black
  std::uint64_t vanishing = 0;   // taylor: triangles whose normal vanishes in the centre, drawn as if they had none
  // Operations since the start of the run, where they are counted.
  geometry::OperationCounts set_up;  // of triangles: the host's
  geometry::OperationCounts line;    // from a line's start to its first pixel: the unit's
  geometry::OperationCounts pixel;   // the unit's
  std::uint64_t set_up_angles = 0;   // angular: sines, cosines and arc tangents, in the counts above as series
  std::uint64_t line_angles = 0;
};

class PixelShader {
 public:
  // Throws std::invalid_argument for a method that is no pixel's.
  PixelShader(const ShaderSettings& settings, std::vector<geometry::Reflectance> surfaces,
              const geometry::LightingRules& rules);
  ~PixelShader();
  PixelShader(PixelShader&&) noexcept;
  PixelShader& operator=(PixelShader&&) noexcept;

  // Of a frame, in eye space. `viewer_at_eye`: not infinitely far; with linear attributes it is infinitely far.
  void set_lights(std::vector<geometry::LightSource> lights, bool viewer_at_eye);
  // Corners need positions: a light is at a point, or the viewer is at the eye.
  bool needs_positions() const;

  // What a triangle's set-up costs the host with these lights, and how many words it writes for it: planes, forms or
  // edges, where the triangle is, its material.
  const geometry::OperationCounts& set_up_cost() const { return set_up_cost_; }
  std::uint64_t set_up_words() const { return set_up_words_; }

  // The next triangle. Duff's, Taylor's and the angular method have light and viewer as its centre sees them.
  void set_up(const PixelTriangle& triangle);
  // Levels of a span's pixels before they are rounded and clamped.
  void shade(const span_unit::Span& span, std::vector<glm::dvec3>& levels);
  // Levels as the frame store has them: red, green, blue from the low byte on, rounded half up and clamped.
  void shade(const span_unit::Span& span, std::vector<std::uint32_t>& levels);

  const ShaderCounters& counters() const;

 private:
  class Engine;
  template <class T>
  class EngineOf;
  std::uint64_t count_words() const;

  ShaderSettings settings_;
  std::vector<geometry::Reflectance> surfaces_;
  geometry::LightingRules rules_;
  std::unique_ptr<Engine> engine_;
  geometry::OperationCounts set_up_cost_;
  std::uint64_t set_up_words_ = 0;
  std::vector<glm::dvec3> light_;  // of a span
};

}  // namespace rastertlm::pixel_unit
