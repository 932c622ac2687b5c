#include "modules/host/computation_unit_module.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "modules/object_processor/bus_address.h"
#include "modules/quadric_processor/quadric_words.h"
#include "modules/stream/failure.h"

namespace rastertlm::host {

using stream::Activity;
using stream::picoseconds_now;
using stream::wait_until;

ComputationUnitModule::ComputationUnitModule(const sc_core::sc_module_name& name, std::uint32_t unit,
                                             Computation& computation, Solids solids, const HostCost& cost,
                                             std::size_t children, const sc_core::sc_event& swapped, Links links,
                                             const CopyTimes& copies)
    : sc_module(name),
      from_above("from_above"),
      to_above("to_above"),
      down("down", children),
      up("up", children),
      bus("bus"),
      quadric_bus("quadric_bus", solids.computation == nullptr ? 0 : 1),
      ready("ready"),
      unit_(unit),
      computation_(computation),
      quadrics_(solids.computation),
      quadric_words_(solids.words_a_slot),
      cost_(cost),
      swapped_(swapped),
      links_(std::move(links)),
      copies_(copies),
      above_{links_.above},
      meter_(cost.clock()) {
  for (stream::Link* link : links_.below) below_.push_back({link});
  from_above.register_b_transport(this, &ComputationUnitModule::receive_from_above);
  for (auto& socket : up) socket.register_b_transport(this, &ComputationUnitModule::receive_from_below);
  write_payload_.set_command(tlm::TLM_WRITE_COMMAND);
  write_payload_.set_byte_enable_ptr(nullptr);
  write_payload_.set_dmi_allowed(false);
  write_payload_.set_extension(&object_number_);
  SC_HAS_PROCESS(ComputationUnitModule);
  SC_THREAD(run_guarded);
}

void ComputationUnitModule::run_guarded() {
  stream::run_guarded([this] { run(); });
}

// A frame:
// 1. receive what changed, and forward it to the units below;
// 2. transform the triangles, and report whether the frame needs the guard band;
// 3. receive the frame's grid, and forward it;
// 4. fit the coefficients, and write each slot's to the loading RAMs as they are known;
// 5. be ready until the retrace at which all are.
void ComputationUnitModule::run() {
  ready.write(false);
  for (;; first_ = false) {
    meter_.enter(Activity::starved, picoseconds_now());
    Message message = take(Message::Kind::frame);
    update_ = {};
    update_.animation_frame = message.work->animation_frame;
    forward(message);
    work_on_frame(*message.work);
    update_.cycles = cycles_since_swap();
    updates_.push_back(update_);
    ready.write(true);
    meter_.enter(Activity::idle, picoseconds_now());
    wait(swapped_);
    swap_ps_ = picoseconds_now();
    if (first_) meter_.restart(swap_ps_);
    ready.write(false);
  }
}

// Everything since the swap took whole cycles, each piece of work rounded to a picosecond: the nearest number of cycles
// is the exact one.
Cycles ComputationUnitModule::cycles_since_swap() const {
  return cost_.clock().cycles_round(static_cast<double>(picoseconds_now() - swap_ps_) * 1e-12);
}

void ComputationUnitModule::work_on_frame(const FrameWork& work) {
  geometry::OperationCounts before = computation_.operations();
  survey_ = computation_.survey(work);
  spend_computing(before);
  report();

  meter_.enter(Activity::starved, picoseconds_now());
  Message plan = take(Message::Kind::plan);
  forward(plan);
  fit_and_write(plan, work);
}

void ComputationUnitModule::spend_computing(const geometry::OperationCounts& before) {
  const geometry::OperationCounts counts = computation_.operations() - before;
  const Cycles cycles = cost_.compute(counts);
  update_.operations += counts;
  update_.computing += cycles;
  meter_.enter(Activity::busy, picoseconds_now());
  wait(stream::to_time(cost_.clock(), cycles));
}

// Each slot is written when its coefficients are known, triangles first. Nothing reads a loading RAM but a copy: the
// words that stand there before the next one are written at once, and their time passes afterwards.
void ComputationUnitModule::fit_and_write(const Message& plan, const FrameWork& work) {
  const geometry::OperationCounts before = computation_.operations();
  const BusSchedule schedule = first_ ? BusSchedule(cost_.clock()) : BusSchedule(cost_.clock(), copies_, swap_ps_);
  const Cycles start = cycles_since_swap();
  // Where no copy comes any more, the order of words and arithmetic moves nothing.
  const bool may_be_copied = schedule.next(start).has_value();
  loads_ = &computation_.set_up(plan.guarded, (*plan.placed)[unit_], may_be_copied);
  const geometry::OperationCounts of_triangles = computation_.operations() - before;
  geometry::OperationCounts counts = of_triangles;
  if (quadrics_ != nullptr) {
    const geometry::OperationCounts before_solids = quadrics_->operations();
    solids_ = &quadrics_->set_up(work, may_be_copied);
    counts += quadrics_->operations() - before_solids;
  }
  update_.operations += counts;
  const Cycles computing = cost_.compute(counts);
  update_.computing += computing;
  for (std::size_t i = 0; i < parcels(); ++i) update_.words += parcel(i).words;
  update_.writing = cost_.bus(update_.words);
  parcel_ = word_ = 0;
  if (may_be_copied)
    cut_into_segments(computing, of_triangles);
  else
    segments_.assign(1, {computing, update_.words});
  for (BusBurst burst(schedule, segments_, cost_.word(), start); !burst.done();) {
    const BusBurst::Step step = burst.step();
    write_words(step.words);
    const std::uint64_t bus_words = cost_.bus_words(step.words);  // the bus' clock moves one a cycle
    links_.bus->record(bus_words, Cycles(bus_words), picoseconds_now(), schedule.picoseconds(burst.cycle()));
    update_.stalled += step.blocked;
    meter_.enter(step.blocked > Cycles(0) ? Activity::blocked : Activity::busy, picoseconds_now());
    wait_until(schedule.picoseconds(burst.cycle()));
  }
}

ComputationUnitModule::Parcel ComputationUnitModule::parcel(std::size_t number) const {
  if (!is_solid(number)) {
    const Load& load = (*loads_)[number];
    return {load.slot, load.park ? 0 : load.object + 1, load.park ? kParkWords : object_processor::kWords};
  }
  const QuadricLoad& load = (*solids_)[number - loads_->size()];
  return {load.slot, load.park ? 0 : load.object + 1, load.park ? quadric_processor::kParkWords : quadric_words_};
}

void ComputationUnitModule::cut_into_segments(Cycles computing, const geometry::OperationCounts& of_triangles) {
  segments_.clear();
  Cycles computed;
  for (std::size_t i = 0; i < parcels(); ++i) {
    geometry::OperationCounts counts;
    if (is_solid(i)) {
      counts = of_triangles;
      counts += quadrics_->before()[i - loads_->size()];
    } else {
      counts = computation_.before()[i];
    }
    const Cycles until = cost_.compute(counts);
    segments_.push_back({until - computed, parcel(i).words});
    computed = until;
  }
  segments_.push_back({computing - computed, 0});
}

void ComputationUnitModule::write_words(std::uint64_t count) {
  words_sent_ += count;
  while (count > 0) {
    const std::uint64_t left = parcel(parcel_).words - word_;
    const std::uint64_t now = std::min(left, count);
    write(parcel_, word_, now);
    count -= now;
    word_ += now;
    if (now < left) continue;
    ++parcel_;
    word_ = 0;
  }
}

// A burst of consecutive words of a slot.
void ComputationUnitModule::write(std::size_t number, std::size_t first_word, std::size_t count) {
  const Parcel at = parcel(number);
  object_number_.object = at.object;
  if (is_solid(number)) {
    quadric_processor::QuadricImage image = quadric_processor::to_image((*solids_)[number - loads_->size()].words);
    put_on_bus(quadric_bus[0],
               object_processor::bus_address(unit_, at.slot, first_word, quadric_processor::kQuadricShift),
               image.data() + first_word, count);
    return;
  }
  object_processor::ProcessorWords words = object_processor::to_words((*loads_)[number].words);
  put_on_bus(bus, object_processor::bus_address(unit_, at.slot, first_word), words.data() + first_word, count);
}

void ComputationUnitModule::put_on_bus(BusSocket& socket, std::uint64_t address, std::uint32_t* words,
                                       std::size_t count) {
  write_payload_.set_address(address);
  write_payload_.set_data_ptr(reinterpret_cast<unsigned char*>(words));
  write_payload_.set_data_length(static_cast<unsigned>(count * sizeof(std::uint32_t)));
  write_payload_.set_streaming_width(write_payload_.get_data_length());
  write_payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  sc_core::sc_time delay;
  socket->b_transport(write_payload_, delay);
  if (write_payload_.is_response_error())
    throw ModelError(name(), cost_.clock().cycles_at(picoseconds_now()).count(),
                     "the board refused a bus write: " + write_payload_.get_response_string());
}

Message ComputationUnitModule::take(Message::Kind kind) {
  while (inbox_.empty()) wait(sent_down_);
  Letter letter = std::move(inbox_.front());
  inbox_.pop_front();
  wait_until(letter.arrives_ps);
  if (letter.message.kind != kind)
    throw ModelError(name(), cost_.clock().cycles_at(picoseconds_now()).count(), "a message arrived out of turn");
  return std::move(letter.message);
}

void ComputationUnitModule::forward(const Message& message) {
  payload_.message = message;
  const Message& sent = payload_.message;
  const bool with_meshes = sent.kind == Message::Kind::frame && sent.work->initial && !links_.resident_below.empty();
  for (std::size_t i = 0; i < down.size(); ++i) {
    if (with_meshes) payload_.message.bytes = sent.work->message_bytes + links_.resident_below[i];
    send_on(down[i], below_[i]);
  }
}

void ComputationUnitModule::send_on(MessageInitiator<ComputationUnitModule>& socket, LinkPort& port) {
  send(socket, payload_, cost_, port, meter_);
  update_.starting += cost_.link_set_up();
}

// One message up: the own survey with those of the units below, when they have come.
void ComputationUnitModule::report() {
  meter_.enter(Activity::starved, picoseconds_now());
  while (surveys_ < up.size()) wait(sent_up_);
  wait_until(last_survey_ps_);
  Message& message = payload_.message;
  message = std::exchange(subtree_, {});
  message.kind = Message::Kind::survey;
  message.guarded = message.guarded || survey_.guarded;
  message.free_slots.push_back({unit_, survey_.free_slots});
  message.homeless.insert(message.homeless.end(), std::make_move_iterator(survey_.homeless.begin()),
                          std::make_move_iterator(survey_.homeless.end()));
  message.bytes = survey_bytes(message);
  surveys_ = 0;
  send_on(to_above, above_);
}

void ComputationUnitModule::receive_from_above(MessagePayload& payload, sc_core::sc_time& delay) {
  inbox_.push_back({payload.message, picoseconds_now() + delay.value()});
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  sent_down_.notify(sc_core::SC_ZERO_TIME);
}

void ComputationUnitModule::receive_from_below(MessagePayload& payload, sc_core::sc_time& delay) {
  const Message& message = payload.message;
  subtree_.guarded = subtree_.guarded || message.guarded;
  subtree_.free_slots.insert(subtree_.free_slots.end(), message.free_slots.begin(), message.free_slots.end());
  subtree_.homeless.insert(subtree_.homeless.end(), message.homeless.begin(), message.homeless.end());
  ++surveys_;
  last_survey_ps_ = std::max<std::uint64_t>(last_survey_ps_, picoseconds_now() + delay.value());
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  sent_up_.notify(sc_core::SC_ZERO_TIME);
}

}  // namespace rastertlm::host
