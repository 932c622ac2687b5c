// Does a line go on when its last board has sent it, after the unit's latency, and is a board out of turn caught?
#include "modules/decision_unit/decision_unit_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "modules/stream/simulated_time.h"
#include "src/base/errors.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::decision_unit {
namespace {

constexpr std::size_t kColumns = 10;
constexpr std::uint32_t kNothing = 0xFFFFFF;

class Board : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Board, stream::kNoBusWidth, stream::FragmentProtocol> out;
  Board(const sc_core::sc_module_name& name, stream::LinePool& pool) : sc_module(name), out("out"), pool_(pool) {}

  void send(stream::SpanLines spans, std::uint64_t delay_ps) {
    spans_ = spans;
    stream::FragmentPayload payload;
    payload.spans = &spans_;
    sc_core::sc_time delay = stream::to_time(delay_ps);
    out->b_transport(payload, delay);
    EXPECT_TRUE(payload.is_response_ok());
  }
  // An object at one column, that much away.
  void send(std::size_t line, std::size_t column, std::uint32_t depth, std::uint32_t object, std::uint64_t delay_ps) {
    stream::FragmentPayload payload;
    payload.frame = 3;
    payload.line = line;
    payload.fragments = pool_.acquire();
    payload.fragments->extend(column, column + 1, kNothing);
    payload.fragments->depth[column] = depth;
    payload.fragments->object[column] = object;
    payload.fragments->coverage[column] = 1;
    sc_core::sc_time delay = stream::to_time(delay_ps);
    out->b_transport(payload, delay);
    EXPECT_TRUE(payload.is_response_ok());
    EXPECT_EQ(payload.fragments, nullptr);  // taken
  }

 private:
  stream::LinePool& pool_;
  stream::SpanLines spans_;
};

class Shading : public sc_core::sc_module {
 public:
  struct Line {
    std::uint64_t frame;
    std::size_t line;
    std::uint64_t picoseconds;
    std::uint32_t object_5;
    std::uint16_t coverage_5;
  };
  tlm_utils::simple_target_socket<Shading, stream::kNoBusWidth, stream::FragmentProtocol> in;
  std::vector<Line> lines;

  explicit Shading(const sc_core::sc_module_name& name) : sc_module(name), in("in") {
    in.register_b_transport(this, &Shading::receive);
  }

 private:
  void receive(stream::FragmentPayload& payload, sc_core::sc_time& delay) {
    const stream::LinePool::Handle line = std::move(payload.fragments);
    lines.push_back(
        {payload.frame, payload.line, stream::picoseconds_now() + delay.value(), line->object[5], line->coverage[5]});
  }
};

struct Machine {
  stream::LinePool pool{kColumns};
  DecisionUnit core{DecisionUnitParameters{}, kNothing};
  stream::Link link{"decision unit to shading", 64, Clock::from_period_ns("pixel clock", 60.0)};
  object_processor::LineComposer composer{object_processor::ObjectProcessorParameters{}, kColumns};
  DecisionUnitModule unit{"decision_unit", core, composer, kColumns, 3, Clock::from_period_ns("pixel clock", 60.0),
                          Cycles(7),       link};
  std::deque<Board> boards;
  Shading shading{"shading"};

  Machine() {
    for (std::size_t k = 0; k < 3; ++k) {
      boards.emplace_back(("board_" + std::to_string(k)).c_str(), pool);
      boards[k].out.bind(unit.in[k]);
    }
    unit.out.bind(shading.in);
  }

  std::string failure(const std::function<void()>& body) {
    stream::Script script("script", body);
    try {
      stream::simulate();
    } catch (const ModelError& error) {
      return error.what();
    }
    return "no failure";
  }
};

