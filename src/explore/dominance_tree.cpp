#include "src/explore/dominance_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace rastertlm::explore {
namespace {

constexpr std::size_t kLeaf = 8;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

bool nowhere_above(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  for (std::size_t d = 0; d < a.size(); ++d)
    if (a[d] > b[d]) return false;
  return true;
}

}  // namespace

DominanceTree::DominanceTree(const RankTable& table, std::size_t first_dimension, std::vector<std::size_t> places)
    : table_(table),
      first_dimension_(first_dimension),
      width_(table.dimensions() - first_dimension),
      places_(std::move(places)) {
  if (!places_.empty()) build(0, places_.size());
}

std::size_t DominanceTree::build(std::size_t begin, std::size_t end) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({begin, end, 0, kNone});
  bound(node);
  if (end - begin <= kLeaf || width_ == 0) return node;
  // Across the box's longest side, so that boxes stay compact whatever the figures' distribution.
  std::size_t side = 0;
  for (std::size_t d = 1; d < width_; ++d)
    if (highest(node)[d] - lowest(node)[d] > highest(node)[side] - lowest(node)[side]) side = d;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return places_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](std::size_t a, std::size_t b) { return ranks(a)[side] < ranks(b)[side]; });
  build(begin, middle);
  nodes_[node].right = build(middle, end);
  return node;
}

void DominanceTree::bound(std::size_t node) {
  boxes_.resize(boxes_.size() + width_, std::numeric_limits<std::uint32_t>::max());
  boxes_.resize(boxes_.size() + width_, 0);
  std::uint32_t* const low = boxes_.data() + 2 * node * width_;
  std::uint32_t* const high = low + width_;
  for (std::size_t i = nodes_[node].begin; i < nodes_[node].end; ++i) {
    const auto own = ranks(places_[i]);
    for (std::size_t d = 0; d < width_; ++d) {
      low[d] = std::min(low[d], own[d]);
      high[d] = std::max(high[d], own[d]);
    }
    nodes_[node].least = std::min(nodes_[node].least, places_[i]);
  }
}

void DominanceTree::search(std::size_t node, std::span<const std::uint32_t> asked, bool any_will_do,
                           std::size_t& best) const {
  const Node& n = nodes_[node];
  if (n.least >= best || (any_will_do && best != kNone) || !nowhere_above(lowest(node), asked)) return;
  if (nowhere_above(highest(node), asked)) {
    best = n.least;
    return;
  }
  if (n.right != 0) {
    search(node + 1, asked, any_will_do, best);
    search(n.right, asked, any_will_do, best);
    return;
  }
  for (std::size_t i = n.begin; i < n.end; ++i)
    if (places_[i] < best && nowhere_above(ranks(places_[i]), asked)) best = places_[i];
}

bool DominanceTree::any_below(std::size_t asked) const {
  std::size_t best = kNone;
  if (!nodes_.empty()) search(0, ranks(asked), true, best);
  return best != kNone;
}

std::optional<std::size_t> DominanceTree::first_below(std::size_t asked) const {
  std::size_t best = kNone;
  if (!nodes_.empty()) search(0, ranks(asked), false, best);
  if (best == kNone) return {};
  return best;
}

}  // namespace rastertlm::explore
