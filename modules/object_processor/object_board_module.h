// An object board: the object processors of one computation unit behind one bus, sending one line of fragments a scan
// line.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <systemc>

#include "modules/object_processor/object_board.h"
#include "modules/stream/line_payload.h"
#include "modules/stream/line_pool.h"
#include "modules/stream/link.h"
#include "src/base/units.h"

namespace rastertlm::object_processor {

class ObjectBoardModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<ObjectBoardModule> bus;  // loading RAMs, memory mapped
  tlm_utils::simple_target_socket<ObjectBoardModule, stream::kNoBusWidth, stream::SyncProtocol> sync;
  tlm_utils::simple_initiator_socket<ObjectBoardModule, stream::kNoBusWidth, stream::FragmentProtocol> out;

  struct Timing {
    Clock clock;
    Cycles first_pixel;  // from the start of a line to the word of its first pixel leaving the board
  };

  ObjectBoardModule(const sc_core::sc_module_name& name, std::uint32_t board_number, ObjectBoard& board,
                    const Timing& timing, std::size_t columns, stream::Link& link);

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
  ObjectBoard& board_;
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

}  // namespace rastertlm::object_processor
