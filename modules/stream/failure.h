// SystemC turns an exception that leaves a process into a report of its own, and the unit and cycle it named are lost.
// A process body runs guarded instead: the first failure is kept, the simulation stops, and whoever started it throws
// the failure on. The other processes stay where they wait, and their stacks are never unwound: what owns memory and
// lives over a wait is a member of its module, not a local variable.
#pragma once

#include <cstddef>
#include <exception>
#include <systemc>

#if defined(__SANITIZE_ADDRESS__)
#include <pthread.h>
#include <sanitizer/common_interface_defs.h>
#endif

namespace rastertlm::stream {

// SystemC tells AddressSanitizer of every switch between the stacks of its processes, but not where the stack of its
// caller lies. Without that, what is thrown after a simulation leaves marks on that stack, which are then reported.
inline void know_own_stack() {
#if defined(__SANITIZE_ADDRESS__)
  pthread_attr_t attributes;
  void* bottom = nullptr;
  std::size_t size = 0;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return;
  pthread_attr_getstack(&attributes, &bottom, &size);
  pthread_attr_destroy(&attributes);
  void* fake_stack = nullptr;
  __sanitizer_start_switch_fiber(&fake_stack, bottom, size);
  __sanitizer_finish_switch_fiber(fake_stack, nullptr, nullptr);
#endif
}

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

// Called where sc_start has returned.
inline void rethrow_failure() {
  know_own_stack();
  if (first_failure()) std::rethrow_exception(first_failure());
}

}  // namespace rastertlm::stream
