#include "src/base/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

namespace rastertlm {
namespace {

TEST(ChildProcess, ReturnsItsBytes) {
  // More than a pipe holds.
  std::string bytes(3'000'000, '\0');
  bytes.append("end");
  const ChildOutcome outcome = in_child({}, [&] { return bytes; });
  EXPECT_EQ(outcome.end, ChildEnd::done);
  EXPECT_TRUE(outcome.bytes == bytes);
  EXPECT_EQ(in_child({}, [] { return std::string(); }).end, ChildEnd::done);
}

TEST(ChildProcess, WhatItDoesIsItsOwn) {
  int mine = 1;
  const ChildOutcome outcome = in_child({}, [&] { return std::to_string(++mine); });
  EXPECT_EQ(outcome.bytes, "2");
  EXPECT_EQ(mine, 1);
}

TEST(ChildProcess, SaysHowItWasStopped) {
  const ChildOutcome aborted = in_child({}, []() -> std::string { std::abort(); });
  EXPECT_EQ(aborted.end, ChildEnd::stopped);
  EXPECT_EQ(aborted.signal, SIGABRT);
  EXPECT_EQ(aborted.bytes, "");
  const ChildOutcome threw = in_child({}, []() -> std::string { throw std::runtime_error("no"); });
  EXPECT_EQ(threw.end, ChildEnd::stopped);
  EXPECT_EQ(threw.signal, 0);
  // It leaves in the middle, and what it was to say was not said.
  EXPECT_EQ(in_child({}, []() -> std::string { ::_exit(0); }).end, ChildEnd::stopped);
}

// A terminal sends them to both: who forked it decides.
TEST(ChildProcess, LeavesInterruptsToItsParent) {
  const ChildOutcome outcome = in_child({}, [] {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::raise(signal);
    return std::string("whole");
  });
  EXPECT_EQ(outcome.end, ChildEnd::done);
  EXPECT_EQ(outcome.bytes, "whole");
}

TEST(ChildProcess, IsEndedAtItsTime) {
  const ChildOutcome outcome = in_child({0.2, std::uint64_t{1} << 30}, []() -> std::string {
    volatile bool on = true;
    while (on) {
    }
    return "";
  });
  EXPECT_EQ(outcome.end, ChildEnd::out_of_time);
}

TEST(ChildProcess, IsEndedAtItsMemory) {
  const ChildOutcome outcome = in_child({60.0, std::uint64_t{64} << 20}, []() -> std::string {
    std::vector<std::unique_ptr<std::string>> held;
    for (;;) held.push_back(std::make_unique<std::string>(std::size_t{1} << 20, 'x'));
  });
  EXPECT_EQ(outcome.end, ChildEnd::out_of_memory);
}

}  // namespace
}  // namespace rastertlm
