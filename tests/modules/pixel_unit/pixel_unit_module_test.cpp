// When do a shaded pixel's levels leave, when may the next span come, who waits for whom, and what passes untouched?
#include "modules/pixel_unit/pixel_unit_module.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "modules/stream/simulated_time.h"
#include "tests/modules/pixel_unit/triangles.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::pixel_unit::test {
namespace {

using frame_store::SpanPayload;

constexpr std::uint64_t kCycle = 10'000;  // picoseconds
constexpr std::uint64_t kLoad = 5, kLine = 3, kInterval = 4, kLatency = 11;

PixelUnitParameters unit_of_10_ns() {
  PixelUnitParameters parameters;
  parameters.clock_ns = 10.0;
  parameters.load_cycles = kLoad;
  parameters.cycles_per_line = kLine;
  parameters.cycles_per_pixel = kInterval;
  parameters.latency_cycles = kLatency;
  return parameters;
}

PixelShader shader() {
  PixelShader made({ShadingMethod::duff, set_up::Attributes::linear, true},
                   {{glm::dvec3(0.1), glm::dvec3(0.5), glm::dvec3(0.3), 10}}, {});
  made.set_lights({far_light({0.2, 0.1, 1.0})}, false);
  return made;
}

// The unit between a span unit that asks when the test says, and a memory that takes what it says.
struct Machine : sc_core::sc_module {
  struct Stored {
    SpanPayload::Kind kind;
    std::uint64_t picoseconds;
    std::vector<std::uint32_t> levels;  // given; of spans of registers none
    std::uint32_t object;
    std::uint64_t pixels;
  };
  tlm_utils::simple_initiator_socket<Machine, stream::kNoBusWidth, frame_store::SpanProtocol> spans;
  tlm_utils::simple_target_socket<Machine, stream::kNoBusWidth, frame_store::SpanProtocol> memory;
  std::vector<Stored> stored;
  std::uint64_t memory_ps = 0;  // a pixel
  PixelShader core = shader();
  stream::Link link{"pixel unit to frame store", 48, Clock::from_period_ns("pixel unit", 10.0)};
  PixelUnitModule module;
  SpanPayload payload;

  explicit Machine(const sc_core::sc_module_name& name, const PixelUnitParameters& parameters = unit_of_10_ns())
      : sc_module(name), spans("spans"), memory("memory"), module("pixel_unit", parameters, core, link) {
    memory.register_b_transport(this, &Machine::receive);
    spans.bind(module.in);
    module.out.bind(memory);
  }
  // Cycles at which the next span may come.
  std::uint64_t draw(std::uint32_t line, std::uint32_t count, const PixelTriangle* shading, std::uint64_t cycle) {
    span_unit::Span span;
    span.line = line;
    span.column = 20;
    span.count = count;
    payload.spans = {&span, 1};
    payload.pixels = count;
    payload.shading = shading;
    payload.object = shading != nullptr ? 1 : 2;
    return transport(SpanPayload::Kind::spans, cycle);
  }
  std::uint64_t transport(SpanPayload::Kind kind, std::uint64_t cycle) {
    payload.kind = kind;
    const std::uint64_t now = stream::picoseconds_now();
    sc_core::sc_time delay = stream::to_time(cycle * kCycle - now);
    spans->b_transport(payload, delay);
    EXPECT_TRUE(payload.is_response_ok());
    EXPECT_EQ((now + delay.value()) % kCycle, 0U);
    return (now + delay.value()) / kCycle;
  }

