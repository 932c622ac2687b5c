#include "modules/shading/table_load.h"

#include <algorithm>

namespace rastertlm::shading {
namespace {

constexpr double kTolerance = 1e-6;  // of a step: times are sums of products in double

template <class Word>
void run_into(const TableJob& job, std::vector<Word>& memory) {
  const auto& ramp = std::get<Ramp>(job.arguments);
  fill(ramp, std::span<Word>(memory).subspan(job.first_entry, ramp.entries));
}

}  // namespace

bool LoadRecord::holds(const TableJob& job) const {
  return job.ordinal < loaded_.size() && loaded_[job.ordinal] == job.arguments;
}

void LoadRecord::mark(const TableJob& job) {
  if (job.ordinal >= loaded_.size()) loaded_.resize(job.ordinal + 1);
  loaded_[job.ordinal] = job.arguments;
}

void LoadRecord::forget(const TableJob& job) {
  if (job.ordinal < loaded_.size()) loaded_[job.ordinal].reset();
}

LoaderId loader_of(const TableJob& job) {
  const bool dot = job.table.kind == TableKind::diffuse_dot || job.table.kind == TableKind::specular_dot;
  return {job.table.kind, job.table.light, dot ? 0 : job.table.component, job.unit};
}

std::uint64_t steps_of(const TableJob& job, std::int64_t argument_cycles) {
  if (const auto* ramp = std::get_if<Ramp>(&job.arguments)) return ramp->entries;
  return std::get<ScaledPath>(job.arguments).moves.size() + static_cast<std::uint64_t>(argument_cycles);
}

std::uint64_t stores_of(const TableJob& job) {
  if (const auto* ramp = std::get_if<Ramp>(&job.arguments)) return ramp->entries;
  const auto& moves = std::get<ScaledPath>(job.arguments).moves;
  return static_cast<std::uint64_t>(std::count(moves.begin(), moves.end(), Move::right));
}

TableLoad::TableLoad(std::span<const TableJob> jobs, std::int64_t argument_cycles, StepCost cost)
    : jobs_(jobs), argument_cycles_(static_cast<std::uint64_t>(argument_cycles)), cost_(cost) {
  open_job();
}

void TableLoad::open_job() {
  ramp_.reset();
  path_.reset();
  arguments_left_ = 0;
  at_start_ = true;
  if (done()) return;
  if (const auto* ramp = std::get_if<Ramp>(&jobs_[job_].arguments)) {
    ramp_.emplace(*ramp);
  } else {
    const auto& path = std::get<ScaledPath>(jobs_[job_].arguments);
    path_.emplace(path.moves, path.scale);
    arguments_left_ = argument_cycles_;
  }
}

LoadStep TableLoad::step() {
  LoadStep result;
  result.job = job_;
  at_start_ = false;
  if (arguments_left_ > 0) {
    --arguments_left_;
    ++ups_;
    result.is_argument = result.is_up = true;
    return result;
  }
  result.fill = ramp_ ? ramp_->step() : path_->step();
  result.fill.address += jobs_[job_].first_entry;
  result.is_up = !result.fill.stores;
  ++(result.is_up ? ups_ : stores_);
  if (ramp_ ? ramp_->done() : path_->done()) {
    ++job_;
    open_job();
  }
  return result;
}

bool TableLoad::in_time(std::uint64_t stores, std::uint64_t ups, double seconds) const {
  const double end = static_cast<double>(stores) * cost_.store + static_cast<double>(ups) * cost_.up;
  return end <= seconds + kTolerance * std::max(cost_.store, cost_.up);
}

// The job that has not begun, if it ends in time.
bool TableLoad::whole_job(double seconds, const WordSink& sink) {
  const TableJob& job = jobs_[job_];
  const std::uint64_t stores = stores_of(job);
  const std::uint64_t ups = steps_of(job, static_cast<std::int64_t>(argument_cycles_)) - stores;
  if (!in_time(stores_ + stores, ups_ + ups, seconds)) return false;
  words_.resize(stores);
  if (ramp_) {
    fill(std::get<Ramp>(job.arguments), std::span(words_));
  } else {
    const auto& path = std::get<ScaledPath>(job.arguments);
    fill(path.moves, path.scale, std::span(words_));
  }
  stores_ += stores;
  ups_ += ups;
  first_word_ = job.first_entry;
  flush(job.table, sink);
  ++job_;
  open_job();
  return true;
}

void TableLoad::flush(const TableId& table, const WordSink& sink) {
  if (!words_.empty()) sink(table, first_word_, words_);
  words_.clear();
}

void TableLoad::advance_to(double seconds, const WordSink& sink) {
  words_.clear();
  while (!done()) {
    if (at_start_ && whole_job(seconds, sink)) continue;
    const TableId table = jobs_[job_].table;
    for (const std::size_t job = job_; job_ == job;) {
      const bool is_up = arguments_left_ > 0 || (path_ && path_->next() == Move::up);
      if (!in_time(stores_ + (is_up ? 0 : 1), ups_ + (is_up ? 1 : 0), seconds)) return flush(table, sink);
      const FillStep done_step = step().fill;
      if (!done_step.stores) continue;
      if (words_.empty()) first_word_ = done_step.address;
      words_.push_back(done_step.value);
    }
    flush(table, sink);
  }
}

void run(const TableJob& job, TableBank& bank) {
  const TableId& table = job.table;
  switch (table.kind) {
    case TableKind::diffuse_dot:
      run_into(job, bank.lights.at(table.light).diffuse.products.at(table.component));
      break;
    case TableKind::specular_dot:
      run_into(job, bank.lights.at(table.light).specular.products.at(table.component));
      break;
    case TableKind::diffuse:
      run_into(job, bank.material_tables.at(table.light).diffuse.at(table.component));
      break;
    default: {
      auto& memory = bank.material_tables.at(table.light).specular.at(table.component);
      const auto& path = std::get<ScaledPath>(job.arguments);
      fill(path.moves, path.scale, std::span(memory).subspan(job.first_entry));
    }
  }
}

}  // namespace rastertlm::shading
