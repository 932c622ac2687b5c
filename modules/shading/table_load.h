// A load of tables as a sequence of jobs that can be stopped after any step: one table (or one material of a table) a
// job.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "modules/shading/loader_parameters.h"
#include "modules/shading/table_bank.h"
#include "modules/shading/table_filler.h"
#include "src/base/units.h"

namespace rastertlm::shading {

// A specular path scaled by Ks. `moves` points into the processor's path ROM.
struct ScaledPath {
  std::span<const Move> moves;
  PathScale scale;
  std::int64_t exponent = 0;
  friend bool operator==(const ScaledPath& a, const ScaledPath& b) {
    return a.scale == b.scale && a.exponent == b.exponent;
  }
};
using JobArguments = std::variant<Ramp, ScaledPath>;

struct TableJob {
  TableId table;
  std::uint32_t first_entry = 0;  // of the table; a diffuse or specular job writes one material's entries
  JobArguments arguments;
  std::size_t ordinal = 0;  // which of the machine's jobs it is, the same in every load
  std::size_t unit = 0;     // which of the loaders that share its table does it
};

// A register that the host writes along with a load; it takes no step of a loader.
struct RegisterWrite {
  TableId table;
  std::uint32_t entry = 0;
  std::uint32_t value = 0;
};

struct LoadProgram {
  std::vector<TableJob> jobs;
  std::vector<RegisterWrite> registers;
};

// With which arguments each job of a bank was last run to its end: what has not changed is not loaded again.
class LoadRecord {
 public:
  bool holds(const TableJob& job) const;
  void mark(const TableJob& job);
  void forget(const TableJob& job);  // its table is being written

 private:
  std::vector<std::optional<JobArguments>> loaded_;
};

// Which loader runs a job: all jobs of one loader run one after the other, loaders run at the same time. A light has a
// loader for N.L, one for N.H, one a diffuse colour and one a specular table; `units` of them where they share.
struct LoaderId {
  TableKind kind = TableKind::diffuse_dot;
  std::size_t light = 0;
  std::size_t component = 0;  // colour of diffuse and specular; 0 for dot products
  std::size_t unit = 0;
  friend auto operator<=>(const LoaderId&, const LoaderId&) = default;
};
LoaderId loader_of(const TableJob& job);

// Steps of a job: one an entry of a ramp; one a move of a path, and argument_cycles before it.
std::uint64_t steps_of(const TableJob& job, std::int64_t argument_cycles);
std::uint64_t stores_of(const TableJob& job);

struct LoadStep {
  std::size_t job = 0;
  bool is_argument = false;
  bool is_up = false;  // a vertical move (or an argument step): costs the 68000 another time than a store
  FillStep fill;       // address within the table, the job's first entry included
};

// Seconds of a step.
struct StepCost {
  double store = 0.0;
  double up = 0.0;
};

// Consecutive entries of one table, to be written.
using WordSink =
    std::function<void(const TableId& table, std::uint32_t first_entry, std::span<const std::uint32_t> words)>;

// Runs the jobs of one loader step by step. Cycle n of the load is the n-th step().
class TableLoad {
 public:
  // `jobs` must outlive the load.
  TableLoad(std::span<const TableJob> jobs, std::int64_t argument_cycles, StepCost cost);

  bool done() const { return job_ == jobs_.size(); }
  std::uint64_t steps_done() const { return stores_ + ups_; }
  std::uint64_t stores_done() const { return stores_; }
  LoadStep step();  // !done()

  // The steps that end at most `seconds` after the start of the load (to a millionth of a step), and no further one.
  // Whole jobs are run by the fast form: the same words (tested).
  void advance_to(double seconds, const WordSink& sink);

 private:
  void open_job();
  bool in_time(std::uint64_t stores, std::uint64_t ups, double seconds) const;
  bool whole_job(double seconds, const WordSink& sink);
  void flush(const TableId& table, const WordSink& sink);
  std::span<const TableJob> jobs_;
  std::uint64_t argument_cycles_;
  StepCost cost_;
  std::size_t job_ = 0;
  std::uint64_t arguments_left_ = 0;
  bool at_start_ = true;
  std::uint64_t stores_ = 0;
  std::uint64_t ups_ = 0;
  std::optional<RampFiller> ramp_;
  std::optional<PathFiller> path_;
  std::uint32_t first_word_ = 0;
  std::vector<std::uint32_t> words_;
};

// A whole job at once, into memory. The same words as stepping (tested).
void run(const TableJob& job, TableBank& bank);

}  // namespace rastertlm::shading
