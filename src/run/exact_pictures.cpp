#include "src/run/exact_pictures.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "modules/set_up/word_format.h"
#include "src/base/digest.h"
#include "src/reference/sphere_renderer.h"
#include "src/run/inputs.h"

namespace rastertlm::run {
namespace {

std::string grid_text(const geometry::SnapGrid& grid) {
  return fmt::format("{},{},{}", grid.fraction_bits, grid.guard_x, grid.guard_y);
}

// Equal for pictures that are equal; the scene and its frame apart.
std::string options_text(const reference::RenderOptions& o) {
  return fmt::format("{} {}x{} {} {} {} {}", reference::to_string(o.kind), o.columns, o.lines,
                     grid_text(o.grids.on_screen), grid_text(o.grids.guarded), o.lights_at_points, o.specular_mean);
}

void add_bytes(std::string& text, const double* values, std::size_t count) {
  text.append(reinterpret_cast<const char*>(values), count * sizeof(double));
}
template <class Matrix>
void add_matrix(std::string& text, const Matrix& matrix) {
  for (int column = 0; column < Matrix::length(); ++column)
    add_bytes(text, &matrix[column][0], static_cast<std::size_t>(Matrix::col_type::length()));
}

// Everything of the pose, bit by bit.
std::string pose_bytes(const scene::Pose& pose) {
  std::string bytes;
  add_matrix(bytes, pose.world_to_eye);
  add_matrix(bytes, pose.eye_to_clip);
  for (const glm::dmat4& matrix : pose.object_to_eye) add_matrix(bytes, matrix);
  for (const glm::dmat3& matrix : pose.normal_to_eye) add_matrix(bytes, matrix);
  for (const scene::Light& light : pose.lights) {
    bytes += light.kind == scene::LightKind::point ? 'p' : 'd';
    add_bytes(bytes, &light.vector[0], 3);
    add_bytes(bytes, &light.intensity[0], 3);
  }
  return bytes;
}

reference::DepthWords depth_words(const set_up::WordFormat& format, double bound) {
  return {static_cast<double>(set_up::near_depth(format)), static_cast<double>(set_up::far_depth(format)), bound};
}

// Along the lattice a register's words round, and what is stored is floored; a start edge that is off takes depth along
// its slope, up to the margin beside near and far.
double depth_bound(const quadratic::Machine& machine) {
  if (machine.span_unit.start_edge != span_unit::StartEdge::lattice)
    return static_cast<double>(set_up::depth_margin(machine.depth_format()));
  const std::uint64_t steps =
      span_unit::longest_iteration(machine.span_unit, static_cast<std::uint64_t>(machine.video.columns),
                                   static_cast<std::uint64_t>(machine.video.lines));
  return 1.0 + span_unit::linear_fraction_bound(machine.span_unit.depth_fraction_bits, steps);
}

}  // namespace

std::vector<reference::RenderOptions> exact_options(const imogene::Machine& machine) {
  reference::RenderOptions options;
  options.columns = static_cast<std::size_t>(machine.video.columns);
  options.lines = static_cast<std::size_t>(machine.video.lines);
  options.grids = imogene::snap_grids(machine);
  options.specular_mean = machine.shading.specular_tables == 1;
  std::vector<reference::RenderOptions> all(3, options);
  all[0].kind = reference::Reference::ideal;
  all[1].kind = reference::Reference::snapped;
  all[2].kind = reference::Reference::true_model;
  return all;
}

std::vector<reference::RenderOptions> exact_options(const quadratic::Machine& machine) {
  reference::RenderOptions options;
  options.columns = machine.viewport().columns;
  options.lines = machine.viewport().lines;
  options.grids = host::span_grids(machine.viewport(), static_cast<int>(machine.set_up.snap_bits));
  options.lights_at_points = true;
  std::vector<reference::RenderOptions> all(2, options);
  // A machine that takes what lights see from the surface has the true model for its own.
  const bool perspective = machine.set_up.attributes == set_up::Attributes::perspective;
  all[0].kind = perspective ? reference::Reference::true_model : reference::Reference::ideal;
  all[1].kind = reference::Reference::true_model;
  return all;
}

std::optional<reference::DepthWords> depth_words(const imogene::Machine& machine) {
  const set_up::WordFormat format{static_cast<int>(machine.object_processor.word_bits),
                                  static_cast<std::size_t>(machine.video.columns),
                                  static_cast<std::size_t>(machine.video.lines)};
  return depth_words(format, static_cast<double>(set_up::depth_margin(format)));
}

std::optional<reference::DepthWords> depth_words(const quadratic::Machine& machine) {
  if (!machine.frame_store.depth_test) return std::nullopt;
  return depth_words(machine.depth_format(), depth_bound(machine));
}

reference::MeterOptions meter_options(const std::string& reference, const std::optional<reference::DepthWords>& depth,
                                      const Options& options) {
  return {reference, depth, options.perceptual_pixels_per_degree};
}

void take_objects(const frame::Frame& shown, frame::ExactFrame& spheres) {
  for (std::size_t pixel = 0; pixel < spheres.object.size(); ++pixel)
    if (spheres.object[pixel] != 0 && shown.object[pixel] != 0) spheres.object[pixel] = shown.object[pixel];
}

void ExactPictures::keep(const std::string& key, const std::function<frame::ExactFrame()>& render, KeptPicture& kept,
                         const KeptPicture* other) {
  ++wanted_;
  std::string digest = sha256_hex(key);
  if (kept.digest == digest) return;
  if (other != nullptr && other->digest == digest) {
    kept = *other;
    return;
  }
  ++made_;
  const auto start = std::chrono::steady_clock::now();
  kept.picture = store_ == nullptr ? render() : store_->picture(digest, render);
  time_ += std::chrono::steady_clock::now() - start;
  kept.digest = std::move(digest);
}

void ExactPictures::render(const scene::Pose& pose, const reference::RenderOptions& options, KeptPicture& kept,
                           const KeptPicture* other) {
  keep(
      fmt::format("{} {} ", scene_.digest, options_text(options)) + pose_bytes(pose),
      [&] { return reference::render(scene_, pose, options); }, kept, other);
}

void ExactPictures::render_spheres(const scene::Pose& pose, std::size_t columns, std::size_t lines, KeptPicture& kept) {
  keep(
      fmt::format("{} spheres {}x{} ", scene_.digest, columns, lines) + pose_bytes(pose),
      [&] { return reference::render_spheres(scene_, pose, columns, lines); }, kept, nullptr);
}

ExactNeeds exact_needs(const Inputs& inputs, std::uint64_t frames) {
  ExactNeeds needs;
  needs.key = fmt::format("{} {}", inputs.content->scene->digest, frames);
  const auto options = std::visit([](const auto& machine) { return exact_options(machine); }, inputs.content->machine);
  for (const reference::RenderOptions& one : options) {
    needs.key += '\n' + options_text(one);
    needs.pixels = one.columns * one.lines;
  }
  constexpr std::size_t kFieldsAndSpheres = 2;
  needs.pictures = (options.size() + kFieldsAndSpheres) * kFieldsAndSpheres * static_cast<std::size_t>(frames);
  return needs;
}

}  // namespace rastertlm::run
