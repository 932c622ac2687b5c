// Does a frame take a host exactly the cycles of its links, its arithmetic and its bus, and not one less?
//
// The schedules are worked here by hand from the data of the T800-20: 50 ns a cycle, a message of b bytes 19 +
// ceil(11.5 b) cycles a link, 40 / 3 cycles an operation, 3 cycles a bus word. The operations themselves come from the
// core, whose tests say what they are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>

#include "modules/object_processor/bus_address.h"
#include "src/base/errors.h"
#include "tests/modules/host/stub_machine.h"

namespace rastertlm::host {
namespace {

constexpr std::uint64_t kCyclePs = 50'000;

std::uint64_t twenty_megahertz(std::uint64_t bytes) { return 19 + (23 * bytes + 1) / 2; }
std::uint64_t compute(std::uint64_t flops) { return (40 * flops + 2) / 3; }

glm::dvec3 at(double x, double y) { return {(x + 0.5) / 32 - 1, 1 - (y + 0.5) / 24, 0.5}; }

// Objects of `triangles` front faces each on the screen, 3 units unless said otherwise.
void add_objects(Hosts& hosts, const std::vector<std::pair<std::size_t, bool>>& triangles_and_moves) {
  std::vector<glm::dvec3> places;
  for (const auto& [triangles, moves] : triangles_and_moves) {
    geometry::Mesh& mesh = hosts.world.add(false, moves);
    for (std::size_t i = 0; i < triangles; ++i) {
      const auto x = static_cast<double>(2 * i + 3);
      add_triangle(mesh, at(x, 10), at(x, 20), at(x + 8.3, 15.1), 0);
    }
    places.emplace_back(0.0);
  }
  hosts.world.places.assign(4, places);
  hosts.parameters.computation_units = 3;
  hosts.parameters.processors_per_unit = 16;
}

// What the two steps of a unit's frames cost in operations, from cores of their own.
struct Work {
  std::uint64_t survey = 0;
  std::uint64_t fit = 0;
  std::uint64_t words = 0;
  std::vector<std::uint64_t> known;  // operations of the second step before each slot's words
};
std::vector<std::vector<Work>> work_of(const Hosts& hosts, std::int64_t frames) {
  const SlotMap slots = assign_objects(hosts.world.triangles(), hosts.parameters);
  const Animation animation(hosts.world.resident, hosts.parameters.send == Send::all);
  std::vector<std::vector<Work>> result;
  std::deque<Computation> computations;
  for (const auto& owners : slots.boards) computations.emplace_back(hosts.world.resident, format(16), owners);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const FrameWork work = animation.frame_work(frame, frame == 0);
    result.emplace_back();
    for (Computation& computation : computations) {
      const std::uint64_t start = computation.operations().flops();
      computation.survey(work);
      const std::uint64_t surveyed = computation.operations().flops();
      const std::vector<Load>& loads = computation.set_up(false, {});
      std::vector<std::uint64_t> known;
      known.reserve(loads.size());
      for (const geometry::OperationCounts& before : computation.before()) known.push_back(before.flops());
      result.back().push_back(
          {surveyed - start, computation.operations().flops() - surveyed, 22 * loads.size(), known});
    }
  }
  return result;
}

// Unit 2 below unit 1 below unit 0: frame messages of `bytes`, surveys of 5, 9 and 13 bytes (a flag, and four bytes a
// unit), plans of one byte. A unit that forwards starts the message before it works. Cycles from the start to ready, by
// unit.
std::vector<std::uint64_t> chain_schedule(std::uint64_t bytes, const std::vector<Work>& work,
                                          std::uint64_t (*message)(std::uint64_t) = twenty_megahertz) {
  const std::uint64_t start = message(0);
  std::array<std::uint64_t, 3> surveyed{};
  for (std::size_t k = 0; k < 3; ++k)
    surveyed[k] = (k + 1) * message(bytes) + (k < 2 ? start : 0) + compute(work[k].survey);
  const std::uint64_t from_2 = surveyed[2] + message(5);
  const std::uint64_t from_1 = std::max(surveyed[1], from_2) + message(9);
  const std::uint64_t settled = std::max(surveyed[0], from_1) + message(13);
  std::vector<std::uint64_t> ready;
  for (std::size_t k = 0; k < 3; ++k)
    ready.push_back(settled + (k + 1) * message(1) + (k < 2 ? start : 0) + compute(work[k].fit) + 3 * work[k].words);
  return ready;
}

// Units 0 and 1 below the animation unit, unit 2 below unit 0: what a tree of three links makes of three units. The
// animation unit starts the message to unit 1 after that to unit 0.
std::vector<std::uint64_t> tree_schedule(std::uint64_t bytes, const std::vector<Work>& work) {
  const auto message = twenty_megahertz;
  const std::uint64_t start = message(0);
  const std::uint64_t hop = message(bytes);
  const std::uint64_t from_2 = 2 * hop + compute(work[2].survey) + message(5);
  const std::uint64_t from_0 = std::max(hop + start + compute(work[0].survey), from_2) + message(9);
  const std::uint64_t from_1 = start + hop + compute(work[1].survey) + message(5);
  const std::uint64_t settled = std::max(from_0, from_1);
  std::vector<std::uint64_t> ready;
  for (std::size_t k = 0; k < 3; ++k)
    ready.push_back(settled + (k == 2 ? 2 : 1) * message(1) + (k == 2 ? 0 : start) + compute(work[k].fit) +
                    3 * work[k].words);
  return ready;
}

TEST(HostsModule, InitialLoadInAChain) {
  Hosts hosts;
  add_objects(hosts, {{4, false}, {3, false}});
  hosts.parameters.link_topology = LinkTopology::chain;
  const auto work = work_of(hosts, 1)[0];
  hosts.build();
  stream::simulate();
  // Header, camera, a light, two objects.
  const auto expected = chain_schedule(8 + 128 + 12 + 2 * 64, work);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_THAT(hosts.edges[k].list(), testing::ElementsAre(stream::Edges::Edge{expected[k] * kCyclePs, true})) << k;
    ASSERT_EQ(hosts.units[k].updates().size(), 1U);
    const auto& update = hosts.units[k].updates()[0];
    EXPECT_EQ(update.cycles, Cycles(expected[k]));
    EXPECT_EQ(update.computing, Cycles(compute(work[k].survey) + compute(work[k].fit)));
    EXPECT_EQ(update.writing, Cycles(3 * work[k].words));
    EXPECT_EQ(update.flops(), work[k].survey + work[k].fit);
    EXPECT_EQ(update.words, work[k].words);
    EXPECT_EQ(hosts.bus_links[k].words(), work[k].words);
  }
  // Frame and plan down, a survey up.
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(hosts.links[k].bytes(), 276U + 1);
    EXPECT_EQ(hosts.up_links[k].bytes(), 13U - 4 * k);
  }
}

