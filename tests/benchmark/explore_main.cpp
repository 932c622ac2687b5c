// What a point of a sweep costs beside the same simulation called in-process, and what a second job gains: see
// README.md.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "src/explore/runner.h"
#include "src/run/simulate.h"
#include "tests/benchmark/measuring.h"
#include "tests/support/forked.h"

namespace rastertlm::benchmark {
namespace {

namespace fs = std::filesystem;

struct Settings {
  std::uint64_t points = 200;  // of a sweep
  std::uint64_t pairs = 5;
  std::uint64_t size = 128;  // columns and lines
  bool reference = true;
};

struct Times {
  double passed = 0.0;  // ms a point
  double worked = 0.0;  // ms of all processors a point
};

double worked(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto ms = [](const timeval& time) {
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

double passed_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

class Benchmark {
 public:
  Benchmark(const Settings& settings, const std::string& folder)
      : settings_(settings), store_(folder + "/store.sqlite"), sweep_file_(folder + "/sweep.toml") {
    const std::string source = RASTERTLM_SOURCE_DIR;
    std::ofstream(sweep_file_) << fmt::format(
        "schema = 1\nmachine = \"{0}/configs/machines/imogene.toml\"\nscene = \"{0}/configs/scenes/teapot.toml\"\n"
        "reference = {1}\nset.video.columns = {2}\nset.video.lines = {2}\n"
        "[[vary]]\npath = \"host.link_mbit_per_s\"\nfrom = 5\nto = {3}\nstep = 1\n"
        "[[objective]]\npath = \"answer.frame_rate_hz\"\nsense = \"maximise\"\n",
        source, settings.reference, settings.size, settings.points + 4);
    machine_ = source + "/configs/machines/imogene.toml";
    scene_ = source + "/configs/scenes/teapot.toml";
  }

  // SystemC allows one simulation a process: each has one, which is not counted.
  Times in_process() const {
    Times sum;
    for (std::uint64_t point = 0; point < settings_.points; ++point) {
      const std::string text = test::in_child([&] {
        const double before = worked(RUSAGE_SELF);
        const auto start = std::chrono::steady_clock::now();
        const run::Inputs inputs = run::read_inputs(
            machine_, scene_,
            {fmt::format("video.columns={}", settings_.size), fmt::format("video.lines={}", settings_.size),
             fmt::format("host.link_mbit_per_s={}", point + 5)});
        run::Options options;
        options.reference = settings_.reference;
        run::simulate(inputs, options, {});
        return fmt::format("{} {}", passed_since(start), worked(RUSAGE_SELF) - before);
      });
      sum.passed += std::strtod(text.c_str(), nullptr);
      sum.worked += std::strtod(text.c_str() + text.find(' '), nullptr);
    }
    return a_point(sum);
  }

  // With a store on disk, as a user has it.
  Times sweep(std::size_t jobs) {
    fs::remove(store_);
    explore::Sweep sweep = explore::read_sweep(sweep_file_);
    const explore::Design design(sweep);
    const double before = worked(RUSAGE_SELF) + worked(RUSAGE_CHILDREN);
    const auto start = std::chrono::steady_clock::now();
    explore::RunOptions options;
    options.jobs = jobs;
    explore::Store store(store_, explore::Store::Opening::fresh);
    const explore::RunStatus status = explore::run_sweep(sweep, design, store, options, [](const auto&) {});
    Times sum{passed_since(start), worked(RUSAGE_SELF) + worked(RUSAGE_CHILDREN) - before};
    if (status.simulated != settings_.points || status.failed != 0) throw std::runtime_error("points are missing");
    std::string figures;
    for (const explore::Row& row : store.table().rows)
      figures += row.config_digest + fmt::format("{}", *row.figures[0]);
    if (figures_.empty()) figures_ = figures;
    if (figures != figures_) throw std::runtime_error("figures depend on the number of jobs");
    return a_point(sum);
  }

 private:
  Times a_point(const Times& sum) const {
    const auto points = static_cast<double>(settings_.points);
    return {sum.passed / points, sum.worked / points};
  }

  Settings settings_;
  std::string store_;
  std::string sweep_file_;
  std::string machine_;
  std::string scene_;
  std::string figures_;
};

int run(const Settings& settings) {
  std::string folder = (fs::temp_directory_path() / "rastertlm_benchmark_XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) return 1;
  Benchmark benchmark(settings, folder);
  std::vector<double> alone_passed, alone_worked, one_passed, one_worked, gain;
  for (std::uint64_t pair = 0; pair < settings.pairs; ++pair) {
    const Times alone = benchmark.in_process();
    const Times one = benchmark.sweep(1);
    const Times two = benchmark.sweep(2);
    alone_passed.push_back(alone.passed);
    alone_worked.push_back(alone.worked);
    one_passed.push_back(one.passed);
    one_worked.push_back(one.worked);
    gain.push_back(one.passed / two.passed);
  }
  std::printf("%s", fmt::format("{} points, {} x {}, {}; medians of {}\n"
                                "in-process       {:.2f} ms a point, {:.2f} ms worked\n"
                                "sweep, one job   {:.2f} ms a point, {:.2f} ms worked\n"
                                "a point more     {:.2f} ms, {:.2f} ms worked\n"
                                "two jobs         {:.2f} times one\n",
                                settings.points, settings.size, settings.size,
                                settings.reference ? "with exact pictures" : "without exact pictures", settings.pairs,
                                median(alone_passed), median(alone_worked), median(one_passed), median(one_worked),
                                median(one_passed) - median(alone_passed), median(one_worked) - median(alone_worked),
                                median(gain))
                        .c_str());
  fs::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace rastertlm::benchmark

extern "C" int sc_main(int, char**) { return 0; }

int main(int argc, char** argv) {
  rastertlm::benchmark::Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto number = [&] { return i + 1 < argc ? std::strtoull(argv[++i], nullptr, 10) : 0ULL; };
    if (word == "--points") settings.points = number();
    if (word == "--pairs") settings.pairs = number();
    if (word == "--size") settings.size = number();
    if (word == "--no-reference") settings.reference = false;
  }
  if (settings.points == 0 || settings.pairs == 0 || settings.size == 0) return 2;
  try {
    return rastertlm::benchmark::run(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_explore: %s\n", error.what());
    return 1;
  }
}
