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
      pointers_(boards) {
  for (Gathered& gathered : gathered_) {
    gathered.lines.resize(boards);
    gathered.covered.resize(boards);
  }
  for (std::size_t board = 0; board < boards; ++board)
    in[board].register_b_transport(this, &DecisionUnitModule::receive, static_cast<int>(board));
}

// A line goes on when the last board has sent it.
void DecisionUnitModule::receive(int board, stream::FragmentPayload& payload, sc_core::sc_time& delay) {
  Gathered& gathered = gather(static_cast<std::size_t>(board), payload);
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  if (gathered.boards < pointers_.size()) return;
  payload_.frame = payload.frame;
  payload_.line = payload.line;
  payload_.fragments = merged(gathered);
  const std::size_t columns = payload_.fragments->columns();
  link_.record(columns, Cycles(columns));
  ++lines_sent_;
  delay += latency_;
  out->b_transport(payload_, delay);
}

void DecisionUnitModule::check_turn(std::size_t board, const stream::FragmentPayload& payload,
                                    const Gathered& gathered) const {
  const auto refuse = [&](const std::string& why) {
    throw ModelError(name(), lines_sent_,
                     "board " + std::to_string(board) + " sent line " + std::to_string(payload.line) + why);
  };
  if (open_ > 0 && payload.line / stream::kBandLines != band_)
    refuse(" while lines from " + std::to_string(band_ * stream::kBandLines) + " on were being gathered");
  if (gathered.boards == 0) return;
  if (gathered.lines[board] || gathered.covered[board] != nullptr) refuse(" twice");
  if (gathered.in_pixels != (payload.covered == nullptr)) refuse(" in another form than other boards");
}

DecisionUnitModule::Gathered& DecisionUnitModule::gather(std::size_t board, stream::FragmentPayload& payload) {
  Gathered& gathered = gathered_[payload.line % stream::kBandLines];
  check_turn(board, payload, gathered);
  band_ = payload.line / stream::kBandLines;
  gathered.line = payload.line;
  gathered.in_pixels = payload.covered == nullptr;
  if (gathered.in_pixels)
    gathered.lines[board] = std::move(payload.fragments);
  else
    gathered.covered[board] = payload.covered;
  open_ += gathered.boards == 0 ? 1 : 0;
  ++gathered.boards;
  return gathered;
}

stream::LinePool::Handle DecisionUnitModule::merged(Gathered& gathered) {
  gathered.boards = 0;
  --open_;
  stream::LinePool::Handle line;
  if (gathered.in_pixels) {
    for (std::size_t board = 0; board < pointers_.size(); ++board) pointers_[board] = gathered.lines[board].get();
    unit_.merge(pointers_);
    line = std::move(gathered.lines[0]);
    for (auto& other : gathered.lines) other.reset();
  } else {
    line = pool_.acquire();
    unit_.merge(gathered.covered, static_cast<std::uint32_t>(gathered.line), composer_, *line);
    std::fill(gathered.covered.begin(), gathered.covered.end(), nullptr);
  }
  return line;
}

}  // namespace rastertlm::decision_unit