TEST(HostsModule, InitialLoadInATree) {
  Hosts hosts;
  add_objects(hosts, {{7, false}});
  hosts.parameters.links = 3;
  const auto work = work_of(hosts, 1)[0];
  hosts.build();
  stream::simulate();
  const auto expected = tree_schedule(8 + 128 + 12 + 64, work);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_THAT(hosts.edges[k].list(), testing::ElementsAre(stream::Edges::Edge{expected[k] * kCyclePs, true})) << k;
}

// At 30 MHz no number of picoseconds is a cycle: what a unit counts is still the sum of whole cycles.
TEST(HostsModule, CyclesOfARationalClockAreWhole) {
  Hosts hosts;
  add_objects(hosts, {{5, true}, {4, false}});
  hosts.parameters.link_topology = LinkTopology::chain;
  hosts.parameters.clock_hz = 30'000'000;
  hosts.parameters.sustained_mflops = 2.25;
  hosts.parameters.link_set_up_cycles = 20;
  const auto work = work_of(hosts, 1)[0];
  hosts.build();
  stream::simulate();
  const auto thirty = [](std::uint64_t bytes) { return 20 + (69 * bytes + 3) / 4; };
  const auto expected = chain_schedule(8 + 128 + 12 + 2 * 64, work, thirty);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(hosts.units[k].updates().at(0).cycles, Cycles(expected[k])) << k;
}

