#include "modules/set_up/stitching.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

namespace rastertlm::set_up {
namespace {

using geometry::SnappedPoint;

bool is_before(const SnappedPoint& a, const SnappedPoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// What light sees of both is the same, and so is their depth.
bool is_same(const LitCorner& a, const LitCorner& b) {
  return a.point.normal == b.point.normal && a.point.position == b.point.position && a.depth == b.depth;
}

// Steps of the grid along the longer axis.
std::int64_t steps(const SnappedPoint& a, const SnappedPoint& b) {
  return std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
}

}  // namespace

StitchCounts& StitchCounts::operator+=(const StitchCounts& other) {
  triangles += other.triangles;
  corners += other.corners;
  return *this;
}

Stitching::Edge Stitching::edge_of(const LitCorner& a, const LitCorner& b) {
  const auto& [first, last] =
      is_before(a.point.at, b.point.at) ? std::pair(a.point.at, b.point.at) : std::pair(b.point.at, a.point.at);
  return {first.x, first.y, last.x, last.y};
}

// Exactly on the line, and between the ends.
bool Stitching::is_inside(const LitCorner& a, const LitCorner& b, const LitCorner& corner) {
  operations_.integer += 9;
  operations_.integer_multiply += 2;
  const SnappedPoint &p = a.point.at, &q = b.point.at, &at = corner.point.at;
  if (at == p || at == q || geometry::doubled_area(p, q, at) != 0) return false;
  return std::min(p.x, q.x) <= at.x && at.x <= std::max(p.x, q.x) && std::min(p.y, q.y) <= at.y &&
         at.y <= std::max(p.y, q.y);
}

void Stitching::note(const CutTriangle& cut) {
  if (cut.parts.size() < 2) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const LitCorner &a = cut.whole[i], &b = cut.whole[(i + 1) % 3];
    const bool in_order = is_before(a.point.at, b.point.at);
    std::vector<Noted> found;
    for (const LitTriangle& part : cut.parts)
      for (const LitCorner& corner : part) {
        if (!is_inside(a, b, corner)) continue;
        if (std::none_of(found.begin(), found.end(),
                         [&](const Noted& other) { return other.corner.point.at == corner.point.at; }))
          found.push_back({corner, {in_order ? a : b, in_order ? b : a}, cut.material});
      }
    if (found.empty()) continue;
    std::vector<Noted>& noted = edges_[edge_of(a, b)];
    noted.insert(noted.end(), found.begin(), found.end());
  }
}

// In a table in order: four words are compared a step.
const std::vector<Stitching::Noted>* Stitching::find(const Edge& edge) {
  operations_.integer += 4 * static_cast<std::uint64_t>(std::bit_width(edges_.size()));
  const auto found = edges_.find(edge);
  return found == edges_.end() ? nullptr : &found->second;
}

// The corner as this triangle has it.
LitCorner Stitching::own(const LitCorner& a, const LitCorner& b, const Noted& noted, std::uint32_t material) {
  const bool in_order = is_before(a.point.at, b.point.at);
  const LitCorner &first = in_order ? a : b, &last = in_order ? b : a;
  if (material == noted.material && is_same(first, noted.ends[0]) && is_same(last, noted.ends[1])) return noted.corner;
  const SnappedPoint& at = noted.corner.point.at;
  const double t =
      static_cast<double>(steps(first.point.at, at)) / static_cast<double>(steps(first.point.at, last.point.at));
  LitCorner corner;
  corner.point = lighting_.inside({&first.point, &last.point, &last.point}, {1.0 - t, t, 0.0});
  corner.point.at = at;
  corner.depth = first.depth + t * (last.depth - first.depth);
  corner.levels = lighting_.levels(corner.point, material);
  operations_.divide += 1;
  operations_.multiply += 1;
  operations_.add += 3;
  operations_.convert += 2;
  return corner;
}

// In order, each place once.
void Stitching::sort_corners() {
  operations_.integer += 2 * corners_.size() * static_cast<std::uint64_t>(std::bit_width(corners_.size()));
  std::stable_sort(corners_.begin(), corners_.end(),
                   [](const LitCorner& a, const LitCorner& b) { return is_before(a.point.at, b.point.at); });
  const auto end = std::unique(corners_.begin(), corners_.end(),
                               [](const LitCorner& a, const LitCorner& b) { return a.point.at == b.point.at; });
  corners_.erase(end, corners_.end());
}

// All corners that the triangle's parts must have in common with each other and with what lies beside them.
void Stitching::collect(const CutTriangle& cut) {
  corners_.clear();
  for (const LitTriangle& part : cut.parts) corners_.insert(corners_.end(), part.begin(), part.end());
  sort_corners();
  const std::vector<LitCorner> own_corners = corners_;
  for (std::size_t i = 0; i < 3; ++i) {
    const LitCorner &a = cut.whole[i], &b = cut.whole[(i + 1) % 3];
    const std::vector<Noted>* beside = find(edge_of(a, b));
    if (beside == nullptr) continue;
    for (const Noted& noted : *beside)
      if (!std::binary_search(
              own_corners.begin(), own_corners.end(), noted.corner,
              [](const LitCorner& one, const LitCorner& other) { return is_before(one.point.at, other.point.at); }))
        corners_.push_back(own(a, b, noted, cut.material));
  }
  if (corners_.size() > own_corners.size()) sort_corners();
}

// Of the triangle's corners, those inside an edge.
std::vector<const LitCorner*> Stitching::inside(const LitCorner& a, const LitCorner& b) {
  const std::int64_t left = std::min(a.point.at.x, b.point.at.x), right = std::max(a.point.at.x, b.point.at.x);
  std::vector<const LitCorner*> found;
  operations_.integer += static_cast<std::uint64_t>(std::bit_width(corners_.size()));
  auto corner = std::partition_point(corners_.begin(), corners_.end(),
                                     [left](const LitCorner& one) { return one.point.at.x < left; });
  for (; corner != corners_.end() && corner->point.at.x <= right; ++corner)
    if (is_inside(a, b, *corner)) found.push_back(&*corner);
  return found;
}

void Stitching::stitch(CutTriangle& cut) {
  collect(cut);
  if (corners_.size() == 3) return;
  std::vector<LitTriangle> parts;
  for (const LitTriangle& part : cut.parts) split(part, parts);
  if (parts.size() == cut.parts.size()) return;
  ++counts_.triangles;
  counts_.corners += parts.size() - cut.parts.size();
  cut.parts = std::move(parts);
}

// In two at the middle one of the corners inside the edge that has the most, again and again.
void Stitching::split(const LitTriangle& part, std::vector<LitTriangle>& out) {
  std::array<std::vector<const LitCorner*>, 3> on_edge;
  for (std::size_t i = 0; i < 3; ++i) on_edge[i] = inside(part[i], part[(i + 1) % 3]);
  const auto most = std::max_element(on_edge.begin(), on_edge.end(),
                                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (most->empty()) {
    out.push_back(part);
    return;
  }
  const auto from = static_cast<std::size_t>(most - on_edge.begin());
  const LitCorner &a = part[from], &b = part[(from + 1) % 3], &opposite = part[(from + 2) % 3];
  const auto middle = most->begin() + static_cast<std::ptrdiff_t>(most->size() / 2);
  std::nth_element(most->begin(), middle, most->end(), [&](const LitCorner* one, const LitCorner* other) {
    return steps(a.point.at, one->point.at) < steps(a.point.at, other->point.at);
  });
  const LitCorner at = **middle;
  split({a, at, opposite}, out);
  split({at, b, opposite}, out);
}

}  // namespace rastertlm::set_up
