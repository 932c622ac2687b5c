#include "modules/video/video_output_module.h"

#include <utility>

#include "modules/stream/simulated_time.h"

namespace rastertlm::video {

VideoOutputModule::VideoOutputModule(const sc_core::sc_module_name& name, const FrameAssembly::Format& format,
                                     FrameSink sink)
    : sc_module(name), in("in"), assembly_(format), sink_(std::move(sink)) {
  in.register_b_transport(this, &VideoOutputModule::receive);
}

void VideoOutputModule::receive(stream::RgbPayload& payload, sc_core::sc_time& delay) {
  assembly_.add_line(payload.line, *payload.rgb, *payload.fragments);
  ++lines_shown_;
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  if (assembly_.ends_field(payload.line) && sink_)
    sink_(payload.frame, assembly_.field(payload.line), assembly_.frame(), stream::picoseconds_now() + delay.value());
}

}  // namespace rastertlm::video
