// The set-up processor's work: from a scene's triangles to a span unit's loads, triangle by triangle, with what each
// costs. Everything is computed for every frame, because the frame store is drawn anew.
#pragma once

#include <cstdint>
#include <deque>
#include <glm/mat4x4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "modules/host/path_counts.h"
#include "modules/host/resident_scene.h"
#include "modules/host/shared_vertices.h"
#include "modules/pixel_unit/pixel_shader.h"
#include "modules/set_up/colour_steps.h"
#include "modules/set_up/highlight_classifier.h"
#include "modules/set_up/load_words.h"
#include "modules/set_up/parameters.h"
#include "modules/set_up/pieces.h"
#include "modules/set_up/point_lighting.h"
#include "modules/set_up/span_load.h"
#include "modules/set_up/triangle_batch.h"
#include "modules/set_up/triangle_colourer.h"
#include "src/geometry/frame_grid.h"
#include "src/geometry/lighting.h"

namespace rastertlm::host {

struct SetUpFormat {
  geometry::Viewport viewport;
  unsigned depth_bits = 24;
  set_up::SpanFormat span;
};

// What became of a frame's triangles, and what that took. A triangle is whole: it faces the viewer where any of its
// pieces is to be drawn, and has no area where none has. triangles = facing + back_faces + degenerate + outside.
struct SetUpCounts {
  std::uint64_t triangles = 0;  // of the scene
  std::uint64_t facing = 0;     // the viewer, or two-sided
  std::uint64_t back_faces = 0;
  std::uint64_t degenerate = 0;  // on the grid
  std::uint64_t outside = 0;     // of the view
  std::uint64_t pieces = 0;      // more than one a triangle, from clipping
  std::uint64_t loads = 0;
  set_up::LoadWords words;
  std::uint64_t shaded = 0;               // of the loads: by a pixel unit
  std::uint64_t wraps = 0;                // loads whose slopes a prestep's products cannot take
  set_up::ColourCounts colour;            // of pieces and of what they are split into, one by one
  set_up::ClassifiedCounts classified;    // methods of 003
  set_up::SubdivisionCounts subdivision;  // likewise
  set_up::StitchCounts stitched;          // likewise
  set_up::LightingCounts lighting;
  geometry::OperationCounts operations;
};

class SetUpWork {
 public:
  SetUpWork(const ResidentScene& scene, const set_up::SetUpParameters& parameters, const SetUpFormat& format,
            std::vector<geometry::Reflectance> surfaces, const geometry::LightingRules& rules);

  // `viewer_at_eye`: the view is perspective, and the viewer not infinitely far.
  void begin_frame(const geometry::Pose& pose, bool viewer_at_eye);
  // The next triangle of the frame. False where there is none left.
  bool next();

  // Of the triangle: what is drawn of it, none where it is not seen.
  const std::vector<set_up::ColourTriangle>& coloured() const { return coloured_; }
  std::span<const span_unit::TriangleLoad> loads() const { return {room_.data(), load_count_}; }
  const geometry::OperationCounts& operations() const { return triangle_operations_; }
  // A pixel unit's are counted in.
  set_up::LoadWords words_of(const span_unit::TriangleLoad& load) const;
  // Of a machine whose method shades pixels; else null. It knows the frame's lights from begin_frame() on.
  pixel_unit::PixelShader* shader() const { return shader_.get(); }
  const set_up::LoadWidths& widths() const { return widths_; }

  // Of the frame so far.
  SetUpCounts counts() const;
  // Of a frame that has been computed, where the method splits triangles.
  set_up::ColourSteps colour_steps() const;
  const geometry::FrameGrid& grid() const { return grid_; }

 private:
  using Number = geometry::Counted<double>;
  void transform_block();
  set_up::Pieces<double> pieces_of(std::size_t object, std::size_t triangle, bool& cut) const;
  set_up::Pieces<double> pieces_counted(std::size_t object, std::size_t triangle);
  void count_pieces() const;
  bool is_highlighted(std::size_t object, std::size_t triangle) const;
  void survey();
  void fill_request(const set_up::ScreenTriangle<double>& piece, std::size_t object, std::size_t triangle);
  void colour(const set_up::ScreenTriangle<double>& piece, std::size_t object, std::size_t triangle);
  glm::dvec3 eye_position(const geometry::ScreenVertex<double>& corner) const;
  void count_paths();
  void classify();
  void light_vertices();
  void give_shading();
  void count_outcome(std::size_t pieces, std::uint64_t back_faces_before);

  const ResidentScene& scene_;
  set_up::SetUpParameters parameters_;
  SetUpFormat format_;
  bool linear_;
  set_up::LoadWidths widths_;
  geometry::FrameGrid grid_;
  double near_word_;
  double depth_range_;
  set_up::PointLighting lighting_;
  set_up::TriangleColourer colourer_;
  set_up::SpanLoadCosts load_costs_;
  geometry::OperationCounts inside_cost_;     // a triangle's corners to the screen, none outside the band
  geometry::OperationCounts uncut_cost_;      // of it, what is left where vertices are placed by themselves
  geometry::OperationCounts vertex_cost_;     // one to the screen
  geometry::OperationCounts corner_cost_;     // one to the grid, and its depth word
  geometry::OperationCounts position_cost_;   // one, where lights need it
  geometry::OperationCounts corner_costs_;    // all three to the grid, and their depth words
  geometry::OperationCounts position_costs_;  // the corners', where lights need them

  geometry::Pose pose_;
  glm::dmat4 clip_to_eye_{1.0};
  std::vector<glm::dmat4> object_to_clip_;
  std::size_t object_ = 0;
  std::size_t triangle_ = 0;
  std::uint32_t number_ = 0;                      // of the next triangle in the scene
  geometry::OperationCounts waiting_operations_;  // of the frame's matrices, charged to its first triangle
  geometry::OperationCounts triangle_operations_;
  set_up::ColourCounts colour_start_;
  set_up::SubdivisionCounts subdivision_start_;
  set_up::StitchCounts stitch_start_;
  set_up::LightingCounts lighting_start_;
  std::vector<set_up::HighlightClassifier> classifiers_;  // an object each, for methods that need them
  std::vector<const std::vector<set_up::Highlighted>*> highlighted_;
  std::unique_ptr<SharedVertices> vertices_;  // where they are shared
  std::array<set_up::PointLighting::Levels, 3> lit_corners_{};
  bool whole_ = true;  // nothing was cut from the triangle: its corners are vertices
  std::unique_ptr<pixel_unit::PixelShader> shader_;
  std::deque<pixel_unit::PixelTriangle> shadings_;  // of the frame
  set_up::SpanLoadCosts depth_costs_;
  // Eight triangles of an object at a time: those that lie on the screen are not clipped one by one.
  const set_up::TriangleKernels& kernels_;
  set_up::ObjectCorners block_;
  set_up::ScreenCorners screen_;
  unsigned inside_ = 0;  // of the block, a bit a triangle

  std::vector<set_up::ColourTriangle> coloured_;
  std::vector<set_up::ColourTriangle> frame_;  // all of the frame's, where some may have been split
  std::vector<span_unit::TriangleLoad> room_;
  std::size_t load_count_ = 0;     // of them are the triangle's
  set_up::ColourRequest request_;  // of the last triangle
  SetUpCounts counts_;
};

// The grid that corners are moved to, and the band around the screen that triangles are clipped to: the screen's size
// on each side, where the span unit steps over what it does not show.
geometry::SnapGrids span_grids(const geometry::Viewport& viewport, int fraction_bits);

}  // namespace rastertlm::host
