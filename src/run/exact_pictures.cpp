#include "src/run/exact_pictures.h"

#include <fmt/format.h>

#include <variant>

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

frame::ExactFrame from(ExactStore* store, const std::string& key, const std::function<frame::ExactFrame()>& render) {
  return store == nullptr ? render() : store->picture(key, render);
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

frame::ExactFrame ExactPictures::render(const scene::Pose& pose, std::int64_t animation_frame,
                                        const reference::RenderOptions& options) const {
  const std::string key = fmt::format("{} {} {}", scene_.digest, animation_frame, options_text(options));
  return from(store_, key, [&] { return reference::render(scene_, pose, options); });
}

frame::ExactFrame ExactPictures::render_spheres(const scene::Pose& pose, std::int64_t animation_frame,
                                                std::size_t columns, std::size_t lines) const {
  const std::string key = fmt::format("{} {} spheres {}x{}", scene_.digest, animation_frame, columns, lines);
  return from(store_, key, [&] { return reference::render_spheres(scene_, pose, columns, lines); });
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
