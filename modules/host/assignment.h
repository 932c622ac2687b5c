// Which object processor draws which object, for the whole run.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/host/parameters.h"

namespace rastertlm::host {

// Object i of the scene is its i-th triangle, counted through all meshes in order.
struct SlotOwner {
  std::uint32_t object = 0;  // from 0
  std::uint32_t slot = 0;    // processor on the board
};

// One entry a board: the objects that live there, in slot order.
struct SlotMap {
  std::vector<std::vector<SlotOwner>> boards;
  std::uint64_t dropped = 0;  // objects that found no processor (overflow = "drop")
};

// Throws InputError, with both numbers, where objects are more than processors and overflow is "error".
SlotMap assign_objects(std::size_t objects, const HostParameters& parameters);

}  // namespace rastertlm::host
