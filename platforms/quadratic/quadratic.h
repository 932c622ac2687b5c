// The quadratic-shading machine put together (000/001; its figure 6 is the span unit). Assembly only: cores compute,
// modules decide when, and this says who is connected to whom.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <systemc>
#include <utility>
#include <vector>

#include "modules/frame_store/frame_store_module.h"
#include "modules/host/set_up_processor_module.h"
#include "modules/host/software_renderer.h"
#include "modules/pixel_unit/pixel_unit_module.h"
#include "modules/span_unit/span_unit_module.h"
#include "modules/video/video_output_module.h"
#include "platforms/quadratic/machine.h"
#include "src/scene/scene.h"

namespace rastertlm::quadratic {

struct Options {
  std::uint64_t frames = 1;  // to show; where later ones are seen on their screens, as many more are drawn
  bool observe = true;       // frames have all their planes; without, their levels alone
};

// What drawing a frame took.
struct FrameWork {
  std::uint64_t span_cycles = 0;     // of the busiest span unit, in its clock: loads, lines, pixels
  std::uint64_t waiting_cycles = 0;  // of a span unit for the memory, or for a pixel unit before it; the mean of all
  std::uint64_t starved_cycles = 0;  // of a span unit for set-up, with its buffer free or not; the mean of all
  std::uint64_t shading_cycles = 0;  // of a pixel unit, in its clock: loads, lines, pixels
  std::uint64_t shaded_pixels = 0;   // by it
  std::uint64_t shading_flops = 0;   // of its lines and pixels; a triangle's set-up is the host's
  std::uint64_t accesses = 0;        // of the memory's busiest bank, for spans
};

// A frame that is shown, and how it came to be.
struct ShownFrame {
  host::SetUpFrame set_up;
  std::uint64_t first_pixel_ps = 0;  // since the start of the simulation
  std::uint64_t last_pixel_ps = 0;
  std::uint64_t drawn_ps = 0;     // when its last pixel was in the store
  span_unit::SpanCounters drawn;  // of this frame
  FrameWork work;
  std::uint64_t torn_lines = 0;  // of its screen, that do not show it as it was when it was whole
};

class Quadratic {
 public:
  // Called for every frame, in order.
  using Sink = std::function<void(const ShownFrame&, const frame::Frame&)>;

  // Machine and scene outlive it. Throws InputError where the machine cannot take the scene. One a process.
  Quadratic(const Machine& machine, const scene::Scene& scene, const Options& options, Sink sink);

  // Told, while it runs, what units did and what crossed the links; before the simulation.
  struct Watchers {
    stream::ActivityWatcher set_up_processor;
    span_unit::SpanUnitModule::Watcher span_units;
    frame_store::MemorySchedule::Watcher memory;
    stream::LinkWatcher bus;
    stream::LinkWatcher pixels;
  };
  void watch(const Watchers& watchers);

  // Simulates until the last frame has been shown, and checks the identities of conservation (ModelError).
  void run();

  const Machine& machine() const { return machine_; }
  const video::Timing& timing() const { return timing_; }
  const host::HostCost& cost() const { return cost_; }
  const host::SetUpWork& work() const { return *work_; }
  // How it renders the scene, for others that do. Outlived by the platform.
  host::Rendering rendering() const;
  const host::SetUpProcessorModule& set_up_processor() const { return *set_up_processor_; }
  const span_unit::SpanUnitModule& span_unit() const { return *span_unit_; }
  // Of a machine whose method shades pixels; else null.
  const pixel_unit::PixelUnitModule* pixel_unit() const { return pixel_unit_.get(); }
  const frame_store::FrameStore& store() const { return store_; }
  const frame_store::FrameStoreModule& frame_store() const { return *frame_store_; }
  // In this order; then a pixel unit's.
  static constexpr std::size_t kBusLink = 0, kPixelLink = 1, kScreenLink = 2;
  const std::deque<stream::Link>& links() const { return links_; }
  std::vector<ShownFrame> const& frames() const { return frames_; }
  // When the last frame is shown: what was simulated, ends there.
  std::uint64_t end_ps() const { return frames_.back().set_up.shown_ps; }
  // Frames completed a second: the intervals between the run's frames, from the first to the last that was shown; the
  // display's rate where they take no time, because nothing is drawn.
  // Throws std::logic_error where there is but one frame, which has none.
  double frames_per_second() const;

 private:
  void check_scene() const;
  void bind_pixels();
  void note_screen(std::uint64_t number, const frame::Frame& pixels);
  bool waits_for_screen() const;
  void hand_on();
  void hand_on_screens();
  void note_drawn(const host::SetUpFrame& frame);
  FrameWork work_since_last();
  void note_screens();
  void check_identities() const;

  const Machine& machine_;
  const scene::Scene& scene_;
  Options options_;
  Sink sink_;
  video::Timing timing_;
  host::HostCost cost_;
  host::ResidentScene resident_;
  std::unique_ptr<host::SetUpWork> work_;
  frame_store::FrameStore store_;
  std::deque<stream::Link> links_;

  std::unique_ptr<host::SetUpProcessorModule> set_up_processor_;
  std::unique_ptr<span_unit::SpanUnitModule> span_unit_;
  std::unique_ptr<pixel_unit::PixelUnitModule> pixel_unit_;
  std::unique_ptr<frame_store::FrameStoreModule> frame_store_;
  std::unique_ptr<video::VideoOutputModule> video_output_;

  ShownFrame shown_;
  frame::Frame pixels_;                          // with what observers see
  const frame::Frame* shown_pixels_ = &pixels_;  // that, or the screen's alone
  span_unit::SpanCounters drawn_before_;
  std::vector<std::uint64_t> busy_before_;  // of each span unit
  std::uint64_t waiting_before_ = 0;
  std::uint64_t starved_before_ = 0;
  std::uint64_t accesses_before_ = 0;
  std::uint64_t shading_before_ = 0;
  std::uint64_t shaded_before_ = 0;
  std::uint64_t shading_flops_before_ = 0;
  // Of pictures that change while they are shown: those that have been shown, and not been handed on.
  std::vector<std::pair<std::uint64_t, frame::Frame>> screens_;
  std::uint64_t screens_shown_ = 0;
  bool waiting_ = false;  // shown_ has not been handed on
  std::vector<ShownFrame> frames_;
};

}  // namespace rastertlm::quadratic