 private:
  void receive(SpanPayload& got, sc_core::sc_time& delay) {
    got.set_response_status(tlm::TLM_OK_RESPONSE);
    stored.push_back({got.kind,
                      stream::picoseconds_now() + delay.value(),
                      {got.levels.begin(), got.levels.end()},
                      got.object,
                      got.pixels});
    if (got.kind == SpanPayload::Kind::frame) got.keeps_up = true;
    if (got.kind == SpanPayload::Kind::spans) delay += stream::to_time(got.pixels * memory_ps);
    if (got.kind == SpanPayload::Kind::end) got.shown_ps = 777;
  }
};

void simulated(const std::function<void()>& body) {
  stream::Script script("script", body);
  stream::simulate();
}

TEST(PixelUnitModule, AcceptsAPixelAnIntervalAndGivesItAfterTheLatency) {
  const PixelTriangle triangle = Random(1).triangle(), other = Random(2).triangle();
  Machine m("m");
  simulated([&] {
    m.transport(SpanPayload::Kind::frame, 0);
    EXPECT_FALSE(m.payload.keeps_up);
    // A load, a line, seven pixels; then a line more of it, asked for too early and too late; then another triangle.
    std::uint64_t free = 100 + kLoad + kLine + 7 * kInterval;
    EXPECT_EQ(m.draw(30, 7, &triangle, 100), free);
    free += kLine + 2 * kInterval;
    EXPECT_EQ(m.draw(31, 2, &triangle, 101), free);
    EXPECT_EQ(m.draw(32, 1, &triangle, free + 50), free + 50 + kLine + kInterval);
    free += 50 + kLine + kInterval;
    EXPECT_EQ(m.draw(30, 3, &other, free), free + kLoad + kLine + 3 * kInterval);
    ASSERT_EQ(m.stored.size(), 5U);
    EXPECT_EQ(m.stored[1].picoseconds, (100 + kLoad + kLine + kLatency) * kCycle);
    EXPECT_EQ(m.stored[2].picoseconds, (100 + kLoad + kLine + 7 * kInterval + kLine + kLatency) * kCycle);
    EXPECT_EQ(m.stored[4].picoseconds, (free + kLoad + kLine + kLatency) * kCycle);
  });
  const stream::Occupancy occupancy = m.module.occupancy();
  occupancy.check("pixel unit");
  EXPECT_EQ(occupancy.busy, 2 * kLoad + 4 * kLine + 13 * kInterval);
  EXPECT_EQ(occupancy.starved, 100U + 50);
  EXPECT_EQ(occupancy.blocked, 0U);
  EXPECT_EQ(m.module.shaded(), 13U);
  EXPECT_EQ(m.link.words(), 13U);
  EXPECT_EQ(m.core.counters().triangles, 2U);
}

TEST(PixelUnitModule, GivesTheCoresLevels) {
  const PixelTriangle triangle = Random(1).triangle();
  Machine m("m");
  simulated([&] { m.draw(30, 9, &triangle, 0); });
  PixelShader alone = shader();
  span_unit::Span span;
  span.line = 30;
  span.column = 20;
  span.count = 9;
  std::vector<std::uint32_t> levels;
  alone.set_up(triangle);
  alone.shade(span, levels);
  EXPECT_EQ(m.stored.at(0).levels, levels);
  EXPECT_EQ(m.stored.at(0).object, 1U);
}

// Spans with colours in their registers, and a frame's end: when the last level has left, not a cycle before.
TEST(PixelUnitModule, WhatPassesWaitsForTheLevelsBeforeIt) {
  const PixelTriangle triangle = Random(1).triangle();
  Machine m("m");
  const std::uint64_t last = kLoad + kLine + 4 * kInterval + kLatency;  // the fifth's level
  simulated([&] {
    EXPECT_EQ(m.draw(3, 8, nullptr, 0), 0U);  // a memory that keeps up takes no time
    EXPECT_EQ(m.draw(30, 5, &triangle, 0), kLoad + kLine + 5 * kInterval);
    EXPECT_EQ(m.draw(3, 8, nullptr, last - 1), last);
    EXPECT_EQ(m.draw(3, 8, nullptr, last + 1), last + 1);
    m.draw(31, 1, &triangle, last + 2);
    m.transport(SpanPayload::Kind::end, 0);
    EXPECT_EQ(m.payload.shown_ps, 777U);
    EXPECT_EQ(m.stored.back().picoseconds, (last + 2 + kLine + kLatency) * kCycle);
  });
  EXPECT_TRUE(m.stored[2].levels.empty());
  EXPECT_EQ(m.stored[2].object, 2U);
  EXPECT_EQ(m.stored[2].pixels, 8U);
  EXPECT_EQ(m.module.passed(), 24U);
}

// A memory that takes six cycles a pixel where the unit takes four: the next pixel waits for the two.
TEST(PixelUnitModule, ASlowMemoryBlocksIt) {
  const PixelTriangle triangle = Random(1).triangle();
  Machine m("m");
  m.memory_ps = 6 * kCycle;
  simulated([&] {
    const std::uint64_t free = kLoad + kLine + 10 * 6;
    EXPECT_EQ(m.draw(30, 10, &triangle, 0), free);
    EXPECT_EQ(m.draw(31, 1, &triangle, 0), free + kLine + 6);
  });
  const stream::Occupancy occupancy = m.module.occupancy();
  occupancy.check("pixel unit");
  EXPECT_EQ(occupancy.blocked, 11U * 2);
}

// A triangle of the next frame may stand where one of the last stood.
TEST(PixelUnitModule, EveryFrameLoadsAnew) {
  PixelTriangle triangle = Random(1).triangle();
  Machine m("m");
  simulated([&] {
    m.draw(30, 3, &triangle, 0);
    m.transport(SpanPayload::Kind::frame, 1000);
    triangle = Random(2).triangle();
    m.draw(30, 3, &triangle, 2000);
  });
  EXPECT_EQ(m.core.counters().triangles, 2U);
  EXPECT_NE(m.stored.front().levels, m.stored.back().levels);
}

}  // namespace
}  // namespace rastertlm::pixel_unit::test
