#include "modules/shading/deferred_shading_module.h"

#include <cstring>

#include "modules/stream/simulated_time.h"

namespace rastertlm::shading {

DeferredShadingModule::DeferredShadingModule(const sc_core::sc_module_name& name, DeferredShader& shader,
                                             std::size_t columns, const Clock& clock, Cycles latency,
                                             stream::Link& link)
    : sc_module(name),
      in("in"),
      bus("bus"),
      sync("sync"),
      out("out"),
      shader_(shader),
      latency_(stream::to_time(clock, latency)),
      link_(link) {
  rgb_.resize(columns);
  in.register_b_transport(this, &DeferredShadingModule::shade);
  bus.register_b_transport(this, &DeferredShadingModule::write);
  sync.register_b_transport(this, &DeferredShadingModule::synchronise);
}

void DeferredShadingModule::shade(stream::FragmentPayload& payload, sc_core::sc_time& delay) {
  const stream::LinePool::Handle line = std::move(payload.fragments);
  shader_.shade_line(*line, rgb_);
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  payload_.frame = payload.frame;
  payload_.line = payload.line;
  payload_.rgb = &rgb_;
  payload_.fragments = line.get();
  link_.record(rgb_.columns(), Cycles(rgb_.columns()));
  delay += latency_;
  out->b_transport(payload_, delay);
}

// A burst of consecutive entries into the bank that is being written.
void DeferredShadingModule::write(tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  const std::uint64_t first = payload.get_address() >> kTableWordShift;
  const std::size_t count = payload.get_data_length() / sizeof(std::uint32_t);
  if (!payload.is_write() || first + count > shader_.back().words()) {
    payload.set_response_status(payload.is_write() ? tlm::TLM_ADDRESS_ERROR_RESPONSE : tlm::TLM_COMMAND_ERROR_RESPONSE);
    return;
  }
  words_.resize(count);
  std::memcpy(words_.data(), payload.get_data_ptr(), count * sizeof(std::uint32_t));
  shader_.back().write(static_cast<std::uint32_t>(first), words_);
  words_loaded_ += count;
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

void DeferredShadingModule::synchronise(stream::SyncPayload& payload, sc_core::sc_time&) {
  if (payload.kind == stream::SyncPayload::Kind::retrace && payload.switch_tables) shader_.swap_banks();
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

}  // namespace rastertlm::shading
