#include "modules/host/assignment.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/errors.h"

namespace rastertlm::host {

namespace {

SlotMap dealt(std::size_t objects, std::size_t boards, std::size_t slots, Assignment assignment) {
  const std::size_t placed = std::min(objects, boards * slots);
  SlotMap map;
  map.boards.resize(boards);
  map.dropped = objects - placed;
  for (std::size_t i = 0; i < placed; ++i) {
    const bool in_turn = assignment == Assignment::round_robin;
    const std::size_t board = in_turn ? i % boards : i / slots;
    const std::size_t slot = in_turn ? i / boards : i % slots;
    map.boards[board].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(slot)});
  }
  return map;
}

}  // namespace

SlotMap assign_objects(std::size_t objects, const HostParameters& parameters) {
  const auto boards = static_cast<std::size_t>(parameters.computation_units);
  const auto slots = static_cast<std::size_t>(parameters.processors_per_unit);
  const std::size_t processors = boards * slots;
  if (objects > processors && parameters.overflow == Overflow::error)
    throw InputError(
        {"", 0, "host.processors_per_unit",
         fmt::format("the scene has {} objects (triangles) and the machine {} object processors ({} units of {}); "
                     "more processors, or host.overflow = \"drop\", "
                     "would draw it",
                     objects, processors, boards, slots)});
  return dealt(objects, boards, slots, parameters.assignment);
}

SlotMap assign_solids(std::size_t solids, const HostParameters& parameters, std::int64_t per_unit) {
  const auto boards = static_cast<std::size_t>(parameters.computation_units);
  const auto slots = static_cast<std::size_t>(per_unit);
  if (solids > boards * slots && parameters.overflow == Overflow::error)
    throw InputError({"", 0, "quadric_processor.per_unit",
                      fmt::format("the scene has {} solid{} and the machine {} quadric processors ({} units of {}); {}",
                                  solids, solids == 1 ? "" : "s", boards * slots, boards, slots,
                                  slots == 0 ? "1 a unit or more would draw solids"
                                             : "more of them, or host.overflow = \"drop\", would draw it")});
  return dealt(solids, boards, slots, parameters.assignment);
}

}  // namespace rastertlm::host
