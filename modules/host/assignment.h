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

// The same for the scene's solids, numbered among themselves, and the quadric processors, `per_unit` a board: those of
// one kind are dealt whatever the other has.
SlotMap assign_solids(std::size_t solids, const HostParameters& parameters, std::int64_t per_unit);

}  // namespace rastertlm::host
