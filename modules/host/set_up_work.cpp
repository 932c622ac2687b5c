#include "modules/host/set_up_work.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

#include "modules/host/corners.h"
#include "modules/set_up/word_format.h"

namespace rastertlm::host {
namespace {

using geometry::operation_counts;
using geometry::OperationCounts;

template <class Body>
OperationCounts counted(const Body& body) {
  const OperationCounts before = operation_counts;
  body();
  return operation_counts - before;
}

set_up::WordFormat depth_format(const SetUpFormat& format) {
  return {static_cast<int>(format.depth_bits), format.viewport.columns, format.viewport.lines,
          set_up::EdgeForm::snapped};
}

// What has been counted since: every count.
template <class Counts>
Counts since(const Counts& now, const Counts& then);
template <>
set_up::ColourCounts since(const set_up::ColourCounts& now, const set_up::ColourCounts& then) {
  return {now.drawn - then.drawn,
          now.back_faces - then.back_faces,
          now.degenerate - then.degenerate,
          now.flat_low - then.flat_low,
          now.flat_undefined - then.flat_undefined,
          now.splits - then.splits,
          now.at_limit - then.at_limit,
          now.tests - then.tests};
}
template <>
set_up::SubdivisionCounts since(const set_up::SubdivisionCounts& now, const set_up::SubdivisionCounts& then) {
  return {now.divided - then.divided,   now.parts - then.parts,
          now.centres - then.centres,   now.beside - then.beside,
          now.unfound - then.unfound,   now.inserted - then.inserted,
          now.at_limit - then.at_limit, now.at_grid_limit - then.at_grid_limit};
}
template <>
set_up::StitchCounts since(const set_up::StitchCounts& now, const set_up::StitchCounts& then) {
  return {now.triangles - then.triangles, now.corners - then.corners};
}
template <>
set_up::LightingCounts since(const set_up::LightingCounts& now, const set_up::LightingCounts& then) {
  return {now.evaluations - then.evaluations, now.clamped_knots - then.clamped_knots, now.not_finite - then.not_finite};
}

set_up::LoadWidths widths_of(const set_up::SetUpParameters& parameters, const SetUpFormat& format) {
  return set_up::load_widths(format.viewport.columns, format.viewport.lines,
                             static_cast<unsigned>(parameters.corner_bits()), format.span.word_bits,
                             format.depth_bits + format.span.depth_fraction_bits);
}

}  // namespace

geometry::SnapGrids span_grids(const geometry::Viewport& viewport, int fraction_bits) {
  const geometry::SnapGrid grid{fraction_bits, static_cast<std::int64_t>(viewport.columns),
                                static_cast<std::int64_t>(viewport.lines)};
  return {grid, grid};
}

SetUpWork::SetUpWork(const ResidentScene& scene, const set_up::SetUpParameters& parameters, const SetUpFormat& format,
                     std::vector<geometry::Reflectance> surfaces, const geometry::LightingRules& rules)
    : scene_(scene),
      parameters_(parameters),
      format_(format),
      linear_(parameters.linear()),
      widths_(widths_of(parameters, format)),
      grid_(geometry::frame_grid(span_grids(format.viewport, static_cast<int>(parameters.snap_bits)), true,
                                 format.viewport)),
      near_word_(static_cast<double>(set_up::near_depth(depth_format(format)))),
      depth_range_(static_cast<double>(set_up::far_depth(depth_format(format))) - near_word_),
      lighting_(parameters, surfaces, rules),
      colourer_(parameters, lighting_),
      load_costs_(set_up::span_load_costs(linear_)),
      object_to_clip_(scene.objects.size()),
      kernels_(set_up::triangle_kernels(vector_variant())) {
  count_paths();
  if (parameters.classifies())
    for (const auto& object : scene.objects) classifiers_.emplace_back(*object.mesh, surfaces);
  if (parameters.shades_some_pixels()) {
    depth_costs_ = set_up::depth_load_costs();
    const bool chosen = parameters.method == ShadingMethod::gouraud_phong;
    shader_ = std::make_unique<pixel_unit::PixelShader>(
        pixel_unit::ShaderSettings{chosen ? ShadingMethod::phong : parameters.method, parameters.attributes, true},
        std::move(surfaces), rules);
  }
  if (parameters.vertices == set_up::Vertices::shared) vertices_ = std::make_unique<SharedVertices>(scene);
}

void SetUpWork::count_paths() {
  const geometry::FrameGrid grid = grid_;
  inside_cost_ = counted([&] {
    glm::dmat4 middle(1.0);
    middle[3] = {0.0, 0.0, 0.5, 1.0};
    geometry::ClipTriangle<Number> triangle;
    for (auto& vertex : triangle)
      vertex = set_up::transform_vertex<Number>(glm::dvec3(0.0), glm::dvec3(0, 0, 1), middle, glm::dmat3(1.0));
    set_up::pieces(triangle, grid, format_.viewport);
  });
  constexpr std::uint64_t kCorners = 3;
  vertex_cost_ = counted([&] {
    glm::dmat4 middle(1.0);
    middle[3] = {0.0, 0.0, 0.5, 1.0};
    geometry::to_screen(set_up::transform_vertex<Number>(glm::dvec3(0.0), glm::dvec3(0, 0, 1), middle, glm::dmat3(1.0)),
                        format_.viewport);
  });
  // Where the vertices are on the screen already, their part is not done again.
  uncut_cost_ =
      parameters_.vertices == set_up::Vertices::shared ? inside_cost_ - vertex_cost_ * kCorners : inside_cost_;
  corner_cost_.multiply = 3;  // two coordinates onto the grid, and depth
  corner_cost_.add = 1;
  corner_cost_.convert = 2;
  position_cost_.multiply = 12 + 3;
  position_cost_.add = 12;
  position_cost_.divide = 1;
  corner_costs_ = corner_cost_ * kCorners;
  position_costs_ = position_cost_ * kCorners;
}

void SetUpWork::begin_frame(const geometry::Pose& pose, bool viewer_at_eye) {
  pose_ = pose;
  std::vector<geometry::LightSource> lights;
  for (const geometry::Light& light : pose.lights)
    lights.push_back({light.kind == geometry::LightKind::point, light.vector, light.intensity, light.intensity});
  shadings_.clear();
  if (shader_) shader_->set_lights(lights, viewer_at_eye);
  lighting_.set_lights(std::move(lights), viewer_at_eye);
  clip_to_eye_ = glm::inverse(pose.eye_to_clip);
  waiting_operations_ = {};
  const OperationCounts matrix = counted([] { matrix_product<Number>(glm::dmat4(1.0), glm::dmat4(1.0)); });
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    object_to_clip_[i] = matrix_product<double>(pose.eye_to_clip, pose.object_to_eye[i]);
    waiting_operations_ += matrix;
  }
  frame_.clear();
  object_ = triangle_ = 0;
  number_ = 0;
  counts_ = {};
  colour_start_ = colourer_.counts();
  subdivision_start_ = colourer_.subdivision();
  stitch_start_ = colourer_.stitched();
  lighting_start_ = lighting_.counts();
  if (vertices_) light_vertices();
  if (parameters_.classifies()) classify();
  if (parameters_.stitches()) survey();
}

