#include "src/run/imogene_simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "platforms/imogene/imogene.h"
#include "src/base/digest.h"
#include "src/config/writer.h"
#include "src/frame/fields.h"
#include "src/parameter/table.h"
#include "src/reference/error_meter.h"
#include "src/reference/sphere_renderer.h"
#include "src/run/background_warning.h"
#include "src/run/deadlines.h"
#include "src/run/exact_pictures.h"
#include "src/run/host_figures.h"
#include "src/run/imogene_budgets.h"
#include "src/run/imogene_figures.h"
#include "src/run/imogene_timeline.h"
#include "src/run/inputs.h"
#include "src/run/table_budgets.h"

namespace rastertlm::run {
namespace {

// The exact pictures of the pose that is shown; a view that is shown again is not rendered again. Of interlaced video
// they are woven of the poses of two fields, as the screen's picture is.
class Exact {
 public:
  Exact(const imogene::Machine& machine, const scene::Scene& scene, const Options& options)
      : source_(scene, options.exact), fields_(machine.video.interlaced ? 2 : 1) {
    for (const reference::RenderOptions& one : exact_options(machine))
      pictures_.push_back(
          {one, reference::ErrorMeter(meter_options(reference::to_string(one.kind), depth_words(machine), options))});
    if (reference::is_of_spheres(scene))
      spheres_.emplace(Picture{pictures_.front().options,
                               reference::ErrorMeter(meter_options("sphere", depth_words(machine), options))});
  }

  void show(const imogene::ShownFrame& shown) {
    for (Picture& picture : pictures_) {
      source_.render(shown.pose, picture.options, picture.of_pose);
      weave(shown.field, picture);
    }
    if (!spheres_) return;
    source_.render_spheres(shown.pose, spheres_->options.columns, spheres_->options.lines, spheres_->of_pose);
    weave(shown.field, *spheres_);
  }
  std::vector<reference::ErrorFigures> errors(const frame::Frame& shown) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<reference::ErrorFigures> errors;
    for (Picture& picture : pictures_) errors.push_back(picture.meter.measure(shown, on_screen(picture)));
    if (spheres_) {
      frame::ExactFrame& exact = fields_ > 1 ? spheres_->woven : spheres_->of_pose.picture;
      take_objects(shown, exact);
      errors.push_back(spheres_->meter.measure(shown, exact));
    }
    time_ += std::chrono::steady_clock::now() - start;
    return errors;
  }
  const ExactPictures& source() const { return source_; }
  HostTime time() const { return time_; }  // of the figures
  const frame::ExactFrame& ideal() const { return on_screen(pictures_.front()); }

 private:
  struct Picture {
    reference::RenderOptions options;
    reference::ErrorMeter meter;
    KeptPicture of_pose = {};
    frame::ExactFrame woven = {};  // where the video is interlaced
  };
  void weave(std::size_t field, Picture& picture) const {
    if (fields_ > 1) frame::copy_lines(picture.of_pose.picture, field, fields_, picture.woven);
  }
  const frame::ExactFrame& on_screen(const Picture& picture) const {
    return fields_ > 1 ? picture.woven : picture.of_pose.picture;
  }
  ExactPictures source_;
  std::size_t fields_;
  std::vector<Picture> pictures_;
  std::optional<Picture> spheres_;  // where every object is one
  HostTime time_{};
};

// What a displayed frame is from its first field on.
FrameFigures figures_of(const imogene::ShownFrame& shown, const geometry::SnapGrids& grids) {
  FrameFigures f;
  f.frame = shown.frame;
  f.animation_frame = shown.animation_frame;
  f.first_pixel_ps = shown.first_pixel_ps;
  f.facing = shown.triangles.drawn;
  f.drawn = shown.triangles.drawn + shown.triangles.back_faces + shown.triangles.outside;
  f.back_faces = shown.triangles.back_faces;
  f.degenerate = shown.triangles.degenerate;
  f.outside = shown.triangles.outside;
  f.pieces = shown.triangles.pieces;
  f.solids_drawn = shown.solids.drawn;
  f.solids_outside = shown.solids.outside;
  f.solids_refused = shown.solids.refused;
  f.snap_fraction_bits = (shown.guarded ? grids.guarded : grids.on_screen).fraction_bits;
  return f;
}

// What every field adds.
void add_field(const imogene::ShownFrame& shown, FrameFigures& f) {
  f.last_animation_frame = shown.animation_frame;
  f.last_pixel_ps = shown.last_pixel_ps;
  f.pieces_dropped = std::max(f.pieces_dropped, shown.pieces_dropped);
  f.host_flops += shown.flops;
  f.words_sent += shown.words;
  f.words_ahead += shown.words_ahead;
  f.light_apart = f.light_apart || shown.light_apart;
  f.late_table_lines += shown.late_table_lines;
}

void add_pixels(const frame::Frame& pixels, FrameFigures& f) {
  f.covered_pixels = static_cast<std::uint64_t>(
      std::count_if(pixels.object.begin(), pixels.object.end(), [](std::uint32_t object) { return object != 0; }));
  for (const std::uint32_t count : pixels.coverage) f.fragments += count;
}

// Makes displayed frames, with their figures and errors, of what the machine shows field by field.
class DisplayedFrames {
 public:
  DisplayedFrames(const imogene::Machine& machine, const scene::Scene& scene, const Options& options,
                  const FrameSink& sink, std::vector<FrameFigures>& frames)
      : exact_(machine, scene, options), reference_(options.reference), sink_(sink), frames_(frames) {}

