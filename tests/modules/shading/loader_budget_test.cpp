// Are the closed forms the paper's figures, and what the loaders' steps add up to, however many share the work?
#include "modules/shading/loader_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "modules/shading/deferred_shader.h"
#include "modules/shading/shared_load.h"

namespace rastertlm::shading {
namespace {

DeferredShader example(const ShadingParameters& parameters) {
  DeferredShader shader(parameters, 12, 1);
  for (std::size_t m = 0; m < static_cast<std::size_t>(parameters.materials); ++m)
    shader.set_material(
        m, {{0.9, 0.5, 0.2}, 0.1, 0.5 + 0.01 * double(m), 0.4, parameters.exponents[m % parameters.exponents.size()]});
  for (std::size_t l = 0; l < static_cast<std::size_t>(parameters.lights); ++l)
    shader.set_light(l, {{0.6, -0.64, 0.48}, {0.36, -0.48, 0.8}, {1.0, 0.9, 0.5}});
  return shader;
}

std::map<std::string, LoadBudget> budgets_of(const ShadingParameters& parameters, const LoaderParameters& loader) {
  std::map<std::string, LoadBudget> budgets;
  for (const LoadBudget& budget : load_budgets(parameters, loader, parameters.materials))
    budgets.emplace(budget.name, budget);
  return budgets;
}

double used(const LoaderParameters& loader, const std::string& name) {
  return budgets_of(ShadingParameters(), loader).at(name).used;
}

TEST(LoaderBudget, GivesTheFiguresOfThePaper) {
  const LoaderParameters loader;
  EXPECT_EQ(used(loader, "dot_table.words"), 6144);
  EXPECT_NEAR(used(loader, "dot_table.load_sequencer"), 368.64, 1e-6);  // 004: "about 370 us"
  EXPECT_NEAR(used(loader, "dot_table.load_68000"), 19968.0, 1e-6);
  EXPECT_EQ(used(loader, "diffuse.words"), 16384);
  EXPECT_NEAR(used(loader, "diffuse.load_sequencer"), 983.04, 1e-6);
  EXPECT_NEAR(used(loader, "diffuse.load_68000"), 18944.0, 1e-6);
  EXPECT_NEAR(used(loader, "diffuse9.load_sequencer"), 491.52, 1e-6);
  EXPECT_EQ(used(loader, "specular.words"), 16384);
  EXPECT_NEAR(used(loader, "specular.load_sequencer"), 1228.8, 1e-6);
  EXPECT_NEAR(used(loader, "specular.load_68000"), 229376 / 12.5, 1e-6);  // 18.35 ms: 004's "less than 19 ms"
  EXPECT_EQ(used(loader, "path_rom.moves"), 1279);
}

// add.l 8, move.w 8 or move.l 12, dbra 10 a pass of k entries, at 16 MHz: the frame's 20 ms from three times on.
TEST(LoaderBudget, DiffuseFitsTheFrameFromThreeFoldUnrollingOn) {
  LoaderParameters loader;
  for (std::int64_t k = 1; k <= 32; ++k) {
    loader.diffuse.unroll = k;
    EXPECT_NEAR(used(loader, "diffuse.load_68000"), 16384 * (16 + 10.0 / double(k)) / 16, 1e-6) << k;
    EXPECT_EQ(used(loader, "diffuse.load_68000") <= 20000.0, k >= 3) << k;
  }
  loader.diffuse.unroll = 0;
  EXPECT_NEAR(used(loader, "diffuse.load_68000"), 16384.0, 1e-6);  // 16 cycles at 16 MHz
  loader.diffuse.body_cycles = 20.0;
  EXPECT_NEAR(used(loader, "diffuse.load_68000"), 20480.0, 1e-6);
  loader.diffuse.cycles = 17.0;  // whatever the loop says
  EXPECT_NEAR(used(loader, "diffuse.load_68000"), 16384 * 17 / 16.0, 1e-6);
}

TEST(LoaderBudget, NamesTheLoopAndHowOftenItIsUnrolled) {
  LoaderParameters loader;
  const auto source = [&](const std::string& name) { return budgets_of(ShadingParameters(), loader).at(name).source; };
  EXPECT_EQ(source("dot_table.load_68000"), "6144 x 26 cycles (add_l_move_w: 16 + 10 / 1) / 8 MHz");
  EXPECT_EQ(source("diffuse.load_68000"), "16384 x 18.5 cycles (add_l_move_w: 16 + 10 / 4) / 16 MHz");
  EXPECT_EQ(source("specular.load_68000"), "16 x (1024 x 12 + 256 x 8) cycles (move_l_add_l) / 12.5 MHz");
  loader.dot.preset = "";
  loader.diffuse.unroll = 0;
  EXPECT_EQ(source("dot_table.load_68000"), "6144 x 26 cycles (16 + 10 / 1) / 8 MHz");
  EXPECT_EQ(source("diffuse.load_68000"), "16384 x 16 cycles (add_l_move_w: straight line) / 16 MHz");
  EXPECT_EQ(source("diffuse9.load_sequencer"), "8192 x 60 ns: what a 9-bit index would take");
  loader.diffuse.units = 4;
  EXPECT_EQ(source("diffuse9.load_sequencer"), "2048 x 60 ns, the largest share of 4: what a 9-bit index would take");
  loader.dot.cycles = 19.0;
  loader.dot.units = 3;
  EXPECT_EQ(source("dot_table.load_68000"), "2049 x 19 cycles (as given) / 8 MHz, the largest share of 3");
}

// Nobody does more than the largest share: 3 x ceil(2048 / n) entries, ceil(16 / n) materials.
TEST(LoaderBudget, OfLoadersThatShareIsThatOfTheLargestShare) {
  LoaderParameters loader;
  for (const std::int64_t n : {1, 2, 3, 5, 7, 16}) {
    loader.dot.units = loader.diffuse.units = loader.specular.units = n;
    const double entries = 3.0 * std::ceil(2048.0 / double(n));
    const double materials = std::ceil(16.0 / double(n));
    EXPECT_NEAR(used(loader, "dot_table.load_sequencer"), entries * 0.06, 1e-6) << n;
    EXPECT_NEAR(used(loader, "dot_table.load_68000"), entries * 26 / 8, 1e-6) << n;
    EXPECT_NEAR(used(loader, "diffuse.load_sequencer"), materials * 1024 * 0.06, 1e-6) << n;
    EXPECT_NEAR(used(loader, "diffuse9.load_sequencer"), materials * 512 * 0.06, 1e-6) << n;
    EXPECT_NEAR(used(loader, "specular.load_sequencer"), materials * (1279 + 1) * 0.06, 1e-6) << n;
    EXPECT_NEAR(used(loader, "specular.load_68000"), materials * (1024 * 12 + 256 * 8) / 12.5, 1e-6) << n;
    EXPECT_EQ(used(loader, "dot_table.words"), 6144) << n;  // they share the table
  }
}

TEST(LoaderBudget, ClosedFormsEqualTheStepsOfTheJobs) {
  for (const LoaderKind kind : {LoaderKind::mc68000, LoaderKind::sequencer})
    for (const std::int64_t units : {1, 3, 4}) {
      ShadingParameters parameters;
      parameters.arithmetic = Arithmetic::literal;
      LoaderParameters loader;
      loader.kind = kind;
      loader.dot.units = loader.diffuse.units = loader.specular.units = units;
      const DeferredShader shader = example(parameters);
      const LoadProgram program = shader.program(LoadRecord());
      std::map<LoaderId, double> time;  // us, step by step
      for (const TableJob& job : program.jobs)
        for (const TableJob& share : shares_of(job, units))
          for (TableLoad load({&share, 1}, loader.argument_cycles, {}); !load.done();)
            time[loader_of(share)] += 1e6 * step_seconds(loader, share.table.kind, load.step().is_up);
      std::map<std::size_t, double> longest;
      for (const auto& [id, us] : time) longest[engine_of(id.kind)] = std::max(longest[engine_of(id.kind)], us);
      const std::string suffix = kind == LoaderKind::mc68000 ? ".load_68000" : ".load_sequencer";
      const SharedLoad load(program, loader);
      const char* const tables[] = {"dot_table", "diffuse", "specular"};
      for (std::size_t engine = 0; engine < kEngines; ++engine) {
        const double budget = budgets_of(parameters, loader).at(tables[engine] + suffix).used;
        EXPECT_NEAR(longest[engine], budget, 1e-6) << tables[engine] << " of " << units;
        EXPECT_NEAR(1e6 * load.seconds(engine), budget, 1e-6) << tables[engine] << " of " << units;
      }
      EXPECT_EQ(time.size(), 6U * static_cast<std::size_t>(units));  // N.L, N.H, three colours, one specular table
    }
}

// Between two entries of a pass there is no end of the loop, so the mean of a pass is not the shortest time. Dot: 26
// cycles at 8 MHz; diffuse: 16 at 16 MHz, but where every entry is a pass; specular: 12 at 12.5 MHz.
TEST(LoaderBudget, ShortestTimeBetweenStoresIsThatOfTheFastestLoaderWithinAPass) {
  const auto expect = [](const LoaderParameters& loader, double ns, const std::string& named,
                         const std::string& moved_by) {
    const StoreTime store = shortest_store_time(loader);
    EXPECT_NEAR(store.ns, ns, 1e-9);
    EXPECT_THAT(store.source, testing::HasSubstr(named));
    EXPECT_EQ(store.moved_by, moved_by);
  };
  LoaderParameters loader;
  const std::string specular = "loader.specular.preset, loader.specular.clock_mhz, loader.specular.right_cycles";
  const std::string diffuse =
      "loader.diffuse.preset, loader.diffuse.clock_mhz, loader.diffuse.unroll, loader.diffuse.body_cycles";
  expect(loader, 960.0, "12 cycles / 12.5 MHz of the specular loader", specular);
  loader.specular.clock_mhz = 1.0;
  for (const std::int64_t unroll : {0, 2, 4, 100}) {
    loader.diffuse.unroll = unroll;
    expect(loader, 1000.0, "16 cycles / 16 MHz of the diffuse loader", diffuse);
  }
  loader.diffuse.unroll = 1;
  expect(loader, 1625.0, "26 cycles / 16 MHz of the diffuse loader", diffuse);
  loader.diffuse.cycles = 18.0;
  expect(loader, 1125.0, "18 cycles / 16 MHz of the diffuse loader", "loader.diffuse.cycles, loader.diffuse.clock_mhz");
  loader.diffuse.clock_mhz = 1.0;
  expect(loader, 3250.0, "26 cycles / 8 MHz of the dot product loader",
         "loader.dot.preset, loader.dot.clock_mhz, loader.dot.unroll, loader.dot.body_cycles");
  loader.kind = LoaderKind::sequencer;
  expect(loader, 60.0, "the sequencer's clock period", "loader.sequencer_clock_ns");
}

// 600 us / 16 are 625 steps of 60 ns, one of them for the arguments. 20 ms / 16 are 1250 us, of which the arguments
// take 8 cycles of 80 ns; a path's 1024 x 12 + 255 x 8 cycles, 1146.24 us, are 1279 moves.
TEST(LoaderBudget, MovesInATimeAreThoseOfAMaterialsShareOfIt) {
  const ShadingParameters parameters;
  LoaderParameters loader;
  EXPECT_EQ(path_moves_in(20e-3, parameters, loader, 16), std::floor((1250 - 0.64) * 1279 / 1146.24));
  EXPECT_EQ(path_moves_in(0.1e-6, parameters, loader, 16), 0);
  loader.kind = LoaderKind::sequencer;
  EXPECT_EQ(path_moves_in(600e-6, parameters, loader, 16), 624);
  loader.specular.units = 3;  // six materials each: 1666 steps
  EXPECT_EQ(path_moves_in(600e-6, parameters, loader, 16), 1665);
}

// In the time of a whole load there is a whole path for each material, and in any less there is not.
TEST(LoaderBudget, AWholePathIsMadeInTheTimeOfTheLoad) {
  const ShadingParameters parameters;
  for (const LoaderKind kind : {LoaderKind::mc68000, LoaderKind::sequencer})
    for (const std::int64_t units : {1, 3, 5, 16}) {
      LoaderParameters loader;
      loader.kind = kind;
      loader.specular.units = units;
      const double load =
          1e-6 * used(loader, kind == LoaderKind::mc68000 ? "specular.load_68000" : "specular.load_sequencer");
      EXPECT_EQ(path_moves_in(load, parameters, loader, 16), 1279) << units;
      EXPECT_EQ(path_moves_in(load * (1 - 1e-6), parameters, loader, 16), 1278) << units;
    }
}

// What a change needs, from the jobs that it makes; one light, 16 materials.
TEST(LoaderBudget, ReloadsAreWhatAChangeOfTheSceneMakes) {
  const ShadingParameters parameters;
  const LoaderParameters loader;
  DeferredShader shader = example(parameters);
  shader.load();
  std::map<std::string, double> budget;
  for (const LoadBudget& one : reload_budgets(parameters, loader, 16)) budget[one.name] = one.used;
  const auto changed_us = [&] {
    SharedLoad load(shader.program(shader.front_record()), loader);
    const double us = 1e6 * load.seconds();
    shader.load();
    return us;
  };
  shader.set_light(0, {{-0.48, 0.6, 0.64}, {0.8, 0.36, 0.48}, {1.0, 0.9, 0.5}});  // the camera moves, or the light
  EXPECT_NEAR(budget.at("reload.camera"), changed_us(), 1e-6);
  EXPECT_NEAR(budget.at("reload.camera"), 19968.0, 1e-6);
  shader.set_material(5, {{0.1, 0.2, 0.3}, 0.1, 0.9, 0.3, 50});
  EXPECT_NEAR(budget.at("reload.material"), changed_us(), 1e-6);
  EXPECT_NEAR(budget.at("reload.material"), 1024 * 18.5 / 16, 1e-6);  // longer than 14,336 / 12.5 of the path
  shader.set_light(0, {{-0.48, 0.6, 0.64}, {0.8, 0.36, 0.48}, {0.5, 0.4, 0.3}});
  EXPECT_NEAR(budget.at("reload.light_colour"), changed_us(), 1e-6);
  EXPECT_NEAR(budget.at("reload.light_colour"), 18944.0, 1e-6);
}

// However they are dealt out, all loaders together write every word of the load once, and the right one.
TEST(SharedLoad, WritesEveryWordOnce) {
  for (const std::int64_t units : {1, 2, 3, 5}) {
    ShadingParameters parameters;
    parameters.materials = 5;
    parameters.lights = 2;
    LoaderParameters loader;
    loader.dot.units = loader.diffuse.units = loader.specular.units = units;
    DeferredShader shader = example(parameters);
    shader.load();
    SharedLoad load(shader.program(LoadRecord()), loader);
    TableBank bank(parameters);
    std::map<std::uint32_t, int> written;
    const WordSink sink = [&](const TableId& table, std::uint32_t first, std::span<const std::uint32_t> words) {
      for (std::size_t i = 0; i < words.size(); ++i) {
        bank.write(table, first + static_cast<std::uint32_t>(i), words[i]);
        ++written[bank.address(table, first + static_cast<std::uint32_t>(i))];
      }
    };
    for (double seconds = 0.0; seconds < 3e-3; seconds += 0.37e-3)
      for (std::size_t engine = 0; engine < kEngines; ++engine) load.advance_to(engine, seconds, sink);
    EXPECT_FALSE(load.done());
    load.finish(sink);
    EXPECT_TRUE(load.done());
    constexpr std::size_t kWords = 2 * (6 * 2048 + 4 * 5 * 1024);
    EXPECT_EQ(written.size(), kWords) << units;
    EXPECT_EQ(load.stores_done(), kWords);
    for (const auto& [address, times] : written) ASSERT_EQ(times, 1) << address;
    DeferredShader::write_registers(load.program(), bank);
    for (std::uint32_t address = 0; address < bank.words(); ++address)
      ASSERT_EQ(bank.read(address), shader.front().read(address)) << address << " of " << units;
  }
}

// In half the time each loader has done half of its own share: two loaders of 1024 entries a component.
TEST(SharedLoad, LoadersOfOneTableWorkAtTheSameTime) {
  ShadingParameters parameters;
  parameters.materials = 1;
  LoaderParameters loader;
  loader.kind = LoaderKind::sequencer;
  loader.dot.units = 2;
  DeferredShader shader = example(parameters);
  SharedLoad load(shader.program(LoadRecord()), loader);
  TableBank bank(parameters);
  load.advance_to(0, 512 * 60e-9, [&](const TableId& table, std::uint32_t first, std::span<const std::uint32_t> words) {
    for (std::size_t i = 0; i < words.size(); ++i) bank.write(table, first + static_cast<std::uint32_t>(i), words[i]);
  });
  shader.load();
  const auto& whole = shader.front().lights[0].diffuse.products[0];
  const auto& half = bank.lights[0].diffuse.products[0];
  for (std::size_t i = 1; i < 2048; ++i) ASSERT_EQ(half[i], i % 1024 < 512 ? whole[i] : 0U) << i;
  EXPECT_EQ(bank.lights[0].diffuse.products[1][1], 0U);
}

TEST(LoaderLogic, CountsLoadersAndTheMultiplexersOfWhatTheyShare) {
  ShadingParameters parameters;
  parameters.lights = 2;
  LoaderParameters loader;
  loader.kind = LoaderKind::sequencer;
  loader.dot.units = 3;
  loader.diffuse.units = 4;
  std::map<std::string, LoaderLogic> logic;
  for (const LoaderLogic& one : loader_logic(parameters, loader)) logic.emplace(one.name, one);
  EXPECT_EQ(logic.at("dot product loaders").count, 2U * 2 * 3);  // N.L and N.H of each light
  EXPECT_EQ(logic.at("dot product loaders").unit, "sequencers");
  EXPECT_EQ(logic.at("dot product table address multiplexers").count, 2U * 6 * 3);
  EXPECT_EQ(logic.at("diffuse loaders").count, 2U * 3 * 4);
  EXPECT_EQ(logic.at("diffuse table address multiplexers").unit, "of 14 bits");
  EXPECT_EQ(logic.at("specular loaders").count, 2U);
}

TEST(LoaderParameters, RefuseMoreLoadersThanThereIsToShare) {
  ShadingParameters shading;
  shading.materials = 4;
  LoaderParameters loader;
  loader.dot.units = 2048;
  loader.diffuse.units = loader.specular.units = 4;
  Diagnostics fits;
  loader.check(shading, "m.toml", fits);
  EXPECT_TRUE(fits.empty());
  ++loader.dot.units;
  ++loader.diffuse.units;
  ++loader.specular.units;
  Diagnostics found;
  loader.check(shading, "m.toml", found);
  ASSERT_EQ(found.list().size(), 3U);
  EXPECT_EQ(found.list()[0].key, "loader.dot.units");
  EXPECT_THAT(found.list()[0].message, testing::HasSubstr("2049 loaders cannot share 2048 entries"));
  EXPECT_EQ(found.list()[1].key, "loader.diffuse.units");
  EXPECT_THAT(found.list()[1].message, testing::HasSubstr("5 loaders cannot share 4 materials"));
  EXPECT_EQ(found.list()[2].key, "loader.specular.units");
}

}  // namespace
}  // namespace rastertlm::shading