// All of them, before any triangle: charged to the first. Where every pixel is lit, no vertex is.
void SetUpWork::light_vertices() {
  waiting_operations_ += vertex_cost_ * vertices_->size();
  waiting_operations_ += corner_cost_ * vertices_->size();
  if (lighting_.needs_positions()) waiting_operations_ += position_cost_ * vertices_->size();
  if (shades_pixels(parameters_.method)) return;
  const OperationCounts before = lighting_.operations();
  vertices_->light(pose_, lighting_);
  waiting_operations_ += lighting_.operations() - before;
}

// Before any triangle is drawn: what it takes is charged to the first.
void SetUpWork::classify() {
  highlighted_.clear();
  for (std::size_t i = 0; i < classifiers_.size(); ++i) {
    highlighted_.push_back(&classifiers_[i].classify(
        pose_.object_to_eye[i], {lighting_.lights(), lighting_.viewer_at_eye()}, parameters_.rings_treated()));
    counts_.classified += classifiers_[i].counts();
    waiting_operations_ += classifiers_[i].operations();
  }
}

bool SetUpWork::is_highlighted(std::size_t object, std::size_t triangle) const {
  return !highlighted_.empty() && (*highlighted_[object])[triangle] != set_up::Highlighted::no;
}

// Where triangles are stitched to those beside them, what may hold a highlight is cut up before any triangle is drawn.
// Charged to the first, too.
void SetUpWork::survey() {
  colourer_.begin_frame();
  const OperationCounts colouring = colourer_.operations();
  triangle_operations_ = {};
  for (object_ = 0; object_ < scene_.objects.size(); ++object_)
    for (triangle_ = 0; triangle_ < scene_.objects[object_].mesh->triangles.size(); ++triangle_) {
      ++number_;
      if (!is_highlighted(object_, triangle_)) continue;
      for (const auto& piece : pieces_counted(object_, triangle_).list()) {
        fill_request(piece, object_, triangle_);
        colourer_.cut(request_);
      }
    }
  waiting_operations_ += triangle_operations_;
  waiting_operations_ += colourer_.operations() - colouring;
  object_ = triangle_ = 0;
  number_ = 0;
}

