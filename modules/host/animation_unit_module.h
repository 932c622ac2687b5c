// The animation unit: at every retrace that showed its last frame it announces the next one, settles the frame's grid
// from what the computation units report, and tells the table loader which way the lights now stand.
#pragma once

#include <functional>
#include <memory>
#include <systemc>

#include "modules/host/serial_links_module.h"
#include "modules/shading/light_payload.h"
#include "modules/stream/occupancy.h"

namespace rastertlm::host {

class AnimationUnitModule : public sc_core::sc_module {
 public:
  sc_core::sc_vector<MessageInitiator<AnimationUnitModule>> down;  // to the units that it feeds
  sc_core::sc_vector<MessageTarget<AnimationUnitModule>> up;       // their surveys
  tlm_utils::simple_initiator_socket<AnimationUnitModule, stream::kNoBusWidth, shading::LightProtocol>
      loader;  // the lights, to the table loader

  // Meshes that cross the links once, with the first frame: bytes for the units behind each link.
  using InitialLoad = std::vector<std::uint64_t>;

  struct Timeline {
    const sc_core::sc_event* swapped;                // at a retrace that showed the last frame
    std::function<std::uint64_t()> displayed_frame;  // whose retrace that was
  };

  AnimationUnitModule(const sc_core::sc_module_name& name, const Animation& animation, const HostCost& cost,
                      std::size_t children, std::size_t units, Overflow overflow, Timeline timeline,
                      const std::vector<stream::Link*>& links, InitialLoad initial_load = {},
                      stream::Link* bus = nullptr);

  // The frame that the machine shows after the next swap.
  const FrameWork& work() const { return *work_; }
  bool guarded() const { return guarded_; }
  std::uint64_t pieces_dropped() const { return pieces_dropped_; }  // of the frame of work()
  const stream::Occupancy& occupancy(std::uint64_t end_ps) { return meter_.close(end_ps); }
  stream::OccupancyMeter& meter() { return meter_; }

 private:
  void run_guarded();
  void run();
  void announce_frame(std::int64_t animation_frame, bool initial);
  void announce_lights();
  void settle_plan();
  void receive(MessagePayload& payload, sc_core::sc_time& delay);

  const Animation& animation_;
  const HostCost& cost_;
  std::size_t units_;
  Overflow overflow_;
  Timeline timeline_;
  std::vector<LinkPort> links_;
  InitialLoad initial_load_;
  stream::Link* bus_;  // to the table loader, which hangs on it as boards do on theirs; none: it takes no time
  std::unique_ptr<FrameWork> work_;
  MessagePayload payload_;
  shading::LightPayload light_payload_;
  geometry::OperationCounts light_operations_;  // of a frame in which the lights change
  std::vector<std::vector<Piece>> placed_;

  // Gathered from the surveys of a frame.
  std::size_t surveys_ = 0;
  std::uint64_t last_survey_ps_ = 0;
  bool guarded_ = false;
  std::vector<std::uint32_t> free_slots_;
  std::vector<Piece> homeless_;
  sc_core::sc_event sent_up_;

  std::uint64_t pieces_dropped_ = 0;
  stream::OccupancyMeter meter_;
};

}  // namespace rastertlm::host
