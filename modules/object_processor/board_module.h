// A board of processors of one kind: those of one computation unit behind one bus, sending one line of fragments a scan
// line. Board: ObjectBoard, or what has its interface; one without evaluate_line always covers in spans.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstring>
#include <span>
#include <systemc>

#include "modules/object_processor/bus_address.h"
#include "modules/object_processor/interval.h"
#include "modules/object_processor/object_number_payload.h"
#include "modules/stream/line_payload.h"
#include "modules/stream/line_pool.h"
#include "modules/stream/link.h"
#include "modules/stream/simulated_time.h"
#include "src/base/units.h"

namespace rastertlm::object_processor {

static_assert(kBandLines == stream::kBandLines, "spans that are found together stay until all their lines are sent");

template <class Board>
class BoardModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<BoardModule> bus;  // loading RAMs, memory mapped
  tlm_utils::simple_target_socket<BoardModule, stream::kNoBusWidth, stream::SyncProtocol> sync;
  tlm_utils::simple_initiator_socket<BoardModule, stream::kNoBusWidth, stream::FragmentProtocol> out;

  struct Timing {
    Clock clock;
    Cycles first_pixel;  // from the start of a line to the word of its first pixel leaving the board
  };

  BoardModule(const sc_core::sc_module_name& name, std::uint32_t board_number, Board& board, const Timing& timing,
              std::size_t columns, stream::Link& link);

  std::uint64_t words_loaded() const { return words_loaded_; }
  std::uint64_t lines_sent() const { return lines_sent_; }
  std::uint64_t copies() const { return copies_; }
  // Words in use that belong to an update which the computation units have not finished: what tears a picture.
  std::uint64_t words_ahead() const { return words_ahead_; }

 private:
  void write(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  void synchronise(stream::SyncPayload& payload, sc_core::sc_time& delay);
  void retrace(const stream::SyncPayload& payload);
  void send_spans(const stream::Lines& lines, sc_core::sc_time& delay);
  void send_pixels(const stream::Lines& lines, const sc_core::sc_time& delay);
  void send(std::size_t lines, sc_core::sc_time& delay);

  std::uint32_t board_number_;
  Board& board_;
  sc_core::sc_time first_pixel_;
  stream::Link& link_;
  stream::LinePool pool_;
  stream::SpanLines spans_;
  stream::FragmentPayload payload_;
  std::uint64_t words_loaded_ = 0;
  std::uint64_t lines_sent_ = 0;
  std::uint64_t copies_ = 0;
  std::uint64_t words_whole_ = 0;  // of words_loaded_, at the last copy of a whole frame
  std::uint64_t words_ahead_ = 0;
};

template <class Board>
BoardModule<Board>::BoardModule(const sc_core::sc_module_name& name, std::uint32_t board_number, Board& board,
                                const Timing& timing, std::size_t columns, stream::Link& link)
    : sc_module(name),
      bus("bus"),
      sync("sync"),
      out("out"),
      board_number_(board_number),
      board_(board),
      first_pixel_(stream::to_time(timing.clock, timing.first_pixel)),
      link_(link),
      pool_(columns) {
  bus.register_b_transport(this, &BoardModule::write);
  sync.register_b_transport(this, &BoardModule::synchronise);
}

// A burst of consecutive words; the bus's time is annotated by whoever drives it.
template <class Board>
void BoardModule<Board>::write(tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  const BusTarget target = bus_target(payload.get_address(), Board::kSlotShift);
  const std::size_t count = payload.get_data_length() / sizeof(std::uint32_t);
  if (!payload.is_write()) {
    payload.set_response_status(tlm::TLM_COMMAND_ERROR_RESPONSE);
    return;
  }
  if (target.board != board_number_ || target.processor >= board_.processors() ||
      target.word + count > board_.words_a_slot()) {
    payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    return;
  }
  typename Board::SlotImage words;
  std::memcpy(words.data(), payload.get_data_ptr(), count * sizeof(std::uint32_t));
  board_.write_words(target.processor, target.word, std::span(words).first(count));
  ObjectNumber* number = nullptr;
  payload.get_extension(number);
  if (number != nullptr && number->object != 0) board_.set_object(target.processor, number->object);
  words_loaded_ += count;
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

template <class Board>
void BoardModule<Board>::synchronise(stream::SyncPayload& payload, sc_core::sc_time& delay) {
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

template <class Board>
void BoardModule<Board>::retrace(const stream::SyncPayload& payload) {
  if (!payload.copy) return;
  board_.copy();
  ++copies_;
  if (payload.whole) words_whole_ = words_loaded_;
  words_ahead_ = words_loaded_ - words_whole_;
}

template <class Board>
void BoardModule<Board>::send_spans(const stream::Lines& lines, sc_core::sc_time& delay) {
  spans_.lines = lines;
  board_.cover_lines(static_cast<std::uint32_t>(lines.first), lines.count, static_cast<std::uint32_t>(lines.step),
                     spans_.covered.data());
  payload_.spans = &spans_;
  send(lines.count, delay);
}

template <class Board>
void BoardModule<Board>::send_pixels(const stream::Lines& lines, const sc_core::sc_time& delay) {
  if constexpr (requires { &Board::evaluate_line; })
    for (std::size_t k = 0; k < lines.count; ++k) {
      payload_.line = lines.number(k);
      payload_.fragments = pool_.acquire();
      board_.evaluate_line(static_cast<std::uint32_t>(payload_.line), *payload_.fragments);
      sc_core::sc_time of_line = delay + stream::to_time(lines.later_ps[k]);
      send(1, of_line);
    }
}

template <class Board>
void BoardModule<Board>::send(std::size_t lines, sc_core::sc_time& delay) {
  const std::uint64_t words = lines * board_.columns();
  link_.record(words, Cycles(words));
  lines_sent_ += lines;
  out->b_transport(payload_, delay);
}

}  // namespace rastertlm::object_processor
