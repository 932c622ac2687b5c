#include "src/run/simulate.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "platforms/imogene/imogene.h"
#include "src/base/digest.h"
#include "src/config/writer.h"
#include "src/parameter/table.h"
#include "src/reference/metrics.h"
#include "src/reference/renderer.h"
#include "src/run/imogene_budgets.h"
#include "src/run/imogene_figures.h"
#include "src/run/inputs.h"
#include "src/run/table_budgets.h"

namespace rastertlm::run {
namespace {

// The exact pictures of the pose that is shown; a pose that is shown again is not rendered again.
class Exact {
 public:
  Exact(const imogene::Machine& machine, const scene::Scene& scene) : scene_(scene) {
    options_.columns = static_cast<std::size_t>(machine.video.columns);
    options_.lines = static_cast<std::size_t>(machine.video.lines);
    options_.grids = imogene::snap_grids(machine);
    options_.specular_mean = machine.shading.specular_tables == 1;
  }

  void render(const scene::Pose& pose) {
    ideal_ = picture(pose, reference::Reference::ideal);
    snapped_ = picture(pose, reference::Reference::snapped);
    true_ = picture(pose, reference::Reference::true_model);
  }
  std::vector<reference::ErrorFigures> errors(const frame::Frame& shown) const {
    return {reference::compare(shown, ideal_, "ideal"), reference::compare(shown, snapped_, "snapped"),
            reference::compare(shown, true_, "true")};
  }
  const frame::ExactFrame& ideal() const { return ideal_; }

 private:
  frame::ExactFrame picture(const scene::Pose& pose, reference::Reference kind) {
    options_.kind = kind;
    return reference::render(scene_, pose, options_);
  }
  const scene::Scene& scene_;
  reference::RenderOptions options_;
  frame::ExactFrame ideal_;
  frame::ExactFrame snapped_;
  frame::ExactFrame true_;
};

FrameFigures figures_of(const imogene::ShownFrame& shown, const frame::Frame& pixels,
                        const geometry::SnapGrids& grids) {
  FrameFigures f;
  f.frame = shown.frame;
  f.animation_frame = shown.animation_frame;
  f.first_pixel_ps = shown.first_pixel_ps;
  f.last_pixel_ps = shown.last_pixel_ps;
  f.facing = shown.triangles.drawn;
  f.drawn = shown.triangles.drawn + shown.triangles.back_faces + shown.triangles.outside;
  f.back_faces = shown.triangles.back_faces;
  f.degenerate = shown.triangles.degenerate;
  f.outside = shown.triangles.outside;
  f.pieces = shown.triangles.pieces;
  f.pieces_dropped = shown.pieces_dropped;
  f.snap_fraction_bits = (shown.guarded ? grids.guarded : grids.on_screen).fraction_bits;
  f.covered_pixels = static_cast<std::uint64_t>(
      std::count_if(pixels.object.begin(), pixels.object.end(), [](std::uint32_t object) { return object != 0; }));
  for (const std::uint32_t count : pixels.coverage) f.fragments += count;
  f.host_flops = shown.flops;
  f.words_sent = shown.words;
  f.words_ahead = shown.words_ahead;
  f.late_table_lines = shown.late_table_lines;
  return f;
}

void add_warnings(imogene::Imogene& platform, const shading::DeferredShader& shader, Result& result) {
  result.warnings = shader.warnings();
  for (const FrameFigures& frame : result.frames)
    if (frame.covered_pixels == 0) {
      result.warnings.push_back(
          frame.facing == 0
              ? fmt::format("frame {} shows nothing but the background: no triangle of the scene that faces the viewer "
                            "is in view",
                            frame.frame)
              : fmt::format("frame {} shows nothing but the background, although {} triangles face the viewer",
                            frame.frame, frame.facing));
      break;
    }
  std::uint64_t pieces = 0;
  for (const FrameFigures& frame : result.frames) pieces = std::max(pieces, frame.pieces_dropped);
  if (pieces > 0)
    result.warnings.push_back(fmt::format(
        "up to {} pieces of clipped triangles a frame found no processor and are missing from the picture", pieces));
  if (platform.slots().dropped > 0)
    result.warnings.push_back(std::to_string(platform.slots().dropped) +
                              " objects (triangles) found no processor and are missing from the picture");
  if (const std::string late = late_tables_warning(platform, result.frames); !late.empty())
    result.warnings.push_back(late);
  if (shader.counters().short_normals > 0)
    result.warnings.push_back(std::to_string(shader.counters().short_normals) +
                              " pixels had a normal too short for the normaliser and are darker than they should be");
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

Result simulate(const Inputs& inputs, const Options& options, const FrameSink& sink) {
  const imogene::Machine& machine = inputs.content->machine;
  const scene::Scene& scene = inputs.content->scene;
  const auto start = std::chrono::steady_clock::now();
  std::chrono::steady_clock::duration outside{};  // spent in references and sinks, which is not the simulation's

  Result result;
  Exact exact(machine, scene);
  std::unique_ptr<imogene::Imogene> platform;
  const auto show = [&](const imogene::ShownFrame& shown, const frame::Frame& pixels) {
    const auto entered = std::chrono::steady_clock::now();
    FrameFigures figures = figures_of(shown, pixels, platform->grids());
    if (options.reference) {
      if (shown.updated) exact.render(shown.pose);
      figures.errors = exact.errors(pixels);
    }
    if (sink) sink({pixels, options.reference ? &exact.ideal() : nullptr, figures});
    result.frames.push_back(std::move(figures));
    outside += std::chrono::steady_clock::now() - entered;
  };
  try {
    platform = std::make_unique<imogene::Imogene>(machine, scene,
                                                  imogene::Options{options.frames, options.model_everything}, show);
    platform->run();
  } catch (const InputError& error) {
    throw inputs.content->located(error);
  }

  result.platform = "imogene";
  imogene::Machine resolved = machine;
  parameter::Table table = parameter::view(resolved);
  result.config_digest = config::digest(table);
  result.scene_digest = scene.digest;
  result.frame_count = options.frames;
  result.columns = static_cast<std::size_t>(machine.video.columns);
  result.lines = static_cast<std::size_t>(machine.video.lines);
  result.obtained_refresh_hz = platform->timing().obtained_refresh_hz();
  result.units = unit_figures(*platform);
  result.budgets = imogene_budgets(*platform);
  result.answer = imogene_answer(*platform, result.budgets);
  result.answer.torn_frames = static_cast<std::uint64_t>(
      std::count_if(result.frames.begin(), result.frames.end(), [](const auto& f) { return f.words_ahead > 0; }));
  result.links = link_figures(*platform);
  result.memories = memory_figures(*platform);
  result.logic = logic_figures(*platform);
  result.modelled = modelled_figures(*platform, scene, options.model_everything);
  add_warnings(*platform, platform->shader(), result);
  if (options.host_figures) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start - outside).count();
    result.host.wall_seconds = seconds;
    result.host.simulated_clocks_per_second =
        static_cast<double>(options.frames * platform->timing().frame.count()) / seconds;
    result.host.peak_memory_bytes = peak_memory_bytes();
  }
  return result;
}

}  // namespace rastertlm::run
