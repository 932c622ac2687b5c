#include "modules/shading/shared_load.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "modules/shading/loader_budget.h"

namespace rastertlm::shading {

std::size_t engine_of(TableKind kind) { return kind == TableKind::diffuse ? 1 : kind == TableKind::specular ? 2 : 0; }

std::int64_t units_of(const LoaderParameters& loader, TableKind kind) {
  const std::array<std::int64_t, kEngines> units{loader.dot.units, loader.diffuse.units, loader.specular.units};
  return units[engine_of(kind)];
}

std::vector<TableJob> shares_of(const TableJob& job, std::int64_t units) {
  const auto count = static_cast<std::uint64_t>(units);
  std::vector<TableJob> shares;
  if (engine_of(job.table.kind) != 0) {
    shares.push_back(job);
    shares.back().unit = job.first_entry / stores_of(job) % count;
    return shares;
  }
  const Ramp& ramp = std::get<Ramp>(job.arguments);
  for (std::uint64_t unit = 0; unit < count; ++unit) {
    const auto first = static_cast<std::uint32_t>(unit * ramp.entries / count);
    const auto end = static_cast<std::uint32_t>((unit + 1) * ramp.entries / count);
    if (first == end) continue;
    shares.push_back(job);
    shares.back().first_entry += first;
    shares.back().arguments = slice(ramp, first, end - first);
    shares.back().unit = unit;
  }
  return shares;
}

SharedLoad::SharedLoad(LoadProgram program, const LoaderParameters& parameters) : program_(std::move(program)) {
  std::map<LoaderId, Loader> by_loader;
  for (const TableJob& job : program_.jobs)
    for (const TableJob& share : shares_of(job, units_of(parameters, job.table.kind))) {
      Loader& loader = by_loader[loader_of(share)];
      loader.engine = engine_of(share.table.kind);
      loader.seconds += job_seconds(parameters, share);
      loader.jobs.push_back(share);
    }
  for (auto& [id, loader] : by_loader) {
    seconds_[loader.engine] = std::max(seconds_[loader.engine], loader.seconds);
    loaders_.push_back(std::move(loader));
    const TableKind kind = loaders_.back().jobs.front().table.kind;
    loads_.emplace_back(loaders_.back().jobs, parameters.argument_cycles,
                        StepCost{step_seconds(parameters, kind, false), step_seconds(parameters, kind, true)});
  }
}

bool SharedLoad::done() const {
  return std::all_of(loads_.begin(), loads_.end(), [](const TableLoad& load) { return load.done(); });
}

double SharedLoad::seconds() const { return seconds_[slowest_engine()]; }

std::size_t SharedLoad::slowest_engine() const {
  return static_cast<std::size_t>(std::max_element(seconds_.begin(), seconds_.end()) - seconds_.begin());
}

std::uint64_t SharedLoad::stores_done() const {
  std::uint64_t stores = 0;
  for (const TableLoad& load : loads_) stores += load.stores_done();
  return stores;
}

void SharedLoad::advance_to(std::size_t engine, double seconds, const WordSink& sink) {
  for (std::size_t i = 0; i < loaders_.size(); ++i)
    if (loaders_[i].engine == engine) loads_[i].advance_to(seconds, sink);
}

void SharedLoad::finish(const WordSink& sink) {
  for (TableLoad& load : loads_) load.advance_to(std::numeric_limits<double>::infinity(), sink);
}

}  // namespace rastertlm::shading
