// The benchmark's scenes: triangles in random places in front of a fixed camera, all of them moving in every frame and
// none leaving the screen.
#pragma once

#include <cstddef>
#include <vector>

#include "platforms/imogene/machine.h"
#include "src/scene/scene.h"
#include "tests/benchmark/plain_frame.inc"

namespace rastertlm::benchmark {

// `triangles` that face the viewer and together cover about `pixels` of 512 x 512, in eight objects and four materials.
// The same for the same arguments.
scene::Scene random_scene(std::size_t triangles, double pixels);

// A machine of 004 of `processors`, a multiple of eight, whose host is never late: so every frame shown is a new one.
imogene::Machine quick_host_machine(std::size_t processors);

// The same triangles and the same pose, for the plain loop; triangles in the order of their processors' numbers, which
// decides where depths are equal.
std::vector<plain::Triangle> plain_triangles(const scene::Scene& scene);
plain::Pose plain_pose(const scene::Pose& pose);

}  // namespace rastertlm::benchmark
