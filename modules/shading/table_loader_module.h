// Whoever fills the tables: 68000s or wired sequencers, for each kind of table as many as share it, all at work at the
// same time. The module decides when; the words come from the incremental algorithms of table_filler.h.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <array>
#include <cstdint>
#include <systemc>
#include <utility>
#include <vector>

#include "modules/shading/light_payload.h"
#include "modules/shading/shared_load.h"
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
    // From the start of a line to the cycle in which its first pixel reads these tables.
    std::uint64_t reached_ps = 0;
  };
  static constexpr std::size_t kEngines = shading::kEngines;

  // `materials`: of the machine's, those to load. `retrace_ps`: the time that a load of `when = "retrace"` has.
  TableLoaderModule(const sc_core::sc_module_name& name, DeferredShader& shader, const LoaderParameters& parameters,
                    std::vector<std::size_t> materials, std::uint64_t retrace_ps, const sc_core::sc_event& swapped,
                    std::array<Engine, kEngines> engines);

  std::uint64_t words_sent() const { return words_sent_; }
  // The tables that are used are those of the frame that the hosts are at, whose objects are not wholly written.
  bool tables_ahead() const { return ahead_; }
  // From the retrace that started it to its last word, the longest load after the first picture: the slowest loader's.
  double longest_load_seconds() const { return longest_load_seconds_; }
  std::size_t longest_load_engine() const { return longest_load_engine_; }  // whose that was; 0 where there was none
  // Lines whose first pixel read a table that was not written to its end: of the frame whose lines were announced last,
  // and of all frames.
  std::uint64_t late_lines_of_frame() const { return late_lines_of_frame_; }
  std::uint64_t late_lines() const { return late_lines_; }
  // Of a load under way into the only bank: picoseconds from `since_ps` to its end, of the slowest loader, and to the
  // first time at which a line may start and find every table written to its end. 0: none, or no wait.
  std::uint64_t load_left_ps(std::uint64_t since_ps) const { return left_ps(since_ps, false); }
  std::uint64_t lines_wait_ps(std::uint64_t since_ps) const { return left_ps(since_ps, true); }
  // Words that the loaders have stored up to now are written: the end of what is counted.
  void close(std::uint64_t end_ps);
  const stream::Occupancy& occupancy(std::size_t engine, std::uint64_t end_ps) {
    return engines_[engine].meter.close(end_ps);
  }
  stream::OccupancyMeter& meter(std::size_t engine) { return engines_[engine].meter; }
  const Clock& clock(std::size_t engine) const { return engines_[engine].meter.clock(); }

 private:
  enum class Work { none, planned, running, done };

  void run_guarded();
  void run();
  void run_loads_guarded();
  void run_loads();
  void prepare();
  void receive(LightPayload& payload, sc_core::sc_time& delay);
  void synchronise(stream::SyncPayload& payload, sc_core::sc_time& delay);
  void start_of_retrace(stream::SyncPayload& payload);
  bool advance(std::uint64_t picoseconds, bool to_line);
  std::uint64_t left_ps(std::uint64_t since_ps, bool to_line) const;
  void plan();
  void refuse() const;
  void start();
  void load();
  void load_other_bank();
  void occupy_engines();
  bool at_retrace() const { return parameters_.when == LoadTime::retrace; }
  void finish();
  void write(const TableId& table, std::uint32_t first_entry, std::span<const std::uint32_t> words);
  void write_registers();

  DeferredShader& shader_;
  LoaderParameters parameters_;
  std::vector<std::size_t> materials_;
  std::uint64_t retrace_ps_;
  const sc_core::sc_event& swapped_;
  std::array<Engine, kEngines> engines_;
  std::vector<std::pair<std::uint64_t, std::size_t>> ends_;  // of a load: in picoseconds, and whose
  WordSink sink_;

  bool pending_ = false;  // lights have been received and not yet looked at
  bool changed_ = false;  // they are others than before
  bool will_change_ = false;
  bool ahead_ = false;
  std::uint64_t arrives_ps_ = 0;
  std::uint64_t swap_ps_ = 0;  // the retrace that started the frame in hand
  bool first_ = true;
  sc_core::sc_event received_;
  sc_core::sc_event started_;   // a load of the only bank
  sc_core::sc_event finished_;  // likewise
  SharedLoad load_;
  Work work_ = Work::none;  // on load_
  std::uint64_t started_ps_ = 0;
  std::array<std::uint64_t, kEngines> stored_{};  // words that loaders have stored and the link has not counted
  std::vector<std::uint32_t> words_;
  tlm::tlm_generic_payload write_payload_;
  std::uint64_t words_sent_ = 0;
  double longest_load_seconds_ = 0.0;
  std::size_t longest_load_engine_ = 0;
  std::uint64_t late_lines_of_frame_ = 0;
  std::uint64_t late_lines_ = 0;
};

}  // namespace rastertlm::shading
