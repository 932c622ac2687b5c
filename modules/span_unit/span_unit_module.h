// The span unit on its board: register sets that are written while it draws, and spans on their way to the frame store.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <deque>
#include <systemc>

#include "modules/frame_store/span_payload.h"
#include "modules/span_unit/load_payload.h"
#include "modules/span_unit/span_unit.h"
#include "modules/stream/link.h"
#include "modules/stream/occupancy.h"

namespace rastertlm::span_unit {

class SpanUnitModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<SpanUnitModule, stream::kNoBusWidth, LoadProtocol> bus;
  tlm_utils::simple_initiator_socket<SpanUnitModule, stream::kNoBusWidth, frame_store::SpanProtocol> out;

  // `link`: to the frame store, a pixel a cycle of the unit's clock.
  SpanUnitModule(const sc_core::sc_module_name& name, const SpanUnitParameters& parameters, SpanUnit& unit,
                 stream::Link& link);

  std::uint64_t loads_received() const { return loads_received_; }
  // From the first frame's start to the end of the last triangle.
  stream::Occupancy occupancy() const;
  // Cycles of drawing that the memory took longer.
  std::uint64_t memory_cycles() const { return occupancy_.blocked - blocked_by_buffer_; }
  std::uint64_t buffer_cycles() const { return blocked_by_buffer_; }
  // When the last triangle ended.
  std::uint64_t end_ps() const { return clock_.picoseconds(Cycles(free_)); }

 private:
  void receive(LoadPayload& payload, sc_core::sc_time& delay);
  void begin_frame(LoadPayload& payload, sc_core::sc_time& delay);
  void end_frame(LoadPayload& payload, sc_core::sc_time& delay);
  void draw(LoadPayload& payload, sc_core::sc_time& delay);
  std::uint64_t set_free_ps() const;
  void draw_from(std::uint64_t cycle, const TriangleLoad& load);

  SpanUnitParameters parameters_;
  SpanUnit& unit_;
  Clock clock_;
  stream::Link& link_;
  frame_store::SpanPayload payload_;
  std::uint64_t free_ = 0;               // cycle at which the last triangle ended
  std::uint64_t buffer_free_ = 0;        // cycle from which the frame may be drawn
  std::deque<std::uint64_t> starts_ps_;  // of the last shadow_sets triangles
  std::uint64_t loads_received_ = 0;
  std::uint64_t blocked_by_buffer_ = 0;
  stream::Occupancy occupancy_;
};

}  // namespace rastertlm::span_unit
