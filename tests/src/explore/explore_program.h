// Sweeps of small machines and scenes, run by the program, and what their stores hold.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "src/explore/database.h"
#include "src/explore/store.h"
#include "tests/support/run_program.h"

namespace rastertlm::test {

// Everything that the model says of a configuration: report, figures, error, by its key.
struct StoredResult {
  std::string state;
  std::string error;
  std::string report;
  std::string digests;
  std::string figures;
  std::string picture;
  friend bool operator==(const StoredResult&, const StoredResult&) = default;
};
using StoredResults = std::map<std::string, StoredResult>;

class ExploreTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("machine.toml", kSmallMachine);
    write("scene.toml", one_triangle());
  }

  // A sweep of the two, with what varies in it.
  static std::string sweep(const std::string& vary, const std::string& head = "") {
    return "schema = 1\nmachine = \"machine.toml\"\nscene = \"scene.toml\"\n" + head + vary +
           "[[objective]]\npath = \"answer.frame_rate_hz\"\nsense = \"maximise\"\n"
           "[[objective]]\npath = \"sum(memories[].total_bits)\"\nsense = \"minimise\"\n";
  }
  // Of so many points: the pixel clock and the normals' width vary.
  static std::string grid(std::size_t clocks) {
    return sweep(
        fmt::format("[[vary]]\npath = \"host.link_mbit_per_s\"\nfrom = 5\nto = {}\nstep = 1\n"
                    "[[vary]]\npath = \"decision_unit.topology\"\nvalues = [\"pipeline\", \"tree\"]\n",
                    4 + clocks));
  }
  static std::vector<std::string> run_sweep(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"explore", "run", "sweep.toml", "--store", "s.sqlite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  explore::SweepTable table(const std::string& store = "s.sqlite") const {
    return explore::Store(in_work(store), explore::Store::Opening::look).table();
  }
  StoredResults results(const std::string& store = "s.sqlite") const {
    explore::Database database(in_work(store), explore::Database::Access::existing);
    StoredResults results;
    if (database.integer("SELECT count(*) FROM sqlite_master WHERE name = 'result'") == 0) return results;
    explore::Statement row(
        database,
        "SELECT key, state, error, report, config_digest || scene_digest, picture, (SELECT "
        "group_concat(path || '=' || coalesce(value, 'null'), ' ') FROM figure WHERE figure.result = "
        "result.id) FROM result");
    while (row.step())
      results[row.text(0)] = {row.text(1), row.text(2), row.text(3), row.text(4), row.text(6), row.text(5)};
    return results;
  }
};

}  // namespace rastertlm::test
