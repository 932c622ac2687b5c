#include "src/explore/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "src/base/errors.h"
#include "src/config/document.h"
#include "src/explore/ranges.h"
#include "src/run/input_files.h"

namespace rastertlm::explore {
namespace {

constexpr std::uint64_t kMostPoints = 1'000'000'000'000;
constexpr std::uint64_t kMostDrawn = 10'000'000;

// SplitMix64 (Steele, Lea, Flood 2014): the draws are the same with every library.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream) : state_(seed ^ (stream * 0x9E3779B97F4A7C15ULL)) { next(); }
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  // From 0, below 1, 53 bits.
  double fraction() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(fraction() * static_cast<double>(count)));
  }

 private:
  std::uint64_t state_;
};

// The fraction of an axis that each point draws: anywhere, or each in a stratum of its own.
std::vector<double> fractions(Mode mode, std::uint64_t points, Random& random) {
  std::vector<double> fractions(points);
  if (mode == Mode::random) {
    for (double& fraction : fractions) fraction = random.fraction();
    return fractions;
  }
  std::vector<std::size_t> strata(points);
  std::iota(strata.begin(), strata.end(), std::size_t{0});
  for (std::size_t i = strata.size(); i > 1; --i) std::swap(strata[i - 1], strata[random.below(i)]);
  for (std::size_t i = 0; i < strata.size(); ++i)
    fractions[i] = (static_cast<double>(strata[i]) + random.fraction()) / static_cast<double>(points);
  return fractions;
}

double number_of(const config::Raw& raw) {
  if (const auto* whole = std::get_if<std::int64_t>(&raw.value)) return static_cast<double>(*whole);
  return std::get<double>(raw.value);
}

// The values that were drawn become the axis' choices, in order, after the baseline's; the points say which.
std::vector<std::size_t> choose(Vary& axis, const std::vector<double>& fractions) {
  std::vector<config::Raw> values;
  values.reserve(fractions.size());
  std::map<double, config::Override> drawn;
  for (const double fraction : fractions) {
    values.push_back(value_at(*axis.span, fraction));
    drawn.emplace(number_of(values.back()), run::override_of(axis.path, values.back()));
  }
  std::map<double, std::size_t> places;
  const std::size_t before = axis.choices.size();
  for (const auto& [number, set] : drawn) {
    std::size_t place = 0;
    while (place < before && axis.choices[place].text != set.text) ++place;
    if (place == before) {
      place = axis.choices.size();
      axis.choices.push_back({set.text, {set}, ""});
    }
    places[number] = place;
  }
  std::vector<std::size_t> chosen;
  chosen.reserve(values.size());
  for (const config::Raw& value : values) chosen.push_back(places.at(number_of(value)));
  return chosen;
}

}  // namespace

Design::Design(Sweep& sweep) : mode_(sweep.mode) {
  if (mode_ == Mode::random || mode_ == Mode::latin_hypercube) draw(sweep);
  for (const Vary& axis : sweep.axes) {
    sizes_.push_back(axis.choices.size());
    if (sweep.baseline) start_.push_back(*axis.start);
  }
  if (mode_ == Mode::grid) count_grid(sweep);
  if (mode_ == Mode::one_at_a_time) count_one_at_a_time(sweep);
  if (mode_ != Mode::grid && sweep.baseline) baseline_ = 0;
}

void Design::count_grid(const Sweep& sweep) {
  size_ = 1;
  for (const std::size_t size : sizes_) {
    if (size > kMostPoints / size_)
      throw InputError(Diagnostic{sweep.file, 0, "vary", fmt::format("the grid has more than {} points", kMostPoints)});
    size_ *= size;
  }
  if (!sweep.baseline) return;
  std::uint64_t number = 0;
  for (std::size_t axis = 0; axis < sizes_.size(); ++axis) number = number * sizes_[axis] + start_[axis];
  baseline_ = number;
}

void Design::count_one_at_a_time(const Sweep&) {
  size_ = 1;
  for (const std::size_t size : sizes_) size_ += size - 1;
}

void Design::draw(Sweep& sweep) {
  size_ = sweep.points + (sweep.baseline ? 1 : 0);
  if (sweep.points > kMostDrawn)
    throw InputError(Diagnostic{sweep.file, 0, "points", fmt::format("more than {} points are drawn", kMostDrawn)});
  for (std::size_t axis = 0; axis < sweep.axes.size(); ++axis) draw_axis(sweep, axis, drawn_);
}

void Design::draw_axis(Sweep& sweep, std::size_t axis, std::vector<std::vector<std::size_t>>& drawn) const {
  Random random(sweep.seed, axis + 1);
  Vary& vary = sweep.axes[axis];
  const std::vector<double> drawn_fractions = fractions(mode_, sweep.points, random);
  std::vector<std::size_t> chosen;
  if (vary.span) {
    chosen = choose(vary, drawn_fractions);
  } else {
    const auto count = static_cast<double>(vary.choices.size());
    for (const double fraction : drawn_fractions)
      chosen.push_back(std::min(vary.choices.size() - 1, static_cast<std::size_t>(fraction * count)));
  }
  drawn.push_back(std::move(chosen));
}

std::vector<std::size_t> Design::point(std::uint64_t number) const {
  std::vector<std::size_t> choices(sizes_.size(), 0);
  if (mode_ == Mode::grid) {
    for (std::size_t axis = sizes_.size(); axis-- > 0; number /= sizes_[axis])
      choices[axis] = static_cast<std::size_t>(number % sizes_[axis]);
    return choices;
  }
  if (baseline_ && number == 0) return start_;
  if (mode_ == Mode::one_at_a_time) {
    choices = start_;
    std::uint64_t left = number - 1;
    for (std::size_t axis = 0; axis < sizes_.size(); ++axis) {
      if (left < sizes_[axis] - 1) {
        const auto place = static_cast<std::size_t>(left);
        choices[axis] = place < start_[axis] ? place : place + 1;
        return choices;
      }
      left -= sizes_[axis] - 1;
    }
    return choices;
  }
  const std::uint64_t draw = number - (baseline_ ? 1 : 0);
  for (std::size_t axis = 0; axis < sizes_.size(); ++axis) choices[axis] = drawn_[axis][draw];
  return choices;
}

}  // namespace rastertlm::explore
