// Are tables loaded in the loaders' own time, used from the retrace that copies, and refused where they cannot be in
// time?
#include <gmock/gmock.h>

#include "src/base/errors.h"
#include "tests/modules/shading/loader_machine.h"

namespace rastertlm::shading {
namespace {

using testing::ElementsAre;

bool all_zero(const TableBank& bank) {
  for (std::uint32_t address = 0; address < bank.words(); ++address)
    if (bank.read(address) != 0) return false;
  return true;
}

// 004, section 5.3.6: 6144 entries in 20 ms by a 68000 of 8 MHz; 26 cycles an entry make 19.968 ms. Two banks: the new
// tables are used from the retrace that copies, not before.
TEST(TableLoaderModule, TwoBanksLoadedBy68000s) {
  Machine m(loader(LoaderKind::mc68000, LoadTime::frame));
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(30, sc_core::SC_MS);
    EXPECT_TRUE(all_zero(m.shader.front()));
    EXPECT_FALSE(m.around.retrace(false));
    EXPECT_TRUE(all_zero(m.shader.front()));
    sc_core::wait(20, sc_core::SC_MS);
    EXPECT_TRUE(m.around.retrace(true));  // 50 ms
    expect_tables(m.shader.front(), kFirst);
    m.around.announce(true, kSecond);
    sc_core::wait(25, sc_core::SC_MS);
    expect_tables(m.shader.front(), kFirst);
    EXPECT_TRUE(m.around.retrace(true));  // 75 ms
    expect_tables(m.shader.front(), kSecond);
  });
  stream::simulate();
  EXPECT_THAT(m.edges.list(),
              ElementsAre(Edge{19'968 * kMicrosecond, true}, Edge{50 * kMillisecond, false},
                          Edge{50 * kMillisecond + 19'968 * kMicrosecond, true}, Edge{75 * kMillisecond, false}));
  EXPECT_NEAR(m.loader.longest_load_seconds(), 19.968e-3, 1e-9);
  // Each dot-product unit has a loader of its own; both work at the same time.
  EXPECT_EQ(m.links[0].words(), 2U * 6144);
  EXPECT_EQ(m.loader.words_sent(), m.shading.words_loaded());
}

// From the first picture on: a load of 6144 entries x 26 cycles keeps the dot loaders busy, the others are done before.
TEST(TableLoaderModule, EnginesAreBusyForTheirOwnLoad) {
  Machine m(loader(LoaderKind::mc68000, LoadTime::frame));
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(30, sc_core::SC_MS);
    m.around.retrace(true);
    m.around.announce(true, kSecond);
    sc_core::wait(30, sc_core::SC_MS);
  });
  stream::simulate();
  const std::uint64_t end = 60 * kMillisecond;
  EXPECT_EQ(m.loader.occupancy(0, end).busy, 6144U * 26);
  EXPECT_EQ(m.loader.occupancy(0, end).cycles, 240'000U);
  EXPECT_EQ(m.loader.occupancy(1, end).busy, 18'944U);                     // 1024 x 18.5
  EXPECT_EQ(m.loader.occupancy(2, end).busy, 1024U * 12 + (255 + 1) * 8);  // one path and its change of arguments
  for (std::size_t engine = 0; engine < 3; ++engine) m.loader.occupancy(engine, end).check("loader");
}

LightArguments dimmed(LightArguments light) {
  light.intensity = {0.5, 0.5, 0.5};
  return light;
}

// A light that dims has new levels, of which the specular path's 1280 steps are more than 1024 of a diffuse table; one
// that turns has new dot products, 6144 steps; what comes after that and is shorter changes nothing.
TEST(TableLoaderModule, TheLongestLoadSaysWhoseItWas) {
  struct Load {
    LightArguments light;
    double us;
    const char* whose;
  };
  Machine m(loader(LoaderKind::sequencer, LoadTime::retrace));
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    for (const Load& load :
         {Load{dimmed(kFirst), 1280 * 0.06, "specular loader"}, Load{kSecond, 6144 * 0.06, "dot product loader"},
          Load{dimmed(kSecond), 6144 * 0.06, "dot product loader"}}) {
      sc_core::wait(5, sc_core::SC_MS);
      m.around.retrace(true);
      m.around.announce(true, load.light);
      sc_core::wait(5, sc_core::SC_MS);
      EXPECT_NEAR(1e6 * m.loader.longest_load_seconds(), load.us, 1e-6);
      EXPECT_STREQ(kEngineNames[m.loader.longest_load_engine()], load.whose);
    }
  });
  stream::simulate();
}

// Registers go with a load: signs of L and H, ambient Ka Ia colour of every material, the background.
TEST(TableLoaderModule, RegistersArrive) {
  Machine m(loader(LoaderKind::mc68000, LoadTime::frame));
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(20, sc_core::SC_MS);
    m.around.retrace(true);
  });
  stream::simulate();
  const TableBank& bank = m.shader.front();
  const std::vector<std::uint8_t> ambient{23, 6, 5, 0, 0, 0, 51, 26, 51, 0, 0, 0};  // 255 x (0.09, 0.025, 0.02) ...
  EXPECT_THAT(bank.ambient, testing::ElementsAreArray(ambient));
  EXPECT_THAT(bank.background, ElementsAre(1, 2, 3));
  EXPECT_EQ(bank.read({TableKind::signs, 0, 0}, 0), 0b010'010U);  // y is negative, of L and of H
}

// Where no light changed the tables stay, and nobody waits for them.
TEST(TableLoaderModule, AnUnchangedFrameLoadsNothing) {
  Machine m(loader(LoaderKind::mc68000, LoadTime::frame));
  std::uint64_t words = 0;
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(20, sc_core::SC_MS);
    m.around.retrace(true);
    words = m.loader.words_sent();
    sc_core::wait(1, sc_core::SC_MS);
    m.around.announce(false, kSecond);
    sc_core::wait(19, sc_core::SC_MS);
    EXPECT_FALSE(m.around.retrace(true));
    expect_tables(m.shader.front(), kFirst);
  });
  stream::simulate();
  EXPECT_EQ(m.loader.words_sent(), words);
  EXPECT_THAT(m.edges.list(), ElementsAre(Edge{19'968 * kMicrosecond, true}, Edge{20 * kMillisecond, false},
                                          Edge{21 * kMillisecond, true}, Edge{40 * kMillisecond, false}));
}

