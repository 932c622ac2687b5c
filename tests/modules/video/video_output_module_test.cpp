// Is a frame handed on with its last line, once, with the time of its last pixel?
#include "modules/video/video_output_module.h"

#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include "tests/modules/stream/simulation.h"

namespace rastertlm::video {
namespace {

class Source : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Source, stream::kNoBusWidth, stream::RgbProtocol> out;
  explicit Source(const sc_core::sc_module_name& name) : sc_module(name), out("out") {}

  void send(std::uint64_t frame, std::size_t line, std::uint8_t level, const sc_core::sc_time& delay) {
    frame::RgbLine rgb;
    rgb.resize(2);
    rgb.levels.assign(6, level);
    frame::FragmentLine fragments;
    fragments.resize(2);
    stream::RgbPayload payload;
    payload.frame = frame;
    payload.line = line;
    payload.rgb = &rgb;
    payload.fragments = &fragments;
    sc_core::sc_time annotated = delay;
    out->b_transport(payload, annotated);
    EXPECT_TRUE(payload.is_response_ok());
  }
};

TEST(VideoOutputModule, HandsOnWholeFrames) {
  struct Shown {
    std::uint64_t frame;
    std::uint8_t first;
    std::uint8_t last;
    std::uint64_t picoseconds;
  };
  std::vector<Shown> shown;
  VideoOutputModule output("video_output", {.columns = 2, .lines = 2},
                           [&](std::uint64_t frame, const frame::Frame& pixels, std::uint64_t last_pixel_ps) {
                             shown.push_back({frame, pixels.rgb.front(), pixels.rgb.back(), last_pixel_ps});
                           });
  Source source("source");
  source.out.bind(output.in);
  stream::Script script("script", [&] {
    sc_core::wait(10, sc_core::SC_NS);
    source.send(4, 0, 11, sc_core::sc_time(1, sc_core::SC_NS));
    EXPECT_TRUE(shown.empty());
    source.send(4, 1, 12, sc_core::sc_time(2, sc_core::SC_NS));
    source.send(5, 0, 13, sc_core::sc_time(3, sc_core::SC_NS));
    source.send(5, 1, 14, sc_core::sc_time(4, sc_core::SC_NS));
  });
  stream::simulate();
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(shown[0].frame, 4U);
  EXPECT_EQ(shown[0].first, 11);
  EXPECT_EQ(shown[0].last, 12);
  EXPECT_EQ(shown[0].picoseconds, 12'000U);
  EXPECT_EQ(shown[1].frame, 5U);
  EXPECT_EQ(shown[1].first, 13);
  EXPECT_EQ(shown[1].picoseconds, 14'000U);
  EXPECT_EQ(output.lines_shown(), 4U);
}

}  // namespace
}  // namespace rastertlm::video
