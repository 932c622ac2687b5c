// Times the simulation beside a plain loop: see README.md.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <systemc>

#include "tests/benchmark/frame_pairs.h"
#include "tests/benchmark/plain_variants.h"

namespace rastertlm::benchmark {
namespace {

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

void print_head() {
  fmt::print("{:>9} {:>10} {:>9} {:>9} | {:>9} {:>9} {:>6} | {:>8} {:>8} | {:>7} {:>7} {:>7} | {:>7} {:>7} {:>9}\n",
             "triangles", "processors", "covered", "visible", "simulated", "plain", "ratio", "ns/cov", "ns/vis",
             "set-up", "spans", "shading", "levels", "metrics", "peak MB");
}

// False where the pictures differ or the run measured nothing.
bool print_row(const Case& wanted) {
  const Measured m = measure_apart(wanted);
  const auto ms = [](double ns) { return ns * 1e-6; };
  const auto each = [&](std::uint64_t count) { return count == 0 ? 0.0 : m.plain / static_cast<double>(count); };
  fmt::print(
      "{:>9} {:>10} {:>9} {:>9} | {:>9.3f} {:>9.3f} {:>6.3f} | {:>8.3f} {:>8.3f} | {:>7.3f} {:>7.3f} {:>7.3f} | "
      "{:>7.3f} {:>7.3f} {:>9.1f}\n",
      wanted.triangles, wanted.processors, m.covered, m.visible, ms(m.simulated), ms(m.plain),
      m.plain > 0.0 ? m.ratio() : 0.0, each(m.covered), each(m.visible), ms(m.plain_set_up), ms(m.plain_spans),
      ms(m.plain_shading), ms(m.levels), ms(m.metrics), static_cast<double>(m.peak_bytes) * 1e-6);
  std::fflush(stdout);
  if (m.different_bytes != 0)
    fmt::print(stderr, "{} bytes of RGB differ in {} frames\n", m.different_bytes, m.frames_compared);
  if (m.repeated_frames != 0) fmt::print(stderr, "{} frames were shown again: the host was late\n", m.repeated_frames);
  return m.different_bytes == 0 && m.repeated_frames == 0;
}

std::size_t processors_for(std::size_t triangles) { return std::max<std::size_t>(1024, (triangles + 7) / 8 * 8); }

std::vector<Case> cases_of(const std::string& series, const Case& given) {
  std::vector<Case> cases;
  const auto add = [&](std::size_t triangles, std::size_t processors, double pixels) {
    Case one = given;
    one.triangles = triangles;
    one.processors = processors;
    one.pixels = pixels;
    cases.push_back(one);
  };
  constexpr double kScreen = 512.0 * 512.0;
  if (series == "one") cases.push_back(given);
  if (series == "ratio")
    for (const std::size_t triangles : {64, 1024}) add(triangles, 1024, 1.5 * kScreen);
  if (series == "processors")
    for (std::size_t processors = 64; processors <= 65536; processors *= 4) add(64, processors, 1.5 * kScreen);
  if (series == "pixels")
    for (const double screens : {0.375, 0.75, 1.5, 3.0, 6.0}) add(1024, 1024, screens * kScreen);
  if (series == "triangles")
    for (std::size_t triangles = 1000; triangles <= 1'000'000; triangles *= 10)
      add(triangles, processors_for(triangles), 4.0 * static_cast<double>(triangles));
  if (series == "memory") {
    add(100'000, 100'000, 1.5 * kScreen);
    cases.back().plain = false;
  }
  return cases;
}

constexpr const char* kUsage = R"(benchmark_frame [ratio|processors|pixels|triangles|memory|one]... [options]
  Times simulated frames beside a plain loop that draws the same; exit code 1 where the pictures differ.
  --pairs N        frames timed of each (30)
  one: --triangles N (64)  --processors N, a multiple of 8 (1024)  --pixels N that the triangles cover together (393216)
  --no-plain       the simulation alone
  --pipeline       the decision unit as a pipeline
)";

struct Arguments {
  std::vector<std::string> series;
  Case given;
};

Arguments read(std::span<char*> words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = words[i];
    const auto number = [&]() -> std::size_t {
      if (i + 1 == words.size()) throw std::invalid_argument(word + " needs a number");
      return std::stoul(words[++i]);
    };
    if (word == "--pairs") {
      arguments.given.pairs = number();
    } else if (word == "--triangles") {
      arguments.given.triangles = number();
    } else if (word == "--processors") {
      arguments.given.processors = number();
    } else if (word == "--pixels") {
      arguments.given.pixels = static_cast<double>(number());
    } else if (word == "--no-plain") {
      arguments.given.plain = false;
    } else if (word == "--pipeline") {
      arguments.given.pipeline = true;
    } else if (cases_of(word, {}).empty()) {
      throw std::invalid_argument("unknown argument " + word);
    } else {
      arguments.series.push_back(word);
    }
  }
  if (arguments.series.empty()) arguments.series.emplace_back("ratio");
  return arguments;
}

int run(const Arguments& arguments) {
  fmt::print("Processor: {}; plain loop for {}. Milliseconds a frame, medians of {} interleaved pairs.\n",
             processor_name(), plain::best_variant(), arguments.given.pairs);
  bool good = true;
  for (const std::string& name : arguments.series) {
    fmt::print("\n{}\n", name);
    print_head();
    for (const Case& wanted : cases_of(name, arguments.given)) good = print_row(wanted) && good;
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace rastertlm::benchmark

int sc_main(int, char**) { return 0; }

int main(int argc, char** argv) {
  try {
    return rastertlm::benchmark::run(rastertlm::benchmark::read(std::span(argv, argv + argc).subspan(1)));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n{}", error.what(), rastertlm::benchmark::kUsage);
    return 2;
  }
}