// What nothing is cut from costs what all such triangles do; others are computed once more, counting.
set_up::Pieces<double> SetUpWork::pieces_counted(std::size_t object, std::size_t triangle) {
  bool cut = false;
  const set_up::Pieces<double> pieces = pieces_of(object, triangle, cut);
  triangle_operations_ += cut ? counted([&] { count_pieces(); }) : uncut_cost_;
  whole_ = !cut;
  return pieces;
}

set_up::Pieces<double> SetUpWork::pieces_of(std::size_t object, std::size_t triangle, bool& cut) const {
  const geometry::Mesh& mesh = *scene_.objects[object].mesh;
  geometry::ClipTriangle<double> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t corner = mesh.triangles[triangle][i];
    corners[i] = set_up::transform_vertex<double>(mesh.positions[corner], mesh.normals[corner], object_to_clip_[object],
                                                  pose_.normal_to_eye[object]);
  }
  cut = std::any_of(corners.begin(), corners.end(),
                    [&](const auto& corner) { return geometry::outcode(corner.position, grid_.volume) != 0; });
  return set_up::pieces(corners, grid_, format_.viewport);
}

void SetUpWork::transform_block() {
  const geometry::Mesh& mesh = *scene_.objects[object_].mesh;
  const std::size_t count = std::min(set_up::kLanes, mesh.triangles.size() - triangle_);
  for (std::size_t lane = 0; lane < count; ++lane)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = mesh.triangles[triangle_ + lane][i];
      for (int c = 0; c < 3; ++c) {
        block_.position[i][static_cast<std::size_t>(c)][lane] = mesh.positions[corner][c];
        block_.normal[i][static_cast<std::size_t>(c)][lane] = mesh.normals[corner][c];
      }
    }
  set_up::TransformRequest request =
      set_up::transform_request(object_to_clip_[object_], pose_.normal_to_eye[object_], grid_.grid, format_.viewport);
  request.lanes = (1U << count) - 1;
  inside_ = kernels_.transform(request, block_, screen_);
}

void SetUpWork::count_pieces() const {
  const geometry::Mesh& mesh = *scene_.objects[object_].mesh;
  geometry::ClipTriangle<Number> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t corner = mesh.triangles[triangle_][i];
    corners[i] = set_up::transform_vertex<Number>(mesh.positions[corner], mesh.normals[corner],
                                                  object_to_clip_[object_], pose_.normal_to_eye[object_]);
  }
  set_up::pieces(corners, grid_, format_.viewport);
}

bool SetUpWork::next() {
  while (object_ < scene_.objects.size() && triangle_ >= scene_.objects[object_].mesh->triangles.size()) {
    ++object_;
    triangle_ = 0;
  }
  if (object_ >= scene_.objects.size()) return false;
  coloured_.clear();
  load_count_ = 0;
  const OperationCounts colouring = colourer_.operations();
  const std::uint64_t back_faces = colourer_.counts().back_faces;
  triangle_operations_ = {};
  ++number_;
  ++counts_.triangles;
  const std::size_t lane = triangle_ % set_up::kLanes;
  if (lane == 0) transform_block();
  if ((inside_ >> lane & 1U) != 0) {
    triangle_operations_ += uncut_cost_;
    whole_ = true;
    colour(set_up::triangle_of_lane<double>(screen_, lane), object_, triangle_);
    count_outcome(1, back_faces);
  } else {
    const set_up::Pieces<double> pieces = pieces_counted(object_, triangle_);
    if (pieces.size > 1) counts_.pieces += pieces.size - 1;
    for (const auto& piece : pieces.list()) colour(piece, object_, triangle_);
    count_outcome(pieces.size, back_faces);
  }
  // What was surveyed has been transformed, and that charged.
  if (parameters_.stitches() && is_highlighted(object_, triangle_)) triangle_operations_ = {};
  triangle_operations_ += std::exchange(waiting_operations_, {});
  triangle_operations_ += colourer_.operations() - colouring;
  if (parameters_.makes_parts()) frame_.insert(frame_.end(), coloured_.begin(), coloured_.end());
  for (const set_up::ColourTriangle& triangle : coloured_) {
    // The room is used again from triangle to triangle: a load is large.
    if (load_count_ == room_.size()) room_.emplace_back();
    span_unit::TriangleLoad& load = room_[load_count_];
    set_up::put_span_load(triangle, format_.span, load);
    triangle_operations_ += set_up::cost_of(load, load.shading != nullptr ? depth_costs_ : load_costs_);
    if (load.count == 0) continue;
    counts_.words += words_of(load);
    ++load_count_;
    counts_.shaded += load.shading != nullptr ? 1 : 0;
    counts_.wraps += load.wraps ? 1 : 0;
  }
  counts_.loads += load_count_;
  counts_.operations += triangle_operations_;
  ++triangle_;
  return true;
}

