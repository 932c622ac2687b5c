// How far one picture of a machine is from an exact one.
#pragma once

#include <string>

#include "src/frame/frame.h"
#include "src/reference/error_figures.h"

namespace rastertlm::reference {

// Of a picture by itself: nothing of its depth order, of flicker, or as the eye sees it (error_meter.h). Both of the
// same size, else std::invalid_argument.
ErrorFigures compare(const frame::Frame& shown, const frame::ExactFrame& exact, const std::string& reference);

// Largest |depth word - (near_word + z * (far_word - near_word))| in units of the depth word, over the pixels that show
// the same triangle in both pictures; 0 where there is none.
double largest_depth_error(const frame::Frame& shown, const frame::ExactFrame& exact, double near_word,
                           double far_word);

}  // namespace rastertlm::reference