  void add(const imogene::Imogene& platform, const imogene::ShownFrame& shown, const frame::Frame& pixels) {
    if (!meter_) meter_.emplace(platform);
    if (shown.field == 0) figures_ = figures_of(shown, platform.grids());
    add_field(shown, figures_);
    meter_->add(shown, figures_);
    if (reference_) exact_.show(shown);
    if (shown.field + 1 < platform.timing().fields) return;
    add_pixels(pixels, figures_);
    if (reference_) figures_.errors = exact_.errors(pixels);
    if (sink_) sink_({pixels, reference_ ? &exact_.ideal() : nullptr, figures_});
    frames_.push_back(figures_);
  }

  // When all have been added.
  Deadlines deadlines(imogene::Imogene& platform) { return meter_->close(platform); }
  const Exact& exact() const { return exact_; }

 private:
  Exact exact_;
  bool reference_;
  const FrameSink& sink_;
  std::vector<FrameFigures>& frames_;
  FrameFigures figures_;
  std::optional<DeadlineMeter> meter_;
};

void add_warnings(imogene::Imogene& platform, const shading::DeferredShader& shader, Result& result) {
  result.warnings = shader.warnings();
  warn_of_background(result);
  std::uint64_t pieces = 0;
  for (const FrameFigures& frame : result.frames) pieces = std::max(pieces, frame.pieces_dropped);
  if (pieces > 0)
    result.warnings.push_back(fmt::format(
        "up to {} pieces of clipped triangles a frame found no processor and are missing from the picture", pieces));
  if (platform.slots().dropped > 0)
    result.warnings.push_back(std::to_string(platform.slots().dropped) +
                              " objects (triangles) found no processor and are missing from the picture");
  if (platform.solid_slots().dropped > 0)
    result.warnings.push_back(fmt::format("{} solids found no quadric processor and are missing from the picture",
                                          platform.solid_slots().dropped));
  std::uint64_t refused = 0;
  for (const FrameFigures& frame : result.frames) refused = std::max(refused, frame.solids_refused);
  if (refused > 0)
    result.warnings.push_back(fmt::format(
        "up to {} solids a frame cannot be shown by the quadric processors and are missing from the picture", refused));
  if (const std::string late = late_tables_warning(platform, result.frames); !late.empty())
    result.warnings.push_back(late);
  if (shader.counters().short_normals > 0)
    result.warnings.push_back(std::to_string(shader.counters().short_normals) +
                              " pixels had a normal too short for the normaliser and are darker than they should be");
}

}  // namespace

Result simulate_imogene(const imogene::Machine& machine, const Inputs& inputs, const Options& options,
                        const FrameSink& sink) {
  const scene::Scene& scene = *inputs.content->scene;
  const auto start = std::chrono::steady_clock::now();
  std::chrono::steady_clock::duration outside{};  // spent in references and sinks, which is not the simulation's

  Result result;
  std::unique_ptr<imogene::Imogene> platform;
  DisplayedFrames displayed(machine, scene, options, sink, result.frames);
  std::optional<ImogeneTimeline> timeline;
  const auto show = [&](const imogene::ShownFrame& shown, const frame::Frame& pixels) {
    const auto entered = std::chrono::steady_clock::now();
    displayed.add(*platform, shown, pixels);
    if (timeline) timeline->add(shown);
    outside += std::chrono::steady_clock::now() - entered;
  };
  try {
    platform = std::make_unique<imogene::Imogene>(machine, scene,
                                                  imogene::Options{options.frames, options.model_everything}, show);
    if (options.timeline) timeline.emplace(*options.timeline, *platform);
    platform->run();
  } catch (const InputError& error) {
    throw inputs.content->located(error);
  }

  result.platform = "imogene";
  result.config_digest = config_digest(inputs);
  result.scene_digest = scene.digest;
  result.frame_count = result.simulated_frames = options.frames;
  result.columns = static_cast<std::size_t>(machine.video.columns);
  result.lines = static_cast<std::size_t>(machine.video.lines);
  result.obtained_refresh_hz = platform->timing().obtained_refresh_hz();
  result.interlaced = machine.video.interlaced;
  result.units = unit_figures(*platform);
  result.budgets = imogene_budgets(*platform);
  result.answer = imogene_answer(*platform, result.budgets);
  result.answer.torn_frames = static_cast<std::uint64_t>(
      std::count_if(result.frames.begin(), result.frames.end(), [](const auto& f) { return f.torn(); }));
  result.deadlines = displayed.deadlines(*platform);
  result.links = link_figures(*platform);
  result.memories = memory_figures(*platform);
  result.logic = logic_figures(*platform);
  result.modelled = modelled_figures(*platform, scene, options.model_everything);
  if (options.reference) result.flip_pixels_per_degree = options.perceptual_pixels_per_degree;
  result.modelled.exact_wanted = displayed.exact().source().wanted();
  result.modelled.exact_made = displayed.exact().source().made();
  add_warnings(*platform, platform->shader(), result);
  if (timeline) result.timeline = std::make_shared<const Timeline>(timeline->close(result));
  if (options.host_figures)
    result.host = host_figures(std::chrono::steady_clock::now() - start - outside, displayed.exact().source().time(),
                               displayed.exact().time(),
                               options.frames * platform->timing().fields * platform->timing().frame.count());
  return result;
}

}  // namespace rastertlm::run
