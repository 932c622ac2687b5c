#include "src/explore/runner.h"

#include <malloc.h>
#include <poll.h>

#include <algorithm>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "src/base/errors.h"
#include "src/explore/figures.h"
#include "src/explore/point.h"
#include "src/explore/shared_pictures.h"
#include "src/explore/stop_signals.h"
#include "src/explore/worker.h"
#include "src/report/figure_path.h"

namespace rastertlm::explore {
namespace {

constexpr std::size_t kAhead = 16;               // points that are made before a worker is free for them
constexpr std::size_t kLinkedAtOnce = 1000;      // points that had their result, a transaction
constexpr std::uint64_t kMostPictured = 10'000;  // points: a picture of each is kept
constexpr int kTick = 200;                       // ms: progress goes on
constexpr std::size_t kSharedBytes = std::size_t{512} << 20;

using Clock = std::chrono::steady_clock;

struct Job {
  Point point;
  std::vector<std::uint64_t> numbers;  // of the points that have this configuration
};

// The exact pictures that a set of jobs shares, and who is rendering them.
struct Shared {
  std::unique_ptr<SharedPictures> pictures;
  bool ready = false;
};

struct Running {
  Job job;
  std::unique_ptr<Worker> worker;
  Shared* renders = nullptr;
};

// A page that is written after a worker was forked is copied first: so what is freed is joined at once, not in passes
// over the whole heap, and no memory is given back that the next point asks for again.
void keep_heap_still() {
  constexpr int kLarge = 1 << 30;
  ::mallopt(M_MXFAST, 0);
  ::mallopt(M_TRIM_THRESHOLD, kLarge);
  ::mallopt(M_MMAP_THRESHOLD, kLarge);
}

class Runner {
 public:
  Runner(const Sweep& sweep, const Design& design, Store& store, const RunOptions& options)
      : sweep_(sweep), design_(design), store_(store), options_(options), maker_(sweep) {
    for (const Objective& objective : sweep.objectives) add_figure(objective.path);
    for (const FurtherFigure& column : sweep.further) add_figure(column.path);
    for (const Constraint& constraint : sweep.constraints) add_figure(constraint.path);
    status_.points = design.size() / options.shards + (design.size() % options.shards > options.shard ? 1 : 0);
  }

  RunStatus run(const std::function<void(const RunStatus&)>& progress) {
    keep_heap_still();
    const StopSignals signals;
    sweep_id_ = store_.enter(sweep_, design_, maker_.sweep_digest());
    store_.complete_figures(figures_);
    store_.begin_session(sweep_id_);
    next_ = options_.shard;
    for (;;) {
      status_.signal = StopSignals::received();
      if (status_.signal != 0) break;
      while (running_.size() < options_.jobs && dispatch()) {
      }
      // One at a time: a worker that is done is not kept waiting.
      if (is_room_ahead()) {
        add(next_);
        next_ += options_.shards;
      }
      if (running_.empty() && ahead_.empty() && next_ >= design_.size()) break;
      wait(signals);
      status_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
      progress(status_);
    }
    running_.clear();  // whoever is still at work is ended
    link_found();
    status_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    if (status_.signal == 0 && !checked_) check(store_.any_report());
    return status_;
  }

 private:
  void add_figure(const std::string& path) {
    if (std::find(figures_.begin(), figures_.end(), path) == figures_.end()) figures_.push_back(path);
  }

  bool is_room_ahead() const { return ahead_.size() < kAhead && next_ < design_.size(); }

  void add(std::uint64_t number) {
    Point point = maker_.make(design_.point(number));
    if (Job* same = job_of(point.key)) {
      same->numbers.push_back(number);
      ++status_.found;
      return;
    }
    const std::optional<KnownResult> known = store_.find(point.key);
    if (known && (known->state == State::done || !options_.retry || retried_.contains(point.key))) {
      found_.emplace_back(number, known->id);
      ++status_.found;
      if (known->state == State::failed) count_failed({number}, known->error, point.inputs == nullptr);
      if (found_.size() >= kLinkedAtOnce) link_found();
      return;
    }
    if (known) retried_.insert(point.key);
    Job job{std::move(point), {number}};
    if (job.point.inputs == nullptr) {
      PointResult wrong;
      wrong.state = State::failed;
      wrong.error = job.point.error;
      record(job, std::move(wrong));
      return;
    }
    ahead_.push_back(std::move(job));
  }

  Job* job_of(const std::string& key) {
    for (Job& job : ahead_)
      if (job.point.key == key) return &job;
    for (Running& one : running_)
      if (one.job.point.key == key) return &one.job;
    return nullptr;
  }

  // Starts the first job whose exact pictures nobody is rendering just now; false where there is none.
  bool dispatch() {
    for (auto job = ahead_.begin(); job != ahead_.end(); ++job) {
      Shared* shared = sweep_.reference ? &shared_of(*job) : nullptr;
      const bool rendered = shared != nullptr && shared->pictures != nullptr;
      if (rendered && !shared->ready) continue;
      if (shared != nullptr && !rendered) shared->pictures = std::make_unique<SharedPictures>(job->point.exact);
      start(job, shared, !rendered);
      return true;
    }
    return false;
  }

  void start(const std::deque<Job>::iterator& job, Shared* shared, bool renders) {
    Running one{std::move(*job), nullptr, renders ? shared : nullptr};
    ahead_.erase(job);
    const std::string& scene = one.job.point.scene_digest;
    const bool known_scene = scenes_.contains(scene) || store_.has_scene(scene);
    const Work work{*one.job.point.inputs,
                    sweep_.frames,
                    sweep_.reference,
                    sweep_.thumbnails && design_.size() <= kMostPictured,
                    !known_scene,
                    figures_,
                    shared == nullptr ? nullptr : shared->pictures.get(),
                    renders};
    store_.count_start();
    one.worker = std::make_unique<Worker>(work);
    running_.push_back(std::move(one));
  }

