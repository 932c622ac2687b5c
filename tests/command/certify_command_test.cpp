// rastertlm certify, as a user gives it.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kMachines = std::string(RASTERTLM_SOURCE_DIR) + "/configs/machines/";

class CertifyCommandTest : public ProgramTest {};

TEST_F(CertifyCommandTest, EveryMachineOfTheRepositoryHolds) {
  std::vector<std::string> arguments{"certify", "--tries", "500",    "--seed",           "5",
                                     "--error", "50",      "--json", "certificates.json"};
  for (const auto& entry : std::filesystem::directory_iterator(kMachines)) arguments.push_back(entry.path().string());
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, Not(HasSubstr("BROKEN")));
  const std::string json = file_text(in_work("certificates.json"));
  EXPECT_THAT(json, Not(HasSubstr("\"holds\": false")));
  std::size_t machines = 0;
  for (std::size_t at = json.find("\"kind\": \"certificates\""); at != std::string::npos;
       at = json.find("\"kind\": \"certificates\"", at + 1))
    ++machines;
  EXPECT_EQ(machines, arguments.size() - 9);
}

TEST_F(CertifyCommandTest, FewestBitsFollowTheWantedError) {
  const Outcome outcome =
      run({"certify", kMachines + "quadratic.toml", "--tries", "100", "--error", "0.5", "--json", "one.json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("fewest bits for 0.5 levels"));
  const std::string json = file_text(in_work("one.json"));
  EXPECT_THAT(json, HasSubstr("\"parameter\": \"span_unit.fraction_bits\""));
  EXPECT_THAT(json, HasSubstr("\"least_bits\": 22"));
}

TEST_F(CertifyCommandTest, SameSeedSameText) {
  const auto text = [&](const char* seed) {
    return run({"certify", kMachines + "quadratic.toml", "--tries", "400", "--seed", seed}).out;
  };
  EXPECT_EQ(text("3"), text("3"));
  EXPECT_NE(text("3"), text("4"));
}

TEST_F(CertifyCommandTest, RefusesWhatItDoesNotKnow) {
  const Outcome exponent = run({"certify", kMachines + "imogene.toml", "--tries", "100", "--exponent", "7"});
  EXPECT_EQ(exponent.exit_code, 2);
  EXPECT_THAT(exponent.err, HasSubstr("7 is not in the path ROM"));
  EXPECT_EQ(run({"certify", kMachines + "imogene.toml", "--error", "0"}).exit_code, 2);
  EXPECT_EQ(run({"certify", kMachines + "imogene.toml", "--set", "shading.index_bit=9"}).exit_code, 2);
  EXPECT_EQ(run({"certify", "nowhere.toml"}).exit_code, 2);
  EXPECT_EQ(run({"certify", kMachines + "quadratic.toml", "--tries", "100", "--json", "no/folder.json"}).exit_code, 4);
}

}  // namespace
}  // namespace rastertlm::test