// After the retrace that shows a frame the next one begins: only what moves is sent, and cycles count from that
// retrace.
TEST(HostsModule, TheNextFrameBeginsAtTheSwap) {
  Hosts hosts;
  add_objects(hosts, {{5, true}, {4, false}});
  hosts.parameters.link_topology = LinkTopology::chain;
  const auto work = work_of(hosts, 2)[1];
  hosts.build();
  const std::uint64_t swap_ps = 20'000'000'000;
  const stream::Script video("video", [&] {
    sc_core::wait(stream::to_time(swap_ps));
    hosts.displayed_frame = 0;
    hosts.swapped.notify(sc_core::SC_ZERO_TIME);
  });
  stream::simulate();
  const auto expected = chain_schedule(8 + 64, work);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& edges = hosts.edges[k].list();
    ASSERT_EQ(edges.size(), 3U);
    EXPECT_EQ(edges[1], (stream::Edges::Edge{swap_ps, false}));
    EXPECT_EQ(edges[2], (stream::Edges::Edge{swap_ps + expected[k] * kCyclePs, true}));
    EXPECT_EQ(hosts.units[k].updates().at(1).cycles, Cycles(expected[k]));
    EXPECT_EQ(hosts.units[k].updates().at(1).animation_frame, 1);
    // Since the swap, the initial load left out, up to the 40 ms of the second retrace.
    const stream::Occupancy& occupancy = hosts.units[k].occupancy(2 * swap_ps);
    occupancy.check("unit");
    EXPECT_EQ(occupancy.cycles, 400'000U);
    // Frame and plan forwarded, but for the last; a survey up.
    const std::uint64_t starts = 19 * (k < 2 ? 3 : 1);
    EXPECT_EQ(hosts.units[k].updates().at(1).starting, Cycles(starts));
    EXPECT_EQ(occupancy.busy, starts + compute(work[k].survey) + compute(work[k].fit) + 3 * work[k].words);
    EXPECT_EQ(occupancy.idle, 400'000U - expected[k]);
    EXPECT_EQ(occupancy.blocked, 0U);
  }
  ASSERT_EQ(hosts.loader.received.size(), 2U);
  EXPECT_TRUE(hosts.loader.received[0].changed);
  EXPECT_FALSE(hosts.loader.received[1].changed);
}

// Loading RAMs are copied at every retrace, while the units still write: the bus stands still for the ten host cycles
// that start within the copy's 480 ns, and the copy finds the words that had been written by then, part of a slot
// included.
TEST(HostsModule, CopiesStopTheBusOfThreeUnits) {
  constexpr std::uint64_t kWord = 6000;  // host cycles: a slow bus, on which a frame's words take more than a frame
  constexpr std::uint64_t kFramePs = 333'333ULL * 60'000;
  constexpr std::uint64_t kCyclesOfFrame = 399'999;  // that end before the next retrace
  Hosts hosts;
  add_objects(hosts, {{12, true}});
  hosts.parameters.bus_cycles_per_word = static_cast<std::int64_t>(kWord);
  hosts.copies.every_retrace = true;
  const auto work = work_of(hosts, 2)[1];
  hosts.build();
  const std::uint64_t swap_ps = 4 * kFramePs;
  const auto words_written = [&](std::size_t k) {
    std::uint64_t words = 0;
    for (const StubBoard::Write& write : hosts.boards[k].writes) words += write.words.size();
    return words;
  };
  std::vector<std::uint64_t> at_copy, before;
  const stream::Script video("video", [&] {
    sc_core::wait(stream::to_time(swap_ps));
    for (std::size_t k = 0; k < 3; ++k) before.push_back(words_written(k));
    hosts.swapped.notify(sc_core::SC_ZERO_TIME);
    sc_core::wait(stream::to_time(kFramePs));
    for (std::size_t k = 0; k < 3; ++k) at_copy.push_back(words_written(k) - before[k]);
  });
  stream::simulate();
  ASSERT_EQ(at_copy.size(), 3U);
  // All three below the animation unit, which starts their messages one after the other.
  const auto message = twenty_megahertz;
  std::uint64_t settled = 0;
  for (std::size_t k = 0; k < 3; ++k)
    settled = std::max(settled, 19 * k + message(8 + 64) + compute(work[k].survey) + message(5));
  for (std::size_t k = 0; k < 3; ++k) {
    SCOPED_TRACE(k);
    ASSERT_EQ(work[k].words, 4U * 22);
    // A slot's words follow the arithmetic up to it.
    const std::uint64_t fits = settled + 19 * k + message(1);
    std::uint64_t stand = 0;
    for (std::size_t word = 0; word < work[k].words; ++word)
      if (fits + compute(work[k].known.at(word / 22)) + kWord * (word + 1) <= kCyclesOfFrame) ++stand;
    EXPECT_EQ(at_copy[k], stand);
    EXPECT_NE(at_copy[k] % 22, 0U) << "a copy within a slot was meant";
    const auto& update = hosts.units[k].updates().at(1);
    EXPECT_EQ(update.cycles, Cycles(fits + compute(work[k].fit) + kWord * work[k].words + 10));
    EXPECT_EQ(update.stalled, Cycles(10));
    EXPECT_EQ(update.writing, Cycles(kWord * work[k].words));
    EXPECT_EQ(words_written(k) - before[k], work[k].words);
    const stream::Occupancy& occupancy = hosts.units[k].occupancy(swap_ps + 2 * kFramePs);
    occupancy.check("unit");
    EXPECT_EQ(occupancy.blocked, 10U);
    EXPECT_EQ(hosts.edges[k].list().back(), (stream::Edges::Edge{swap_ps + update.cycles.count() * kCyclePs, true}));
  }
}

// The same, copied when all are ready only: nothing stops the bus.
TEST(HostsModule, NothingIsCopiedUnderAWritingUnit) {
  Hosts hosts;
  add_objects(hosts, {{12, true}});
  hosts.parameters.bus_cycles_per_word = 6000;
  const auto work = work_of(hosts, 2)[1];
  hosts.build();
  const std::uint64_t swap_ps = 4 * 333'333ULL * 60'000;
  const stream::Script video("video", [&] {
    sc_core::wait(stream::to_time(swap_ps));
    hosts.swapped.notify(sc_core::SC_ZERO_TIME);
  });
  stream::simulate();
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(hosts.units[k].updates().at(1).stalled, Cycles(0));
    EXPECT_EQ(hosts.units[k].updates().at(1).writing, Cycles(6000 * work[k].words));
  }
}

