// What can be said against a description before anything is made of it.
#pragma once

#include <string>
#include <vector>

#include "src/scene/description.h"
#include "src/scene/problems.h"

namespace rastertlm::scene {

// Every number finite and in its declared range, a camera that can look, increasing key frames, axes and directions of
// some length, names that are unique and known. Materials that a mesh file may bring are not looked for.
void check(const SceneDescription& description, Problems& problems);

// Whether a direction can be brought to length 1.
bool has_length(const Triple& t);

// Every key with its value, one a line, by path: the canonical text of the description. Keys named in `leave_out`
// (their last part) are not in it.
std::string canonical_text(const SceneDescription& description, const std::vector<std::string>& leave_out);

}  // namespace rastertlm::scene
