// Are tables loaded in the loaders' own time, used from the retrace that copies, and refused where they cannot be in
// time?
#include "modules/shading/table_loader_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "modules/shading/deferred_shading_module.h"
#include "modules/stream/simulated_time.h"
#include "src/base/errors.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::shading {
namespace {

using Edge = stream::Edges::Edge;
using testing::ElementsAre;

constexpr std::uint64_t kMicrosecond = 1'000'000;
constexpr std::uint64_t kMillisecond = 1000 * kMicrosecond;
// N.L and N.H; a colour each; one table.
constexpr std::array<std::uint64_t, 3> kLoaders{2, 3, 1};
// From the start of a line to its first pixel's reading of the tables.
constexpr std::array<std::uint64_t, 3> kReachedPs{7 * kMicrosecond, 7'180'000, 7'180'000};
constexpr std::uint64_t kRetracePs = 600 * kMicrosecond;  // 004, section 5.3.6

LightArguments light(double x, double y, double z) {
  const auto unit = [](double a, double b, double c) {
    const double length = std::sqrt(a * a + b * b + c * c);
    return Direction{a / length, b / length, c / length};
  };
  const Direction towards = unit(x, y, z);
  return {towards, unit(towards[0], towards[1], towards[2] + 1), {1, 1, 1}};
}

const LightArguments kFirst = light(0.3, -0.5, 0.8);
const LightArguments kSecond = light(-0.2, 0.4, 0.7);

// Host, video timing and screen around a shading processor.
class Surroundings : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, LightProtocol> lights;
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, stream::SyncProtocol> to_loader;
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, stream::SyncProtocol> to_shading;
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, stream::FragmentProtocol> fragments;
  tlm_utils::simple_target_socket<Surroundings, stream::kNoBusWidth, stream::RgbProtocol> rgb;
  sc_core::sc_event swapped;
  const sc_core::sc_signal<bool>* tables_ready = nullptr;

  explicit Surroundings(const sc_core::sc_module_name& name)
      : sc_module(name),
        lights("lights"),
        to_loader("to_loader"),
        to_shading("to_shading"),
        fragments("fragments"),
        rgb("rgb") {
    rgb.register_b_transport(this, &Surroundings::receive);
  }

  void announce(bool changed, const LightArguments& arguments) {
    LightPayload payload;
    payload.changed = changed;
    payload.lights = {arguments};
    sc_core::sc_time delay;
    lights->b_transport(payload, delay);
  }
  // As the video timing, where loading RAMs are copied: the loader first, then the shading processor; then whoever
  // waits for a swap, if all are ready. Whether the tables were switched.
  bool retrace(bool copy, bool hosts_ready = true) {
    sc_core::wait(sc_core::SC_ZERO_TIME);  // who finishes at this very instant is in time
    stream::SyncPayload payload;
    payload.kind = stream::SyncPayload::Kind::retrace;
    payload.copy = copy;
    payload.swap = copy && hosts_ready && tables_ready->read();
    sc_core::sc_time delay;
    to_loader->b_transport(payload, delay);
    to_shading->b_transport(payload, delay);
    if (payload.swap) swapped.notify(sc_core::SC_ZERO_TIME);
    return payload.switch_tables;
  }
  // A line that starts `delay_ps` from now, announced before it does.
  void line(std::uint64_t delay_ps) {
    stream::SyncPayload payload;
    payload.kind = stream::SyncPayload::Kind::line;
    sc_core::sc_time delay = stream::to_time(delay_ps);
    to_loader->b_transport(payload, delay);
    to_shading->b_transport(payload, delay);
  }

 private:
  void receive(stream::RgbPayload&, sc_core::sc_time&) {}
};

ShadingParameters shading_parameters() {
  ShadingParameters parameters;
  parameters.materials = 4;
  return parameters;
}

void set_materials(DeferredShader& shader) {
  shader.set_material(0, {{0.9, 0.5, 0.2}, 0.1, 0.5, 0.4, 20});
  shader.set_material(2, {{1.0, 1.0, 1.0}, 0.2, 0.6, 0.2, 100});
  shader.set_ambient_light({1.0, 0.5, 1.0});
  shader.set_background({1, 2, 3});
}

