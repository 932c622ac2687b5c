// Does a message wait for the one before it on the same link, and for nothing else?
#include "modules/host/serial_links_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/modules/stream/simulation.h"

namespace rastertlm::host {
namespace {

constexpr std::uint64_t kCyclePs = 50'000;  // 20 MHz

struct Arrival {
  std::uint64_t bytes;
  std::uint64_t cycle;
  friend bool operator==(const Arrival&, const Arrival&) = default;
};

class Sender : public sc_core::sc_module {
 public:
  MessageInitiator<Sender> out{"out"};
  explicit Sender(const sc_core::sc_module_name& name) : sc_module(name) {}
};

class Receiver : public sc_core::sc_module {
 public:
  MessageTarget<Receiver> in{"in"};
  std::vector<Arrival> arrivals;
  explicit Receiver(const sc_core::sc_module_name& name) : sc_module(name) {
    in.register_b_transport(this, &Receiver::receive);
  }

 private:
  void receive(MessagePayload& payload, sc_core::sc_time& delay) {
    arrivals.push_back({payload.message.bytes, (stream::picoseconds_now() + delay.value()) / kCyclePs});
  }
};

// 19 cycles start a message of 100 bytes, which takes 1150; the next one, of 10 bytes, is started at once and waits for
// the link; one on another link does not wait. Each message's start takes the processor.
TEST(SerialLinks, AMessageWaitsForTheLinkAlone) {
  const HostCost cost{HostParameters{}};
  stream::Link first("first", 8, Clock::from_frequency_hz("bytes", 1'739'130));
  stream::Link second("second", 8, Clock::from_frequency_hz("bytes", 1'739'130));
  LinkPort first_port{&first};
  LinkPort second_port{&second};
  stream::OccupancyMeter meter(cost.clock());
  Sender to_first("to_first"), to_second("to_second");
  Receiver at_first("at_first"), at_second("at_second");
  to_first.out.bind(at_first.in);
  to_second.out.bind(at_second.in);
  std::uint64_t done_cycle = 0;
  const stream::Script processor("processor", [&] {
    const auto post = [&](Sender& sender, LinkPort& port, std::uint64_t bytes) {
      MessagePayload payload;
      payload.message.bytes = bytes;
      send(sender.out, payload, cost, port, meter);
    };
    post(to_first, first_port, 100);
    post(to_second, second_port, 50);
    post(to_first, first_port, 10);
    done_cycle = stream::picoseconds_now() / kCyclePs;
  });
  stream::simulate();
  EXPECT_THAT(at_first.arrivals, testing::ElementsAre(Arrival{100, 19 + 1150}, Arrival{10, 19 + 1150 + 115}));
  EXPECT_THAT(at_second.arrivals, testing::ElementsAre(Arrival{50, 19 + 19 + 575}));
  EXPECT_EQ(done_cycle, 19U + 1150);
  const stream::Occupancy& occupancy = meter.close((19 + 1150) * kCyclePs);
  occupancy.check("processor");
  EXPECT_EQ(occupancy.busy, 3U * 19);
  EXPECT_EQ(occupancy.blocked, 1150U - 2 * 19);
  EXPECT_EQ(first.bytes(), 110U);
  EXPECT_EQ(first.active(), Cycles(110));
  EXPECT_EQ(second.bytes(), 50U);
}

}  // namespace
}  // namespace rastertlm::host