// Where nothing moves, nothing is announced after the first frame.
TEST(HostsModule, AStillSceneIsLoadedOnce) {
  Hosts hosts;
  add_objects(hosts, {{2, false}});
  hosts.build();
  const stream::Script video("video", [&] {
    for (int i = 0; i < 3; ++i) {
      sc_core::wait(20, sc_core::SC_MS);
      hosts.swapped.notify(sc_core::SC_ZERO_TIME);
    }
  });
  stream::simulate();
  EXPECT_EQ(hosts.loader.received.size(), 1U);
  for (const auto& unit : hosts.units) EXPECT_EQ(unit.updates().size(), 1U);
}

// Object 3 k + s stands in slot s of board k's 16; its 22 words are those of the set-up, and its number goes with them.
TEST(HostsModule, WritesReachTheirSlots) {
  Hosts hosts;
  add_objects(hosts, {{7, false}});
  hosts.build();
  stream::simulate();
  const MachineFormat machine_format = format(16);
  const auto triangles = plain_triangles(hosts.world, 0);
  std::size_t seen = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    std::uint32_t slot = 0;
    for (const StubBoard::Write& write : hosts.boards[k].writes) {
      const auto object = static_cast<std::uint32_t>(k + 3 * slot);
      EXPECT_EQ(write.address, object_processor::bus_address(static_cast<std::uint32_t>(k), slot, 0));
      EXPECT_EQ(write.object, object + 1);
      set_up::ScreenTriangle<double> screen;
      for (std::size_t i = 0; i < 3; ++i)
        screen[i] = geometry::to_screen(triangles[object].corners[i], machine_format.viewport);
      const auto words = object_processor::to_words(
          set_up::set_up_triangle<double>(screen, 0, false, machine_format.grids.on_screen, machine_format.words)
              .words);
      EXPECT_THAT(write.words, testing::ElementsAreArray(words));
      ++slot;
      ++seen;
    }
  }
  EXPECT_EQ(seen, 7U);
}