set_up::ColourSteps SetUpWork::colour_steps() const {
  const bool moved = parameters_.child_coverage == set_up::ChildCoverage::snapped;
  return set_up::colour_steps(frame_, moved ? parameters_.corner_bits() - static_cast<int>(parameters_.snap_bits) : 0);
}

// By all of a triangle's pieces.
void SetUpWork::count_outcome(std::size_t pieces, std::uint64_t back_faces_before) {
  if (pieces == 0)
    ++counts_.outside;
  else if (!coloured_.empty())
    ++counts_.facing;
  else if (colourer_.counts().back_faces > back_faces_before)
    ++counts_.back_faces;
  else
    ++counts_.degenerate;
}

SetUpCounts SetUpWork::counts() const {
  SetUpCounts counts = counts_;
  counts.colour = since(colourer_.counts(), colour_start_);
  counts.lighting = since(lighting_.counts(), lighting_start_);
  counts.subdivision = since(colourer_.subdivision(), subdivision_start_);
  counts.stitched = since(colourer_.stitched(), stitch_start_);
  return counts;
}

glm::dvec3 SetUpWork::eye_position(const geometry::ScreenVertex<double>& corner) const {
  const double x = (corner.x + 0.5) * 2 / static_cast<double>(format_.viewport.columns) - 1;
  const double y = 1 - (corner.y + 0.5) * 2 / static_cast<double>(format_.viewport.lines);
  const glm::dvec4 eye = clip_to_eye_ * glm::dvec4(x, y, corner.z, 1.0);
  return glm::dvec3(eye) / eye.w;
}

void SetUpWork::fill_request(const set_up::ScreenTriangle<double>& piece, std::size_t object, std::size_t triangle) {
  set_up::ColourRequest& request = request_;
  request.object = number_;
  request.material = scene_.objects[object].mesh->material[triangle];
  request.two_sided = scene_.objects[object].two_sided;
  request.highlighted = is_highlighted(object, triangle);
  const bool from_vertices = whole_ && vertices_ != nullptr;
  request.lit = nullptr;
  if (from_vertices && !shades_pixels(parameters_.method)) {
    lit_corners_ = vertices_->corners(object, triangle);
    request.lit = &lit_corners_;
  }
  const int finer = parameters_.corner_bits() - static_cast<int>(parameters_.snap_bits);
  for (std::size_t i = 0; i < 3; ++i) {
    const geometry::ScreenVertex<double>& corner = piece[i];
    set_up::LitPoint& point = request.corners[i];
    const geometry::SnappedPoint at = geometry::snap(corner, static_cast<int>(parameters_.snap_bits));
    point.at = {at.x * (std::int64_t{1} << finer), at.y * (std::int64_t{1} << finer)};
    point.inverse_w = corner.inverse_w;
    point.normal = corner.normal;
    if (lighting_.needs_positions()) point.position = eye_position(corner);
    request.depth[i] = std::clamp(corner.z, 0.0, 1.0) * depth_range_ + near_word_;
  }
  if (!from_vertices) {
    triangle_operations_ += corner_costs_;
    if (lighting_.needs_positions()) triangle_operations_ += position_costs_;
  }
  const bool chosen = parameters_.method != ShadingMethod::gouraud_phong || request.highlighted;
  request.by_pixels = shader_ != nullptr && chosen;
}

void SetUpWork::colour(const set_up::ScreenTriangle<double>& piece, std::size_t object, std::size_t triangle) {
  fill_request(piece, object, triangle);
  const std::size_t before = coloured_.size();
  colourer_.colour(request_, coloured_);
  if (request_.by_pixels && coloured_.size() > before) give_shading();
}

// To the triangle that came last: what the pixel unit needs to know of it.
void SetUpWork::give_shading() {
  pixel_unit::PixelTriangle& shading = shadings_.emplace_back();
  shading.corners = request_.corners;
  shading.fraction_bits = parameters_.corner_bits();
  shading.material = request_.material;
  const auto& [a, b, c] = request_.corners;
  if (!geometry::faces_viewer(geometry::doubled_area(a.at, b.at, c.at)))
    for (set_up::LitPoint& corner : shading.corners) corner.normal = -corner.normal;
  coloured_.back().shading = &shading;
  triangle_operations_ += shader_->set_up_cost();
}

set_up::LoadWords SetUpWork::words_of(const span_unit::TriangleLoad& load) const {
  set_up::LoadWords words = set_up::load_words(load, linear_);
  if (load.shading == nullptr || load.count == 0) return words;
  // The pixel unit's instead of colours.
  words.colours = shader_->set_up_words();
  return words;
}

}  // namespace rastertlm::host
