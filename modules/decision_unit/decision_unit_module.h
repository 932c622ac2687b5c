// The decision unit: takes a line from every board and sends the nearest object at every pixel on to the shading
// processor.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <array>
#include <systemc>
#include <vector>

#include "modules/decision_unit/decision_unit.h"
#include "modules/stream/line_payload.h"
#include "modules/stream/link.h"

namespace rastertlm::decision_unit {

class DecisionUnitModule : public sc_core::sc_module {
 public:
  sc_core::sc_vector<
      tlm_utils::simple_target_socket_tagged<DecisionUnitModule, stream::kNoBusWidth, stream::FragmentProtocol>>
      in;  // one a board
  tlm_utils::simple_initiator_socket<DecisionUnitModule, stream::kNoBusWidth, stream::FragmentProtocol> out;

  // `latency`: from the word of a pixel leaving the boards to its decision, in cycles of `clock`.
  // `composer` makes pixels of lines that come as spans; boards send either all spans or all pixels. A board may be
  // ahead of others by the lines of a band.
  DecisionUnitModule(const sc_core::sc_module_name& name, DecisionUnit& unit, object_processor::LineComposer& composer,
                     std::size_t columns, std::size_t boards, const Clock& clock, Cycles latency, stream::Link& link);

  std::uint64_t lines_sent() const { return lines_sent_; }

 private:
  void receive(int board, stream::FragmentPayload& payload, sc_core::sc_time& delay);
  // A line that some boards have sent: pixels or spans, by board.
  struct Gathered {
    std::size_t boards = 0;
    std::size_t line = 0;
    bool in_pixels = true;
    std::vector<stream::LinePool::Handle> lines;
    std::vector<const frame::CoveredLine*> covered;
  };
  Gathered& gather(std::size_t board, stream::FragmentPayload& payload);
  void check_turn(std::size_t board, const stream::FragmentPayload& payload, const Gathered& gathered) const;
  stream::LinePool::Handle merged(Gathered& gathered);

  DecisionUnit& unit_;
  object_processor::LineComposer& composer_;
  sc_core::sc_time latency_;
  stream::Link& link_;
  stream::LinePool pool_;
  std::array<Gathered, stream::kBandLines> gathered_;  // by the line's place in its band
  std::size_t open_ = 0;   // of them, those that some boards have sent
  std::size_t band_ = 0;   // to which they belong
  std::vector<frame::FragmentLine*> pointers_;
  stream::FragmentPayload payload_;
  std::uint64_t lines_sent_ = 0;
};

}  // namespace rastertlm::decision_unit
