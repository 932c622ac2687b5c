// rastertlm stability, as a user gives it: the catalogue holds on the machines of this repository, and breaks at the
// step in which the papers are wrong.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kConfigs = std::string(RASTERTLM_SOURCE_DIR) + "/configs";
const std::string kQuadratic = kConfigs + "/machines/quadratic.toml";
const std::string kImogene = kConfigs + "/machines/imogene.toml";
const std::string kAdaptive = kConfigs + "/machines/adaptive.toml";

class StabilityCommandTest : public ProgramTest {
 protected:
  Outcome stability(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"stability", "--cases", kConfigs + "/hard_cases"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  // The parameters that broken cases name, each once.
  static std::set<std::string> broken_steps(const Outcome& outcome) {
    std::set<std::string> steps;
    for (std::size_t at = outcome.out.find("\nbroken: "); at != std::string::npos;
         at = outcome.out.find("\nbroken: ", at + 1)) {
      const std::string line = outcome.out.substr(at + 1, outcome.out.find('\n', at + 1) - at - 1);
      steps.insert(line.substr(line.rfind(' ') + 1));
    }
    return steps;
  }
};

// A thousandth of what scripts/nightly tries.
TEST_F(StabilityCommandTest, EveryBoundHoldsOnTheDefaultMachines) {
  const Outcome outcome = stability({kQuadratic, kImogene, kAdaptive, "--seed", "7", "--inputs", "100000"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, Not(HasSubstr("BROKEN")));
  for (const auto& entry : std::filesystem::directory_iterator(kConfigs + "/hard_cases"))
    EXPECT_THAT(outcome.out, HasSubstr(entry.path().stem().string().append(" ("))) << "no machine has such a step";
  EXPECT_THAT(outcome.out, EndsWith("cases with a broken one: 0\n"));
  // "321 bounds, 100,098 inputs; ..."
  std::string count = outcome.out.substr(outcome.out.rfind(" bounds, ") + 9);
  std::erase(count, ',');
  EXPECT_GE(std::stoll(count), 100'000);
  EXPECT_LT(std::stoll(count), 110'000);
}

struct Published {
  const char* machine;
  const char* set;
  const char* step;
};
std::ostream& operator<<(std::ostream& out, const Published& p) { return out << p.machine << ", " << p.set; }

class PublishedVariants : public StabilityCommandTest, public testing::WithParamInterface<Published> {};

TEST_P(PublishedVariants, BreakAtTheStepThatThePapersHaveWrong) {
  const Outcome outcome =
      stability({kConfigs + "/machines/" + GetParam().machine, "--set", GetParam().set, "--tries", "8"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(broken_steps(outcome), std::set<std::string>{GetParam().step}) << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(
    Papers, PublishedVariants,
    testing::Values(Published{"quadratic.toml", "span_unit.start_edge=published", "span_unit.start_edge"},
                    Published{"quadratic.toml", "set_up.solver=published", "set_up.solver"},
                    Published{"quadratic.toml", "span_unit.fraction_bits=10", "span_unit.fraction_bits"},  // log2 M + 1
                    Published{"imogene.toml", "ep1.carry_clock=clock2", "ep1.carry_clock"}));

TEST_F(StabilityCommandTest, RepairsOfTheHouseHold) {
  EXPECT_THAT(broken_steps(stability({kQuadratic, "--set", "set_up.solver=published_swapped", "--tries", "8"})),
              IsEmpty());
}

// Its products move depths, too, by up to 2^-prestep_bits of their slope: of slivers, past near and far.
TEST_F(StabilityCommandTest, APrestepHoldsButForDepthsOfSlivers) {
  const std::string prestep = "span_unit.start_edge=prestep";
  EXPECT_THAT(broken_steps(stability({kQuadratic, "--set", prestep, "--tries", "8"})), IsEmpty());
  const Outcome outcome = stability({kQuadratic, "--set", prestep, "--case", "planes_sliver"});
  EXPECT_EQ(broken_steps(outcome), std::set<std::string>{"span_unit.start_edge"});
  EXPECT_THAT(outcome.out, HasSubstr("required, BROKEN"));
}

TEST_F(StabilityCommandTest, ACaseThatNoMachineHasIsRefused) {
  const Outcome outcome = stability({kImogene, "--case", "solver_sliver_1e6"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--case: solver_sliver_1e6: none of these machines has what it stresses"));
  EXPECT_EQ(stability({kImogene, kQuadratic, "--case", "solver_sliver_1e6", "--tries", "4"}).exit_code, 0);
}

TEST_F(StabilityCommandTest, SameSeedSameText) {
  const std::vector<std::string> arguments{kQuadratic, "--case", "start_edge", "--tries", "8", "--seed", "3"};
  EXPECT_EQ(stability(arguments).out, stability(arguments).out);
  EXPECT_NE(stability(arguments).out,
            stability({kQuadratic, "--case", "start_edge", "--tries", "8", "--seed", "4"}).out);
}

// For programs: the same findings, and the exit code says the verdict.
TEST_F(StabilityCommandTest, JsonHasWhatTheTablesHave) {
  const std::vector<std::string> arguments{kImogene, "--case", "adder_carries", "--tries", "4"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), arguments.begin(), arguments.end());
    return stability(more);
  };
  const Outcome both = with({"--json", "found.json"});
  EXPECT_EQ(both.out, stability(arguments).out);
  const Outcome alone = with({"--json", "-"});
  EXPECT_EQ(alone.exit_code, 0);
  EXPECT_EQ(alone.out, file_text(in_work("found.json")));
  for (const std::string part : {"\"schema\": 1", "\"kind\": \"stability\"", "\"bounds\": 1", "\"broken\": []",
                                 "\"case\": \"adder_carries\"", "\"step\": \"ep1.carry_clock\"", "\"measured\": 0",
                                 "\"bound\": 0", "\"bound_kind\": \"proved\"", "\"holds\": true"})
    EXPECT_THAT(alone.out, HasSubstr(part));
  const Outcome late = with({"--json", "-", "--set", "ep1.carry_clock=clock2"});
  EXPECT_EQ(late.exit_code, 1);
  EXPECT_THAT(late.out, HasSubstr(kImogene + ": adder_carries: ep1.carry_clock\""));
  EXPECT_THAT(late.out, HasSubstr("\"holds\": false"));
  EXPECT_EQ(with({"--json", "no/such/folder/found.json"}).exit_code, 4);
}

// Each bound says on how many inputs it was checked, and the sum counts each input once: of the two bounds of a
// triangle it is one, of the paths of 18 widths each has its own.
TEST_F(StabilityCommandTest, CountsInputs) {
  const std::string triangles = stability({kQuadratic, "--case", "triangles_level", "--tries", "5", "--json", "-"}).out;
  EXPECT_THAT(triangles, AllOf(HasSubstr("\"bounds\": 2,"), HasSubstr("\"inputs\": 5,")));
  EXPECT_THAT(stability({kQuadratic, "--case", "triangles_level", "--tries", "5"}).out,
              HasSubstr("2 bounds, 5 inputs; "));
  EXPECT_THAT(stability({kQuadratic, "--case", "forward_differences", "--tries", "5"}).out,
              HasSubstr("18 bounds, 126 inputs; "));  // and the two worst paths
  EXPECT_THAT(stability({kQuadratic, "--case", "watertight_fan"}).out, HasSubstr("1 bound, 1 input; "));
  EXPECT_THAT(stability({kQuadratic, "--case", "triangles_level", "--case", "forward_differences", "--tries", "5"}).out,
              AllOf(HasSubstr("fewest random inputs of a bound: 5\n"), HasSubstr("nearest to its bound: ")));
  const std::vector<std::string> many{kQuadratic, "--case", "forward_differences", "--case", "triangles_level",
                                      "--inputs", "5000"};
  EXPECT_EQ(stability(many).out, stability(many).out);
  EXPECT_EQ(stability({kQuadratic, "--inputs", "5000", "--tries", "5"}).exit_code, 2);
  EXPECT_EQ(stability({kQuadratic, "--inputs", "0"}).exit_code, 2);
  // More than frames may be: scripts/nightly asks for 100 million.
  EXPECT_EQ(stability({kQuadratic, "--case", "watertight_fan", "--inputs", "100000000"}).exit_code, 0);
}

TEST_F(StabilityCommandTest, RefusesWhatItDoesNotKnow) {
  const Outcome outcome = stability({kQuadratic, "--case", "start_egde"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'start_edge'?"));
  write("cases/one.toml", "schema = 1\nstresses = \"x\"\nkind = \"start_edge\"\ntires = 3\n");
  const Outcome misspelt = run({"stability", kQuadratic, "--cases", "cases"});
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_THAT(misspelt.err, HasSubstr("cases/one.toml:4: tires"));
  write("cases/one.toml", "schema = 1\nstresses = \"x\"\nkind = \"start_egde\"\nsteps = 3\n");
  EXPECT_THAT(run({"stability", kQuadratic, "--cases", "cases"}).err,
              AllOf(HasSubstr("cases/one.toml:3: kind"), Not(HasSubstr("steps"))));
  write("cases/one.toml", "schema = 1\nstresses = \"x\"\nsteps = 3\n");
  EXPECT_THAT(run({"stability", kQuadratic, "--cases", "cases"}).err, HasSubstr("kind"));
  EXPECT_EQ(run({"stability", kQuadratic, "--cases", "nowhere"}).exit_code, 2);
  EXPECT_EQ(stability({kQuadratic, "--tries", "0"}).exit_code, 2);
}

}  // namespace
}  // namespace rastertlm::test
