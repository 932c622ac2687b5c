// Measures the frames of an animation, one after the other, against one kind of exact picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "src/frame/frame.h"
#include "src/reference/error_figures.h"
#include "src/reference/flicker.h"

namespace rastertlm::reference {

// What a depth word means: near_word + z (far_word - near_word) at depth z, 0 near .. 1 far, and how far a right one
// may be from that, in its units.
struct DepthWords {
  double near_word = 0.0;
  double far_word = 0.0;
  double bound = 0.0;
};

struct MeterOptions {
  std::string reference;                                    // ErrorFigures::reference
  std::optional<DepthWords> depth = {};                     // none: wrong_order is not looked for
  std::optional<double> perceptual_pixels_per_degree = {};  // FLIP and CIEDE2000 are computed, at so many
};

class ErrorMeter {
 public:
  explicit ErrorMeter(MeterOptions options) : options_(std::move(options)) {}
  // Of the next frame: its flicker is against the one that was measured before. Both pictures of the same size, and of
  // that of the frames before, else std::invalid_argument.
  ErrorFigures measure(const frame::Frame& shown, const frame::ExactFrame& exact);

 private:
  MeterOptions options_;
  FlickerMeter flicker_;
};

}  // namespace rastertlm::reference
