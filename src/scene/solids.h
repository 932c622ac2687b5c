// Solids of a scene file: from lengths and polynomials to quadrics.
#pragma once

#include <string>
#include <vector>

#include "src/base/errors.h"
#include "src/geometry/solid.h"
#include "src/scene/description.h"
#include "src/scene/problems.h"
#include "src/scene/scene.h"

namespace rastertlm::scene {

bool is_solid(ObjectKind kind);

// What is wrong with a solid whose numbers are each in their range, and planes of what is none: `path` is the object's.
void check_solid(const ObjectDescription& object, const std::string& path, Problems& problems);

// Of a solid that was checked; its material is 0.
Solid make_solid(const ObjectDescription& object);

// One diagnostic, "object[i].type", for every solid of the scene: of a machine that has nothing to draw it with, and
// says so in `why`.
std::vector<Diagnostic> refuse_solids(const Scene& scene, const std::string& why);

// What machines say that draw triangles alone.
inline constexpr const char* kTrianglesAlone =
    "this machine draws triangles; solids need quadric processors: platform imogene";

}  // namespace rastertlm::scene
