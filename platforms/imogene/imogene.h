// The I.M.O.G.E.N.E. machine put together (004, figures 5.1 and 5.5). Assembly only: cores compute, modules decide
// when, and this says who is connected to whom.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <systemc>
#include <vector>

#include "modules/decision_unit/decision_unit_module.h"
#include "modules/host/animation_unit_module.h"
#include "modules/host/computation_unit_module.h"
#include "modules/host/link_topology.h"
#include "modules/object_processor/object_board_module.h"
#include "modules/quadric_processor/quadric_board_module.h"
#include "modules/shading/deferred_shading_module.h"
#include "modules/shading/table_loader_module.h"
#include "modules/stream/tap_module.h"
#include "modules/video/video_output_module.h"
#include "modules/video/video_timing_module.h"
#include "platforms/imogene/machine.h"
#include "src/scene/scene.h"

namespace rastertlm::imogene {

// A machine that has shown nothing after so many video frames never will, and hosts that have not finished.
inline constexpr std::uint64_t kPatienceFrames = 100'000;

struct Options {
  std::uint64_t frames = 1;       // to show; of interlaced video, of two fields each
  bool model_everything = false;  // evaluate every processor on every line
  // Observers of the decision unit's and of the shading processor's output, called inside the simulation for every
  // line; none where empty.
  stream::Observer<stream::FragmentPayload> decided = {};
  stream::Observer<stream::RgbPayload> shaded = {};
  bool observe = true;  // frames have all their planes; without, their levels alone
};

// What a video frame shows, as the hosts left it: a displayed frame, or one of its two fields where it is interlaced.
struct ShownFrame {
  std::uint64_t frame = 0;        // displayed frame
  std::size_t field = 0;          // of it: 0 even lines, 1 odd lines
  bool updated = false;           // new coefficients came in at its retrace
  std::uint64_t video_frame = 0;  // since the start of the simulation
  // Where updated: of the slowest unit, from the retrace that started the update to its last word, and how many video
  // frames passed to the retrace that copied it.
  Cycles host_cycles;
  std::uint64_t host_frames = 0;
  // Pixel clocks from its retrace to the end of a load into the tables that it is shaded from, and before which a line
  // that starts finds them not written to their ends; 0: none.
  Cycles table_load;
  Cycles tables_wait;
  std::int64_t animation_frame = 0;
  scene::Pose pose;
  bool guarded = false;
  host::TriangleCounts triangles;
  host::QuadricCounts solids;
  std::uint64_t flops = 0;  // of the update
  std::uint64_t words = 0;
  std::uint64_t pieces_dropped = 0;  // of clipped triangles, that found no processor
  // A torn picture: words in use that belong to an update which the computation units have not finished; objects of one
  // frame in the light of another.
  std::uint64_t words_ahead = 0;
  bool light_apart = false;
  std::uint64_t late_table_lines = 0;
  std::uint64_t first_pixel_ps = 0;  // of the field, since the first displayed frame's retrace began
  std::uint64_t last_pixel_ps = 0;
};

// Where cycles and bytes went while the frames were displayed.
struct Books {
  stream::Occupancy animation_unit;
  std::vector<stream::Occupancy> computation_units;
  std::array<stream::Occupancy, shading::TableLoaderModule::kEngines> table_loaders{};
  std::vector<stream::Link> links;
};

class Imogene {
 public:
  // Called after every video frame that is shown, with the displayed frame as far as it has come.
  using Sink = std::function<void(const ShownFrame&, const frame::Frame&)>;

  // Machine and scene outlive it. Throws InputError where the machine cannot take the scene. One a process.
  Imogene(const Machine& machine, const scene::Scene& scene, const Options& options, Sink sink);

  // Simulates until the last frame has been shown, and checks the identities of conservation (ModelError).
  void run();

  const Options& options() const { return options_; }
  const Machine& machine() const { return machine_; }
  const video::Timing& timing() const { return timing_; }
  const geometry::SnapGrids& grids() const { return grids_; }
  const host::HostCost& cost() const { return cost_; }
  const host::SlotMap& slots() const { return slots_; }  // of triangles
  const host::SlotMap& solid_slots() const { return solid_slots_; }
  std::uint64_t resident_solid_bytes() const;  // of the solids that have a processor, in the units' memories
  const host::Animation& animation() const { return animation_; }
  std::uint64_t start_ps() const { return video_timing_->first_frame_ps(); }
  std::uint64_t end_ps() const { return end_ps_; }
  std::uint64_t updates() const { return video_timing_->updates(); }
  std::uint64_t frames_before_first() const { return video_timing_->frames_before_first(); }

  // Latencies in pixel clocks: from a pixel's cycle in the first processor to its decision, and to its levels.
  Cycles decision_latency() const { return decision_latency_; }
  Cycles pixel_latency() const { return pixel_latency_; }

