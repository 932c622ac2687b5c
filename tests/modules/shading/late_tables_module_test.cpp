// When is a late load switched to or started, and what do the lines read that come before its end?
#include <gmock/gmock.h>

#include "tests/modules/shading/loader_machine.h"

namespace rastertlm::shading {
namespace {

using testing::ElementsAre;

// A host that copies at every retrace: the tables are switched at the first at which their own load has ended. Of
// lights that came meanwhile the last are loaded next.
TEST(LateTables, ALateBankIsSwitchedWhenItsOwnLoadHasEnded) {
  LoaderParameters parameters = loader(LoaderKind::mc68000, LoadTime::frame);
  parameters.dot.cycles = 52.0;  // 39.936 ms
  Machine m(parameters);
  const LightArguments third = light(0.9, 0.1, 0.3);
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(50, sc_core::SC_MS);
    EXPECT_TRUE(m.around.retrace(true));  // 50 ms
    m.around.announce(true, kSecond);     // until 89.936 ms
    sc_core::wait(20, sc_core::SC_MS);
    EXPECT_FALSE(m.around.retrace(true));  // 70 ms
    expect_tables(m.shader.front(), kFirst);
    m.around.announce(true, third);
    sc_core::wait(1, sc_core::SC_MS);
    m.around.announce(false, third);  // changes nothing of the lights before, which still wait
    sc_core::wait(19, sc_core::SC_MS);
    EXPECT_TRUE(m.around.retrace(true));  // 90 ms
    expect_tables(m.shader.front(), kSecond);
    sc_core::wait(20, sc_core::SC_MS);
    EXPECT_FALSE(m.around.retrace(true));  // 110 ms
    sc_core::wait(19'936, sc_core::SC_US);
    EXPECT_TRUE(m.around.retrace(true));  // 129.936 ms: the load has ended at this instant
    expect_tables(m.shader.front(), third);
    sc_core::wait(20, sc_core::SC_MS);
    EXPECT_FALSE(m.around.retrace(true));  // nothing new
    expect_tables(m.shader.front(), third);
  });
  stream::simulate();
  EXPECT_EQ(m.loader.words_sent(), m.shading.words_loaded());
  EXPECT_EQ(m.loader.late_lines(), 0U);  // what is shown is never half written
}

// Hosts that are late where loading RAMs are copied at every retrace: the tables do not wait for them.
TEST(LateTables, TablesAreSwitchedAtARetraceThatCopiesForLateHosts) {
  Machine m(loader(LoaderKind::mc68000, LoadTime::frame));
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(30, sc_core::SC_MS);
    m.around.retrace(true);
    m.around.announce(true, kSecond);
    sc_core::wait(20, sc_core::SC_MS);
    EXPECT_TRUE(m.around.retrace(true, false));  // 50 ms
    expect_tables(m.shader.front(), kSecond);
    sc_core::wait(20, sc_core::SC_MS);
    EXPECT_FALSE(m.around.retrace(true, true));
    expect_tables(m.shader.front(), kSecond);
  });
  stream::simulate();
  EXPECT_THAT(m.edges.list(), ElementsAre(Edge{19'968 * kMicrosecond, true}, Edge{30 * kMillisecond, false},
                                          Edge{49'968 * kMicrosecond, true}, Edge{70 * kMillisecond, false}));
}

// Likewise with one bank: it is loaded once, in the first retrace that copies.
TEST(LateTables, OneBankIsLoadedAtARetraceThatCopiesForLateHosts) {
  Machine m(loader(LoaderKind::sequencer, LoadTime::retrace));
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(20, sc_core::SC_MS);
    m.around.retrace(true);
    sc_core::wait(1, sc_core::SC_MS);
    m.around.announce(true, kSecond);
    sc_core::wait(19, sc_core::SC_MS);
    m.around.retrace(true, false);  // 40 ms
    m.around.line(kRetracePs);
    expect_tables(m.shader.front(), kSecond);
    sc_core::wait(20, sc_core::SC_MS);
    m.around.retrace(true, true);
    sc_core::wait(1, sc_core::SC_MS);
    m.around.announce(true, kFirst);
    sc_core::wait(19, sc_core::SC_MS);
    m.around.retrace(true, true);  // 80 ms
  });
  stream::simulate();
  EXPECT_EQ(m.loader.occupancy(0, 100 * kMillisecond).busy, 2U * 6144);
  EXPECT_EQ(m.loader.words_sent(), m.shading.words_loaded());
  EXPECT_THAT(m.edges.list(), ElementsAre(Edge{368'640'000, true}, Edge{20 * kMillisecond, false},
                                          Edge{21 * kMillisecond, true}, Edge{60 * kMillisecond, false},
                                          Edge{61 * kMillisecond, true}, Edge{80 * kMillisecond, false}));
}

// The words of the dot-product tables that a loader of one entry in 3.25 us has stored since the light was kFirst.
void expect_half_written(const TableBank& bank, std::size_t entries) {
  DeferredShader before(shading_parameters(), 12, 1);
  before.set_light(0, kFirst);
  before.load();
  DeferredShader after(shading_parameters(), 12, 1);
  after.set_light(0, kSecond);
  after.load();
  const LightTables& is = bank.lights[0];
  std::size_t different = 0;
  for (std::size_t i = 0; i < 3 * 2048; ++i) {
    const LightTables& expected = (i < entries ? after : before).front().lights[0];
    different += is.diffuse.products[i / 2048][i % 2048] != expected.diffuse.products[i / 2048][i % 2048] ? 1U : 0U;
    different += is.specular.products[i / 2048][i % 2048] != expected.specular.products[i / 2048][i % 2048] ? 1U : 0U;
  }
  EXPECT_EQ(different, 0U) << entries;
}

// One bank, 6144 entries x 3.25 us = 19.968 ms from the retrace on: a line is shaded from what is written when its
// first pixel reads it, 7 us after the line's start; the entry that is stored then is in, the next one is not.
TEST(LateTables, ALateLoadOfOneBankShowsWhatIsWritten) {
  LoaderParameters parameters = loader(LoaderKind::mc68000, LoadTime::retrace);
  parameters.on_overrun = Overrun::show;
  Machine m(parameters);
  const auto reads_at = [&](std::uint64_t picoseconds) { m.around.line(picoseconds - kReachedPs[0]); };
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(20, sc_core::SC_MS);
    m.around.retrace(true);
    m.around.line(kRetracePs);  // nothing is loaded: not late
    m.around.announce(true, kSecond);
    sc_core::wait(20, sc_core::SC_MS);
    m.around.retrace(true);  // 40 ms
    expect_half_written(m.shader.front(), 0);
    EXPECT_EQ(m.shader.front().read({TableKind::signs, 0, 0}, 0), 0b001'001U);  // registers change at once
    EXPECT_EQ(m.loader.late_lines(), 0U);
    reads_at(3'250'000ULL * 1000 - 1000);
    expect_half_written(m.shader.front(), 999);
    reads_at(3'250'000ULL * 1000);
    expect_half_written(m.shader.front(), 1000);
    reads_at(3'250'000ULL * 6144 - 1000);
    expect_half_written(m.shader.front(), 6143);
    EXPECT_EQ(m.loader.late_lines_of_frame(), 3U);
    reads_at(3'250'000ULL * 6144);
    expect_tables(m.shader.front(), kSecond);
    EXPECT_EQ(m.loader.late_lines_of_frame(), 3U);
    sc_core::wait(20, sc_core::SC_MS);
    m.around.announce(false, kSecond);
    m.around.retrace(true);
    EXPECT_EQ(m.loader.late_lines_of_frame(), 0U);
    EXPECT_EQ(m.loader.late_lines(), 3U);
  });
  stream::simulate();
  EXPECT_EQ(m.loader.words_sent(), m.shading.words_loaded());
  EXPECT_EQ(m.loader.occupancy(0, 70 * kMillisecond).busy, 6144U * 26);
  m.loader.occupancy(0, 70 * kMillisecond).check("loader");
}

