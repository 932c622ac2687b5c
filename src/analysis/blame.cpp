#include "src/analysis/blame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "src/analysis/blame_machines.h"
#include "src/analysis/blame_split.h"

namespace rastertlm::analysis {
namespace {

constexpr double kHalfLevel = 0.5;
constexpr std::size_t kBinsALevel = 64;

struct Difference {
  double largest = 0.0;  // of a channel
  double squares = 0.0;
  int rounded = 0;  // largest of levels rounded first
};

Difference difference(const glm::dvec3& levels, const double* ideal) {
  Difference d;
  for (int c = 0; c < 3; ++c) {
    const double off = std::fabs(levels[c] - ideal[c]);
    d.largest = std::max(d.largest, off);
    d.squares += off * off;
    const int whole =
        static_cast<int>(std::floor(levels[c] + kHalfLevel)) - static_cast<int>(std::floor(ideal[c] + kHalfLevel));
    d.rounded = std::max(d.rounded, std::abs(whole));
  }
  return d;
}

// How often each size of a difference came, in 64ths of a level.
class Histogram {
 public:
  void add(double level) {
    const auto bin = static_cast<std::size_t>(std::ceil(level * kBinsALevel));
    ++bins_[std::min(bin, bins_.size() - 1)];
    ++count_;
  }
  double quantile(double share) const {
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
      below += bins_[bin];
      if (static_cast<double>(below) >= share * static_cast<double>(count_))
        return static_cast<double>(bin) / kBinsALevel;
    }
    return 0.0;
  }

 private:
  std::vector<std::uint64_t> bins_ = std::vector<std::uint64_t>(256 * kBinsALevel + 1);
  std::uint64_t count_ = 0;
};

// Of one step, over the pixels of a frame.
struct StepSums {
  Step step = Step::none;
  StepSet only;        // the step exact
  StepSet all_others;  // all exact but it
  report::StepFigures figures;
  double left_squares = 0.0;
  double alone_squares = 0.0;
  double alone_levels = 0.0;
  Histogram alone;

  void add(const ExplainedFrame& explained, const double* ideal) {
    const Difference left = difference(explained.levels(only), ideal);
    left_squares += left.squares;
    figures.left_max_level = std::max(figures.left_max_level, left.rounded);
    const Difference made = difference(explained.levels(all_others), ideal);
    alone_squares += made.squares;
    alone_levels += made.largest;
    alone.add(made.largest);
    figures.alone_max_level = std::max(figures.alone_max_level, made.largest);
  }
};

class FrameSums {
 public:
  explicit FrameSums(const std::vector<Step>& steps) {
    StepSet all;
    for (const Step step : steps) all = all.with(step);
    for (const Step step : steps) {
      if (step != Step::coverage && step != Step::depth_order) shading_.push_back(step);
      StepSums& sums = steps_.emplace_back();
      sums.step = step;
      sums.only = StepSet().with(step);
      sums.all_others = all.without(step);
      sums.figures.step = traits_of(step).name;
    }
  }

  // Gives the blamed step.
  Step add(ExplainedFrame& explained, std::size_t column, std::size_t line, const std::uint8_t* shown,
           const double* ideal) {
    ++figures_.pixels;
    const Step seen = explained.look_at(column, line);
    const glm::dvec3 shown_levels(shown[0], shown[1], shown[2]);
    const Difference off = difference(shown_levels, ideal);
    const bool is_wrong = off.rounded > 0;
    figures_.wrong += is_wrong ? 1 : 0;
    if (seen == Step::other_words || explained.levels(StepSet()) != shown_levels) {
      figures_.other_words += is_wrong ? 1 : 0;
      return is_wrong ? Step::other_words : Step::none;
    }
    ++explained_;
    squares_ += off.squares;
    for (StepSums& sums : steps_) sums.add(explained, ideal);
    if (!is_wrong) return Step::none;
    const Step blamed = seen != Step::none ? seen : blamed_by_split(explained, shown_levels, ideal, column, line);
    note(blamed, off.rounded);
    return blamed;
  }

