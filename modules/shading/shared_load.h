// A load dealt out to the loaders that run it at the same time, each for its own time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/shading/loader_parameters.h"
#include "modules/shading/table_load.h"

namespace rastertlm::shading {

// The three kinds of loaders: of dot-product tables, of diffuse and of specular ones.
inline constexpr std::size_t kEngines = 3;
inline constexpr std::array<const char*, kEngines> kEngineNames{"dot product loader", "diffuse loader",
                                                                "specular loader"};
std::size_t engine_of(TableKind kind);

// Loaders that share the work of one table's kind.
std::int64_t units_of(const LoaderParameters& loader, TableKind kind);

// The parts of a job by unit: of n loaders each has its n-th part of every dot-product table (entries [u E / n, (u + 1)
// E / n) of E are unit u's), and the diffuse and specular entries of every n-th material.
std::vector<TableJob> shares_of(const TableJob& job, std::int64_t units);

class SharedLoad {
 public:
  SharedLoad() = default;  // of nothing
  SharedLoad(LoadProgram program, const LoaderParameters& parameters);
  SharedLoad(SharedLoad&&) = default;  // its loads look at its jobs: moved, never copied
  SharedLoad& operator=(SharedLoad&&) = default;
  SharedLoad(const SharedLoad&) = delete;
  SharedLoad& operator=(const SharedLoad&) = delete;
  ~SharedLoad() = default;

  const LoadProgram& program() const { return program_; }
  bool done() const;
  // Of the slowest loader, of an engine or of all.
  double seconds(std::size_t engine) const { return seconds_[engine]; }
  double seconds() const;
  std::size_t slowest_engine() const;  // the first of equal ones
  std::uint64_t stores_done() const;

  // The engine's loaders do what they can in `seconds` from the start of the load.
  void advance_to(std::size_t engine, double seconds, const WordSink& sink);
  void finish(const WordSink& sink);

 private:
  struct Loader {
    std::size_t engine = 0;
    std::vector<TableJob> jobs;
    double seconds = 0.0;
  };
  LoadProgram program_;
  std::vector<Loader> loaders_;
  std::vector<TableLoad> loads_;  // of loaders_
  std::array<double, kEngines> seconds_{};
};

}  // namespace rastertlm::shading
