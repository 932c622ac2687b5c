// A computation unit's work (004, section 5.2.4): the coefficients of its object processors, in two steps. It first
// transforms its triangles and says whether one of them needs the guard band, because a whole frame is snapped to one
// grid; told the grid, it fits the coefficients. Operations are counted by the code that computes (path_counts.h).
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "modules/host/animation.h"
#include "modules/host/assignment.h"
#include "modules/host/corners.h"
#include "modules/host/path_counts.h"
#include "modules/host/resident_scene.h"
#include "modules/set_up/pieces.h"
#include "modules/set_up/triangle_batch.h"
#include "modules/set_up/triangle_kernels.h"
#include "modules/set_up/triangle_set_up.h"
#include "src/base/vector_variant.h"
#include "src/geometry/counted.h"
#include "src/geometry/frame_grid.h"

namespace rastertlm::host {

// What every computation unit knows of the machine.
struct MachineFormat {
  set_up::WordFormat words;
  geometry::SnapGrids grids;
  geometry::Viewport viewport;
  std::uint32_t slots = 128;  // object processors a board
};

// A piece of a clipped triangle, ready to be loaded.
struct Piece {
  std::uint32_t object = 0;  // from 0
  object_processor::TriangleWords words;
};

// What the unit writes to its board: a whole slot, or as few words as park it.
struct Load {
  std::uint32_t slot = 0;
  std::uint32_t object = 0;  // from 0
  bool park = false;
  object_processor::TriangleWords words;
};
inline constexpr std::uint64_t kParkWords = 3;  // the first edge alone: it is then -1 everywhere

struct Survey {
  bool guarded = false;
  std::uint32_t free_slots = 0;  // left on the unit's own board
  std::vector<Piece> homeless;   // pieces that found no slot there
};

// What became of a unit's triangles in the current frame.
struct TriangleCounts {
  std::uint64_t drawn = 0;
  std::uint64_t back_faces = 0;
  std::uint64_t degenerate = 0;
  std::uint64_t outside = 0;
  std::uint64_t pieces = 0;  // slots taken beyond one a triangle
  TriangleCounts& operator+=(const TriangleCounts& other);
};

class Computation {
 public:
  // `owners`: triangles of the scene, numbered from 0 in its order, and their slots.
  Computation(const ResidentScene& scene, const MachineFormat& format, const std::vector<SlotOwner>& owners,
              VectorVariant variant = vector_variant());

  // The first step. The survey covers all triangles of the unit, also those that did not change.
  Survey survey(const FrameWork& work);

  // The second step: what to write, in slot order of need. `adopted`: pieces of other units that this board has slots
  // for. `timed`: `before` is kept.
  const std::vector<Load>& set_up(bool guarded, const std::vector<Piece>& adopted, bool timed = true);
  // One a load: operations of the second step up to it. It is written then.
  const std::vector<geometry::OperationCounts>& before() const { return before_; }

  // Operations since the start of the run.
  const geometry::OperationCounts& operations() const { return operations_; }
  TriangleCounts triangle_counts() const;
  std::size_t triangles() const { return triangles_.size(); }

 private:
  using Number = geometry::Counted<double>;
  enum class Fate : std::uint8_t { unknown, drawn, back_face, degenerate, outside };

  struct Triangle {
    std::uint32_t object;  // of the machine: triangles and solids counted together in the scene's order, from 0
    std::uint32_t mesh;    // object of the scene
    std::uint32_t corner[3];
    std::uint32_t slot;
    std::uint16_t material;
    bool two_sided;
    bool needs_guard = false;
    bool renewed = false;  // in this frame
    bool loaded = false;   // its slot is not parked
    Fate fate = Fate::unknown;
  };
  // Triangles are computed eight at a time, side by side.
  static constexpr std::size_t kLanes = set_up::kLanes;
  struct Block {
    std::size_t begin = 0;  // indices of triangles_
    std::size_t end = 0;
  };
  Block block(std::size_t number) const {
    return {number * kLanes, std::min(triangles_.size(), (number + 1) * kLanes)};
  }

  void prefetch(const Triangle& triangle) const;
  void prepare_matrices();
  void transform(const Block& block, set_up::ScreenCorners& screen);
  void transform_of_mesh(const Block& block, unsigned lanes, std::uint32_t mesh, set_up::ScreenCorners& screen);
  void transform_counted(Triangle& triangle);
  void cut(Triangle& triangle, const geometry::ClipTriangle<Number>& corners);
  void allocate(Survey& survey);
  void fit(const Block& block, const set_up::ScreenCorners& screen, unsigned lanes);
  void fit_alone(Triangle& triangle, const set_up::ScreenCorners& screen, std::size_t lane);
  void put_pieces(Triangle& triangle);
  void settle(Triangle& triangle, set_up::Outcome outcome);
  void load_pieces();
  // Of a load that is added; its words are to be filled in.
  object_processor::TriangleWords& put(std::uint32_t slot, std::uint32_t object);
  void park(std::uint32_t slot);

  const ResidentScene& scene_;
  MachineFormat format_;
  PathCounts paths_;
  geometry::FrameGrid guarded_frame_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> free_slots_;  // that no triangle owns, ascending
  std::map<std::uint32_t, std::vector<object_processor::TriangleWords>>
      cut_;                                      // by index of triangles_: what is drawn of clipped ones
  std::map<std::uint32_t, Piece> extra_;         // by slot: pieces in free slots, this frame
  std::map<std::uint32_t, Piece> loaded_extra_;  // and as they were last written
  std::vector<set_up::ScreenCorners> screen_;    // a block: of triangles that need no guard band
  const set_up::TriangleKernels& kernels_;
  set_up::ObjectCorners object_corners_;       // of the block being transformed
  set_up::FittedTriangles fitted_;             // of the block being fitted
  std::optional<set_up::FitRequest> request_;  // of the frame's grid
  geometry::SnapGrid grid_;
  std::vector<glm::dmat4> object_to_clip_;  // one an object of the scene
  const FrameWork* work_ = nullptr;
  bool last_guarded_ = false;
  bool first_ = true;
  geometry::OperationCounts operations_;
  geometry::OperationCounts step_start_;  // of the step that makes loads_
  std::vector<Load> loads_;
  bool timed_ = true;
  std::vector<geometry::OperationCounts> before_;
};

// Gives homeless pieces to boards with free slots, board by board. Returns one list a unit; what fits nowhere is left
// in `homeless`.
std::vector<std::vector<Piece>> place_pieces(std::vector<Piece>& homeless,
                                             const std::vector<std::uint32_t>& free_slots);

}  // namespace rastertlm::host
