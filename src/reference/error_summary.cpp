#include "src/reference/error_summary.h"

#include <algorithm>
#include <type_traits>

#include "src/base/mathematics.h"

namespace rastertlm::reference {
namespace {

template <class T>
void take_worse(Worse worse, T& worst, const T& other) {
  worst = worse == Worse::larger ? std::max(worst, other) : std::min(worst, other);
}
void take_worse(Worse worse, std::optional<double>& worst, const std::optional<double>& other) {
  if (!other) return;
  worst = worst ? (worse == Worse::larger ? std::max(*worst, *other) : std::min(*worst, *other)) : *other;
}

struct Mean {
  double sum = 0.0;
  std::uint64_t count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  std::optional<double> value() const {
    return count == 0 ? std::nullopt : std::optional(sum / static_cast<double>(count));
  }
};
using MeanSums = PartFigures<Mean, Mean, Mean, Mean>;
struct Sums : MeanSums {
  MeanSums inside;
  MeanSums silhouettes;
  MeanSums highlights;
};

// Mean squares in units of full scale.
double square_of(double psnr_db) { return mathematics::exp(-psnr_db / 10.0 * mathematics::log(10.0)); }
std::optional<double> psnr_of(const Mean& squares) {
  const std::optional<double> mean = squares.value();
  if (!mean || *mean == 0.0) return std::nullopt;
  return -10.0 * mathematics::log(*mean) / mathematics::log(10.0);
}

struct AddFigure {
  bool compared;  // whether the part has pixels to compare: else its levels are no figures
  template <class T>
  void operator()(Worse, Mean& mean, const T& figure) const {
    if (compared || std::is_same_v<T, std::uint64_t>) mean.add(static_cast<double>(figure));
  }
  void operator()(Worse worse, Mean& mean, const std::optional<double>& figure) const {
    if (figure) mean.add(worse == Worse::smaller ? square_of(*figure) : *figure);
  }
};

// A picture without an error has no PSNR either, nor has one of nothing.
void add_exact(Mean& squares, const std::optional<double>& psnr_db, std::uint64_t pixels) {
  if (!psnr_db && pixels > 0) squares.add(0.0);
}

}  // namespace

ErrorSummary summary_of(std::span<const ErrorFigures* const> frames) {
  ErrorSummary summary;
  summary.reference = frames.front()->reference;
  summary.frames = frames.size();
  summary.worst = *frames.front();
  Sums sums;
  for (const ErrorFigures* frame : frames) {
    for_each_part(
        [](RegionFigures& worst, const RegionFigures& other) {
          for_each_figure([](Worse worse, auto& w, const auto& o) { take_worse(worse, w, o); }, worst, other);
        },
        summary.worst, *frame);
    for_each_part(
        [](MeanSums& sum, const RegionFigures& one) {
          for_each_figure(AddFigure{one.compared > 0}, sum, one);
          add_exact(sum.psnr_db, one.psnr_db, one.compared);
          add_exact(sum.psnr_outline_db, one.psnr_outline_db, one.compared + one.covered_missing + one.covered_extra);
        },
        sums, *frame);
  }
  for_each_part(
      [](MeanPart& mean, const MeanSums& sum) {
        for_each_figure([](Worse worse, std::optional<double>& m,
                           const Mean& s) { m = worse == Worse::smaller ? psnr_of(s) : s.value(); },
                        mean, sum);
      },
      summary.mean, sums);
  return summary;
}

}  // namespace rastertlm::reference
