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
                           [&](std::uint64_t frame, std::size_t field, const frame::Frame& pixels, std::uint64_t ps) {
                             EXPECT_EQ(field, 0U);
                             shown.push_back({frame, pixels.rgb.front(), pixels.rgb.back(), ps});
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

// Of interlaced video each field is handed on, with what the other one last was.
TEST(VideoOutputModule, HandsOnEachField) {
  struct Shown {
    std::uint64_t frame;
    std::size_t field;
    std::uint8_t even;
    std::uint8_t odd;
  };
  std::vector<Shown> shown;
  VideoOutputModule output("video_output", {.columns = 2, .lines = 4, .fields = 2},
                           [&](std::uint64_t frame, std::size_t field, const frame::Frame& pixels, std::uint64_t) {
                             shown.push_back({frame, field, pixels.rgb[2 * 6], pixels.rgb[3 * 6]});
                           });
  Source source("source");
  source.out.bind(output.in);
  stream::Script script("script", [&] {
    for (std::uint64_t frame = 0; frame < 2; ++frame)
      for (const std::size_t line : {0U, 2U, 1U, 3U})
        source.send(frame, line, static_cast<std::uint8_t>(10 * (frame + 1) + line), sc_core::SC_ZERO_TIME);
  });
  stream::simulate();
  ASSERT_EQ(shown.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(shown[i].frame, i / 2) << i;
    EXPECT_EQ(shown[i].field, i % 2) << i;
  }
  EXPECT_EQ(shown[0].even, 12);
  EXPECT_EQ(shown[1].odd, 13);
  EXPECT_EQ(shown[2].even, 22);
  EXPECT_EQ(shown[2].odd, 13);  // not yet come
  EXPECT_EQ(shown[3].odd, 23);
}

}  // namespace
}  // namespace rastertlm::video
