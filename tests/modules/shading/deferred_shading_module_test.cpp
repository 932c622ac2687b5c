// Does a line leave with its levels after the processor's latency, and is only what the tables have written?
#include "modules/shading/deferred_shading_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/stream/simulated_time.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::shading {
namespace {

constexpr std::size_t kColumns = 6;

class Surroundings : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, stream::FragmentProtocol> fragments;
  tlm_utils::simple_initiator_socket<Surroundings> bus;
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, stream::SyncProtocol> sync;
  tlm_utils::simple_target_socket<Surroundings, stream::kNoBusWidth, stream::RgbProtocol> rgb;
  struct Line {
    std::uint64_t frame;
    std::size_t line;
    std::uint64_t picoseconds;
    std::vector<std::uint8_t> levels;
    std::uint32_t object_2;
  };
  std::vector<Line> lines;

  explicit Surroundings(const sc_core::sc_module_name& name)
      : sc_module(name), fragments("fragments"), bus("bus"), sync("sync"), rgb("rgb") {
    rgb.register_b_transport(this, &Surroundings::receive);
  }

  // An object of `material` at column 2, without a normal: ambient light alone.
  void send(stream::LinePool& pool, std::size_t line, std::uint8_t material, std::uint64_t delay_ps) {
    stream::FragmentPayload payload;
    payload.frame = 8;
    payload.line = line;
    payload.fragments = pool.acquire();
    payload.fragments->extend(2, 3, 0xFFFFFF);
    payload.fragments->object[2] = 77;
    payload.fragments->material[2] = material;
    payload.fragments->normal_x[2] = payload.fragments->normal_y[2] = payload.fragments->normal_z[2] = 0;
    sc_core::sc_time delay = stream::to_time(delay_ps);
    fragments->b_transport(payload, delay);
    EXPECT_TRUE(payload.is_response_ok());
  }
  tlm::tlm_response_status write(std::uint64_t address, std::vector<std::uint32_t> words,
                                 tlm::tlm_command command = tlm::TLM_WRITE_COMMAND) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(words.data()));
    payload.set_data_length(static_cast<unsigned>(4 * words.size()));
    sc_core::sc_time delay;
    bus->b_transport(payload, delay);
    return payload.get_response_status();
  }
  void retrace(bool switch_tables) {
    stream::SyncPayload payload;
    payload.kind = stream::SyncPayload::Kind::retrace;
    payload.copy = true;
    payload.switch_tables = switch_tables;
    sc_core::sc_time delay;
    sync->b_transport(payload, delay);
  }

 private:
  void receive(stream::RgbPayload& payload, sc_core::sc_time& delay) {
    lines.push_back({payload.frame, payload.line, stream::picoseconds_now() + delay.value(), payload.rgb->levels,
                     payload.fragments->object[2]});
  }
};

struct Machine {
  stream::LinePool pool{kColumns};
  // Literal: a normal of zero has no direction and takes ambient light alone.
  DeferredShader shader{[] {
                          ShadingParameters parameters;
                          parameters.arithmetic = Arithmetic::literal;
                          parameters.materials = 2;
                          return parameters;
                        }(),
                        12, 2};
  stream::Link link{"rgb", 24, Clock::from_period_ns("pixel clock", 60.0)};
  DeferredShadingModule module{"deferred_shading", shader, kColumns, Clock::from_period_ns("pixel clock", 60.0),
                               Cycles(10),         link};
  Surroundings around{"around"};

  Machine() {
    around.fragments.bind(module.in);
    around.bus.bind(module.bus);
    around.sync.bind(module.sync);
    module.out.bind(around.rgb);
  }
  std::uint64_t address(TableKind kind, std::uint32_t entry) {
    return std::uint64_t{shader.back().address({kind, 0, 0}, entry)} << kTableWordShift;
  }
};

// Ambient and background are written to the bank behind and used after the switch.
TEST(DeferredShadingModule, ShadesFromTheBankInFront) {
  Machine m;
  EXPECT_EQ(m.around.write(m.address(TableKind::ambient, 3), {40, 50, 60}), tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(m.around.write(m.address(TableKind::background, 0), {1, 2, 3}), tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(m.module.words_loaded(), 6U);
  m.around.send(m.pool, 0, 1, 0);
  m.around.retrace(false);
  m.around.send(m.pool, 0, 1, 0);
  m.around.retrace(true);
  m.around.send(m.pool, 0, 1, 0);
  ASSERT_EQ(m.around.lines.size(), 3U);
  const std::vector<std::uint8_t> dark(3 * kColumns, 0);
  EXPECT_EQ(m.around.lines[0].levels, dark);
  EXPECT_EQ(m.around.lines[1].levels, dark);
  EXPECT_THAT(m.around.lines[2].levels, testing::ElementsAre(1, 2, 3, 1, 2, 3, 40, 50, 60, 1, 2, 3, 1, 2, 3, 1, 2, 3));
}

TEST(DeferredShadingModule, ALineLeavesAfterTheLatency) {
  Machine m;
  m.around.send(m.pool, 5, 0, 1'000);
  ASSERT_EQ(m.around.lines.size(), 1U);
  EXPECT_EQ(m.around.lines[0].frame, 8U);
  EXPECT_EQ(m.around.lines[0].line, 5U);
  EXPECT_EQ(m.around.lines[0].picoseconds, 1'000U + 10 * 60'000);
  EXPECT_EQ(m.around.lines[0].object_2, 77U);  // observers see the fragments
  EXPECT_EQ(m.link.words(), kColumns);
  EXPECT_EQ(m.link.active(), Cycles(kColumns));
}

TEST(DeferredShadingModule, RefusesAddressesThatItDoesNotHave) {
  Machine m;
  const std::uint64_t end = std::uint64_t{m.shader.back().words()} << kTableWordShift;
  EXPECT_EQ(m.around.write(end, {1}), tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(m.around.write(end - 4, {1, 2}), tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(m.around.write(0, {1}, tlm::TLM_READ_COMMAND), tlm::TLM_COMMAND_ERROR_RESPONSE);
  EXPECT_EQ(m.module.words_loaded(), 0U);
  EXPECT_EQ(m.around.write(end - 4, {200}), tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(m.shader.back().background[2], 200);
}

}  // namespace
}  // namespace rastertlm::shading
