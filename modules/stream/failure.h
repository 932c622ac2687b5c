// SystemC turns an exception that leaves a process into a report of its own, and the unit and cycle it named are lost.
// A process body runs guarded instead: the first failure is kept, the simulation stops, and whoever started it throws
// the failure on.
#pragma once

#include <exception>
#include <systemc>

namespace rastertlm::stream {

inline std::exception_ptr& first_failure() {
  static std::exception_ptr failure;
  return failure;
}

template <class Body>
void run_guarded(const Body& body) {
  try {
    body();
  } catch (const sc_core::sc_unwind_exception&) {
    throw;  // the kernel ends the process
  } catch (...) {
    if (!first_failure()) first_failure() = std::current_exception();
    sc_core::sc_stop();
  }
}

inline void rethrow_failure() {
  if (first_failure()) std::rethrow_exception(first_failure());
}

}  // namespace rastertlm::stream
