// Does a tap see every line with its time, and leave it, its delay and who handles it as they would be without?
#include "modules/stream/tap_module.h"

#include <gtest/gtest.h>

#include "tests/modules/stream/simulation.h"

namespace rastertlm::stream {
namespace {

class Source : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Source, kNoBusWidth, FragmentProtocol> out;
  explicit Source(const sc_core::sc_module_name& name) : sc_module(name), out("out"), pool_(2) {}

  void send(std::size_t line, std::uint32_t depth, std::uint64_t delay_ps) {
    FragmentPayload payload;
    payload.frame = 7;
    payload.line = line;
    payload.fragments = pool_.acquire();
    payload.fragments->extend(0, 1, depth);
    sc_core::sc_time delay = to_time(delay_ps);
    out->b_transport(payload, delay);
    EXPECT_TRUE(payload.is_response_ok());
    EXPECT_EQ(delay, to_time(delay_ps + 1)) << "the receiver's, no more";
    EXPECT_FALSE(payload.fragments) << "the receiver took the line";
  }

 private:
  LinePool pool_;
};

struct Seen {
  std::size_t line;
  std::uint32_t depth;
  std::uint64_t picoseconds;
  friend bool operator==(const Seen&, const Seen&) = default;
};

class Sink : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<Sink, kNoBusWidth, FragmentProtocol> in;
  explicit Sink(const sc_core::sc_module_name& name) : sc_module(name), in("in") {
    in.register_b_transport(this, &Sink::receive);
  }
  std::vector<Seen> seen;

 private:
  void receive(FragmentPayload& payload, sc_core::sc_time& delay) {
    const LinePool::Handle line = std::move(payload.fragments);
    seen.push_back({payload.line, line->depth[0], picoseconds_now() + delay.value()});
    delay += to_time(1);
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
  }
};

TEST(TapModule, SeesEveryLineAndHandsItOn) {
  std::vector<Seen> tapped;
  TapModule<FragmentPayload> tap("tap", [&](const FragmentPayload& payload, std::uint64_t first_pixel_ps) {
    EXPECT_EQ(payload.frame, 7U);
    tapped.push_back({payload.line, payload.fragments->depth[0], first_pixel_ps});
  });
  Source source("source");
  Sink sink("sink");
  source.out.bind(tap.in);
  tap.out.bind(sink.in);
  Script script("script", [&] {
    source.send(0, 11, 5);
    sc_core::wait(to_time(100));
    source.send(1, 12, 6);
  });
  simulate();
  const std::vector<Seen> expected{{0, 11, 5}, {1, 12, 106}};
  EXPECT_EQ(tapped, expected);
  EXPECT_EQ(sink.seen, expected);
}

}  // namespace
}  // namespace rastertlm::stream
