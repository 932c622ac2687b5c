#include "modules/shading/table_loader_module.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/shading/deferred_shading_module.h"
#include "modules/shading/loader_budget.h"
#include "modules/stream/failure.h"
#include "modules/stream/simulated_time.h"

namespace rastertlm::shading {

using stream::Activity;
using stream::picoseconds_now;

namespace {

std::uint64_t to_picoseconds(double seconds) { return static_cast<std::uint64_t>(std::llround(seconds * 1e12)); }

}  // namespace

TableLoaderModule::TableLoaderModule(const sc_core::sc_module_name& name, DeferredShader& shader,
                                     const LoaderParameters& parameters, std::vector<std::size_t> materials,
                                     std::uint64_t retrace_ps, const sc_core::sc_event& swapped,
                                     std::array<Engine, kEngines> engines)
    : sc_module(name),
      lights("lights"),
      sync("sync"),
      bus("bus"),
      ready("ready"),
      shader_(shader),
      parameters_(parameters),
      materials_(std::move(materials)),
      retrace_ps_(retrace_ps),
      swapped_(swapped),
      engines_(std::move(engines)),
      sink_([this](const TableId& table, std::uint32_t first, std::span<const std::uint32_t> words) {
        write(table, first, words);
      }) {
  lights.register_b_transport(this, &TableLoaderModule::receive);
  sync.register_b_transport(this, &TableLoaderModule::synchronise);
  write_payload_.set_command(tlm::TLM_WRITE_COMMAND);
  write_payload_.set_byte_enable_ptr(nullptr);
  write_payload_.set_dmi_allowed(false);
  SC_HAS_PROCESS(TableLoaderModule);
  SC_THREAD(run_guarded);
  SC_THREAD(run_loads_guarded);
}

void TableLoaderModule::run_guarded() {
  stream::run_guarded([this] { run(); });
}

void TableLoaderModule::run_loads_guarded() {
  stream::run_guarded([this] { run_loads(); });
}

// A frame:
// 1. wait for its lights, and for the end of a load of the only bank; where nothing changed the tables stay;
// 2. in the second bank (and before the first picture) load during the frame, each loader for its own time; with one
//    bank, be ready at once, and load when the next retrace comes that copies (run_load);
// 3. be ready until the retrace that shows the whole frame.
void TableLoaderModule::run() {
  ready.write(false);
  for (;; first_ = false) {
    while (!pending_) wait(received_);
    pending_ = false;
    stream::wait_until(arrives_ps_);
    while (work_ == Work::running) wait(finished_);
    if (std::exchange(changed_, false)) prepare();
    ready.write(true);
    wait(swapped_);
    swap_ps_ = picoseconds_now();
    if (first_)
      for (Engine& engine : engines_) engine.meter.restart(picoseconds_now());
    ready.write(false);
  }
}

// The loads of the only bank: each begins with a retrace, and goes on into the frame if it must.
void TableLoaderModule::run_loads() {
  for (;;) {
    wait(started_);
    occupy_engines();
    finish();
    finished_.notify();  // at once: what ends with the retrace is in time for it
  }
}

void TableLoaderModule::prepare() {
  plan();
  const double message = at_retrace() ? 0.0 : static_cast<double>(arrives_ps_ - swap_ps_) * 1e-12;
  if (!first_ && load_.seconds() + message > longest_load_seconds_) {
    longest_load_seconds_ = load_.seconds() + message;
    longest_load_engine_ = load_.slowest_engine();
  }
  if (first_ || !at_retrace()) {
    load();
    if (first_ && will_change_ && !at_retrace()) load_other_bank();
  } else {
    if (parameters_.on_overrun == Overrun::refuse && to_picoseconds(load_.seconds()) > retrace_ps_) refuse();
    work_ = Work::planned;
  }
}

// What must be loaded, and by whom.
void TableLoaderModule::plan() {
  load_ = SharedLoad(shader_.program(shader_.back_record(), materials_), parameters_);
  work_ = Work::none;
}

void TableLoaderModule::refuse() const {
  throw InputError({"", 0, "loader.when",
                    fmt::format("the tables that change with every frame take {:.6g} us to load, and the vertical "
                                "retrace has {:.6g} us; a faster loader, loader.when = \"frame\" or "
                                "loader.on_overrun = \"show\" would do",
                                load_.seconds() * 1e6, static_cast<double>(retrace_ps_) * 1e-6)});
}

// Into the bank that is not in use, in the time that the loaders need.
void TableLoaderModule::load() {
  start();
  occupy_engines();
  finish();
}

// Before the first picture both banks are filled, so that a frame's load is what the frame changes.
void TableLoaderModule::load_other_bank() {
  shader_.swap_banks();
  plan();
  load();
}

// The registers change at once; the tables hold what they held, but for what is written from now on.
void TableLoaderModule::start() {
  started_ps_ = picoseconds_now();
  for (const TableJob& job : load_.program().jobs) shader_.back_record().forget(job);
  write_registers();
  work_ = Work::running;
}

// Every engine is busy from the start of the load on for as long as its slowest loader.
void TableLoaderModule::occupy_engines() {
  ends_.clear();
  for (std::size_t engine = 0; engine < kEngines; ++engine) {
    if (load_.seconds(engine) == 0.0) continue;
    engines_[engine].meter.enter(Activity::busy, started_ps_);
    ends_.emplace_back(started_ps_ + to_picoseconds(load_.seconds(engine)), engine);
  }
  std::sort(ends_.begin(), ends_.end());
  for (const auto& [end, engine] : ends_) {
    stream::wait_until(end);
    engines_[engine].meter.enter(Activity::idle, end);
  }
}

void TableLoaderModule::finish() {
  load_.finish(sink_);
  std::uint64_t planned = 0;
  for (const TableJob& job : load_.program().jobs) {
    planned += stores_of(job);
    shader_.back_record().mark(job);
  }
  if (load_.stores_done() != planned)
    throw ModelError(name(), 0, fmt::format("a load of {} words has stored {}", planned, load_.stores_done()));
  work_ = at_retrace() ? Work::none : Work::done;
}

// To what the loaders have done at `picoseconds`, or when the first pixel of a line that starts then reads their
// tables. Whether that is not all.
bool TableLoaderModule::advance(std::uint64_t picoseconds, bool to_line) {
  bool late = false;
  for (std::size_t engine = 0; engine < kEngines; ++engine) {
    const std::uint64_t elapsed = picoseconds + (to_line ? engines_[engine].reached_ps : 0) - started_ps_;
    load_.advance_to(engine, static_cast<double>(elapsed) * 1e-12, sink_);
    late = late || to_picoseconds(load_.seconds(engine)) > elapsed;
  }
  return late;
}

std::uint64_t TableLoaderModule::left_ps(std::uint64_t since_ps, bool to_line) const {
  std::uint64_t left = 0;
  if (work_ != Work::running || !at_retrace()) return left;
  for (std::size_t engine = 0; engine < kEngines; ++engine) {
    const std::uint64_t end = started_ps_ + to_picoseconds(load_.seconds(engine));
    const std::uint64_t from = since_ps + (to_line ? engines_[engine].reached_ps : 0);
    if (end > from) left = std::max(left, end - from);
  }
  return left;
}

void TableLoaderModule::close(std::uint64_t end_ps) {
  if (work_ == Work::running) advance(end_ps, false);
}

void TableLoaderModule::write(const TableId& table, std::uint32_t first_entry, std::span<const std::uint32_t> words) {
  words_.assign(words.begin(), words.end());
  write_payload_.set_address(std::uint64_t{shader_.back().address(table, first_entry)} << kTableWordShift);
  write_payload_.set_data_ptr(reinterpret_cast<unsigned char*>(words_.data()));
  write_payload_.set_data_length(static_cast<unsigned>(words_.size() * sizeof(std::uint32_t)));
  write_payload_.set_streaming_width(write_payload_.get_data_length());
  write_payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  sc_core::sc_time delay;
  bus->b_transport(write_payload_, delay);
  if (write_payload_.is_response_error())
    throw ModelError(name(), 0, "the tables refused a write: " + write_payload_.get_response_string());
  words_sent_ += words.size();
  if (table.kind >= TableKind::signs) return;  // a register: the host writes it
  Engine& engine = engines_[engine_of(table.kind)];
  std::uint64_t& stored = stored_[engine_of(table.kind)];
  stored += words.size();
  engine.link->record(stored / engine.loaders, Cycles(stored / engine.loaders));
  stored %= engine.loaders;
}

void TableLoaderModule::write_registers() {
  for (const RegisterWrite& value : load_.program().registers) write(value.table, value.entry, {&value.value, 1});
}

void TableLoaderModule::receive(LightPayload& payload, sc_core::sc_time& delay) {
  changed_ = changed_ || payload.changed;
  will_change_ = payload.will_change;
  arrives_ps_ = picoseconds_now() + delay.value();
  if (payload.changed)
    for (std::size_t i = 0; i < payload.lights.size(); ++i) shader_.set_light(i, payload.lights[i]);
  pending_ = true;
  received_.notify(sc_core::SC_ZERO_TIME);
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

void TableLoaderModule::synchronise(stream::SyncPayload& payload, sc_core::sc_time& delay) {
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  if (payload.kind == stream::SyncPayload::Kind::retrace) {
    late_lines_of_frame_ = 0;
    if (payload.copy) start_of_retrace(payload);
    if (payload.swap) ahead_ = false;
  } else if (work_ == Work::running && at_retrace() && advance(picoseconds_now() + delay.value(), true)) {
    ++late_lines_of_frame_;
    ++late_lines_;
  }
}

// Two banks: the other one is used from now on, if its own load has ended. One: its load begins.
void TableLoaderModule::start_of_retrace(stream::SyncPayload& payload) {
  if (work_ == Work::done) {
    payload.switch_tables = true;
    ahead_ = true;
    work_ = Work::none;
  } else if (work_ == Work::planned) {
    start();
    ahead_ = true;
    started_.notify(sc_core::SC_ZERO_TIME);
  }
}

}  // namespace rastertlm::shading
