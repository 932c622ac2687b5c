#include "tests/benchmark/frame_pairs.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "platforms/imogene/imogene.h"
#include "src/geometry/lighting.h"
#include "src/reference/error_meter.h"
#include "src/reference/level_sums.h"
#include "src/reference/renderer.h"
#include "tests/benchmark/benchmark_scene.h"
#include "tests/benchmark/measuring.h"
#include "tests/benchmark/plain_variants.h"

namespace rastertlm::benchmark {
namespace {

constexpr std::uint64_t kWarmFrames = 3;
constexpr std::size_t kMostMeasuredErrors = 30;  // frames: an exact picture takes as long as a hundred of them

// The memories of the shading processor, as they were loaded.
plain::Tables tables_of(shading::DeferredShader& shader, const scene::Pose& pose) {
  plain::Tables tables;
  const shading::TableBank& bank = shader.front();
  tables.inverse_root = shader.normaliser().rom();
  const glm::dvec3 towards = pose.lights.at(0).vector;
  const geometry::Vector3<double> halfway = geometry::normalised<double>(towards + glm::dvec3(0, 0, 1));
  for (int i = 0; i < 3; ++i) {
    tables.light_word[0][i] = shader.light_word(towards[i]);
    tables.light_word[1][i] = shader.light_word(halfway[i]);
    tables.negative[0][i] = towards[i] < 0;
    tables.negative[1][i] = halfway[i] < 0;
  }
  for (std::size_t c = 0; c < 3; ++c) tables.diffuse[c] = bank.material_tables[0].diffuse[c];
  tables.specular = bank.material_tables[0].specular[0];
  tables.ambient = bank.ambient;
  for (std::size_t c = 0; c < 3; ++c) tables.background[c] = bank.background[c];
  return tables;
}

class Pairs {
 public:
  explicit Pairs(const Case& wanted) : case_(wanted), scene_(random_scene(wanted.triangles, wanted.pixels)) {
    machine_ = quick_host_machine(wanted.processors);
    if (wanted.pipeline) machine_.decision_unit.topology = decision_unit::Topology::pipeline;
  }

  Measured run() {
    imogene::Options options;
    options.frames = kWarmFrames + (case_.errors ? std::min(case_.pairs, kMostMeasuredErrors) : case_.pairs);
    options.observe = case_.errors;
    platform_ = std::make_unique<imogene::Imogene>(
        machine_, scene_, options,
        [this](const imogene::ShownFrame& shown, const frame::Frame& pixels) { show(shown, pixels); });
    started_ = worked();
    platform_->run();
    if (loop_) {
      const plain::Counts counts = loop_->counts();
      measured_.covered = counts.covered;
      measured_.visible = counts.visible;
    }
    measured_.simulated = median(simulated_);
    measured_.plain = median(plain_);
    measured_.plain_set_up = median(set_up_);
    measured_.plain_spans = median(spans_);
    measured_.plain_shading = median(shading_);
    measured_.levels = median(levels_);
    measured_.metrics = median(metrics_);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    measured_.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return measured_;
  }

 private:
  // From where the last frame was handed on to where this one is: its host's start, its loads and all its lines. The
  // host starts when the last frame's retrace has copied, and the simulation pauses between that and the host.
  void show(const imogene::ShownFrame& shown, const frame::Frame& pixels) {
    const double shown_at = worked();
    if (!shown.updated) ++measured_.repeated_frames;
    if (case_.errors) return measure_error(shown, pixels);
    if (shown.frame >= kWarmFrames) simulated_.push_back(shown_at - started_);
    if (case_.plain) plain_frame(shown, pixels);
    started_ = worked();
  }

  void plain_frame(const imogene::ShownFrame& shown, const frame::Frame& pixels) {
    if (!loop_) {
      loop_ = plain::make(plain::best_variant(), plain_triangles(scene_), tables_of(platform_->shader(), shown.pose));
      rgb_.resize(pixels.rgb.size() + 64);
    }
    const plain::Pose pose = plain_pose(shown.pose);
    const double start = worked();
    if (!loop_->frame(pose, rgb_.data())) throw std::runtime_error("a triangle of the benchmark left the screen");
    const double end = worked();
    for (std::size_t i = 0; i < pixels.rgb.size(); ++i) measured_.different_bytes += rgb_[i] != pixels.rgb[i] ? 1 : 0;
    ++measured_.frames_compared;
    if (shown.frame < kWarmFrames) return;
    plain_.push_back(end - start);
    const plain::Parts parts = loop_->timed(pose, rgb_.data());
    set_up_.push_back(parts.set_up);
    spans_.push_back(parts.spans);
    shading_.push_back(parts.shading);
  }

  void measure_error(const imogene::ShownFrame& shown, const frame::Frame& pixels) {
    reference::RenderOptions options;
    options.columns = pixels.columns;
    options.lines = pixels.lines;
    options.grids = imogene::snap_grids(machine_);
    options.specular_mean = machine_.shading.specular_tables == 1;
    const frame::ExactFrame exact = reference::render(scene_, shown.pose, options);
    const double start = worked();
    const reference::LevelComparison levels = reference::compare_frames(pixels, exact);
    const double between = worked();
    const reference::ErrorFigures figures = meter_.measure(pixels, exact);
    const double end = worked();
    std::uint64_t compared = 0;
    for (const reference::LevelSums& sums : levels.regions) compared += sums.compared;
    if (compared == 0 || compared != figures.compared) throw std::runtime_error("wrong figures of two frames");
    if (shown.frame < kWarmFrames) return;
    levels_.push_back(between - start);
    metrics_.push_back(end - between);
  }

  Case case_;
  scene::Scene scene_;
  imogene::Machine machine_;
  std::unique_ptr<imogene::Imogene> platform_;
  std::unique_ptr<plain::Loop> loop_;
  std::vector<std::uint8_t> rgb_;
  double started_ = 0.0;
  reference::ErrorMeter meter_{{"ideal"}};
  std::vector<double> simulated_, plain_, set_up_, spans_, shading_, levels_, metrics_;
  Measured measured_;
};

}  // namespace

Measured measure(const Case& wanted) { return Pairs(wanted).run(); }

namespace {

Measured measure_in_child(const Case& wanted) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    bool written = false;
    try {
      const Measured measured = measure(wanted);
      written = write(ends[1], &measured, sizeof(measured)) == static_cast<ssize_t>(sizeof(measured));
    } catch (const std::exception& error) {
      static_cast<void>(std::fputs(error.what(), stderr));
    }
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  Measured measured;
  const ssize_t size = read(ends[0], &measured, sizeof(measured));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (child < 0 || status != 0 || size != static_cast<ssize_t>(sizeof(measured)))
    throw std::runtime_error("a measurement failed");
  return measured;
}

}  // namespace

Measured measure_apart(const Case& wanted) {
  Measured measured = measure_in_child(wanted);
  if (!wanted.plain) return measured;
  Case errors = wanted;
  errors.errors = true;
  const Measured of_errors = measure_in_child(errors);
  measured.levels = of_errors.levels;
  measured.metrics = of_errors.metrics;
  return measured;
}

}  // namespace rastertlm::benchmark
