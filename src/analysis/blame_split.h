// Splits an error among the steps that make it together.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "src/analysis/blame_step.h"

namespace rastertlm::analysis {

// One share a step, in the order given; they add up to error(none) - error(all). A step's share is what making it exact
// takes away, averaged over all orders in which the steps could be made exact one after the other (Shapley value):
// first of all is "it alone exact", last "it alone the machine's". Neither end would do: a step that is cut early, made
// exact alone, draws the rounding of all later ones anew, so that at the worst pixel, where they all came together
// badly, whatever is first looks guilty. error() is asked for every subset: 2^steps.
std::vector<double> split(std::span<const Step> steps, const std::function<double(StepSet)>& error);

}  // namespace rastertlm::analysis
