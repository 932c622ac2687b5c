// What a computation unit computes for the quadric processors on its bus: words of the solids that it owns, whole slots
// or what parks them. Solids need no survey: nothing of them is snapped or clipped. Operations are counted by the code
// that computes.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "modules/host/animation.h"
#include "modules/host/assignment.h"
#include "modules/host/resident_scene.h"
#include "modules/set_up/quadric_set_up.h"
#include "src/geometry/counted.h"

namespace rastertlm::host {

// What the unit writes to its quadric processors.
struct QuadricLoad {
  std::uint32_t slot = 0;
  std::uint32_t object = 0;  // of the machine: triangles and solids counted together in the scene's order, from 0
  bool park = false;         // quadric_processor::kParkWords words
  quadric_processor::QuadricWords words;
};

// What became of a unit's solids in the current frame.
struct QuadricCounts {
  std::uint64_t drawn = 0;
  std::uint64_t outside = 0;
  std::uint64_t refused = 0;  // left out (on_refusal = "drop")
  QuadricCounts& operator+=(const QuadricCounts& other);
};

class QuadricComputation {
 public:
  // `owners`: solids of the scene, numbered from 0 in its order, and their slots. The scene and its solids outlive
  // this.
  QuadricComputation(const ResidentScene& scene, const set_up::QuadricFormat& format,
                     const std::vector<SlotOwner>& owners);

  // What to write, in the order of owners. `timed`: `before` is kept. Throws InputError where a solid is refused and
  // on_refusal is "error": it names the object as the scene file has it ("object[0]"), the frame, and the parameter
  // with the value that would do, if there is one.
  const std::vector<QuadricLoad>& set_up(const FrameWork& work, bool timed = true);
  // One a load: operations of set_up up to it. It is written then.
  const std::vector<geometry::OperationCounts>& before() const { return before_; }

  // Operations since the start of the run.
  const geometry::OperationCounts& operations() const { return operations_; }
  QuadricCounts counts() const;
  std::size_t solids() const { return solids_.size(); }

 private:
  using Number = geometry::Counted<double>;
  enum class Fate : std::uint8_t { unknown, drawn, outside, refused };

  struct Solid {
    std::uint32_t number;  // of the machine's objects, from 0
    std::uint32_t object;  // of the scene
    std::uint32_t slot;
    bool loaded = false;  // its slot is not parked
    Fate fate = Fate::unknown;
  };

  void renew(Solid& solid, const FrameWork& work);
  [[noreturn]] void refuse(const Solid& solid, const FrameWork& work, const set_up::QuadricProblem& problem) const;
  void put(const Solid& solid, bool park, const quadric_processor::QuadricWords& words);

  const ResidentScene& scene_;
  set_up::QuadricFormat format_;
  std::vector<Solid> solids_;
  std::optional<glm::dmat4> eye_to_clip_;  // of which screen_to_eye_ is
  glm::dmat4 screen_to_eye_{1.0};
  geometry::OperationCounts operations_;
  geometry::OperationCounts step_start_;     // of operations_
  geometry::OperationCounts counted_start_;  // of the thread's
  std::vector<QuadricLoad> loads_;
  bool timed_ = true;
  std::vector<geometry::OperationCounts> before_;
};

}  // namespace rastertlm::host