TEST(DecisionUnitModule, SendsALineWhenItsLastBoardHasSentIt) {
  Machine machine;
  EXPECT_EQ(machine.failure([&] {
    machine.boards[2].send(0, 5, 200, 3, 1'000);
    machine.boards[0].send(0, 5, 300, 1, 1'000);
    EXPECT_TRUE(machine.shading.lines.empty());
    machine.boards[1].send(0, 5, 250, 2, 1'000);
    ASSERT_EQ(machine.shading.lines.size(), 1U);
    // A tie: the lower number, whoever sent first.
    machine.boards[2].send(1, 5, 200, 3, 2'000);
    machine.boards[1].send(1, 5, 200, 2, 2'000);
    machine.boards[0].send(1, 6, 200, 1, 2'000);
  }),
            "no failure");
  const auto& lines = machine.shading.lines;
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].frame, 3U);
  EXPECT_EQ(lines[0].line, 0U);
  EXPECT_EQ(lines[0].picoseconds, 1'000U + 7 * 60'000);
  EXPECT_EQ(lines[0].object_5, 3U);
  EXPECT_EQ(lines[0].coverage_5, 3U);
  EXPECT_EQ(lines[1].line, 1U);
  EXPECT_EQ(lines[1].picoseconds, 2'000U + 7 * 60'000);
  EXPECT_EQ(lines[1].object_5, 2U);
  EXPECT_EQ(machine.unit.lines_sent(), 2U);
  EXPECT_EQ(machine.link.words(), 2 * kColumns);
  EXPECT_EQ(machine.link.active(), Cycles(2 * kColumns));
}

TEST(DecisionUnitModule, ABoardThatRunsAheadIsCaught) {
  Machine machine;
  EXPECT_THAT(machine.failure([&] {
    machine.boards[1].send(8, 5, 1, 1, 0);
    machine.boards[1].send(9, 5, 1, 1, 0);
  }),
              testing::AllOf(testing::HasSubstr("decision_unit"),
                             testing::HasSubstr("board 1 sent line 9 while line 8 was being gathered")));
}

TEST(DecisionUnitModule, ABoardThatSendsTwiceIsCaught) {
  Machine machine;
  EXPECT_THAT(machine.failure([&] {
    machine.boards[0].send(8, 5, 1, 1, 0);
    machine.boards[0].send(8, 5, 1, 1, 0);
  }),
              testing::HasSubstr("board 0 sent line 8 while line 8"));
}

TEST(DecisionUnitModule, AnotherLineIsCaught) {
  Machine machine;
  EXPECT_THAT(machine.failure([&] {
    machine.boards[0].send(8, 5, 1, 1, 0);
    machine.boards[2].send(7, 5, 1, 1, 0);
  }),
              testing::HasSubstr("board 2 sent line 7 while line 8"));
}

// Spans of a band of lines: each goes on at its own time.
TEST(DecisionUnitModule, SendsTheLinesOfABandOneByOne) {
  Machine machine;
  const frame::FragmentSource source{{0, 0, 200}, {}, 3, 7};
  const frame::CoveredSpan span{4, 6, &source};
  const frame::CoveredLine covered{&span, 1, 2};
  const frame::CoveredLine empty{};
  EXPECT_EQ(machine.failure([&] {
    for (std::size_t board = 0; board < 3; ++board)
      machine.boards[board].send({{9, 2, 2, {0, 500}}, {&empty, board == 1 ? &covered : &empty}}, 1'000);
  }),
            "no failure");
  const auto& lines = machine.shading.lines;
  ASSERT_EQ(lines.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(lines[k].line, 9 + 2 * k);
    EXPECT_EQ(lines[k].picoseconds, 1'000 + 500 * k + 7 * 60'000);
    EXPECT_EQ(lines[k].object_5, k == 0 ? 0U : 7U);
  }
  EXPECT_EQ(machine.link.words(), 2 * kColumns);
}

TEST(DecisionUnitModule, SpansOfOtherLinesAreCaught) {
  Machine machine;
  const frame::CoveredLine empty{};
  EXPECT_THAT(machine.failure([&] {
    machine.boards[0].send({{8, 2, 1, {0, 500}}, {&empty, &empty}}, 0);
    machine.boards[1].send({{8, 1, 1, {0}}, {&empty}}, 0);
  }),
              testing::HasSubstr("board 1 sent line 8 while line 8 was being gathered"));
}

// However many lines pass, three are in use at a time.
TEST(DecisionUnitModule, LinesGoBackToTheirPool) {
  Machine machine;
  std::vector<const frame::FragmentLine*> in_use;
  EXPECT_EQ(machine.failure([&] {
    for (std::size_t line = 0; line < 100; ++line)
      for (Board& board : machine.boards) board.send(line, line % kColumns, 9, 1, 0);
    std::vector<stream::LinePool::Handle> handles;
    handles.reserve(6);
    for (int i = 0; i < 3; ++i) handles.push_back(machine.pool.acquire());
    in_use = {handles[0].get(), handles[1].get(), handles[2].get()};
    for (auto& handle : handles) handle.reset();
    machine.boards[0].send(100, 0, 9, 1, 0);
    machine.boards[1].send(100, 0, 9, 1, 0);
    machine.boards[2].send(100, 0, 9, 1, 0);
    for (int i = 0; i < 3; ++i)
      EXPECT_THAT(in_use, testing::Contains(handles.emplace_back(machine.pool.acquire()).get()));
  }),
            "no failure");
  EXPECT_EQ(machine.shading.lines.size(), 101U);
}

}  // namespace
}  // namespace rastertlm::decision_unit
