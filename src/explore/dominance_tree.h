// Points given by ranks (0 is best in each dimension), asked whether one of them is nowhere above another point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rastertlm::explore {

// Rank vectors of equal length, one after another. A place is the number of a vector.
class RankTable {
 public:
  RankTable(std::size_t places, std::size_t dimensions) : dimensions_(dimensions), ranks_(places * dimensions) {}
  std::size_t dimensions() const { return dimensions_; }
  std::span<std::uint32_t> of(std::size_t place) { return {ranks_.data() + place * dimensions_, dimensions_}; }
  std::span<const std::uint32_t> of(std::size_t place) const {
    return {ranks_.data() + place * dimensions_, dimensions_};
  }

 private:
  std::size_t dimensions_;
  std::vector<std::uint32_t> ranks_;
};

// A k-d tree of some places. A question visits only boxes that reach below the asked point and are not wholly below it:
// about n^(1 - 1/k) of n points in k dimensions, where a list would have all.
class DominanceTree {
 public:
  // Looks at the dimensions from `first_dimension` on; the table must outlive the tree.
  DominanceTree(const RankTable& table, std::size_t first_dimension, std::vector<std::size_t> places);

  // Is there a place none of whose ranks is above the asked one's?
  bool any_below(std::size_t asked) const;
  // The least of such places.
  std::optional<std::size_t> first_below(std::size_t asked) const;

 private:
  struct Node {
    std::size_t begin = 0;
    std::size_t end = 0;    // of places_
    std::size_t right = 0;  // the left child is the next node; 0: a leaf
    std::size_t least = 0;  // place
  };
  std::size_t build(std::size_t begin, std::size_t end);
  void bound(std::size_t node);
  void search(std::size_t node, std::span<const std::uint32_t> asked, bool any_will_do, std::size_t& best) const;

  std::span<const std::uint32_t> ranks(std::size_t place) const { return table_.of(place).subspan(first_dimension_); }
  std::span<const std::uint32_t> lowest(std::size_t node) const { return {boxes_.data() + 2 * node * width_, width_}; }
  std::span<const std::uint32_t> highest(std::size_t node) const {
    return {boxes_.data() + (2 * node + 1) * width_, width_};
  }

  const RankTable& table_;
  std::size_t first_dimension_;
  std::size_t width_;
  std::vector<std::size_t> places_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> boxes_;  // of each node the lowest ranks, then the highest
};

}  // namespace rastertlm::explore
