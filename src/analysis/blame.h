// Which step made a pixel wrong: each made exact alone, and all made exact but one.
//
// L(S) are the levels of a pixel, not rounded, with the steps in S exact and the others the machine's. L(none) is the
// machine's picture, bit for bit, and L(all) the ideal one. A pixel is wrong where a channel's level is not the ideal
// one, rounded. Over a frame, of the squares of the differences from the ideal picture:
//   removed by k    those of L(none) less those of L(k): what goes where the step alone is made exact
//   alone, k        those of L(all but k): what it makes where it alone is the machine's
// What a step removes beyond what it makes alone is its interaction with the others (negative: its error hides theirs).
//
// The blamed step of a wrong pixel:
// 1. Pixels whose words are another pose's (late, torn, without a processor) are told apart: they are not explained.
// 2. Where another triangle is seen than in the ideal picture: coverage if exact coverage shows the right one, else
//    depth order if exact depth does, else coverage (both are wrong).
// 3. Else the step with the largest share of the error of the channel that is farthest off (blame_split.h), of equal
//    ones the first.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "src/analysis/blame_step.h"
#include "src/frame/frame.h"
#include "src/report/blame_figures.h"
#include "src/run/inputs.h"
#include "src/run/result.h"

namespace rastertlm::analysis {

// A machine's frame, computed again pixel by pixel.
class ExplainedFrame {
 public:
  virtual ~ExplainedFrame() = default;

  // What can be made exact, in the order of the data.
  virtual std::vector<Step> steps() const = 0;
  // The pixel that is asked about from now on. Gives what is to blame for another triangle being seen: coverage or
  // depth order, `none` where both pictures see the same, `other_words` where the machine's is not this pose's.
  virtual Step look_at(std::size_t column, std::size_t line) = 0;
  // L(S) of that pixel.
  virtual glm::dvec3 levels(StepSet exact) const = 0;
};

struct FrameBlame {
  report::FrameBlameFigures figures;
  std::vector<std::uint32_t> step;  // a pixel: the number of its step
  report::Legend legend;            // of the numbers that this machine's pixels may have
};

// `frames`: of the lines k, k + count ... frames[k] explains line k: one, or two where the picture is two fields of two
// poses. All have the same steps. `shown` and `ideal` are of one size.
FrameBlame blame(const std::vector<std::unique_ptr<ExplainedFrame>>& frames, const frame::Frame& shown,
                 const frame::ExactFrame& ideal);

// The same of a frame that a run shows, with its number. Throws std::invalid_argument without an ideal picture.
FrameBlame blame(const run::Inputs& inputs, const run::FramePixels& pixels);

}  // namespace rastertlm::analysis
