// Whether a camera can look where it should.
#pragma once

#include <string>

#include "src/scene/animation.h"

namespace rastertlm::scene {

// "" or one clause: eye and target coincide, or up is parallel to the view.
std::string what_is_wrong(const View& view);

}  // namespace rastertlm::scene
