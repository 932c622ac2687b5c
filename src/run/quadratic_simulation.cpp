#include "src/run/quadratic_simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "platforms/quadratic/quadratic.h"
#include "src/base/digest.h"
#include "src/config/writer.h"
#include "src/parameter/table.h"
#include "src/reference/error_meter.h"
#include "src/reference/sphere_renderer.h"
#include "src/run/background_warning.h"
#include "src/run/drawing_limits.h"
#include "src/run/exact_pictures.h"
#include "src/run/highlight_recall.h"
#include "src/run/host_figures.h"
#include "src/run/inputs.h"
#include "src/run/quadratic_budgets.h"
#include "src/run/quadratic_figures.h"
#include "src/run/quadratic_timeline.h"
#include "src/run/software_budgets.h"

namespace rastertlm::run {
namespace {

// Frames that show at what rate the machine goes on: it takes three to have an interval in steady state.
constexpr std::uint64_t kLeastFrames = 3;

FrameFigures figures_of(std::uint64_t number, const quadratic::ShownFrame& shown, const frame::Frame& pixels,
                        int snap_bits) {
  const host::SetUpCounts& counts = shown.set_up.counts;
  const set_up::ColourCounts& colour = counts.colour;
  FrameFigures f;
  f.frame = number;
  f.animation_frame = f.last_animation_frame = shown.set_up.animation_frame;
  f.first_pixel_ps = shown.first_pixel_ps;
  f.last_pixel_ps = shown.last_pixel_ps;
  f.facing = counts.facing;
  f.back_faces = counts.back_faces;
  f.degenerate = counts.degenerate;
  f.outside = counts.outside;
  f.drawn = counts.facing + counts.back_faces + counts.outside;
  f.pieces = counts.pieces;
  f.snap_fraction_bits = snap_bits;
  f.covered_pixels = static_cast<std::uint64_t>(
      std::count_if(pixels.object.begin(), pixels.object.end(), [](std::uint32_t object) { return object != 0; }));
  for (const std::uint32_t count : pixels.coverage) f.fragments += count;
  f.host_flops = counts.operations.flops();
  f.words_sent = counts.words.total();
  constexpr double kMicrosecond = 1e-6;
  f.span = {colour.drawn,
            colour.splits,
            colour.at_limit,
            colour.flat_low + colour.flat_undefined,
            counts.lighting.evaluations,
            shown.work.shaded_pixels,
            shown.work.shading_flops,
            shown.set_up.colour_steps.edges,
            shown.set_up.colour_steps.largest_levels,
            counts.lighting.clamped_knots,
            counts.lighting.not_finite,
            shown.drawn.pixels,
            shown.drawn.off_screen,
            static_cast<double>(shown.set_up.end_ps - shown.set_up.begin_ps) * kMicrosecond,
            static_cast<double>(shown.set_up.shown_ps - shown.set_up.begin_ps) * kMicrosecond,
            shown.torn_lines};
  const set_up::SubdivisionCounts& cut = counts.subdivision;
  f.highlight = {counts.classified.tested,
                 counts.classified.potentially,
                 counts.classified.neighbours,
                 cut.divided,
                 cut.parts,
                 cut.centres,
                 cut.beside,
                 cut.unfound,
                 cut.at_limit,
                 cut.at_grid_limit,
                 counts.stitched.triangles,
                 counts.stitched.corners,
                 0,
                 {},
                 {}};
  return f;
}

// The exact pictures of the pose that is shown, under the names that the report has them by.
class Exact {
 public:
  Exact(const quadratic::Machine& machine, const scene::Scene& scene, const Options& options)
      : scene_(scene), source_(scene, options.exact), options_(exact_options(machine)) {
    for (const char* name : kNames)
      kinds_.push_back({reference::ErrorMeter(meter_options(name, depth_words(machine), options)), {}});
  }
  std::vector<reference::ErrorFigures> errors(const scene::Pose& pose, const frame::Frame& shown) {
    std::vector<reference::ErrorFigures> errors;
    for (std::size_t i = 0; i < options_.size(); ++i) {
      source_.render(pose, options_[i], kinds_[i].exact, &kinds_.front().exact);  // the true model may be its own
      errors.push_back(measured(kinds_[i], shown));
    }
    if (reference::is_of_spheres(scene_)) errors.push_back(sphere_errors(pose, shown));
    return errors;
  }
  const frame::ExactFrame& ideal() const { return kinds_.front().exact.picture; }
  const ExactPictures& source() const { return source_; }
  HostTime time() const { return time_; }  // of the figures

 private:
  // The order of exact_options, and behind them the spheres.
  static constexpr std::array<const char*, 3> kNames{"ideal", "true", "sphere"};
  struct Kind {
    reference::ErrorMeter meter;
    KeptPicture exact;
  };
  reference::ErrorFigures measured(Kind& kind, const frame::Frame& shown) {
    const auto start = std::chrono::steady_clock::now();
    reference::ErrorFigures figures = kind.meter.measure(shown, kind.exact.picture);
    time_ += std::chrono::steady_clock::now() - start;
    return figures;
  }
  reference::ErrorFigures sphere_errors(const scene::Pose& pose, const frame::Frame& shown) {
    Kind& spheres = kinds_.back();
    source_.render_spheres(pose, options_[0].columns, options_[0].lines, spheres.exact);
    take_objects(shown, spheres.exact.picture);
    return measured(spheres, shown);
  }

