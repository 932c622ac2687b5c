#include "modules/host/set_up_processor_module.h"

#include <utility>

#include "modules/stream/failure.h"
#include "modules/stream/simulated_time.h"

namespace rastertlm::host {

using span_unit::LoadPayload;

SetUpProcessorModule::SetUpProcessorModule(const sc_core::sc_module_name& name, SetUpWork& work, const HostCost& cost,
                                           Timeline timeline, stream::Link& link)
    : sc_module(name),
      bus("bus"),
      work_(work),
      cost_(cost),
      crossings_(work.widths(), cost.bus_bits()),
      timeline_(std::move(timeline)),
      link_(link) {
  SC_HAS_PROCESS(SetUpProcessorModule);
  SC_THREAD(run_guarded);
}

void SetUpProcessorModule::run_guarded() {
  stream::run_guarded([this] { run(); });
}

// A frame:
// 1. the store is told, which gives the buffer that is to be drawn when it is free;
// 2. triangle by triangle: compute, wait for a free register set, write. The unit answers with its time, so that the
//    kernel need not stop at each: nobody else writes to it;
// 3. the store is told that the frame is whole, and says when it is shown;
// 4. whoever runs the simulation gets a chance to look at the picture, and time passes to the end of the set-up.
void SetUpProcessorModule::run() {
  for (std::uint64_t f = 0; f < timeline_.frames || (timeline_.goes_on && timeline_.goes_on()); ++f) {
    SetUpFrame frame;
    frame.animation_frame = static_cast<std::int64_t>(f);
    frame.pose = timeline_.pose(frame.animation_frame);
    frame.begin_ps = now_ps();
    payload_.frame = f;
    transport(LoadPayload::Kind::frame);
    work_.begin_frame(frame.pose, timeline_.viewer_at_eye);
    compute(frame);
    frame.end_ps = now_ps();
    transport(LoadPayload::Kind::end);
    frame.shown_ps = payload_.shown_ps;
    frame.counts = work_.counts();
    frame.colour_steps = work_.colour_steps();
    occupancy_.cycles = now_.count();
    if (timeline_.drawn) timeline_.drawn(frame);
    sc_core::sc_pause();
    stream::wait_until(now_ps());
  }
  finished_ = true;
  sc_core::sc_pause();
}

void SetUpProcessorModule::compute(SetUpFrame& frame) {
  while (work_.next()) {
    const Cycles computing = cost_.compute(work_.operations());
    spend(stream::Activity::busy, computing);
    frame.computing += computing;
    occupancy_.busy += computing.count();
    for (const span_unit::TriangleLoad& load : work_.loads()) send(load, frame);
  }
}

void SetUpProcessorModule::send(const span_unit::TriangleLoad& load, SetUpFrame& frame) {
  const set_up::LoadWords kinds = work_.words_of(load);
  const std::uint64_t words = kinds.total();
  const std::uint64_t bus_words = crossings_.of(kinds);
  const Cycles writing = cost_.bus_transfer(bus_words);
  payload_.load = &load;
  payload_.words = words;
  payload_.write_ps = cost_.clock().picoseconds(writing);
  payload_.blocked_ps = 0;
  transport(LoadPayload::Kind::triangle);
  // The processor notices at its next cycle.
  const Cycles blocked = cost_.clock().cycles_at(payload_.blocked_ps);
  spend(stream::Activity::blocked, blocked);
  const std::uint64_t begin_ps = now_ps();
  spend(stream::Activity::busy, writing);
  frame.blocked += blocked;
  frame.writing += writing;
  occupancy_.blocked += blocked.count();
  occupancy_.busy += writing.count();
  words_sent_ += words;
  link_.record(bus_words, Cycles(bus_words), begin_ps, now_ps());
}

void SetUpProcessorModule::spend(stream::Activity activity, Cycles cycles) {
  const std::uint64_t begin_ps = now_ps();
  now_ += cycles;
  if (watcher_ && cycles > Cycles(0)) watcher_(activity, begin_ps, now_ps());
}

void SetUpProcessorModule::transport(LoadPayload::Kind kind) {
  payload_.kind = kind;
  sc_core::sc_time delay = stream::to_time(now_ps() - stream::picoseconds_now());
  bus->b_transport(payload_, delay);
}

}  // namespace rastertlm::host
