// Is a load that stops and goes on the same as one at once, does it take the paper's steps, and does a bus write land
// where it should?
#include "modules/shading/table_load.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <random>
#include <stdexcept>

#include "modules/shading/deferred_shader.h"

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

// Writes what it is given into a bank.
WordSink into(TableBank& bank) {
  return [&bank](const TableId& table, std::uint32_t first, std::span<const std::uint32_t> words) {
    for (std::size_t i = 0; i < words.size(); ++i) bank.write(table, first + static_cast<std::uint32_t>(i), words[i]);
  };
}

TEST(TableLoad, StoppingAnywhereChangesNothing) {
  ShadingParameters parameters;
  parameters.materials = 3;
  DeferredShader shader = example(parameters);
  shader.load();
  const LoadProgram program = shader.program(LoadRecord());
  std::uint64_t total = 0;
  for (const TableJob& job : program.jobs) total += steps_of(job, 2);
  constexpr StepCost kSecondAStep{1.0, 1.0};
  TableBank stepped(parameters);
  TableLoad one_by_one(program.jobs, 2, kSecondAStep);
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
  TableLoad load(program.jobs, 2, kSecondAStep);
  std::uint64_t until = 0;
  for (std::mt19937 random(1); !load.done();) {
    until += 1 + random() % 3000;
    load.advance_to(static_cast<double>(until), into(chunked));
    ASSERT_EQ(load.steps_done(), std::min(until, total));
  }
  DeferredShader::write_registers(program, chunked);
  EXPECT_TRUE(same_words(chunked, shader.front()));
}

// A store of 12 cycles and an up of 8 at 12.5 MHz: a step is done when the times of all before it and its own have
// passed, and not a picosecond sooner.
TEST(TableLoad, DoesWhatEndsInTheTimeGivenAndNoMore) {
  ShadingParameters parameters;
  parameters.materials = 1;
  const DeferredShader shader = example(parameters);
  LoadProgram program = shader.program(LoadRecord());
  std::erase_if(program.jobs, [](const TableJob& job) { return job.table.kind != TableKind::specular; });
  ASSERT_EQ(program.jobs.size(), 1U);
  constexpr StepCost kCost{0.96e-6, 0.64e-6};
  std::vector<std::uint64_t> ends_ps{0};  // of the steps, one after the other
  for (TableLoad load(program.jobs, 1, kCost); !load.done();)
    ends_ps.push_back(ends_ps.back() + (load.step().is_up ? 640'000U : 960'000U));
  ASSERT_EQ(ends_ps.size(), 1U + 1280);
  for (const std::size_t step : {1U, 2U, 3U, 600U, 1279U, 1280U}) {
    TableBank bank(parameters);
    TableLoad load(program.jobs, 1, kCost);
    load.advance_to(static_cast<double>(ends_ps[step] - 1000) * 1e-12, into(bank));
    EXPECT_EQ(load.steps_done(), step - 1);
    load.advance_to(static_cast<double>(ends_ps[step]) * 1e-12, into(bank));
    EXPECT_EQ(load.steps_done(), step);
  }
}

TEST(TableLoad, AHalfWrittenTableHoldsOldWordsBehindTheNewOnes) {
  const ShadingParameters parameters;
  DeferredShader shader = example(parameters);
  shader.load();
  const TableBank old = shader.front();
  shader.set_light(0, {{1, 0, 0}, {0.8, 0, 0.6}, {1, 1, 1}});
  const LoadProgram program = shader.program(shader.front_record());
  TableLoad load(program.jobs, 1, {1.0, 1.0});
  load.advance_to(1000.5, into(shader.front()));
  const auto& x = shader.front().lights[0].diffuse.products[0];
  EXPECT_EQ(x[999], 999U);  // n * 1
  EXPECT_EQ(x[1000], old.lights[0].diffuse.products[0][1000]);
  load.advance_to(2048.0, into(shader.front()));
  EXPECT_EQ(x[2047], 2047U);
}

TEST(LoadRecord, HoldsWhatWasMarkedUntilItIsForgotten) {
  const ShadingParameters parameters;
  const DeferredShader shader = example(parameters);
  const LoadProgram program = shader.program(LoadRecord());
  LoadRecord record;
  for (const TableJob& job : program.jobs) record.mark(job);
  EXPECT_TRUE(shader.program(record).jobs.empty());
  record.forget(program.jobs[3]);
  ASSERT_EQ(shader.program(record).jobs.size(), 1U);
  EXPECT_EQ(shader.program(record).jobs[0].ordinal, program.jobs[3].ordinal);
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
  // A burst across every border between tables is the same as words one by one.
  std::vector<std::uint32_t> burst(bank.words());
  for (std::uint32_t address = 0; address < bank.words(); ++address) burst[address] = (7 * address) % 31;
  TableBank by_burst(parameters);
  by_burst.write(0, std::span<const std::uint32_t>(burst).first(11));
  by_burst.write(11, std::span<const std::uint32_t>(burst).subspan(11));
  for (std::uint32_t address = 0; address < bank.words(); ++address) bank.write(address, burst[address]);
  EXPECT_TRUE(same_words(by_burst, bank));
  EXPECT_THROW(static_cast<void>(bank.decode(bank.words())), std::out_of_range);
  EXPECT_THROW(static_cast<void>(bank.address({TableKind::diffuse, 2, 0}, 0)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(bank.address({TableKind::specular, 0, 3}, 0)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(bank.address({TableKind::diffuse_dot, 0, 0}, 32)), std::out_of_range);
}

}  // namespace
}  // namespace rastertlm::shading
