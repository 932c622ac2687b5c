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

std::size_t engine_of(TableKind kind) { return kind == TableKind::diffuse ? 1 : kind == TableKind::specular ? 2 : 0; }

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
      engines_(std::move(engines)) {
  lights.register_b_transport(this, &TableLoaderModule::receive);
  sync.register_b_transport(this, &TableLoaderModule::synchronise);
  write_payload_.set_command(tlm::TLM_WRITE_COMMAND);
  write_payload_.set_byte_enable_ptr(nullptr);
  write_payload_.set_dmi_allowed(false);
  SC_HAS_PROCESS(TableLoaderModule);
  SC_THREAD(run_guarded);
}

void TableLoaderModule::run_guarded() {
  stream::run_guarded([this] { run(); });
}

// A frame:
// 1. wait for its lights; where nothing changed the tables stay;
// 2. in the second bank (and before the first picture) load during the frame, each loader for its own time;
//    with one bank, be ready at once, and load when the retrace comes (synchronise);
// 3. be ready until the retrace that shows the frame.
void TableLoaderModule::run() {
  ready.write(false);
  for (;; first_ = false) {
    while (!pending_) wait(received_);
    pending_ = false;
    const double message = static_cast<double>(arrives_ps_ - swap_ps_) * 1e-12;
    stream::wait_until(arrives_ps_);
    if (changed_) {
      const double longest = plan();
      if (!first_) longest_load_seconds_ = std::max(longest_load_seconds_, longest + (at_retrace() ? 0.0 : message));
      if (first_ || !at_retrace()) {
        load();
        if (first_ && will_change_ && !at_retrace()) load_other_bank();
      } else if (to_picoseconds(longest) > retrace_ps_) {
        throw InputError({"", 0, "loader.when",
                          fmt::format("the tables that change with every frame take {:.6g} us to load, and the "
                                      "vertical retrace has {:.6g} us; a faster loader, or "
                                      "loader.when = \"frame\", would do",
                                      longest * 1e6, static_cast<double>(retrace_ps_) * 1e-6)});
      } else {
        load_at_retrace_ = true;
      }
    }
    ready.write(true);
    wait(swapped_);
    swap_ps_ = picoseconds_now();
    if (first_)
      for (Engine& engine : engines_) engine.meter.restart(picoseconds_now());
    ready.write(false);
    if (std::exchange(loaded_at_retrace_, false)) occupy_engines();
  }
}

// Into the bank that is not in use, in the time that the engines need.
void TableLoaderModule::load() {
  write_all();
  occupy_engines();
}

// Before the first picture both banks are filled, so that a frame's load is what the frame changes.
void TableLoaderModule::load_other_bank() {
  shader_.swap_banks();
  plan();
  load();
}

// Every engine is busy from now on for as long as its slowest loader.
void TableLoaderModule::occupy_engines() {
  const std::uint64_t start = picoseconds_now();
  std::array<double, kEngines> busy{};
  for (const auto& [loader, seconds] : seconds_)
    busy[engine_of(loader.kind)] = std::max(busy[engine_of(loader.kind)], seconds);
  std::vector<std::pair<std::uint64_t, std::size_t>> ends;
  for (std::size_t engine = 0; engine < kEngines; ++engine) {
    if (busy[engine] == 0.0) continue;
    engines_[engine].meter.enter(Activity::busy, start);
    ends.emplace_back(start + to_picoseconds(busy[engine]), engine);
  }
  std::sort(ends.begin(), ends.end());
  for (const auto& [end, engine] : ends) {
    stream::wait_until(end);
    engines_[engine].meter.enter(Activity::idle, end);
  }
}

// What must be loaded, and how long each loader takes for it. Returns the longest, in seconds.
double TableLoaderModule::plan() {
  program_ = shader_.program(shader_.back_record(), materials_);
  seconds_.clear();
  double longest = 0.0;
  for (const TableJob& job : program_.jobs) {
    double& seconds = seconds_[loader_of(job)];
    seconds += job_seconds(parameters_, job);
    longest = std::max(longest, seconds);
  }
  return longest;
}

void TableLoaderModule::write_all() {
  std::array<std::uint64_t, kEngines> stored{};
  for (const TableJob& job : program_.jobs) {
    write_job(job);
    stored[engine_of(job.table.kind)] += words_.size();
    shader_.back_record().mark(job);
  }
  for (std::size_t i = 0; i < kEngines; ++i) {
    const std::uint64_t steps = stored[i] / engines_[i].loaders;
    engines_[i].link->record(steps, Cycles(steps));
  }
  for (const RegisterWrite& value : program_.registers) {
    words_.assign(1, value.value);
    write_words(value.table, value.entry);
  }
}

void TableLoaderModule::write_job(const TableJob& job) {
  if (const Ramp* ramp = std::get_if<Ramp>(&job.arguments)) {
    words_.resize(ramp->entries);
    fill(*ramp, std::span<std::uint32_t>(words_));
  } else {
    const ScaledPath& path = std::get<ScaledPath>(job.arguments);
    levels_.resize(shader_.back().material_tables.empty() ? 0 : std::size_t{1} << shader_.parameters().index_bits);
    fill(path.moves, path.scale, std::span<std::uint8_t>(levels_));
    words_.assign(levels_.begin(), levels_.end());
  }
  write_words(job.table, job.first_entry);
}

void TableLoaderModule::write_words(const TableId& table, std::uint32_t first_entry) {
  write_payload_.set_address(std::uint64_t{shader_.back().address(table, first_entry)} << kTableWordShift);
  write_payload_.set_data_ptr(reinterpret_cast<unsigned char*>(words_.data()));
  write_payload_.set_data_length(static_cast<unsigned>(words_.size() * sizeof(std::uint32_t)));
  write_payload_.set_streaming_width(write_payload_.get_data_length());
  write_payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  sc_core::sc_time delay;
  bus->b_transport(write_payload_, delay);
  if (write_payload_.is_response_error())
    throw ModelError(name(), 0, "the tables refused a write: " + write_payload_.get_response_string());
  words_sent_ += words_.size();
}

void TableLoaderModule::receive(LightPayload& payload, sc_core::sc_time& delay) {
  changed_ = payload.changed;
  will_change_ = payload.will_change;
  arrives_ps_ = picoseconds_now() + delay.value();
  if (changed_)
    for (std::size_t i = 0; i < payload.lights.size(); ++i) shader_.set_light(i, payload.lights[i]);
  pending_ = true;
  received_.notify(sc_core::SC_ZERO_TIME);
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

void TableLoaderModule::synchronise(stream::SyncPayload& payload, sc_core::sc_time&) {
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  if (payload.kind != stream::SyncPayload::Kind::retrace || !payload.copy) return;
  payload.switch_tables = changed_ && !at_retrace();
  if (!load_at_retrace_) return;
  load_at_retrace_ = false;
  loaded_at_retrace_ = true;
  write_all();
}

}  // namespace rastertlm::shading
