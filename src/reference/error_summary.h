// The errors of an animation: of many frames, the worst and the mean.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/reference/error_figures.h"

namespace rastertlm::reference {

// Means over frames, counts too. A figure that some frames have not is the mean of those that have it, and none where
// no frame has. PSNR: of the mean over the frames of the mean square, so that frames without an error count, and none
// where no frame has one.
using MeanPart =
    PartFigures<std::optional<double>, std::optional<double>, std::optional<double>, std::optional<double>>;
struct MeanErrors : MeanPart {
  MeanPart inside;
  MeanPart silhouettes;
  MeanPart highlights;
};

struct ErrorSummary {
  std::string reference;
  std::uint64_t frames = 0;  // that were compared with it
  ErrorFigures worst;        // each figure by itself: the largest, of PSNR the smallest
  MeanErrors mean;
};

// Figures of frames compared with one reference; there is at least one.
ErrorSummary summary_of(std::span<const ErrorFigures* const> frames);

}  // namespace rastertlm::reference
