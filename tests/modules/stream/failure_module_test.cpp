// Does a failure in a process stop the simulation and reach whoever started it, as what it was?
#include "modules/stream/failure.h"

#include <gmock/gmock.h>

#include "src/base/errors.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::stream {
namespace {

using sc_core::SC_NS;

TEST(FailureModule, StopsTheSimulationAndKeepsItsType) {
  int steps = 0;
  Script failing("failing", [] {
    sc_core::wait(5, SC_NS);
    throw ModelError("unit_7", 42, "a rule was broken");
  });
  Script running("running", [&] {
    for (;; ++steps) sc_core::wait(1, SC_NS);
  });
  try {
    simulate();
    FAIL() << "nothing was thrown";
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("unit_7"), testing::HasSubstr("42")));
  }
  EXPECT_EQ(sc_core::sc_get_status(), sc_core::SC_STOPPED);
  EXPECT_EQ(sc_core::sc_time_stamp(), sc_core::sc_time(5, SC_NS));
  EXPECT_LE(steps, 5);
}

TEST(FailureModule, KeepsTheDiagnosticsOfBadInput) {
  Script failing("failing", [] { throw InputError({"m.toml", 3, "host.links", "too few"}); });
  try {
    simulate();
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1U);
    EXPECT_EQ(error.diagnostics()[0].key, "host.links");
  }
}

// Two processes fail at one instant: the first is the cause.
TEST(FailureModule, TheFirstFailureCounts) {
  sc_core::sc_event second;
  Script late("late", [&] {
    sc_core::wait(second);
    throw std::runtime_error("second");
  });
  Script early("early", [&] {
    second.notify(sc_core::SC_ZERO_TIME);
    throw ModelError("first", 0, "first");
  });
  EXPECT_THROW(simulate(), ModelError);
}

TEST(FailureModule, NoFailureThrowsNothing) {
  Script script("script", [] { sc_core::wait(1, SC_NS); });
  EXPECT_NO_THROW(simulate());
  EXPECT_NO_THROW(rethrow_failure());
}

}  // namespace
}  // namespace rastertlm::stream