  const scene::Scene& scene_;
  ExactPictures source_;
  std::vector<reference::RenderOptions> options_;
  std::vector<Kind> kinds_;
  HostTime time_{};
};

Modelled modelled_figures(const quadratic::Quadratic& platform, const scene::Scene& scene) {
  Modelled m;
  m.objects_made = scene.triangle_count();
  for (const scene::Object& object : scene.objects) m.objects_degenerate += object.mesh.degenerate;
  const frame_store::StoreCounters& store = platform.store().counters();
  m.fragments_in = store.fragments_in;
  m.fragments_kept = store.fragments_kept;
  m.fragments_hidden = store.fragments_hidden;
  if (platform.frame_store().never_waited_for())
    m.left_out.emplace_back("the memory's schedule span by span: it keeps up with the span unit whatever is drawn");
  return m;
}

// Of the displayed frames.
void add_software_budgets(const quadratic::Quadratic& platform, std::uint64_t displayed, std::vector<Budget>& budgets) {
  const quadratic::Machine& machine = platform.machine();
  std::vector<geometry::Pose> poses;
  for (std::size_t frame = 0; frame < std::min<std::size_t>(displayed, platform.frames().size()); ++frame)
    poses.push_back(platform.frames()[frame].set_up.pose);
  for (Budget& b :
       software_budgets(machine.software, platform.rendering(), machine.platform_name, poses, frame_seconds(platform)))
    budgets.push_back(std::move(b));
}

// A picture of which parts are another's, or missing, is not what the scene asks for, however often it changes.
void judge_torn_frames(Result& result) {
  std::uint64_t lines = 0;
  for (const FrameFigures& frame : result.frames) {
    result.answer.torn_frames += frame.torn() ? 1 : 0;
    lines += frame.span.torn_lines;
  }
  if (lines == 0) return;
  Answer& answer = result.answer;
  answer.sustained = answer.display_works = false;
  answer.limits.push_back(fmt::format(
      "{} of {} displayed frames are torn, {} lines of their screens show what was not whole; it moves with "
      "frame_store.swap, frame_store.buffers",
      answer.torn_frames, result.frames.size(), lines));
}

}  // namespace

Result simulate_quadratic(const quadratic::Machine& machine, const Inputs& inputs, const Options& options,
                          const FrameSink& sink) {
  const scene::Scene& scene = *inputs.content->scene;
  const auto start = std::chrono::steady_clock::now();
  std::chrono::steady_clock::duration outside{};  // spent in references and sinks, which is not the simulation's
  Result result;
  Exact exact(machine, scene, options);
  std::optional<QuadraticTimeline> timeline;
  const auto show = [&](const quadratic::ShownFrame& shown, const frame::Frame& pixels) {
    if (result.frames.size() >= options.frames) return;
    const auto entered = std::chrono::steady_clock::now();
    FrameFigures figures = figures_of(result.frames.size(), shown, pixels, static_cast<int>(machine.set_up.snap_bits));
    if (options.reference) {
      figures.errors = exact.errors(shown.set_up.pose, pixels);
      add_highlight_recall(machine, scene, shown.set_up.pose, figures.highlight);
    }
    if (sink) sink({pixels, options.reference ? &exact.ideal() : nullptr, figures});
    result.frames.push_back(std::move(figures));
    outside += std::chrono::steady_clock::now() - entered;
  };
  std::unique_ptr<quadratic::Quadratic> platform;
  const std::uint64_t frames = std::max(options.frames, kLeastFrames);
  try {
    platform = std::make_unique<quadratic::Quadratic>(machine, scene, quadratic::Options{frames}, show);
    if (options.timeline) timeline.emplace(*options.timeline, options.frames, *platform);
    platform->run();
  } catch (const InputError& error) {
    throw inputs.content->located(error);
  }
  result.platform = machine.platform_name;
  result.config_digest = config_digest(inputs);
  result.scene_digest = scene.digest;
  result.frame_count = options.frames;
  result.simulated_frames = platform->frames().size();
  result.columns = machine.viewport().columns;
  result.lines = machine.viewport().lines;
  result.obtained_refresh_hz = platform->timing().obtained_refresh_hz();
  result.units = unit_figures(*platform);
  result.budgets = quadratic_budgets(*platform);
  add_software_budgets(*platform, options.frames, result.budgets);
  result.answer = quadratic_answer(*platform, result.budgets);
  judge_torn_frames(result);
  result.links = link_figures(*platform);
  result.memories = memory_figures(machine);
  result.logic = logic_figures(*platform);
  result.modelled = modelled_figures(*platform, scene);
  if (options.reference) result.flip_pixels_per_degree = options.perceptual_pixels_per_degree;
  result.modelled.exact_wanted = exact.source().wanted();
  result.modelled.exact_made = exact.source().made();
  result.warnings = quadratic_warnings(*platform, options.frames);
  warn_of_background(result);
  if (timeline) result.timeline = std::make_shared<const Timeline>(timeline->close());
  if (options.host_figures)
    result.host = host_figures(std::chrono::steady_clock::now() - start - outside, exact.source().time(), exact.time(),
                               frames * platform->timing().frame.count());
  return result;
}

}  // namespace rastertlm::run
