// What points found, in an SQLite file. A result belongs to a configuration, by its key, and not to a sweep: a changed
// sweep finds those that it shares with the one before. At any moment the file holds whole results alone.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/explore/database.h"
#include "src/explore/design.h"
#include "src/explore/store_lock.h"
#include "src/explore/sweep.h"
#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

inline constexpr std::int64_t kStoreSchema = 2;

struct PointResult {
  std::string key;  // of the configuration: machine, scene, frames, program
  State state = State::done;
  std::string error;
  std::string config_digest;  // of the resolved machine; "" where there is none
  std::string scene_digest;
  double seconds = 0.0;                                                // that the simulation took
  std::string report;                                                  // report.json, compressed; "" where it failed
  std::vector<std::pair<std::string, std::optional<double>>> figures;  // of the report, by path
  std::string thumbnail;                                               // PNG; "": none
  std::string machine_toml;                                            // resolved, compressed
  std::string scene_toml;                                              // the same; "": the store has it already
};

struct KnownResult {
  std::int64_t id = 0;
  State state = State::done;
  std::string error;  // failed: why
};

class Store {
 public:
  enum class Opening {
    fresh,   // makes it; InputError where there is one
    resume,  // makes it or goes on with it
    look,    // only reads it
  };
  // Throws InputError where the file is no store, is damaged, is of another schema or is in use, and OutputError where
  // it cannot be opened.
  Store(const std::string& file, Opening opening);

  // The sweep, which is made with its points where the store does not have it, and is the one that is shown from now
  // on. `digest` tells sweeps apart.
  std::int64_t enter(const Sweep& sweep, const Design& design, const std::string& digest);
  std::optional<KnownResult> find(const std::string& key);
  // Adds a result, or one in place of one that failed; all of it or nothing. `sweep`'s points `numbers` have it.
  std::int64_t record(const PointResult& result, std::int64_t sweep, const std::vector<std::uint64_t>& numbers);
  // These points of the sweep have these results.
  void link(std::int64_t sweep, const std::vector<std::pair<std::uint64_t, std::int64_t>>& points);
  // Everything that the sweep's results lack of these figures is taken from their reports.
  void complete_figures(const std::vector<std::string>& paths);
  // A run of the sweep, and a simulation that it starts: with the next result the store says how many there were.
  void begin_session(std::int64_t sweep);
  void count_start() { ++started_; }
  bool has_scene(const std::string& digest);
  // The report.json of a result; "" where it has none.
  std::string report(std::int64_t result);
  // A figure of a result that is done; none where it has none.
  std::optional<double> figure(std::int64_t result, const std::string& path);
  // The first report of all; "" where there is none.
  std::string any_report();

  // The sweep that was entered last. Throws InputError where there is none.
  SweepTable table();
  // Writes the table `front` of that sweep: a row for each point that front.h compares, by number, and of the front's
  // points the first that beats it, null for the front itself. It is what the store holds now: a run forgets it first.
  void keep_front();
  void forget_front();

  Database& database() { return database_; }

 private:
  void check_header(Opening opening);
  void make_schema();
  void add_sweep(const Sweep& sweep, const Design& design, const std::string& digest);
  void add_parts(const PointResult& result, std::int64_t id);

  std::unique_ptr<StoreLock> lock_;
  Database database_;
  std::int64_t session_ = 0;
  std::int64_t started_ = 0;
};

// What a joined store still lacks: points without a result, by number, of so many.
struct Lacking {
  std::uint64_t points = 0;
  std::vector<std::uint64_t> missing;
};

// "2 of 6 points have no result: all of share 3/3"; "" where none is missing. Shares are named where the missing points
// are whole ones of the fewest shares that tell them from the others; else the first of them is.
std::string lacking_text(const Lacking& lacking);

// Joins stores of one sweep: `out` is made whole, or not at all. Throws InputError where one of them is of another
// sweep, holds another result for a configuration, or `out` is there.
Lacking merge_stores(const std::string& out, const std::vector<std::string>& stores);

// Bytes made smaller, and as they were. Throws InputError where they cannot be had back.
std::string compressed(const std::string& bytes);
std::string expanded(const std::string& bytes, const std::string& file);

}  // namespace rastertlm::explore
