#include "src/cli/explore_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <thread>

#include "src/cli/explore_progress.h"
#include "src/cli/usage.h"
#include "src/explore/design.h"
#include "src/explore/runner.h"
#include "src/explore/store.h"
#include "src/explore/sweep.h"
#include "src/explore/sweep_csv.h"
#include "src/explore/sweep_page.h"
#include "src/explore/sweep_text.h"
#include "src/explore/table_text.h"
#include "src/report/number_text.h"
#include "src/report/text_file.h"

namespace rastertlm::cli {
namespace {

using explore::RunStatus;

constexpr std::uint64_t kMostUnasked = 100'000;  // points that are simulated without --yes
constexpr int kSignalExit = 128;

CLI::Option* validated(CLI::Option* option, std::string (*check)(const std::string&)) {
  return option->check(CLI::Validator([check](std::string& text) { return check(text); }, "", ""));
}

std::string shard_number(const std::string& text) {
  const auto [share, shares] = share_of(text);
  if (share >= 1 && share <= shares) return {};
  return fmt::format("'{}' is not K/N, the share K, from 1, of N", text);
}

// A sweep that somebody mistyped would run for weeks.
void refuse_too_many(const explore::Sweep& sweep, const explore::Design& design, std::uint64_t points,
                     std::size_t jobs) {
  const double seconds = explore::time_of_a_point(sweep, design) * static_cast<double>(points);
  throw InputError(Diagnostic{sweep.file, 0, "",
                              fmt::format("the sweep has {} points here, {} with {} (by its first point); --yes "
                                          "simulates more than {}",
                                          report::grouped(points), rough_time(seconds / static_cast<double>(jobs)),
                                          report::counted(jobs, "job", "jobs"), report::grouped(kMostUnasked))});
}

// Why points failed: the first of them, and how many others did.
std::string failure_text(const RunStatus& status) {
  std::string error;
  for (const char c : status.first_error) error += c == '\n' ? std::string("; ") : std::string(1, c);
  const std::uint64_t others = status.failed - 1;
  return fmt::format("rastertlm: point {} failed: {}{}\n", status.first_failed, error,
                     others == 0 ? std::string()
                                 : fmt::format("; so did {}, `explore show` lists why",
                                               report::counted(others, "other point", "other points")));
}

// Points that are missing leave the sweep's question half answered; where all are, the reason says whose fault it was.
ExitCode code_of(const RunStatus& status) {
  if (status.failed == 0) return ExitCode::kDone;
  if (status.failed < status.points) return ExitCode::kRequirementMissed;
  return status.wrong == status.failed ? ExitCode::kBadInput : ExitCode::kModelBroken;
}

ExitCode end_of(const RunStatus& status, const std::string& store) {
  using report::grouped;
  if (status.signal != 0) {
    const std::string text = fmt::format("rastertlm: {}: {} of {} points are in {}; --resume goes on\n",
                                         status.signal == SIGINT ? "interrupted" : "terminated",
                                         grouped(status.found + status.simulated), grouped(status.points), store);
    std::fputs(text.c_str(), stderr);
    return static_cast<ExitCode>(kSignalExit + status.signal);
  }
  const std::string text = fmt::format(
      "{}: {} simulated, {} had their result; {} failed. {:.1f} s, {:.3g} points/s\n"
      "{}: `rastertlm explore show` shows it\n",
      report::counted(status.points, "point", "points"), grouped(status.simulated), grouped(status.found),
      grouped(status.failed), status.seconds,
      status.seconds > 0.0 ? static_cast<double>(status.simulated) / status.seconds : 0.0, store);
  std::fputs(text.c_str(), stdout);
  if (status.failed > 0) std::fputs(failure_text(status).c_str(), stderr);
  return code_of(status);
}

}  // namespace

void ExploreCommand::declare(CLI::App& app) {
  app_ = &app;
  app.require_subcommand(1);
  declare_run(*app.add_subcommand("run", "Simulate what a store lacks of a sweep"));
  declare_merge(*app.add_subcommand("merge", "Join the stores of a sweep's shares"));
  declare_show(*app.add_subcommand("show", "Print what a store holds"));
}

void ExploreCommand::declare_run(CLI::App& app) {
  app.add_option("SWEEP", sweep_, "sweep file")->required();
  app.add_option("--set", overrides_,
                 "path=value: set a parameter of every point's machine or scene; of a list's element\n"
                 "as object[0].radius=2")
      ->type_name("path=value")
      ->allow_extra_args(false);
  validated(app.add_option("--store", store_, "file of the results (default: out/<sweep>.sqlite)")->type_name("FILE"),
            not_empty);
  validated(app.add_option("--jobs", jobs_, "simulations at a time (default: one a processor)")->type_name("N"),
            whole_from_one);
  validated(
      app.add_option("--shard", shard_, "simulate the K-th of N shares, into a store of its own")->type_name("K/N"),
      shard_number);
  app.add_flag("--resume", resume_, "go on with a store that is there: what it holds is not simulated again");
  app.add_flag("--retry", retry_, "simulate again what failed");
  app.add_flag("--yes", yes_, fmt::format("simulate also more than {} points", report::grouped(kMostUnasked)));
}

void ExploreCommand::declare_merge(CLI::App& app) {
  app.add_option("OUT", store_, "store to make")->required();
  app.add_option("IN", parts_, "stores of one sweep")->required();
}

void ExploreCommand::declare_show(CLI::App& app) {
  app.add_option("STORE", store_, "store")->required();
  auto* point = app.add_option("--point", point_,
                               "from which one parameter is moved one step (default: the baseline, else the answer)");
  validated(point->type_name("N"), frame_number);
  auto* tolerance =
      app.add_option("--tolerance", tolerance_, "part by which a figure may be worse and count as no worse");
  validated(tolerance->capture_default_str()->type_name("FRACTION"), part_of_one);
  validated(app.add_option("--rows", rows_, "rows of a table at most")->capture_default_str()->type_name("N"),
            whole_from_one);
  std::vector<CLI::Option*> forms{
      validated(app.add_option("--html", html_, "write a page to look at instead")->type_name("FILE"), not_empty),
      app.add_flag("--list", list_, "the points in their order instead"),
      app.add_flag("--csv", csv_, "the points as CSV, with the front and what it beats"),
      app.add_flag("--csv-sensitivity", csv_sensitivity_, "how parameters move the objectives, as CSV"),
      app.add_flag("--csv-steps", csv_steps_, "single steps from --point, as CSV")};
  for (CLI::Option* form : forms)
    for (CLI::Option* other : forms)
      if (form != other) form->excludes(other);
}

ExitCode ExploreCommand::run() {
  if (app_->got_subcommand("merge")) return merge();
  if (app_->got_subcommand("show")) return show();
  return run_sweep();
}

std::string ExploreCommand::store_of(const std::string& sweep_name) const {
  if (!store_.empty()) return store_;
  std::string share = shard_;
  std::replace(share.begin(), share.end(), '/', '_');
  return fmt::format("out/{}{}{}.sqlite", sweep_name, share.empty() ? "" : ".shard_", share);
}

ExitCode ExploreCommand::run_sweep() {
  explore::Sweep sweep = explore::read_sweep(sweep_, overrides_);
  const explore::Design design(sweep);
  explore::RunOptions options;
  options.jobs = jobs_ > 0 ? jobs_ : std::max(1U, std::thread::hardware_concurrency());
  options.retry = retry_;
  if (!shard_.empty()) {
    const auto [share, shares] = share_of(shard_);
    options.shard = share - 1;
    options.shards = shares;
  }
  const std::uint64_t points = (design.size() + options.shards - 1 - options.shard) / options.shards;
  if (points > kMostUnasked && !yes_) refuse_too_many(sweep, design, points, options.jobs);
  const std::string file = store_of(sweep.name);
  RunStatus status;
  {
    explore::Store store(file, resume_ ? explore::Store::Opening::resume : explore::Store::Opening::fresh);
    store.forget_front();
    ExploreProgress progress;
    status = explore::run_sweep(sweep, design, store, options, [&](const RunStatus& now) { progress.show(now); });
    if (status.signal == 0) store.keep_front();
  }
  return end_of(status, file);
}

ExitCode ExploreCommand::merge() {
  const std::string lacking = explore::lacking_text(explore::merge_stores(store_, parts_));
  std::fputs(fmt::format("{}: {} joined\n", store_, report::counted(parts_.size(), "store", "stores")).c_str(), stdout);
  if (!lacking.empty())
    std::fputs(fmt::format("{}; `explore run --resume` with this store goes on\n", lacking).c_str(), stdout);
  return ExitCode::kDone;
}

// The row of --point; none where it was not given.
std::optional<std::size_t> ExploreCommand::chosen_row(const explore::SweepTable& table) const {
  if (!point_) return {};
  const auto found = std::ranges::find_if(table.rows, [&](const explore::Row& row) { return row.number == *point_; });
  if (found == table.rows.end())
    throw InputError(Diagnostic{
        store_, 0, "--point",
        fmt::format("{} is no point of the sweep, which has {}", *point_, report::grouped(table.rows.size()))});
  if (found->state != explore::State::done)
    throw InputError(Diagnostic{store_, 0, "--point",
                                fmt::format("point {} {}, so it has no figures", *point_,
                                            found->state == explore::State::failed ? "failed" : "has not run yet")});
  return static_cast<std::size_t>(found - table.rows.begin());
}

std::string ExploreCommand::shown(const explore::SweepTable& table) const {
  const std::optional<std::size_t> from = chosen_row(table);
  if (list_) return explore::table_text(table, rows_);
  if (csv_sensitivity_) return explore::sensitivity_csv(table, explore::find_sensitivity(table));
  if (csv_) return explore::table_csv(table, explore::find_front(table));
  if (!csv_steps_) return explore::sweep_text(table, {from, tolerance_, rows_});
  const std::optional<std::size_t> start = explore::start_of_steps(table, explore::find_front(table), from);
  if (!start) throw InputError(Diagnostic{store_, 0, "", "no point is done, so there is none to step from"});
  return explore::what_if_csv(table, explore::find_what_if(table, *start, tolerance_));
}

ExitCode ExploreCommand::show() {
  const explore::SweepTable table = explore::Store(store_, explore::Store::Opening::look).table();
  if (html_.empty()) {
    std::fputs(shown(table).c_str(), stdout);
  } else {
    report::make_folder_of(html_);
    report::write_whole_file(html_, explore::sweep_page(table));
    std::fputs((html_ + '\n').c_str(), stdout);
  }
  return ExitCode::kDone;
}

}  // namespace rastertlm::cli
