#include "modules/shading/table_load.h"

namespace rastertlm::shading {
namespace {

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
  return {job.table.kind, job.table.light, dot ? 0 : job.table.component};
}

std::uint64_t steps_of(const TableJob& job, std::int64_t argument_cycles) {
  if (const auto* ramp = std::get_if<Ramp>(&job.arguments)) return ramp->entries;
  return std::get<ScaledPath>(job.arguments).moves.size() + static_cast<std::uint64_t>(argument_cycles);
}

TableLoad::TableLoad(std::span<const TableJob> jobs, std::int64_t argument_cycles)
    : jobs_(jobs), argument_cycles_(static_cast<std::uint64_t>(argument_cycles)) {
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
  ++steps_;
  at_start_ = false;
  if (arguments_left_ > 0) {
    --arguments_left_;
    result.is_argument = result.is_up = true;
    return result;
  }
  result.fill = ramp_ ? ramp_->step() : path_->step();
  result.fill.address += jobs_[job_].first_entry;
  result.is_up = !result.fill.stores;
  if (ramp_ ? ramp_->done() : path_->done()) {
    ++job_;
    open_job();
  }
  return result;
}

void TableLoad::advance(std::uint64_t steps, TableBank& bank, LoadRecord& record) {
  while (steps > 0 && !done()) {
    const TableJob& job = jobs_[job_];
    const std::uint64_t whole = steps_of(job, static_cast<std::int64_t>(argument_cycles_));
    if (at_start_ && whole <= steps) {
      run(job, bank);
      record.mark(job);
      steps -= whole;
      steps_ += whole;
      ++job_;
      open_job();
      continue;
    }
    record.forget(job);
    const std::size_t before = job_;
    const LoadStep one = step();
    if (one.fill.stores) bank.write(job.table, one.fill.address, one.fill.value);
    if (job_ != before) record.mark(job);
    --steps;
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
