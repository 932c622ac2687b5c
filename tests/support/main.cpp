// The test runner's own main: libsystemc exports one too, and with that one no test would run and the exit code would
// be 0.
#include <gtest/gtest.h>

#include <cstdio>

extern "C" int sc_main(int, char**) { return 0; }

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const int result = RUN_ALL_TESTS();
  if (!testing::GTEST_FLAG(list_tests) && testing::UnitTest::GetInstance()->test_to_run_count() == 0) {
    std::fputs("no test ran\n", stderr);
    return 1;
  }
  return result;
}
