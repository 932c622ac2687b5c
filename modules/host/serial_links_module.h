// The link side of a host processor: sends messages to the processors that it feeds and to the one that feeds it, store
// and forward. The processor starts a message; from then on the link works beside it, each link on its own.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <string>
#include <systemc>

#include "modules/host/cost_model.h"
#include "modules/host/message_payload.h"
#include "modules/stream/link.h"
#include "modules/stream/occupancy.h"
#include "modules/stream/simulated_time.h"

namespace rastertlm::host {

template <class Owner>
using MessageInitiator = tlm_utils::simple_initiator_socket<Owner, stream::kNoBusWidth, HostProtocol>;
template <class Owner>
using MessageTarget = tlm_utils::simple_target_socket<Owner, stream::kNoBusWidth, HostProtocol>;

// One direction of a link, as its sender knows it.
struct LinkPort {
  stream::Link* link = nullptr;  // its words are bytes
  std::uint64_t free_ps = 0;     // when the last message will have gone
};

// The processor spends the start of a message of `bytes`; where the link still carries an earlier one it waits for it
// (blocked). Returns how long the message is on its way from then on.
inline sc_core::sc_time start_message(std::uint64_t bytes, const HostCost& cost, LinkPort& port,
                                      stream::OccupancyMeter& meter) {
  meter.enter(stream::Activity::busy, stream::picoseconds_now());
  sc_core::wait(stream::to_time(cost.clock(), cost.link_set_up()));
  if (port.free_ps > stream::picoseconds_now()) {
    meter.enter(stream::Activity::blocked, stream::picoseconds_now());
    stream::wait_until(port.free_ps);
  }
  const sc_core::sc_time transfer = stream::to_time(cost.clock(), cost.transfer(bytes));
  port.free_ps = stream::picoseconds_now() + transfer.value();
  port.link->record(bytes, cost.link_cycles(bytes), stream::picoseconds_now(), port.free_ps);
  return transfer;
}

// Called from a process of the sender.
template <class Socket>
void send(Socket& socket, MessagePayload& payload, const HostCost& cost, LinkPort& port,
          stream::OccupancyMeter& meter) {
  sc_core::sc_time delay = start_message(payload.message.bytes, cost, port, meter);
  socket->b_transport(payload, delay);
}

}  // namespace rastertlm::host
