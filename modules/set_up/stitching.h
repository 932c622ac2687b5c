// Corners that parts of a triangle have on its edges, given to the triangles beside it: without, an edge that one has
// whole and the other in parts covers every pixel once (the parts' corners are exactly on it), but has two colours.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "modules/set_up/subdivision.h"

namespace rastertlm::set_up {

// A triangle whose corners are lit, and what it was cut into.
struct CutTriangle {
  LitTriangle whole;
  std::vector<LitTriangle> parts;
  std::uint32_t material = 0;
};

struct StitchCounts {
  std::uint64_t triangles = 0;  // that got corners
  std::uint64_t corners = 0;    // that they got: as many parts more
  StitchCounts& operator+=(const StitchCounts& other);
};

// Of a frame: first all triangles that are cut are noted, then any is stitched. Edges are known by their ends on the
// screen, so that triangles have them in common whatever became of them before, as pieces of clipped ones.
class Stitching {
 public:
  // `lighting` outlives it.
  explicit Stitching(PointLighting& lighting) : lighting_(lighting) {}

  void begin_frame() { edges_.clear(); }
  void note(const CutTriangle& cut);
  // Cuts parts until no corner of the triangle's parts, and none that was noted on its edges, lies inside an edge of
  // one. A corner of the same surface keeps its colour; across a crease, or of another material, it is lit anew.
  void stitch(CutTriangle& cut);

  // Since the start of the run.
  const StitchCounts& counts() const { return counts_; }
  const geometry::OperationCounts& operations() const { return operations_; }

 private:
  using Edge = std::array<std::int64_t, 4>;  // from the end that is first in order
  struct Noted {
    LitCorner corner;
    std::array<LitCorner, 2> ends;  // likewise
    std::uint32_t material = 0;
  };
  static Edge edge_of(const LitCorner& a, const LitCorner& b);
  bool is_inside(const LitCorner& a, const LitCorner& b, const LitCorner& corner);
  const std::vector<Noted>* find(const Edge& edge);
  LitCorner own(const LitCorner& a, const LitCorner& b, const Noted& noted, std::uint32_t material);
  void collect(const CutTriangle& cut);
  void sort_corners();
  std::vector<const LitCorner*> inside(const LitCorner& a, const LitCorner& b);
  void split(const LitTriangle& part, std::vector<LitTriangle>& out);

  PointLighting& lighting_;
  std::map<Edge, std::vector<Noted>> edges_;
  std::vector<LitCorner> corners_;  // of the triangle that is stitched, from left to right
  StitchCounts counts_;
  geometry::OperationCounts operations_;
};

}  // namespace rastertlm::set_up
