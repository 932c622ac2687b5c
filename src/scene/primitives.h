// Shapes that are made from numbers.
#pragma once

#include <cstddef>

#include "src/scene/scene.h"

namespace rastertlm::scene {

// The teapot in its original units (z up, about 6.5 wide, 3.15 high, standing on z = 0), `segments` x `segments` quads
// a patch, two triangles each. `patches`: 28 is Newell's, open below; 32 has the bottom that was added later. Normals
// are the surface's own, at the poles their limit. Points on borders that patches share are bit-identical and are one
// vertex, so the mesh is closed where the surface is. The triangles at the poles, 4 x segments a pole, have two equal
// corners: they are counted in Mesh::degenerate.
Mesh teapot(std::size_t segments, std::size_t patches);

// A sphere about the origin, poles on the z axis, the first meridian at +x: 2 * slices * (stacks - 1) triangles, slices
// >= 3, stacks >= 2.
Mesh uv_sphere(double radius, std::size_t slices, std::size_t stacks);

}  // namespace rastertlm::scene
