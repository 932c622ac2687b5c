#include "modules/object_processor/object_board_module.h"

#include <cstring>
#include <span>

#include "modules/object_processor/bus_address.h"
#include "modules/object_processor/object_number_payload.h"
#include "modules/stream/simulated_time.h"

namespace rastertlm::object_processor {

static_assert(kBandLines == stream::kBandLines, "spans that are found together stay until all their lines are sent");

ObjectBoardModule::ObjectBoardModule(const sc_core::sc_module_name& name, std::uint32_t board_number,
                                     ObjectBoard& board, const Timing& timing, std::size_t columns, stream::Link& link)
    : sc_module(name),
      bus("bus"),
      sync("sync"),
      out("out"),
      board_number_(board_number),
      board_(board),
      first_pixel_(stream::to_time(timing.clock, timing.first_pixel)),
      link_(link),
      pool_(columns) {
  bus.register_b_transport(this, &ObjectBoardModule::write);
  sync.register_b_transport(this, &ObjectBoardModule::synchronise);
}

// A burst of consecutive words; the bus's time is annotated by whoever drives it.
void ObjectBoardModule::write(tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  const BusTarget target = bus_target(payload.get_address());
  const std::size_t count = payload.get_data_length() / sizeof(std::uint32_t);
  if (!payload.is_write()) {
    payload.set_response_status(tlm::TLM_COMMAND_ERROR_RESPONSE);
    return;
  }
  if (target.board != board_number_ || target.processor >= board_.processors() || target.word + count > kWords) {
    payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    return;
  }
  ProcessorWords words;
  std::memcpy(words.data(), payload.get_data_ptr(), count * sizeof(std::uint32_t));
  board_.write_words(target.processor, target.word, std::span(words).first(count));
  ObjectNumber* number = nullptr;
  payload.get_extension(number);
  if (number != nullptr && number->object != 0) board_.set_object(target.processor, number->object);
  words_loaded_ += count;
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

void ObjectBoardModule::synchronise(stream::SyncPayload& payload, sc_core::sc_time& delay) {
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  if (payload.kind == stream::SyncPayload::Kind::retrace) {
    retrace(payload);
    return;
  }
  payload_.frame = payload.frame;
  delay += first_pixel_;
  if (board_.covers_in_spans())
    send_spans(payload.lines, delay);
  else
    send_pixels(payload.lines, delay);
}

void ObjectBoardModule::retrace(const stream::SyncPayload& payload) {
  if (!payload.copy) return;
  board_.copy();
  ++copies_;
  if (payload.whole) words_whole_ = words_loaded_;
  words_ahead_ = words_loaded_ - words_whole_;
}

void ObjectBoardModule::send_spans(const stream::Lines& lines, sc_core::sc_time& delay) {
  spans_.lines = lines;
  board_.cover_lines(static_cast<std::uint32_t>(lines.first), lines.count, static_cast<std::uint32_t>(lines.step),
                     spans_.covered.data());
  payload_.spans = &spans_;
  send(lines.count, delay);
}

void ObjectBoardModule::send_pixels(const stream::Lines& lines, const sc_core::sc_time& delay) {
  for (std::size_t k = 0; k < lines.count; ++k) {
    payload_.line = lines.number(k);
    payload_.fragments = pool_.acquire();
    board_.evaluate_line(static_cast<std::uint32_t>(payload_.line), *payload_.fragments);
    sc_core::sc_time of_line = delay + stream::to_time(lines.later_ps[k]);
    send(1, of_line);
  }
}

void ObjectBoardModule::send(std::size_t lines, sc_core::sc_time& delay) {
  const std::uint64_t words = lines * board_.columns();
  link_.record(words, Cycles(words));
  lines_sent_ += lines;
  out->b_transport(payload_, delay);
}

}  // namespace rastertlm::object_processor