// 6144 x 60 ns = 368.64 us, "about 370" of 600: the wired sequencer loads within the retrace, into the only bank. The
// first load, before any picture, has the time that it needs.
TEST(TableLoaderModule, TheSequencerLoadsWithinTheRetrace) {
  Machine m(loader(LoaderKind::sequencer, LoadTime::retrace));
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(20, sc_core::SC_MS);
    EXPECT_FALSE(m.around.retrace(true));  // one bank: nothing to switch
    expect_tables(m.shader.front(), kFirst);
    sc_core::wait(1, sc_core::SC_MS);
    m.around.announce(true, kSecond);
    sc_core::wait(19, sc_core::SC_MS);
    expect_tables(m.shader.front(), kFirst);
    m.around.retrace(false);
    expect_tables(m.shader.front(), kFirst);
    m.around.retrace(true);  // 40 ms
    m.around.line(kRetracePs);
    expect_tables(m.shader.front(), kSecond);
    EXPECT_EQ(m.loader.late_lines(), 0U);
    sc_core::wait(5, sc_core::SC_MS);
    m.around.announce(false, kSecond);
  });
  stream::simulate();
  EXPECT_THAT(m.edges.list(),
              ElementsAre(Edge{368'640'000, true}, Edge{20 * kMillisecond, false}, Edge{21 * kMillisecond, true},
                          Edge{40 * kMillisecond, false}, Edge{45 * kMillisecond, true}));
  EXPECT_NEAR(m.loader.longest_load_seconds(), 368.64e-6, 1e-12);
  EXPECT_EQ(m.loader.occupancy(0, 60 * kMillisecond).busy, 6144U);
  EXPECT_EQ(m.loader.occupancy(1, 60 * kMillisecond).busy, 0U);  // levels do not depend on where the light stands
}

TEST(TableLoaderModule, RefusesALoadThatDoesNotFitTheRetrace) {
  Machine m(loader(LoaderKind::mc68000, LoadTime::retrace));
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(20, sc_core::SC_MS);
    m.around.retrace(true);
    m.around.announce(true, kSecond);
  });
  try {
    stream::simulate();
    FAIL() << "19.968 ms in a retrace of 600 us";
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1U);
    EXPECT_EQ(error.diagnostics()[0].key, "loader.when");
    EXPECT_EQ(error.diagnostics()[0].message,
              "the tables that change with every frame take 19968 us to load, and the vertical retrace has 600 us; a "
              "faster loader, loader.when = \"frame\" or loader.on_overrun = \"show\" would do");
  }
}

// Two 68000s of each dot-product unit take half of every table: 3 x 1024 entries of 26 cycles.
TEST(TableLoaderModule, SharedWorkTakesTheTimeOfTheLargestShare) {
  LoaderParameters parameters = loader(LoaderKind::mc68000, LoadTime::frame);
  parameters.dot.units = 2;
  Machine m(parameters);
  stream::Script script("script", [&] {
    m.around.announce(true, kFirst);
    sc_core::wait(30, sc_core::SC_MS);
    m.around.retrace(true);
    expect_tables(m.shader.front(), kFirst);
    m.around.announce(true, kSecond);
    sc_core::wait(20, sc_core::SC_MS);
    EXPECT_TRUE(m.around.retrace(true));  // 50 ms
    expect_tables(m.shader.front(), kSecond);
  });
  stream::simulate();
  EXPECT_THAT(m.edges.list(),
              ElementsAre(Edge{9984 * kMicrosecond, true}, Edge{30 * kMillisecond, false},
                          Edge{30 * kMillisecond + 9984 * kMicrosecond, true}, Edge{50 * kMillisecond, false}));
  EXPECT_EQ(m.loader.occupancy(0, 60 * kMillisecond).busy, 3072U * 26);
  // Both banks have their N.L and N.H tables, two loaders each: a word of the link is four entries.
  EXPECT_EQ(m.links[0].words(), 2U * 6144 / 2);
  EXPECT_EQ(m.loader.words_sent(), m.shading.words_loaded());
}

}  // namespace
}  // namespace rastertlm::shading
