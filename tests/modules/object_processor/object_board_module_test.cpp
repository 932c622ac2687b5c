// Do bus writes reach the words that their addresses name, wait for the retrace, and does a line leave at its time?
#include "modules/object_processor/object_board_module.h"

#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include "modules/object_processor/bus_address.h"
#include "modules/object_processor/line_composer.h"
#include "modules/object_processor/object_number_payload.h"
#include "modules/stream/simulated_time.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::object_processor {
namespace {

constexpr std::uint32_t kColumns = 16;
constexpr std::uint32_t kLines = 4;
constexpr std::uint32_t kBoard = 5;
constexpr std::uint32_t kProcessors = 8;

class Surroundings : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Surroundings> bus;
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, stream::SyncProtocol> sync;
  tlm_utils::simple_target_socket<Surroundings, stream::kNoBusWidth, stream::FragmentProtocol> in;
  struct Line {
    std::uint64_t frame;
    std::size_t line;
    std::uint64_t picoseconds;
    frame::FragmentLine fragments;
  };
  std::vector<Line> lines;

  explicit Surroundings(const sc_core::sc_module_name& name) : sc_module(name), bus("bus"), sync("sync"), in("in") {
    in.register_b_transport(this, &Surroundings::receive);
  }

  tlm::tlm_response_status write(std::uint64_t address, std::vector<std::uint32_t> words, std::uint32_t object = 0,
                                 tlm::tlm_command command = tlm::TLM_WRITE_COMMAND) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(words.data()));
    payload.set_data_length(static_cast<unsigned>(4 * words.size()));
    payload.set_streaming_width(payload.get_data_length());
    ObjectNumber number;
    number.object = object;
    payload.set_extension(&number);
    sc_core::sc_time delay;
    bus->b_transport(payload, delay);
    payload.clear_extension(&number);
    return payload.get_response_status();
  }
  void retrace(bool copy, bool whole = true) {
    stream::SyncPayload payload;
    payload.kind = stream::SyncPayload::Kind::retrace;
    payload.copy = copy;
    payload.whole = copy && whole;
    sc_core::sc_time delay;
    sync->b_transport(payload, delay);
  }
  void line(std::uint64_t frame, std::size_t number, std::uint64_t delay_ps = 0) {
    stream::SyncPayload payload;
    payload.frame = frame;
    payload.lines.first = number;
    sc_core::sc_time delay = stream::to_time(delay_ps);
    sync->b_transport(payload, delay);
  }

 private:
  void receive(stream::FragmentPayload& payload, sc_core::sc_time& delay) {
    ASSERT_NE(payload.spans, nullptr);  // a board with right carries sends spans
    EXPECT_EQ(payload.fragments, nullptr);
    const stream::SpanLines& spans = *payload.spans;
    for (std::size_t k = 0; k < spans.lines.count; ++k) {
      frame::FragmentLine line;
      line.resize(kColumns);
      const std::size_t number = spans.lines.number(k);
      composer_.compose(std::array{spans.covered[k]}, static_cast<std::uint32_t>(number), line);
      lines.push_back(
          {payload.frame, number, stream::picoseconds_now() + delay.value() + spans.lines.later_ps[k], line});
    }
  }

  LineComposer composer_{ObjectProcessorParameters{}, kColumns};
};

struct Machine {
  ObjectBoard core{{}, kProcessors, kBoard* kProcessors, kColumns, kLines};
  stream::Link link{"board 5", 64, Clock::from_period_ns("pixel clock", 60.0)};
  ObjectBoardModule board{"object_board_5", kBoard, core, {Clock::from_period_ns("pixel clock", 60.0), Cycles(120)},
                          kColumns,         link};
  Surroundings around{"around"};

  Machine() {
    around.bus.bind(board.bus);
    around.sync.bind(board.sync);
    board.out.bind(around.in);
  }
};

// Edges 0: every pixel is inside; depth `depth` everywhere.
std::vector<std::uint32_t> everywhere(std::uint32_t depth) {
  std::vector<std::uint32_t> words(kWords, 0);
  words[word_index(kDepth, 2)] = depth;
  words[word_index(kNormalX + 2, 2)] = 1U << 22;
  words[kMaterialIndex] = 9;
  return words;
}

