// The set-up processor: computes triangle after triangle and writes their loads to the span unit, while that draws.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>

#include <functional>
#include <systemc>
#include <utility>
#include <vector>

#include "modules/host/cost_model.h"
#include "modules/host/resident_scene.h"
#include "modules/host/set_up_work.h"
#include "modules/span_unit/load_payload.h"
#include "modules/stream/link.h"
#include "modules/stream/occupancy.h"

namespace rastertlm::host {

// A frame as it was computed and drawn. Times in picoseconds since the start of the simulation.
struct SetUpFrame {
  std::int64_t animation_frame = 0;
  geometry::Pose pose;
  SetUpCounts counts;
  set_up::ColourSteps colour_steps;
  std::uint64_t begin_ps = 0;  // of its set-up
  std::uint64_t end_ps = 0;    // its last word has been written
  std::uint64_t shown_ps = 0;
  Cycles computing;
  Cycles writing;
  Cycles blocked;  // no register set was free
};

class SetUpProcessorModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<SetUpProcessorModule, stream::kNoBusWidth, span_unit::LoadProtocol> bus;

  struct Timeline {
    std::function<geometry::Pose(std::int64_t frame)> pose;
    bool viewer_at_eye = false;
    std::uint64_t frames = 1;
    std::function<void(const SetUpFrame&)> drawn;  // called when a frame has been drawn
    std::function<bool()> goes_on{};               // whether one more is, after so many; none: no
  };

  // Frames are computed one after the other; simulated time follows at each frame's end. `link`: the bus.
  SetUpProcessorModule(const sc_core::sc_module_name& name, SetUpWork& work, const HostCost& cost, Timeline timeline,
                       stream::Link& link);

  // Told what it did, and when.
  void watch(stream::ActivityWatcher watcher) { watcher_ = std::move(watcher); }

  bool finished() const { return finished_; }
  std::uint64_t words_sent() const { return words_sent_; }
  // From the start of the first frame to the end of the last one's set-up.
  const stream::Occupancy& occupancy() const { return occupancy_; }

 private:
  void run_guarded();
  void run();
  void compute(SetUpFrame& frame);
  void send(const span_unit::TriangleLoad& load, SetUpFrame& frame);
  void spend(stream::Activity activity, Cycles cycles);
  void transport(span_unit::LoadPayload::Kind kind);
  std::uint64_t now_ps() const { return cost_.clock().picoseconds(now_); }

  SetUpWork& work_;
  const HostCost& cost_;
  set_up::BusCrossings crossings_;
  Timeline timeline_;
  stream::Link& link_;
  span_unit::LoadPayload payload_;
  Cycles now_;  // of the processor; simulated time is never later
  std::uint64_t words_sent_ = 0;
  stream::Occupancy occupancy_;
  bool finished_ = false;
  stream::ActivityWatcher watcher_;
};

}  // namespace rastertlm::host
