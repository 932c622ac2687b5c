// The pixel unit on its board, between a span unit and the frame store: what the host has given a shading is shaded
// here, other triangles' spans pass in their order.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <systemc>
#include <vector>

#include "modules/frame_store/span_payload.h"
#include "modules/pixel_unit/parameters.h"
#include "modules/pixel_unit/pixel_shader.h"
#include "modules/stream/link.h"
#include "modules/stream/occupancy.h"

namespace rastertlm::pixel_unit {

class PixelUnitModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<PixelUnitModule, stream::kNoBusWidth, frame_store::SpanProtocol> in;
  tlm_utils::simple_initiator_socket<PixelUnitModule, stream::kNoBusWidth, frame_store::SpanProtocol> out;

  // `shader` outlives it, and knows a frame's lights before its first triangle comes. `link`: to the frame store.
  PixelUnitModule(const sc_core::sc_module_name& name, const PixelUnitParameters& parameters, PixelShader& shader,
                  stream::Link& link);

  // To the end of its last pixel's interval. Busy: loads, lines and pixels; starved: nothing to shade was there;
  // blocked: the memory took longer.
  stream::Occupancy occupancy() const;
  // When its last level was in the memory.
  std::uint64_t drained_ps() const { return drained_ps_; }
  std::uint64_t shaded() const { return shaded_; }  // pixels
  std::uint64_t passed() const { return passed_; }

 private:
  void receive(frame_store::SpanPayload& payload, sc_core::sc_time& delay);
  void shade(frame_store::SpanPayload& payload, sc_core::sc_time& delay);
  std::uint64_t shade_span(const frame_store::SpanPayload& payload, const span_unit::Span& span, std::uint64_t at_ps);
  void pass(frame_store::SpanPayload& payload, sc_core::sc_time& delay);

  PixelUnitParameters parameters_;
  PixelShader& shader_;
  Clock clock_;
  stream::Link& link_;
  frame_store::SpanPayload payload_;  // of a shaded span
  std::vector<std::uint32_t> levels_;
  const PixelTriangle* loaded_ = nullptr;
  std::uint64_t free_ = 0;        // cycle from which a pixel may come
  std::uint64_t drained_ps_ = 0;  // when the last level was in the memory
  std::uint64_t shaded_ = 0;
  std::uint64_t passed_ = 0;
  stream::Occupancy occupancy_;
};

}  // namespace rastertlm::pixel_unit