TEST(ObjectBoardModule, WordsWaitForARetraceThatCopies) {
  Machine m;
  EXPECT_EQ(m.around.write(bus_address(kBoard, 3, 0), everywhere(1000), 77), tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(m.board.words_loaded(), 22U);
  m.around.line(0, 1);
  m.around.retrace(false);
  m.around.line(1, 1);
  EXPECT_EQ(m.board.copies(), 0U);
  m.around.retrace(true);
  EXPECT_EQ(m.board.copies(), 1U);
  m.around.line(2, 1);
  ASSERT_EQ(m.around.lines.size(), 3U);
  EXPECT_TRUE(m.around.lines[0].fragments.empty());
  EXPECT_TRUE(m.around.lines[1].fragments.empty());
  const frame::FragmentLine& line = m.around.lines[2].fragments;
  EXPECT_EQ(line.begin, 0U);
  EXPECT_EQ(line.end, kColumns);
  for (std::size_t x = 0; x < kColumns; ++x) {
    EXPECT_EQ(line.depth[x], 1000U);
    EXPECT_EQ(line.object[x], 77U);
    EXPECT_EQ(line.material[x], 9U);
    EXPECT_EQ(line.coverage[x], 1U);
  }
  EXPECT_EQ(m.board.lines_sent(), 3U);
}

// What a copy takes of an update that the hosts have not finished is ahead of it; the copy of the whole leaves none.
TEST(ObjectBoardModule, CountsTheWordsOfAnUnfinishedUpdate) {
  Machine m;
  m.around.write(bus_address(kBoard, 3, 0), everywhere(1000), 77);
  m.around.retrace(true);
  EXPECT_EQ(m.board.words_ahead(), 0U);
  m.around.write(bus_address(kBoard, 3, word_index(kDepth, 2)), {400});
  EXPECT_EQ(m.board.words_ahead(), 0U);
  m.around.retrace(true, false);
  EXPECT_EQ(m.board.words_ahead(), 1U);
  m.around.line(0, 0);
  EXPECT_EQ(m.around.lines.back().fragments.depth[4], 400U);
  m.around.write(bus_address(kBoard, 3, 0), {0, 0, 0xFFFFFF});
  m.around.retrace(true, false);
  EXPECT_EQ(m.board.words_ahead(), 4U);
  m.around.retrace(false);
  EXPECT_EQ(m.board.words_ahead(), 4U);
  m.around.retrace(true);
  EXPECT_EQ(m.board.words_ahead(), 0U);
}

// A burst of three words parks a processor; a burst may begin at any word.
TEST(ObjectBoardModule, BurstsBeginWhereTheirAddressSays) {
  Machine m;
  m.around.write(bus_address(kBoard, 0, 0), everywhere(1000), 1);
  m.around.write(bus_address(kBoard, 7, 0), everywhere(500), 2);
  m.around.write(bus_address(kBoard, 0, word_index(kDepth, 2)), {400});
  m.around.retrace(true);
  m.around.line(0, 0);
  EXPECT_EQ(m.around.lines.back().fragments.depth[4], 400U);
  EXPECT_EQ(m.around.lines.back().fragments.object[4], 1U);  // a write without a number keeps it
  EXPECT_EQ(m.around.lines.back().fragments.coverage[4], 2U);
  m.around.write(bus_address(kBoard, 0, 0), {0, 0, 0xFFFFFF});
  m.around.retrace(true);
  m.around.line(1, 0);
  EXPECT_EQ(m.around.lines.back().fragments.object[4], 2U);
  EXPECT_EQ(m.around.lines.back().fragments.coverage[4], 1U);
}

TEST(ObjectBoardModule, RefusesWhatItDoesNotHave) {
  Machine m;
  const auto words = everywhere(1);
  EXPECT_EQ(m.around.write(bus_address(kBoard + 1, 0, 0), words), tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(m.around.write(bus_address(kBoard, kProcessors, 0), words), tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(m.around.write(bus_address(kBoard, 0, 1), words), tlm::TLM_ADDRESS_ERROR_RESPONSE);  // runs over the end
  EXPECT_EQ(m.around.write(bus_address(kBoard, 0, kWords), {1}), tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(m.around.write(bus_address(kBoard, 0, 0), words, 0, tlm::TLM_READ_COMMAND),
            tlm::TLM_COMMAND_ERROR_RESPONSE);
  EXPECT_EQ(m.board.words_loaded(), 0U);
  EXPECT_EQ(m.core.copy(), 0U);  // nothing was written
  EXPECT_EQ(m.around.write(bus_address(kBoard, kProcessors - 1, kMaterialIndex), {1}), tlm::TLM_OK_RESPONSE);
}

// 120 cycles of 60 ns after the line began its first pixel leaves; all of its words cross the link.
TEST(ObjectBoardModule, ALineLeavesAtItsTime) {
  Machine m;
  m.around.line(4, 2, 1'000'000);
  ASSERT_EQ(m.around.lines.size(), 1U);
  EXPECT_EQ(m.around.lines[0].frame, 4U);
  EXPECT_EQ(m.around.lines[0].line, 2U);
  EXPECT_EQ(m.around.lines[0].picoseconds, 1'000'000U + 120 * 60'000);
  EXPECT_EQ(m.link.words(), kColumns);
  EXPECT_EQ(m.link.active(), Cycles(kColumns));
  EXPECT_EQ(m.link.bytes(), 8U * kColumns);
}

// Lines that are announced together leave together, each at the time at which it would have left alone.
TEST(ObjectBoardModule, LinesOfABandLeaveTogether) {
  Machine m;
  m.around.write(bus_address(kBoard, 3, 0), everywhere(1000), 77);
  m.around.retrace(true);
  stream::SyncPayload payload;
  payload.frame = 4;
  payload.lines = {1, 2, 2, {0, 500'000}};
  sc_core::sc_time delay = stream::to_time(1'000'000);
  m.around.sync->b_transport(payload, delay);
  ASSERT_EQ(m.around.lines.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(m.around.lines[k].frame, 4U);
    EXPECT_EQ(m.around.lines[k].line, 1 + 2 * k);
    EXPECT_EQ(m.around.lines[k].picoseconds, 1'000'000U + 500'000 * k + 120 * 60'000);
    EXPECT_EQ(m.around.lines[k].fragments.object[4], 77U);
  }
  EXPECT_EQ(m.board.lines_sent(), 2U);
  EXPECT_EQ(m.link.words(), 2 * kColumns);
}

}  // namespace
}  // namespace rastertlm::object_processor
