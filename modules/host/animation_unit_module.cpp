#include "modules/host/animation_unit_module.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "modules/stream/failure.h"
#include "src/geometry/lighting.h"

namespace rastertlm::host {

using stream::Activity;
using stream::picoseconds_now;
using stream::wait_until;

namespace {

using Number = geometry::Counted<double>;

// Light and highlight vectors as the shading processor knows them: constant over the frame, the viewer infinitely far
// along +z.
std::vector<shading::LightArguments> light_arguments(const geometry::Pose& pose) {
  std::vector<shading::LightArguments> result;
  for (const geometry::Light& light : pose.lights) {
    const geometry::Vector3<Number> sum{light.vector.x, light.vector.y, Number(light.vector.z) + Number(1.0)};
    const geometry::Vector3<Number> halfway = geometry::normalised<Number>(sum);
    result.push_back({{light.vector.x, light.vector.y, light.vector.z},
                      {halfway.x.value(), halfway.y.value(), halfway.z.value()},
                      {light.intensity.x, light.intensity.y, light.intensity.z}});
  }
  return result;
}

}  // namespace

AnimationUnitModule::AnimationUnitModule(const sc_core::sc_module_name& name, const Animation& animation,
                                         const HostCost& cost, std::size_t children, std::size_t units,
                                         Overflow overflow, Timeline timeline, const std::vector<stream::Link*>& links,
                                         InitialLoad initial_load, stream::Link* bus)
    : sc_module(name),
      down("down", children),
      up("up", children),
      loader("loader"),
      animation_(animation),
      cost_(cost),
      units_(units),
      overflow_(overflow),
      timeline_(std::move(timeline)),
      initial_load_(std::move(initial_load)),
      bus_(bus),
      meter_(cost.clock()) {
  for (stream::Link* link : links) links_.push_back({link});
  for (auto& socket : up) socket.register_b_transport(this, &AnimationUnitModule::receive);
  SC_HAS_PROCESS(AnimationUnitModule);
  SC_THREAD(run_guarded);
}

void AnimationUnitModule::run_guarded() {
  stream::run_guarded([this] { run(); });
}

// A frame:
// 1. say what changed to the units that it feeds and to the table loader;
// 2. work out where the lights will stand, wait for their surveys, settle the grid, place pieces of clipped triangles,
// and say so;
// 3. wait for the retrace that shows the frame. The next one is for the frame after that retrace's.
void AnimationUnitModule::run() {
  announce_frame(0, true);
  settle_plan();
  for (bool first = true;; first = false) {
    meter_.enter(Activity::idle, picoseconds_now());
    wait(*timeline_.swapped);
    if (first) meter_.restart(picoseconds_now());
    if (!animation_.moves()) return;
    announce_frame(static_cast<std::int64_t>(timeline_.displayed_frame()) + 1, false);
    settle_plan();
  }
}

void AnimationUnitModule::announce_frame(std::int64_t animation_frame, bool initial) {
  meter_.enter(Activity::busy, picoseconds_now());
  surveys_ = 0;
  guarded_ = false;
  free_slots_.assign(units_, 0);
  homeless_.clear();
  work_ = std::make_unique<FrameWork>(animation_.frame_work(animation_frame, initial));
  Message& message = payload_.message;
  message.kind = Message::Kind::frame;
  message.work = work_.get();
  for (std::size_t i = 0; i < down.size(); ++i) {
    message.bytes = work_->message_bytes + (initial && i < initial_load_.size() ? initial_load_[i] : 0);
    send(down[i], payload_, cost_, links_[i], meter_);
  }
  announce_lights();
}

void AnimationUnitModule::announce_lights() {
  light_payload_.changed = work_->lights_changed;
  light_payload_.will_change = animation_.lights_change();
  const geometry::OperationCounts before = geometry::operation_counts;
  light_payload_.lights = light_arguments(work_->pose);
  sc_core::sc_time delay;
  light_operations_ = light_payload_.changed ? geometry::operation_counts - before : geometry::OperationCounts();
  if (bus_ != nullptr && light_payload_.changed) {
    const std::uint64_t words = shading::light_words(light_payload_.lights.size());
    const sc_core::sc_time taken = stream::to_time(cost_.clock(), cost_.bus(words));
    bus_->record(cost_.bus_words(words), Cycles(cost_.bus_words(words)), picoseconds_now(),
                 picoseconds_now() + taken.value());
    meter_.enter(Activity::busy, picoseconds_now());
    wait(taken);
  }
  loader->b_transport(light_payload_, delay);
}

void AnimationUnitModule::settle_plan() {
  // While the units work: the lights of the next frame, so that its message need not wait for them.
  meter_.enter(Activity::busy, picoseconds_now());
  wait(stream::to_time(cost_.clock(), cost_.compute(light_operations_)));
  meter_.enter(Activity::starved, picoseconds_now());
  while (surveys_ < up.size()) wait(sent_up_);
  wait_until(last_survey_ps_);
  meter_.enter(Activity::busy, picoseconds_now());
  placed_ = place_pieces(homeless_, free_slots_);
  if (!homeless_.empty()) {
    if (overflow_ == Overflow::error)
      throw InputError({"", 0, "host.processors_per_unit",
                        fmt::format("animation frame {}: clipping makes {} more pieces than the machine has free "
                                    "object processors; more processors, or "
                                    "host.overflow = \"drop\", would draw it",
                                    work_->animation_frame, homeless_.size())});
  }
  pieces_dropped_ = homeless_.size();
  Message& message = payload_.message;
  message.kind = Message::Kind::plan;
  message.guarded = guarded_;
  message.placed = &placed_;
  message.bytes = kFlagBytes;
  for (const auto& pieces : placed_) message.bytes += kPieceBytes * pieces.size();
  for (std::size_t i = 0; i < down.size(); ++i) send(down[i], payload_, cost_, links_[i], meter_);
}

void AnimationUnitModule::receive(MessagePayload& payload, sc_core::sc_time& delay) {
  const Message& message = payload.message;
  guarded_ = guarded_ || message.guarded;
  for (const FreeSlots& free : message.free_slots) free_slots_[free.unit] = free.count;
  homeless_.insert(homeless_.end(), message.homeless.begin(), message.homeless.end());
  ++surveys_;
  last_survey_ps_ = std::max<std::uint64_t>(last_survey_ps_, picoseconds_now() + delay.value());
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  sent_up_.notify(sc_core::SC_ZERO_TIME);
}

}  // namespace rastertlm::host