  std::vector<object_processor::ObjectBoard>& boards() { return boards_; }
  std::vector<std::unique_ptr<object_processor::ObjectBoardModule>>& board_modules() { return board_modules_; }
  // One a computation unit, where the machine has quadric processors. Without a solid no processor of them is
  // simulated.
  std::vector<quadric_processor::QuadricBoard>& quadric_boards() { return quadric_boards_; }
  std::vector<std::unique_ptr<quadric_processor::QuadricBoardModule>>& quadric_modules() { return quadric_modules_; }
  std::vector<std::unique_ptr<host::ComputationUnitModule>>& computation_units() { return computation_units_; }
  host::AnimationUnitModule& animation_unit() { return *animation_unit_; }
  shading::DeferredShader& shader() { return shader_; }
  shading::TableLoaderModule& table_loader() { return *table_loader_; }
  decision_unit::DecisionUnit& decision() { return decision_; }
  decision_unit::DecisionUnitModule& decision_module() { return *decision_module_; }
  const Books& books() const { return books_; }
  std::deque<stream::Link>& links() { return links_; }
  // The most processors that pieces of clipped triangles asked for in a displayed frame, beyond one a triangle.
  std::uint64_t most_pieces() const { return most_pieces_; }

 private:
  void load_materials();
  void build_links();
  void build_hosts();
  void build_boards();
  void build_quadric_boards();
  bool has_quadrics() const { return machine_.quadric.per_unit > 0; }
  Cycles first_pixel_of_boards() const;  // from the start of a line
  void build_shading();
  void build_video();
  void bind_hosts();
  void bind_display();
  void note_shown(std::uint64_t frame, std::size_t field, const frame::Frame& pixels, std::uint64_t last_line_ps);
  void note_deadlines();
  void reset_host_links();
  void close_books();
  void settle();
  void check_identities();
  stream::Link& add_link(const std::string& name, unsigned bits, const Clock& clock);

  const Machine& machine_;
  const scene::Scene& scene_;
  Options options_;
  Sink sink_;
  video::Timing timing_;
  geometry::SnapGrids grids_;
  host::HostCost cost_;
  host::SlotMap slots_;
  host::SlotMap solid_slots_;
  host::ResidentScene resident_;
  host::Animation animation_;
  Cycles decision_latency_;
  Cycles pixel_latency_;

  std::deque<stream::Link> links_;
  std::vector<stream::Link*> host_links_;     // to unit k, from whoever feeds it
  std::vector<stream::Link*> up_links_;       // from unit k
  std::vector<stream::Link*> bus_links_;      // of unit k
  std::vector<stream::Link*> board_links_;    // of board k
  std::vector<stream::Link*> quadric_links_;  // of quadric board k
  std::vector<stream::Link*> table_links_;
  stream::Link* loader_bus_ = nullptr;
  std::vector<std::unique_ptr<host::Computation>> computations_;
  std::vector<std::unique_ptr<host::QuadricComputation>> quadric_computations_;
  std::vector<object_processor::ObjectBoard> boards_;
  std::vector<quadric_processor::QuadricBoard> quadric_boards_;
  decision_unit::DecisionUnit decision_;
  object_processor::LineComposer composer_;
  shading::DeferredShader shader_;

  std::unique_ptr<video::VideoTimingModule> video_timing_;
  std::unique_ptr<host::AnimationUnitModule> animation_unit_;
  std::vector<std::unique_ptr<host::ComputationUnitModule>> computation_units_;
  std::vector<std::unique_ptr<object_processor::ObjectBoardModule>> board_modules_;
  std::vector<std::unique_ptr<quadric_processor::QuadricBoardModule>> quadric_modules_;
  std::unique_ptr<decision_unit::DecisionUnitModule> decision_module_;
  std::unique_ptr<shading::DeferredShadingModule> shading_module_;
  std::unique_ptr<shading::TableLoaderModule> table_loader_;
  std::unique_ptr<video::VideoOutputModule> video_output_;
  std::unique_ptr<stream::TapModule<stream::FragmentPayload>> decided_tap_;
  std::unique_ptr<stream::TapModule<stream::RgbPayload>> shaded_tap_;
  std::deque<sc_core::sc_signal<bool>> ready_;
  sc_core::sc_signal<bool> tables_ready_{"tables_ready"};

  ShownFrame shown_;
  const frame::Frame* pixels_ = nullptr;  // of shown_, until it has been handed on
  std::uint64_t updates_seen_ = 0;
  std::uint64_t end_ps_ = 0;
  std::uint64_t most_pieces_ = 0;
  Books books_;
};

}  // namespace rastertlm::imogene