struct Machine {
  Surroundings around{"around"};
  DeferredShader shader;
  stream::Link rgb_link{"rgb", 24, Clock::from_period_ns("pixel clock", 60.0)};
  DeferredShadingModule shading;
  std::vector<stream::Link> links;
  TableLoaderModule loader;
  sc_core::sc_signal<bool> ready{"ready_signal"};
  stream::Edges edges{"edges", ready};

  static std::vector<stream::Link> engine_links(const LoaderParameters& p) {
    const auto clock = [&](double mhz) {
      return p.kind == LoaderKind::sequencer
                 ? Clock::from_period_ns("loader", p.sequencer_clock_ns)
                 : Clock::from_frequency_hz("loader", static_cast<std::uint64_t>(mhz * 1e6));
    };
    return {{"dot", 11, clock(p.dot.clock_mhz)},
            {"diffuse", 8, clock(p.diffuse.clock_mhz)},
            {"specular", 8, clock(p.specular.clock_mhz)}};
  }
  TableLoaderModule::Engine engine(std::size_t i, const LoaderParameters& p) {
    const std::int64_t units[] = {p.dot.units, p.diffuse.units, p.specular.units};
    return {&links[i], kLoaders[i] * static_cast<std::uint64_t>(units[i]), stream::OccupancyMeter(links[i].clock()),
            kReachedPs[i]};
  }

  explicit Machine(const LoaderParameters& parameters, std::vector<std::size_t> materials = {0})
      : shader(shading_parameters(), 12, parameters.when == LoadTime::frame ? 2 : 1),
        shading("deferred_shading", shader, 16, Clock::from_period_ns("pixel clock", 60.0), Cycles(10), rgb_link),
        links(engine_links(parameters)),
        loader("table_loader", shader, parameters, std::move(materials), kRetracePs, around.swapped,
               {engine(0, parameters), engine(1, parameters), engine(2, parameters)}) {
    set_materials(shader);
    around.lights.bind(loader.lights);
    around.to_loader.bind(loader.sync);
    around.to_shading.bind(shading.sync);
    around.fragments.bind(shading.in);
    shading.out.bind(around.rgb);
    loader.bus.bind(shading.bus);
    loader.ready.bind(ready);
    around.tables_ready = &ready;
  }
};

LoaderParameters loader(LoaderKind kind, LoadTime when) {
  LoaderParameters parameters;
  parameters.kind = kind;
  parameters.when = when;
  return parameters;
}

// Every word that a processor with all the time it needs would have, given this light.
void expect_tables(const TableBank& bank, const LightArguments& arguments) {
  DeferredShader shader(shading_parameters(), 12, 1);
  set_materials(shader);
  shader.set_light(0, arguments);
  shader.load();
  const std::uint32_t index_mask = (1U << 10) - 1;
  std::size_t different = 0;
  for (std::uint32_t address = 0; address < bank.words(); ++address) {
    const EntryAddress place = bank.decode(address);
    const bool by_material = place.table.kind == TableKind::diffuse || place.table.kind == TableKind::specular;
    if (by_material && (place.entry & ~index_mask) != 0) continue;  // material 0 alone is loaded
    different += bank.read(address) != shader.front().read(address) ? 1U : 0U;
  }
  EXPECT_EQ(different, 0U);
}

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

// A host that copies at every retrace: the tables are switched at the first at which their own load has ended. Of
// lights that came meanwhile the last are loaded next.
TEST(TableLoaderModule, ALateBankIsSwitchedWhenItsOwnLoadHasEnded) {
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
TEST(TableLoaderModule, TablesAreSwitchedAtARetraceThatCopiesForLateHosts) {
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
TEST(TableLoaderModule, OneBankIsLoadedAtARetraceThatCopiesForLateHosts) {
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
TEST(TableLoaderModule, ALateLoadOfOneBankShowsWhatIsWritten) {
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
TEST(TableLoaderModule, ALoadOfOneBankThatOutlastsTheFrameGoesOn) {
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
