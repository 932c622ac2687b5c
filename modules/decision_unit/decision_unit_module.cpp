#include "modules/decision_unit/decision_unit_module.h"

#include <fmt/format.h>

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
      pixels_(boards),
      pointers_(boards),
      spans_(boards),
      covered_(boards) {
  for (std::size_t board = 0; board < boards; ++board)
    in[board].register_b_transport(this, &DecisionUnitModule::receive, static_cast<int>(board));
}

// The boards send in step, so lines go on when the last of them has sent them.
void DecisionUnitModule::receive(int board, stream::FragmentPayload& payload, sc_core::sc_time& delay) {
  gather(static_cast<std::size_t>(board), payload);
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  if (gathered_ < pixels_.size()) return;
  gathered_ = 0;
  payload_.frame = payload.frame;
  for (std::size_t k = 0; k < lines_.count; ++k) {
    if (in_spans_)
      merge_spans(k);
    else
      merge_pixels();
    sc_core::sc_time of_line = delay + latency_ + stream::to_time(lines_.later_ps[k]);
    send(lines_.number(k), of_line);
  }
  std::fill(spans_.begin(), spans_.end(), nullptr);
}

void DecisionUnitModule::send(std::size_t line, sc_core::sc_time& delay) {
  payload_.line = line;
  const std::size_t columns = payload_.fragments->columns();
  link_.record(columns, Cycles(columns));
  ++lines_sent_;
  out->b_transport(payload_, delay);
}

void DecisionUnitModule::check_turn(std::size_t board, const stream::FragmentPayload& payload) const {
  const bool in_spans = payload.spans != nullptr;
  const stream::Lines lines = in_spans ? payload.spans->lines : stream::Lines{payload.line};
  const bool twice = pixels_[board] || spans_[board] != nullptr;
  if (gathered_ > 0 && (twice || in_spans != in_spans_ || !(lines == lines_)))
    throw ModelError(
        name(), lines_sent_,
        fmt::format("board {} sent line {} while line {} was being gathered", board, lines.first, lines_.first));
}

void DecisionUnitModule::gather(std::size_t board, stream::FragmentPayload& payload) {
  check_turn(board, payload);
  in_spans_ = payload.spans != nullptr;
  if (in_spans_) {
    lines_ = payload.spans->lines;
    spans_[board] = payload.spans;
  } else {
    lines_ = {payload.line};
    pixels_[board] = std::move(payload.fragments);
  }
  ++gathered_;
}

void DecisionUnitModule::merge_pixels() {
  for (std::size_t board = 0; board < pixels_.size(); ++board) pointers_[board] = pixels_[board].get();
  unit_.merge(pointers_);
  payload_.fragments = std::move(pixels_[0]);
  for (auto& other : pixels_) other.reset();
}

void DecisionUnitModule::merge_spans(std::size_t k) {
  for (std::size_t board = 0; board < spans_.size(); ++board) covered_[board] = spans_[board]->covered[k];
  payload_.fragments = pool_.acquire();
  unit_.merge(covered_, static_cast<std::uint32_t>(lines_.number(k)), composer_, *payload_.fragments);
}

}  // namespace rastertlm::decision_unit
