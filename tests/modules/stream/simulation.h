// What every test with a SystemC module in it needs: one simulation a process, and no warning of the kernel passes.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <systemc>
#include <utility>
#include <vector>

#include "modules/stream/failure.h"

namespace rastertlm::stream {

// From the first simulated instant to sc_stop, or to the end of all activity. The first failure of a process is thrown.
inline void simulate() {
  sc_core::sc_report_handler::set_actions("/OSCI/SystemC", sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  sc_core::sc_report_handler::set_actions("/IEEE_Std_1666/deprecated", sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  do {
    sc_core::sc_start();
    rethrow_failure();
  } while (sc_core::sc_get_status() == sc_core::SC_PAUSED && sc_core::sc_pending_activity());
  EXPECT_EQ(sc_core::sc_report_handler::get_count(sc_core::SC_WARNING), 0);
}

// A process of a test: runs `body` from the start.
class Script : public sc_core::sc_module {
 public:
  Script(const sc_core::sc_module_name& name, std::function<void()> body) : sc_module(name), body_(std::move(body)) {
    SC_HAS_PROCESS(Script);
    SC_THREAD(run);
  }

 private:
  void run() {
    run_guarded([this] { body_(); });
  }
  std::function<void()> body_;
};

// The time at which a signal changes to true or false, in order.
class Edges : public sc_core::sc_module {
 public:
  struct Edge {
    std::uint64_t picoseconds;
    bool value;
    friend bool operator==(const Edge&, const Edge&) = default;
  };

  Edges(const sc_core::sc_module_name& name, const sc_core::sc_signal<bool>& signal)
      : sc_module(name), signal_(signal) {
    SC_HAS_PROCESS(Edges);
    SC_METHOD(note);
    sensitive << signal.value_changed_event();
    dont_initialize();
  }
  const std::vector<Edge>& list() const { return list_; }

 private:
  void note() { list_.push_back({sc_core::sc_time_stamp().value(), signal_.read()}); }
  const sc_core::sc_signal<bool>& signal_;
  std::vector<Edge> list_;
};
inline void PrintTo(const Edges::Edge& edge, std::ostream* out) {
  *out << (edge.value ? "true at " : "false at ") << edge.picoseconds << " ps";
}

}  // namespace rastertlm::stream
