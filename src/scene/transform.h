// Matrices in GLM's conventions whose entries do not depend on the C library: right-handed, column vectors, depth 0..1.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace rastertlm::scene {

glm::dmat4 translation(const glm::dvec3& by);
glm::dmat4 scaling(const glm::dvec3& factors);
// About an axis of any length through the origin, counter-clockwise seen from its tip; a zero axis gives the identity.
glm::dmat4 rotation_deg(const glm::dvec3& axis, double degrees);
// About x, then y, then z.
glm::dmat4 rotation_xyz_deg(const glm::dvec3& degrees);
// A rotation (or any map) about a centre.
glm::dmat4 about(const glm::dvec3& centre, const glm::dmat4& map);

glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);  // lookAtRH
glm::dmat4 perspective(double vertical_fov_deg, double aspect, double near, double far);    // perspectiveRH_ZO
glm::dmat4 orthographic(double width, double height, double near, double far);              // orthoRH_ZO, centred

// The transposed inverse: what normals go through.
glm::dmat3 inverse_transpose(const glm::dmat3& matrix);

}  // namespace rastertlm::scene
