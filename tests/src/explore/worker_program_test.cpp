// Workers of a sweep where the system gives them less than they ask for.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include "tests/src/explore/explore_program.h"

namespace rastertlm::test {
namespace {

using WorkerTest = ExploreTest;

// Stacks of threads that no address space holds: as where a user has all the threads that one may have. Nothing is
// thrown past a worker's beginning, where it would end the workers beside it, and no point is lost.
TEST_F(WorkerTest, GoesOnWithoutAThreadOfItsOwn) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "ThreadSanitizer does not start with such a stack";
#endif
  write("sweep.toml", grid(5));
  ASSERT_EQ(run({"explore", "run", "sweep.toml", "--store", "usual.sqlite"}).exit_code, 0);
  constexpr rlim_t kAll = rlim_t{1} << 47U;  // all of a process's addresses
  rlimit usual{};
  ASSERT_EQ(::getrlimit(RLIMIT_STACK, &usual), 0);
  if (usual.rlim_max < kAll) GTEST_SKIP() << "the stack's hard limit is lower";
  const rlimit large{kAll, usual.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_STACK, &large), 0);
  const pid_t explorer = start(run_sweep({"--jobs", "2"}));
  ASSERT_EQ(::setrlimit(RLIMIT_STACK, &usual), 0);
  const Outcome outcome = wait_for(explorer);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(results().size(), 10U);
  EXPECT_TRUE(results() == results("usual.sqlite"));
}

}  // namespace
}  // namespace rastertlm::test
