// The span unit on its board: register sets that are written while it draws, and spans on their way to the frame store.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <deque>
#include <functional>
#include <memory>
#include <systemc>

#include "modules/frame_store/span_payload.h"
#include "modules/span_unit/dealt_units.h"
#include "modules/span_unit/load_payload.h"
#include "modules/span_unit/span_unit.h"
#include "modules/stream/link.h"
#include "modules/stream/occupancy.h"

namespace rastertlm::span_unit {

class SpanUnitModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<SpanUnitModule, stream::kNoBusWidth, LoadProtocol> bus;
  tlm_utils::simple_initiator_socket<SpanUnitModule, stream::kNoBusWidth, frame_store::SpanProtocol> out;

  // A board of one unit, of several that share the columns of every triangle, or of several that triangles are dealt
  // to. `link`: to the frame store, a pixel of each unit a cycle of their clock; counted to the last whole word.
  SpanUnitModule(const sc_core::sc_module_name& name, const SpanUnitParameters& parameters, std::uint32_t columns,
                 std::uint32_t lines, stream::Link& link);

  // Told what a unit did from one time to another, in picoseconds: of each unit that triangles are dealt to, else of
  // all together.
  using Watcher =
      std::function<void(std::size_t unit, stream::Activity activity, std::uint64_t begin_ps, std::uint64_t end_ps)>;
  void watch(const Watcher& watcher);

  std::uint64_t loads_received() const { return loads_received_; }
  std::uint64_t words_loaded() const { return words_loaded_; }
  // From the first frame's start to the end of the unit's last triangle; of each unit that triangles are dealt to, else
  // of all together.
  std::vector<stream::Occupancy> occupancies() const;
  SpanCounters counters() const { return dealt_ ? dealt_->counters() : unit_.counters(); }
  // Cycles that units waited for the memory, all together.
  std::uint64_t memory_cycles() const;
  // When the last triangle ended.
  std::uint64_t end_ps() const { return clock_.picoseconds(Cycles(free_)); }

 private:
  void receive(LoadPayload& payload, sc_core::sc_time& delay);
  void begin_frame(LoadPayload& payload, sc_core::sc_time& delay);
  void end_frame(LoadPayload& payload, sc_core::sc_time& delay);
  void draw(LoadPayload& payload, sc_core::sc_time& delay);
  void tell(stream::Activity activity, std::uint64_t begin, std::uint64_t end) const;
  std::uint64_t set_free_ps() const;
  void draw_from(std::uint64_t cycle, const TriangleLoad& load);
  Cycles crossing(std::uint64_t begin_ps, const DrawnLines& drawn);
  std::uint64_t store(std::uint64_t begin_ps, Cycles taken, const DrawnLines& drawn, const TriangleLoad& load);

  SpanUnitParameters parameters_;
  SpanUnit unit_;
  std::unique_ptr<DealtUnits> dealt_;
  Clock clock_;
  stream::Link& link_;
  frame_store::SpanPayload payload_;
  std::uint64_t free_ = 0;               // cycle at which the last triangle ended
  std::uint64_t buffer_free_ = 0;        // cycle from which the frame may be drawn
  std::deque<std::uint64_t> starts_ps_;  // of the last shadow_sets triangles
  bool memory_keeps_up_ = false;         // as the store has said for the frame
  std::uint64_t loads_received_ = 0;
  std::uint64_t words_loaded_ = 0;
  std::uint64_t blocked_by_buffer_ = 0;
  std::uint64_t pixels_sent_ = 0;
  std::uint64_t sent_until_ = 0;  // cycle; of units that send by themselves
  stream::Occupancy occupancy_;
  Watcher watcher_;
};

}  // namespace rastertlm::span_unit
