// The deferred shading processor on its board: fragments in, levels out, tables written over a bus.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <systemc>
#include <vector>

#include "modules/shading/deferred_shader.h"
#include "modules/stream/line_payload.h"
#include "modules/stream/link.h"

namespace rastertlm::shading {

// Byte addresses of 32-bit words on the bus: those of TableBank, of the bank that is being written.
inline constexpr unsigned kTableWordShift = 2;

class DeferredShadingModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<DeferredShadingModule, stream::kNoBusWidth, stream::FragmentProtocol> in;
  tlm_utils::simple_target_socket<DeferredShadingModule> bus;
  tlm_utils::simple_target_socket<DeferredShadingModule, stream::kNoBusWidth, stream::SyncProtocol> sync;
  tlm_utils::simple_initiator_socket<DeferredShadingModule, stream::kNoBusWidth, stream::RgbProtocol> out;

  // `latency`: from a pixel's words to its levels.
  DeferredShadingModule(const sc_core::sc_module_name& name, DeferredShader& shader, std::size_t columns,
                        const Clock& clock, Cycles latency, stream::Link& link);

  std::uint64_t words_loaded() const { return words_loaded_; }

 private:
  void shade(stream::FragmentPayload& payload, sc_core::sc_time& delay);
  void write(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  void synchronise(stream::SyncPayload& payload, sc_core::sc_time& delay);

  DeferredShader& shader_;
  sc_core::sc_time latency_;
  stream::Link& link_;
  frame::RgbLine rgb_;
  stream::RgbPayload payload_;
  std::vector<std::uint32_t> words_;  // of a burst
  std::uint64_t words_loaded_ = 0;
};

}  // namespace rastertlm::shading
