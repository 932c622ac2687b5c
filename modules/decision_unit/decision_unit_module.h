// The decision unit: takes a line from every board and sends the nearest object at every pixel on to the shading
// processor.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

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
  // `composer` makes pixels of lines that come as spans; boards send either all spans, of the same lines, or all
  // pixels.
  DecisionUnitModule(const sc_core::sc_module_name& name, DecisionUnit& unit, object_processor::LineComposer& composer,
                     std::size_t columns, std::size_t boards, const Clock& clock, Cycles latency, stream::Link& link);

  std::uint64_t lines_sent() const { return lines_sent_; }

 private:
  void receive(int board, stream::FragmentPayload& payload, sc_core::sc_time& delay);
  void gather(std::size_t board, stream::FragmentPayload& payload);
  void check_turn(std::size_t board, const stream::FragmentPayload& payload) const;
  void merge_pixels();
  void merge_spans(std::size_t k);
  void send(std::size_t line, sc_core::sc_time& delay);

  DecisionUnit& unit_;
  object_processor::LineComposer& composer_;
  sc_core::sc_time latency_;
  stream::Link& link_;
  stream::LinePool pool_;
  // What is being gathered, by board: pixels of a line, or spans of some.
  std::vector<stream::LinePool::Handle> pixels_;
  std::vector<frame::FragmentLine*> pointers_;
  std::vector<const stream::SpanLines*> spans_;
  std::vector<const frame::CoveredLine*> covered_;  // of one of the lines
  std::size_t gathered_ = 0;                        // boards
  stream::Lines lines_;
  bool in_spans_ = false;
  stream::FragmentPayload payload_;
  std::uint64_t lines_sent_ = 0;
};

}  // namespace rastertlm::decision_unit
