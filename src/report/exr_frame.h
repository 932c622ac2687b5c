// Everything that is known of a frame's pixels, as an EXR file.
#pragma once

#include <string>

#include "src/frame/frame.h"
#include "src/report/labelled_picture.h"

namespace rastertlm::report {

inline constexpr const char* kRegionChannel = "reference.region";

// Channels: R G B, level / 255; Z, the depth word (a float holds 24 bits); N.X N.Y N.Z, the normal in eye space, 0
// where nothing is seen; object.id, 0 the background; material.id; coverage.count; and with a reference, reference.R G
// B, the exact level / 255 not rounded, error.R G B, R - reference.R, and reference.region, a number of frame::Region.
// `ideal` may be null, and so may `labels`, whose channel has unsigned integers. Throws OutputError.
void write_exr_frame(const std::string& path, const frame::Frame& shown, const frame::ExactFrame* ideal,
                     const LabelledPicture* labels = nullptr);

}  // namespace rastertlm::report