// A triangle that turned away takes three words, and no number.
TEST(HostsModule, ParksWithThreeWords) {
  Hosts hosts;
  add_objects(hosts, {{1, true}});
  hosts.parameters.computation_units = 1;
  hosts.world.places[1][0].x = 100.0;
  hosts.build();
  const stream::Script video("video", [&] {
    sc_core::wait(20, sc_core::SC_MS);
    hosts.swapped.notify(sc_core::SC_ZERO_TIME);
  });
  stream::simulate();
  ASSERT_EQ(hosts.boards[0].writes.size(), 2U);
  EXPECT_EQ(hosts.boards[0].writes[1].words, (std::vector<std::uint32_t>{0, 0, 0xFFFFFF}));
  EXPECT_EQ(hosts.boards[0].writes[1].object, 0U);
  EXPECT_EQ(hosts.units[0].updates().at(1).words, 3U);
  EXPECT_EQ(hosts.units[0].updates().at(1).writing, Cycles(9));
  EXPECT_TRUE(hosts.animation_unit->guarded());
}

TEST(HostsModule, ABoardThatRefusesNamesTheUnit) {
  Hosts hosts;
  add_objects(hosts, {{3, false}});
  hosts.build();
  hosts.boards[1].refuses = true;
  try {
    stream::simulate();
    FAIL() << "a refused write went unnoticed";
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("computation_unit_1"),
                                             testing::HasSubstr("the board refused a bus write"),
                                             testing::HasSubstr("TLM_ADDRESS_ERROR_RESPONSE")));
  }
}

// Across the screen's corner a triangle is cut into pieces, and no slot is free for the further ones.
void cut_by_the_border(Hosts& hosts, Overflow overflow) {
  geometry::Mesh& mesh = hosts.world.add(false, false);
  add_triangle(mesh, at(-200, -200), at(-200, 400), at(500, 20));
  hosts.world.places.assign(2, {glm::dvec3(0.0)});
  hosts.parameters.computation_units = 1;
  hosts.parameters.processors_per_unit = 1;
  hosts.parameters.overflow = overflow;
  hosts.build();
}

TEST(HostsModule, RefusesPiecesWithoutAProcessor) {
  Hosts hosts;
  cut_by_the_border(hosts, Overflow::error);
  try {
    stream::simulate();
    FAIL() << "pieces vanished";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().at(0).key, "host.processors_per_unit");
    EXPECT_THAT(error.diagnostics().at(0).message,
                testing::AllOf(testing::StartsWith("animation frame 0: clipping makes "),
                               testing::HasSubstr(" more pieces than the machine has free object processors")));
  }
}

TEST(HostsModule, CountsPiecesThatAreDropped) {
  Hosts hosts;
  cut_by_the_border(hosts, Overflow::drop);
  stream::simulate();
  const auto cut = set_up::pieces(plain_triangles(hosts.world, 0)[0].corners,
                                  geometry::frame_grid(format(1).grids, true, {kColumns, kLines}), {kColumns, kLines});
  ASSERT_GT(cut.size, 1U);
  EXPECT_EQ(hosts.animation_unit->pieces_dropped(), cut.size - 1);
  EXPECT_EQ(hosts.boards[0].writes.size(), 1U);
}

}  // namespace
}  // namespace rastertlm::host
