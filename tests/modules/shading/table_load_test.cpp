// Is a load that stops and goes on the same as one at once, does it take the paper's steps, and does a bus write land
// where it should?
#include "modules/shading/table_load.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <random>
#include <stdexcept>

#include "modules/shading/deferred_shader.h"
#include "modules/shading/loader_budget.h"

namespace rastertlm::shading {
namespace {

DeferredShader example(const ShadingParameters& parameters, std::size_t banks = 1) {
  DeferredShader shader(parameters, 12, banks);
  for (std::size_t m = 0; m < static_cast<std::size_t>(parameters.materials); ++m)
    shader.set_material(
        m, {{0.9, 0.5, 0.2}, 0.1, 0.5 + 0.01 * double(m), 0.4, parameters.exponents[m % parameters.exponents.size()]});
  for (std::size_t l = 0; l < static_cast<std::size_t>(parameters.lights); ++l)
    shader.set_light(l, {{0.6, -0.64, 0.48}, {0.36, -0.48, 0.8}, {1.0, 0.9, 0.5}});
  return shader;
}

bool same_words(const TableBank& a, const TableBank& b) {
  for (std::uint32_t address = 0; address < a.words(); ++address)
    if (a.read(address) != b.read(address)) return false;
  return a.words() == b.words();
}

TEST(TableLoad, TakesTheStepsOfThePaper) {
  const ShadingParameters parameters;
  const DeferredShader shader = example(parameters);
  const LoadProgram program = shader.program(LoadRecord());
  std::map<LoaderId, std::uint64_t> steps;
  for (const TableJob& job : program.jobs) steps[loader_of(job)] += steps_of(job, 1);
  EXPECT_EQ(steps.size(), 6U);  // N.L, N.H, three colours, one specular table
  EXPECT_EQ((steps[{TableKind::diffuse_dot, 0, 0}]), 6144U);
  EXPECT_EQ((steps[{TableKind::specular_dot, 0, 0}]), 6144U);
  EXPECT_EQ((steps[{TableKind::diffuse, 0, 2}]), 16384U);
  EXPECT_EQ((steps[{TableKind::specular, 0, 0}]), 20480U);  // 16 x (1279 moves + 1)
}

TEST(TableLoad, StoppingAnywhereChangesNothing) {
  ShadingParameters parameters;
  parameters.materials = 3;
  DeferredShader shader = example(parameters);
  shader.load();
  const LoadProgram program = shader.program(LoadRecord());
  std::uint64_t total = 0;
  for (const TableJob& job : program.jobs) total += steps_of(job, 2);
  TableBank stepped(parameters);
  TableLoad one_by_one(program.jobs, 2);
  std::uint64_t steps = 0;
  for (; !one_by_one.done(); ++steps) {
    const LoadStep step = one_by_one.step();
    if (step.fill.stores)
      stepped.write(stepped.address(program.jobs[step.job].table, step.fill.address), step.fill.value);
  }
  EXPECT_EQ(steps, total);
  DeferredShader::write_registers(program, stepped);
  EXPECT_TRUE(same_words(stepped, shader.front()));

  TableBank chunked(parameters);
  LoadRecord record;
  TableLoad load(program.jobs, 2);
  for (std::mt19937 random(1); !load.done();) load.advance(1 + random() % 3000, chunked, record);
  EXPECT_EQ(load.steps_done(), total);
  DeferredShader::write_registers(program, chunked);
  EXPECT_TRUE(same_words(chunked, shader.front()));
  EXPECT_TRUE(shader.program(record).jobs.empty());
}

TEST(TableLoad, AHalfWrittenTableHoldsOldWordsBehindTheNewOnes) {
  const ShadingParameters parameters;
  DeferredShader shader = example(parameters);
  shader.load();
  const TableBank old = shader.front();
  shader.set_light(0, {{1, 0, 0}, {0.8, 0, 0.6}, {1, 1, 1}});
  const LoadProgram program = shader.program(shader.front_record());
  TableLoad load(program.jobs, 1);
  load.advance(1000, shader.front(), shader.front_record());
  const auto& x = shader.front().lights[0].diffuse.products[0];
  EXPECT_EQ(x[999], 999U);  // n * 1
  EXPECT_EQ(x[1000], old.lights[0].diffuse.products[0][1000]);
  EXPECT_FALSE(shader.front_record().holds(program.jobs[0]));
  load.advance(1048, shader.front(), shader.front_record());
  EXPECT_EQ(x[2047], 2047U);
  EXPECT_TRUE(shader.front_record().holds(program.jobs[0]));
}

TEST(TableLoad, LoadsOnlyWhatChanged) {
  const ShadingParameters parameters;
  DeferredShader shader = example(parameters, 2);
  shader.load();
  EXPECT_TRUE(shader.program(shader.front_record()).jobs.empty());
  shader.set_material(5, {{1, 1, 1}, 0.1, 0.3, 0.2, 50});
  EXPECT_EQ(shader.program(shader.front_record()).jobs.size(), 4U);  // three colours and the specular table
  const std::size_t used[] = {1, 2};
  EXPECT_TRUE(shader.program(shader.front_record(), used).jobs.empty());
  // The other bank has seen nothing yet: six dot-product tables, and four tables of each material.
  EXPECT_EQ(shader.program(shader.back_record()).jobs.size(), 6U + 4U * 16U);
  EXPECT_EQ(shader.program(shader.back_record(), used).jobs.size(), 6U + 4U * 2U);
  const TableBank* before = &shader.front();
  shader.swap_banks();
  EXPECT_NE(before, &shader.front());
}

TEST(TableBank, AddressesAreOneToOne) {
  ShadingParameters parameters;
  parameters.lights = 2;
  parameters.materials = 3;
  parameters.index_bits = 4;
  parameters.dot_table_address_bits = parameters.dot_table_output_bits = 5;
  parameters.specular_tables = 3;
  TableBank bank(parameters);
  // 6 dot tables of 32, 3 diffuse and 3 specular of 3 x 16, the signs; ambient and background.
  ASSERT_EQ(bank.words(), 2U * (6 * 32 + 6 * 48 + 1) + 9 + 3);
  for (std::uint32_t address = 0; address < bank.words(); ++address) {
    const EntryAddress place = bank.decode(address);
    ASSERT_EQ(bank.address(place.table, place.entry), address);
    bank.write(address, address % 29);
  }
  for (std::uint32_t address = 0; address < bank.words(); ++address)
    ASSERT_EQ(bank.read(address), address % 29) << address;
  EXPECT_THROW(static_cast<void>(bank.decode(bank.words())), std::out_of_range);
  EXPECT_THROW(static_cast<void>(bank.address({TableKind::diffuse, 2, 0}, 0)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(bank.address({TableKind::specular, 0, 3}, 0)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(bank.address({TableKind::diffuse_dot, 0, 0}, 32)), std::out_of_range);
}

TEST(LoaderBudget, GivesTheFiguresOfThePaper) {
  std::map<std::string, double> used;
  for (const LoadBudget& budget : load_budgets(ShadingParameters(), LoaderParameters(), 16))
    used[budget.name] = budget.used;
  EXPECT_EQ(used.at("dot_table.words"), 6144);
  EXPECT_NEAR(used.at("dot_table.load_sequencer"), 368.64, 1e-6);  // 004: "about 370 us"
  EXPECT_NEAR(used.at("dot_table.load_68000"), 19968.0, 1e-6);
  EXPECT_EQ(used.at("diffuse.words"), 16384);
  EXPECT_NEAR(used.at("diffuse.load_sequencer"), 983.04, 1e-6);
  EXPECT_NEAR(used.at("diffuse.load_68000"), 18944.0, 1e-6);
  EXPECT_NEAR(used.at("diffuse9.load_sequencer"), 491.52, 1e-6);
  EXPECT_EQ(used.at("specular.words"), 16384);
  EXPECT_NEAR(used.at("specular.load_sequencer"), 1228.8, 1e-6);
  EXPECT_NEAR(used.at("specular.load_68000"), 229376 / 12.5, 1e-6);  // 18.35 ms: 004's "less than 19 ms"
  EXPECT_EQ(used.at("path_rom.moves"), 1279);
}

TEST(LoaderBudget, ClosedFormsEqualTheStepsOfTheJobs) {
  for (const LoaderKind kind : {LoaderKind::mc68000, LoaderKind::sequencer}) {
    ShadingParameters parameters;
    parameters.arithmetic = Arithmetic::literal;  // its paths end with their last store, as the closed form says of all
    LoaderParameters loader;
    loader.kind = kind;
    const DeferredShader shader = example(parameters);
    const LoadProgram program = shader.program(LoadRecord());
    std::map<LoaderId, double> job_time;
    std::map<LoaderId, double> step_time;
    for (const TableJob& job : program.jobs) job_time[loader_of(job)] += 1e6 * job_seconds(loader, job);
    for (TableLoad load(program.jobs, loader.argument_cycles); !load.done();) {
      const LoadStep step = load.step();
      const TableJob& job = program.jobs[step.job];
      step_time[loader_of(job)] += 1e6 * step_seconds(loader, job.table.kind, step.is_up);
    }
    const std::string suffix = kind == LoaderKind::mc68000 ? "load_68000" : "load_sequencer";
    for (const LoadBudget& budget : load_budgets(parameters, loader, 16)) {
      if (budget.name != "dot_table." + suffix && budget.name != "diffuse." + suffix &&
          budget.name != "specular." + suffix)
        continue;
      const LoaderId id{budget.name[0] == 's'   ? TableKind::specular
                        : budget.name[1] == 'o' ? TableKind::diffuse_dot
                                                : TableKind::diffuse,
                        0, 0};
      EXPECT_NEAR(job_time.at(id), budget.used, 1e-6) << budget.name;
      EXPECT_NEAR(step_time.at(id), budget.used, 1e-6) << budget.name;
    }
  }
}

}  // namespace
}  // namespace rastertlm::shading
