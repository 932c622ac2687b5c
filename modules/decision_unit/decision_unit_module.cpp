#include "modules/decision_unit/decision_unit_module.h"

#include <algorithm>
#include <utility>

#include "modules/stream/simulated_time.h"
#include "src/base/errors.h"

namespace rastertlm::decision_unit {

DecisionUnitModule::DecisionUnitModule(const sc_core::sc_module_name& name, DecisionUnit& unit,
                                       object_processor::LineComposer& composer, std::size_t columns,
                                       std::size_t boards, const Clock& clock, Cycles latency, stream::Link& link)
    : sc_module(name),
      in("in", boards),
      out("out"),
      unit_(unit),
      composer_(composer),
      latency_(stream::to_time(clock, latency)),
      link_(link),
      pool_(columns),
      lines_(boards),
      pointers_(boards),
      covered_(boards) {
  for (std::size_t board = 0; board < boards; ++board)
    in[board].register_b_transport(this, &DecisionUnitModule::receive, static_cast<int>(board));
}

// The boards send in step, so the line goes on when the last of them has sent it.
void DecisionUnitModule::receive(int board, stream::FragmentPayload& payload, sc_core::sc_time& delay) {
  gather(static_cast<std::size_t>(board), payload);
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  if (gathered_ < covered_.size()) return;
  payload_.frame = payload.frame;
  payload_.line = payload.line;
  payload_.fragments = merged();
  const std::size_t columns = payload_.fragments->columns();
  link_.record(columns, Cycles(columns));
  ++lines_sent_;
  delay += latency_;
  out->b_transport(payload_, delay);
}

void DecisionUnitModule::gather(std::size_t board, stream::FragmentPayload& payload) {
  const bool in_pixels = payload.covered == nullptr;
  const bool in_turn = gathered_ == 0 || (payload.line == line_ && in_pixels == in_pixels_ &&
                                          (in_pixels ? !lines_[board] : covered_[board] == nullptr));
  if (!in_turn)
    throw ModelError(name(), lines_sent_,
                     "board " + std::to_string(board) + " sent line " + std::to_string(payload.line) + " while line " +
                         std::to_string(line_) + " was being gathered");
  line_ = payload.line;
  in_pixels_ = in_pixels;
  if (in_pixels)
    lines_[board] = std::move(payload.fragments);
  else
    covered_[board] = payload.covered;
  ++gathered_;
}

stream::LinePool::Handle DecisionUnitModule::merged() {
  gathered_ = 0;
  stream::LinePool::Handle line;
  if (in_pixels_) {
    for (std::size_t board = 0; board < lines_.size(); ++board) pointers_[board] = lines_[board].get();
    unit_.merge(pointers_);
    line = std::move(lines_[0]);
    for (auto& other : lines_) other.reset();
  } else {
    line = pool_.acquire();
    unit_.merge(covered_, static_cast<std::uint32_t>(line_), composer_, *line);
    std::fill(covered_.begin(), covered_.end(), nullptr);
  }
  return line;
}

}  // namespace rastertlm::decision_unit
