// An observer of a stream of lines, spliced between the two units that the stream connects: it sees every payload and
// hands it on as it is. Neither unit knows of it.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <systemc>
#include <utility>

#include "modules/stream/line_payload.h"
#include "modules/stream/simulated_time.h"

namespace rastertlm::stream {

// `first_pixel_ps`: when the line's first pixel passes, counted from the start of the simulation. The payload is as its
// sender left it, and only there during the call.
template <class Payload>
using Observer = std::function<void(const Payload&, std::uint64_t first_pixel_ps)>;

template <class Payload>
class TapModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<TapModule, kNoBusWidth, Protocol<Payload>> in;
  tlm_utils::simple_initiator_socket<TapModule, kNoBusWidth, Protocol<Payload>> out;

  TapModule(const sc_core::sc_module_name& name, Observer<Payload> observer)
      : sc_module(name), in("in"), out("out"), observer_(std::move(observer)) {
    in.register_b_transport(this, &TapModule::pass);
  }

 private:
  void pass(Payload& payload, sc_core::sc_time& delay) {
    observer_(payload, picoseconds_now() + delay.value());
    out->b_transport(payload, delay);
  }
  Observer<Payload> observer_;
};

// From one unit to the next, through a tap where somebody watches.
template <class Payload, class Out, class In>
std::unique_ptr<TapModule<Payload>> bind_watched(const char* name, const Observer<Payload>& observer, Out& out,
                                                 In& in) {
  if (!observer) {
    out.bind(in);
    return nullptr;
  }
  auto tap = std::make_unique<TapModule<Payload>>(name, observer);
  out.bind(tap->in);
  tap->out.bind(in);
  return tap;
}

}  // namespace rastertlm::stream