// A load of 39.936 ms that starts at one retrace goes on through the next, whether it copies or not; the next load
// starts at the first retrace after its end.
TEST(LateTables, ALoadOfOneBankThatOutlastsTheFrameGoesOn) {
  LoaderParameters parameters = loader(LoaderKind::mc68000, LoadTime::retrace);
  parameters.on_overrun = Overrun::show;
  parameters.dot.cycles = 52.0;
  Machine m(parameters);
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(40, sc_core::SC_MS);
    m.around.retrace(true);
    sc_core::wait(1, sc_core::SC_MS);
    m.around.announce(true, kSecond);
    sc_core::wait(19, sc_core::SC_MS);
    m.around.retrace(true);  // 60 ms: starts
    m.around.line(kRetracePs);
    m.around.announce(true, kFirst);
    sc_core::wait(20, sc_core::SC_MS);
    m.around.retrace(true);  // 80 ms: goes on
    m.around.line(6500 * kMicrosecond - kReachedPs[0]);
    expect_half_written(m.shader.front(), 4076);  // 26.5 ms of 6.5 us an entry: 4076.9
    sc_core::wait(20, sc_core::SC_MS);
    expect_tables(m.shader.front(), kSecond);
    m.around.retrace(true);  // 100 ms: the next one starts
    EXPECT_EQ(m.shader.front().read({TableKind::signs, 0, 0}, 0), 0b010'010U);
    m.loader.close((100 + 13) * kMillisecond);  // 2000 entries later, of N.L and of N.H
  });
  stream::simulate();
  EXPECT_EQ(m.loader.words_sent(), m.shading.words_loaded());
  EXPECT_THAT(m.edges.list(), ElementsAre(Edge{39'936 * kMicrosecond, true}, Edge{40 * kMillisecond, false},
                                          Edge{41 * kMillisecond, true}, Edge{60 * kMillisecond, false},
                                          Edge{99'936 * kMicrosecond, true}, Edge{100 * kMillisecond, false}));
}

}  // namespace
}  // namespace rastertlm::shading
