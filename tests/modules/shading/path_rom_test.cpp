// Is the path of a power function the paper's, and does drawing it give figure 5.11?
#include "modules/shading/path_rom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "modules/shading/table_filler.h"
#include "src/base/errors.h"

namespace rastertlm::shading {
namespace {

std::vector<std::vector<std::string>> golden_rows() {
  std::ifstream file(RASTERTLM_SOURCE_DIR "/tests/golden/fig5_11_power_path.csv");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line.starts_with("cycle") || line.starts_with("In")) continue;
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return rows;
}

TEST(PathRom, DrawsFigure511) {
  const auto rows = golden_rows();
  ASSERT_EQ(rows.size(), 23U);
  const std::vector<Move> moves = path_of(power_states(4, 4, 3, Arithmetic::literal), 3);
  ASSERT_EQ(moves.size(), rows.size());
  PathFiller filler(moves, path_scale(6, 3, Arithmetic::literal));
  std::vector<std::uint32_t> table(16, 99);
  for (std::size_t cycle = 0; cycle < rows.size(); ++cycle) {
    SCOPED_TRACE("cycle " + rows[cycle][0]);
    EXPECT_EQ(std::to_string(filler.address()), rows[cycle][1]);
    EXPECT_EQ(std::to_string(filler.error()), rows[cycle][2]);
    EXPECT_EQ(std::to_string(filler.value()), rows[cycle][3]);
    EXPECT_EQ(moves[cycle] == Move::up ? "1" : "0", rows[cycle][4]);
    const std::uint32_t value_before = filler.value();
    const FillStep step = filler.step();
    if (step.stores) table.at(step.address) = step.value;
    EXPECT_EQ(step.stores ? "R" : filler.value() > value_before ? "U" : "N", rows[cycle][8]);
    if (cycle + 1 == rows.size()) break;  // the printed last column clears the counters for the next table
    EXPECT_EQ(std::to_string(filler.address()), rows[cycle][5]);
    EXPECT_EQ(std::to_string(filler.error()), rows[cycle][6]);
    EXPECT_EQ(std::to_string(filler.value()), rows[cycle][7]);
  }
  EXPECT_TRUE(filler.done());
  EXPECT_EQ(table, (std::vector<std::uint32_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 5}));
}

TEST(PathRom, EveryPathHasTheSameLength) {
  for (const Arithmetic arithmetic : {Arithmetic::literal, Arithmetic::centred}) {
    ShadingParameters parameters;
    parameters.arithmetic = arithmetic;
    const PathRom rom(parameters);
    EXPECT_EQ(rom.moves(), 1279U);
    for (const std::int64_t exponent : parameters.exponents) {
      const auto& path = rom.path(exponent);
      EXPECT_EQ(path.size(), 1279U);
      EXPECT_EQ(std::count(path.begin(), path.end(), Move::right), 1024);
    }
  }
}

TEST(PathRom, RefusesAnExponentItDoesNotHoldAndListsThoseItDoes) {
  ShadingParameters parameters;
  parameters.exponents = {1, 7};
  const PathRom rom(parameters);
  EXPECT_TRUE(rom.holds(7));
  EXPECT_FALSE(rom.holds(3));
  try {
    static_cast<void>(rom.path(3, "material.exponent"));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().at(0).key, "material.exponent");
    EXPECT_NE(error.diagnostics().at(0).message.find("accepted: 1, 7"), std::string::npos)
        << error.diagnostics().at(0).message;
  }
}

}  // namespace
}  // namespace rastertlm::shading
