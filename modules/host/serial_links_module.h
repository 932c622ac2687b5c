// The link side of a host processor: sends messages to the processors that it feeds and to the one that feeds it, store
// and forward, each link on its own (a transputer's links work beside its processor).
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <string>
#include <systemc>

#include "modules/host/cost_model.h"
#include "modules/host/message_payload.h"
#include "modules/stream/link.h"
#include "modules/stream/simulated_time.h"

namespace rastertlm::host {

template <class Owner>
using MessageInitiator = tlm_utils::simple_initiator_socket<Owner, stream::kNoBusWidth, HostProtocol>;
template <class Owner>
using MessageTarget = tlm_utils::simple_target_socket<Owner, stream::kNoBusWidth, HostProtocol>;

// Sends a message with the delay of its set-up and bytes, and records the bytes on `link`, whose words and cycles are
// bytes.
template <class Socket>
void send(Socket& socket, MessagePayload& payload, const HostCost& cost, stream::Link& link) {
  const Cycles cycles = cost.message(payload.message.bytes);
  link.record(payload.message.bytes, Cycles(payload.message.bytes));
  sc_core::sc_time delay = stream::to_time(cost.clock(), cycles);
  socket->b_transport(payload, delay);
}

}  // namespace rastertlm::host
