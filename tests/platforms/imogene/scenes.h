// Scenes of the tests: small things in front of a camera that looks along +y, z upwards.
#pragma once

#include <string>

namespace rastertlm::test {

inline constexpr const char* kHead = R"(schema = 1
[[light]]
towards = [0.5, -0.6, 1.0]
[[material]]
name = "glaze"
colour = [0.9, 0.5, 0.2]
[[material]]
name = "slate"
colour = [0.3, 0.4, 0.6]
specular = 0.2
exponent = 5
)";

// Eye at (0, -10, 0); the lower and upper borders of the picture are 10 tan 15 degrees = 2.68 from its middle at y = 0.
inline constexpr const char* kCamera = R"([camera]
eye = [0.0, -10.0, 0.0]
target = [0.0, 0.0, 0.0]
)";

inline constexpr const char* kSphere = R"([[object]]
type = "uv_sphere"
material = "glaze"
radius = 2.0
slices = 24
stacks = 16
)";

inline constexpr const char* kSpin = R"([[object.animation]]
type = "spin"
axis = [0.0, 0.3, 1.0]
deg_per_frame = 7.0
)";

inline std::string scene_of(const std::string& objects, const std::string& camera = kCamera) {
  return std::string(kHead) + camera + objects;
}

}  // namespace rastertlm::test