  // Those that have not been asked for the longest are given up for new ones.
  Shared& shared_of(const Job& job) {
    const std::string& key = job.point.exact.key;
    const auto known = shared_.find(key);
    if (known != shared_.end()) return known->second;
    std::size_t bytes = 0;
    for (const std::string& older : shared_order_)
      if (const Shared& one = shared_.at(older); one.pictures != nullptr) bytes += one.pictures->written_bytes();
    for (auto older = shared_order_.begin(); older != shared_order_.end() && bytes > kSharedBytes;) {
      const Shared& one = shared_.at(*older);
      if (!one.ready) {  // somebody is rendering them
        ++older;
        continue;
      }
      bytes -= one.pictures->written_bytes();
      shared_.erase(*older);
      older = shared_order_.erase(older);
    }
    shared_order_.push_back(key);
    return shared_[key];
  }

  void wait(const StopSignals& signals) {
    std::vector<pollfd> descriptors;
    descriptors.reserve(running_.size());
    for (const Running& one : running_) descriptors.push_back({one.worker->descriptor(), POLLIN, 0});
    // While there are points to make, nobody waits longer than it takes to see who is done.
    const bool idle = running_.size() < options_.jobs && !ahead_.empty() && running_.empty();
    signals.wait(descriptors, is_room_ahead() || idle ? 0 : kTick);
    std::size_t place = 0;
    for (auto one = running_.begin(); one != running_.end(); ++place) {
      if (descriptors[place].revents == 0 || !one->worker->read()) {
        ++one;
        continue;
      }
      PointResult result = one->worker->result();
      if (one->renders != nullptr) {
        // Who failed may not have rendered them: then it is the next one's turn.
        one->renders->ready = result.state == State::done;
        if (!one->renders->ready) one->renders->pictures.reset();
      }
      const Job job = std::move(one->job);
      ended_ = std::move(one->worker);
      one = running_.erase(one);
      record(job, std::move(result));
    }
  }

  void record(const Job& job, PointResult result) {
    result.key = job.point.key;
    result.config_digest = job.point.config_digest;
    result.scene_digest = job.point.scene_digest;
    store_.record(result, sweep_id_, job.numbers);
    if (!result.scene_toml.empty()) scenes_.insert(result.scene_digest);
    ++status_.simulated;
    if (result.state == State::failed) count_failed(job.numbers, result.error, job.point.inputs == nullptr);
    if (!checked_ && result.state == State::done) check(expanded(result.report, store_.database().file()));
  }

  void count_failed(const std::vector<std::uint64_t>& numbers, const std::string& error, bool wrong) {
    if (status_.failed == 0 || numbers.front() < status_.first_failed) {
      status_.first_failed = numbers.front();
      status_.first_error = error;
    }
    status_.failed += numbers.size();
    if (wrong) status_.wrong += numbers.size();
  }

  void link_found() {
    store_.link(sweep_id_, found_);
    found_.clear();
  }

  // A name of an element that the reports do not have is a mistake of the sweep, which only a report shows.
  void check(const std::string& report) {
    if (report.empty()) return;
    checked_ = true;
    const report::Figures figures(report, store_.database().file());
    Diagnostics diagnostics;
    for (std::size_t i = 0; i < sweep_.objectives.size(); ++i)
      add_absent(figures, sweep_.objectives[i].path, sweep_.written_objectives[i], diagnostics);
    for (std::size_t i = 0; i < sweep_.further.size(); ++i)
      add_absent(figures, sweep_.further[i].path, sweep_.written_further[i], diagnostics);
    for (const Constraint& constraint : sweep_.constraints)
      add_absent(figures, constraint.path, {false, constraint.line}, diagnostics);
    diagnostics.throw_if_any();
  }

  void add_absent(const report::Figures& figures, const std::string& path, const Sweep::Written& written,
                  Diagnostics& diagnostics) const {
    const std::string absent = parameter_of(path).empty() && !written.optional ? figures.absent(path) : "";
    if (!absent.empty()) diagnostics.add({sweep_.file, written.line, path, absent});
  }

  const Sweep& sweep_;
  const Design& design_;
  Store& store_;
  RunOptions options_;
  PointMaker maker_;
  std::int64_t sweep_id_ = 0;
  std::uint64_t next_ = 0;  // the point to make next
  std::vector<std::string> figures_;
  std::deque<Job> ahead_;
  std::list<Running> running_;
  std::unique_ptr<Worker> ended_;  // its process may still give back memory: waited for as the next one ends
  std::vector<std::pair<std::uint64_t, std::int64_t>> found_;
  std::set<std::string> scenes_;
  std::set<std::string> retried_;
  std::map<std::string, Shared> shared_;
  std::list<std::string> shared_order_;
  bool checked_ = false;
  Clock::time_point start_ = Clock::now();
  RunStatus status_;
};

}  // namespace

RunStatus run_sweep(const Sweep& sweep, const Design& design, Store& store, const RunOptions& options,
                    const std::function<void(const RunStatus&)>& progress) {
  return Runner(sweep, design, store, options).run(progress);
}

double time_of_a_point(const Sweep& sweep, const Design& design) {
  PointMaker maker(sweep);
  const auto start = Clock::now();
  const Point point = maker.make(design.point(0));
  const std::vector<std::string> none;
  if (point.inputs != nullptr) {
    Worker worker({*point.inputs, sweep.frames, sweep.reference, false, false, none, nullptr, false});
    while (!worker.read()) {
    }
    worker.result();
  }
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace rastertlm::explore
