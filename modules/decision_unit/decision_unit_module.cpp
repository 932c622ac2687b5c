#include "modules/decision_unit/decision_unit_module.h"

#include <utility>

#include "modules/stream/simulated_time.h"
#include "src/base/errors.h"

namespace rastertlm::decision_unit {

DecisionUnitModule::DecisionUnitModule(const sc_core::sc_module_name& name, DecisionUnit& unit, std::size_t boards,
                                       const Clock& clock, Cycles latency, stream::Link& link)
    : sc_module(name),
      in("in", boards),
      out("out"),
      unit_(unit),
      latency_(stream::to_time(clock, latency)),
      link_(link),
      lines_(boards),
      pointers_(boards) {
  for (std::size_t board = 0; board < boards; ++board)
    in[board].register_b_transport(this, &DecisionUnitModule::receive, static_cast<int>(board));
}

// The boards send in step, so the line goes on when the last of them has sent it.
void DecisionUnitModule::receive(int board, stream::FragmentPayload& payload, sc_core::sc_time& delay) {
  const auto index = static_cast<std::size_t>(board);
  if (lines_[index] || (gathered_ > 0 && payload.line != line_))
    throw ModelError(name(), lines_sent_,
                     "board " + std::to_string(board) + " sent line " + std::to_string(payload.line) + " while line " +
                         std::to_string(line_) + " was being gathered");
  line_ = payload.line;
  lines_[index] = std::move(payload.fragments);
  pointers_[index] = lines_[index].get();
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  if (++gathered_ < lines_.size()) return;

  gathered_ = 0;
  unit_.merge(pointers_);
  payload_.frame = payload.frame;
  payload_.line = payload.line;
  payload_.fragments = std::move(lines_[0]);
  for (auto& line : lines_) line.reset();
  const std::size_t columns = payload_.fragments->columns();
  link_.record(columns, Cycles(columns));
  ++lines_sent_;
  delay += latency_;
  out->b_transport(payload_, delay);
}

}  // namespace rastertlm::decision_unit