  report::FrameBlameFigures close() {
    const auto share = [&](double squares) { return squares_ > 0.0 ? squares / squares_ : 0.0; };
    const double values = 3.0 * static_cast<double>(std::max<std::uint64_t>(explained_, 1));
    figures_.rmse_level = std::sqrt(squares_ / values);
    double alone = 0.0;
    for (StepSums& sums : steps_) {
      report::StepFigures& f = sums.figures;
      f.removed_share = share(squares_ - sums.left_squares);
      f.left_rmse_level = std::sqrt(sums.left_squares / values);
      f.alone_share = share(sums.alone_squares);
      f.interaction_share = f.removed_share - f.alone_share;
      f.alone_p999_level = std::min(sums.alone.quantile(0.999), f.alone_max_level);
      f.alone_mean_level = sums.alone_levels / static_cast<double>(std::max<std::uint64_t>(explained_, 1));
      alone += f.alone_share;
      figures_.steps.push_back(f);
    }
    figures_.interaction_share = squares_ > 0.0 ? 1.0 - alone : 0.0;
    return figures_;
  }

 private:
  Step blamed_by_split(const ExplainedFrame& explained, const glm::dvec3& shown, const double* ideal,
                       std::size_t column, std::size_t line) {
    int channel = 0;
    for (int c = 1; c < 3; ++c)
      if (std::fabs(shown[c] - ideal[c]) > std::fabs(shown[channel] - ideal[channel])) channel = c;
    const double sign = shown[channel] > ideal[channel] ? 1.0 : -1.0;
    const double off = sign * (shown[channel] - ideal[channel]);
    const std::vector<double> shares =
        split(shading_, [&](StepSet exact) { return sign * (explained.levels(exact)[channel] - ideal[channel]); });
    if (off > figures_.largest_level) {
      figures_.largest_level = off;
      figures_.largest_column = column;
      figures_.largest_line = line;
      for (StepSums& sums : steps_) sums.figures.of_largest_level = 0.0;
      for (std::size_t i = 0; i < shading_.size(); ++i) sums_of(shading_[i])->figures.of_largest_level = shares[i];
    }
    return shading_[static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin())];
  }

  std::vector<StepSums>::iterator sums_of(Step step) {
    return std::find_if(steps_.begin(), steps_.end(), [&](const StepSums& sums) { return sums.step == step; });
  }

  void note(Step blamed, int levels) {
    figures_.max_level = std::max(figures_.max_level, levels);
    report::StepFigures& f = sums_of(blamed)->figures;
    ++f.blamed_pixels;
    f.blamed_max_level = std::max(f.blamed_max_level, levels);
  }

  report::FrameBlameFigures figures_;
  std::vector<StepSums> steps_;
  std::vector<Step> shading_;  // those that matter where the right triangle is seen
  std::uint64_t explained_ = 0;
  double squares_ = 0.0;
};

report::LegendEntry legend_entry(Step step) {
  const StepTraits& traits = traits_of(step);
  return {static_cast<std::uint32_t>(step), std::string(traits.name), std::string(traits.meaning),
          fmt::format("#{:02x}{:02x}{:02x}", traits.colour[0], traits.colour[1], traits.colour[2])};
}

}  // namespace

FrameBlame blame(const std::vector<std::unique_ptr<ExplainedFrame>>& frames, const frame::Frame& shown,
                 const frame::ExactFrame& ideal) {
  if (shown.columns != ideal.columns || shown.lines != ideal.lines)
    throw std::invalid_argument("pictures of different sizes are compared");
  FrameBlame result;
  result.step.resize(shown.pixels());
  const std::vector<Step> steps = frames.front()->steps();
  result.legend.push_back(legend_entry(Step::none));
  for (const Step step : steps) result.legend.push_back(legend_entry(step));
  result.legend.push_back(legend_entry(Step::other_words));
  FrameSums sums(steps);
  for (std::size_t y = 0; y < shown.lines; ++y)
    for (std::size_t x = 0; x < shown.columns; ++x) {
      const std::size_t pixel = y * shown.columns + x;
      if (shown.object[pixel] == 0 && ideal.object[pixel] == 0) continue;
      result.step[pixel] = static_cast<std::uint32_t>(
          sums.add(*frames[y % frames.size()], x, y, &shown.rgb[3 * pixel], &ideal.rgb[3 * pixel]));
    }
  result.figures = sums.close();
  return result;
}

FrameBlame blame(const run::Inputs& inputs, const run::FramePixels& pixels) {
  if (pixels.ideal == nullptr) throw std::invalid_argument("nothing is to blame without an ideal picture");
  FrameBlame result = blame(explained_frames(inputs, pixels), pixels.shown, *pixels.ideal);
  result.figures.frame = pixels.figures.frame;
  return result;
}

}  // namespace rastertlm::analysis
