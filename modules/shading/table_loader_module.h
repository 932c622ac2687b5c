// Whoever fills the tables: 68000s or wired sequencers, one for each kind of table, all at work at the same time. The
// module decides when; the words come from the incremental algorithms of table_filler.h.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <array>
#include <map>
#include <systemc>
#include <vector>

#include "modules/shading/light_payload.h"
#include "modules/shading/table_load.h"
#include "modules/stream/link.h"
#include "modules/stream/occupancy.h"

namespace rastertlm::shading {

class TableLoaderModule : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<TableLoaderModule, stream::kNoBusWidth, LightProtocol> lights;
  tlm_utils::simple_target_socket<TableLoaderModule, stream::kNoBusWidth, stream::SyncProtocol> sync;
  tlm_utils::simple_initiator_socket<TableLoaderModule, 32> bus;
  sc_core::sc_out<bool> ready;

  // One kind of table with its loaders: dot products, diffuse, specular.
  struct Engine {
    stream::Link* link;  // of all loaders of the kind together; a word is what each of them stores in one step
    std::uint64_t loaders;
    stream::OccupancyMeter meter;
  };
  static constexpr std::size_t kEngines = 3;

  // `materials`: of the machine's, those to load. `retrace_ps`: the time that a load of `when = "retrace"` has.
  TableLoaderModule(const sc_core::sc_module_name& name, DeferredShader& shader, const LoaderParameters& parameters,
                    std::vector<std::size_t> materials, std::uint64_t retrace_ps, const sc_core::sc_event& swapped,
                    std::array<Engine, kEngines> engines);

  std::uint64_t words_sent() const { return words_sent_; }
  // From the retrace that started it to its last word, the longest load after the first picture: the slowest loader's.
  double longest_load_seconds() const { return longest_load_seconds_; }
  const stream::Occupancy& occupancy(std::size_t engine, std::uint64_t end_ps) {
    return engines_[engine].meter.close(end_ps);
  }
  const Clock& clock(std::size_t engine) const { return engines_[engine].meter.clock(); }

 private:
  void run_guarded();
  void run();
  void receive(LightPayload& payload, sc_core::sc_time& delay);
  void synchronise(stream::SyncPayload& payload, sc_core::sc_time& delay);
  double plan();
  void load();
  void load_other_bank();
  void occupy_engines();
  bool at_retrace() const { return parameters_.when == LoadTime::retrace; }
  void write_all();
  void write_job(const TableJob& job);
  void write_words(const TableId& table, std::uint32_t first_entry);

  DeferredShader& shader_;
  LoaderParameters parameters_;
  std::vector<std::size_t> materials_;
  std::uint64_t retrace_ps_;
  const sc_core::sc_event& swapped_;
  std::array<Engine, kEngines> engines_;

  bool pending_ = false;  // lights have been received and not yet looked at
  bool changed_ = false;
  bool will_change_ = false;
  std::uint64_t arrives_ps_ = 0;
  std::uint64_t swap_ps_ = 0;  // the retrace that started the frame in hand
  bool first_ = true;
  bool load_at_retrace_ = false;    // the next retrace that copies loads the program
  bool loaded_at_retrace_ = false;  // it has just done so
  sc_core::sc_event received_;
  LoadProgram program_;
  std::map<LoaderId, double> seconds_;  // of the program, by loader
  std::vector<std::uint32_t> words_;
  std::vector<std::uint8_t> levels_;
  tlm::tlm_generic_payload write_payload_;
  std::uint64_t words_sent_ = 0;
  double longest_load_seconds_ = 0.0;
};

}  // namespace rastertlm::shading
