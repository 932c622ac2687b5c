#include "src/explore/front.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>

#include "src/explore/dominance_tree.h"

namespace rastertlm::explore {
namespace {

constexpr std::size_t kPairwise = 16;

bool is_missing(const std::optional<double>& figure) { return !figure || std::isnan(*figure); }

// The compared rows by objective: 0 for those that have the best figure, 1 for the next best, and so on. What follows
// knows neither senses nor missing figures.
RankTable ranks_of(const SweepTable& table, const std::vector<std::size_t>& rows) {
  RankTable ranks(rows.size(), table.objectives.size());
  std::vector<std::size_t> order(rows.size());
  for (std::size_t o = 0; o < table.objectives.size(); ++o) {
    const Sense sense = table.objectives[o].sense;
    const auto figure = [&](std::size_t i) -> const std::optional<double>& { return table.rows[rows[i]].figures[o]; };
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return compare_figures(figure(a), figure(b), sense) < 0; });
    std::uint32_t rank = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i > 0 && compare_figures(figure(order[i - 1]), figure(order[i]), sense) != 0) ++rank;
      ranks.of(order[i])[o] = rank;
    }
  }
  return ranks;
}

bool equal_ranks(const RankTable& ranks, std::size_t a, std::size_t b) {
  return std::ranges::equal(ranks.of(a), ranks.of(b));
}

bool nowhere_worse(const RankTable& ranks, std::size_t a, std::size_t b) {
  return std::ranges::equal(ranks.of(a), ranks.of(b), [](std::uint32_t x, std::uint32_t y) { return x <= y; });
}

// Those of `places` that none of them beats. They are distinct and in lexicographic order, so that only an earlier one
// can beat a later one, and between the halves the first objective need not be looked at.
std::vector<std::size_t> unbeaten(const RankTable& ranks, std::span<const std::size_t> places) {
  std::vector<std::size_t> kept;
  if (places.size() <= kPairwise) {
    for (const std::size_t place : places)
      if (std::ranges::none_of(kept, [&](std::size_t other) { return nowhere_worse(ranks, other, place); }))
        kept.push_back(place);
    return kept;
  }
  const std::size_t half = places.size() / 2;
  kept = unbeaten(ranks, places.first(half));
  const std::vector<std::size_t> later = unbeaten(ranks, places.subspan(half));
  const DominanceTree tree(ranks, std::min<std::size_t>(1, ranks.dimensions()), kept);
  for (const std::size_t place : later)
    if (!tree.any_below(place)) kept.push_back(place);
  return kept;
}

void check_figures(const SweepTable& table) {
  for (const Row& row : table.rows)
    if (row.figures.size() != table.objectives.size())
      throw std::invalid_argument("point " + std::to_string(row.number) + " has " + std::to_string(row.figures.size()) +
                                  " figures for " + std::to_string(table.objectives.size()) + " objectives");
}

// The front of these rows, which are of one case.
void add_front(const SweepTable& table, const std::vector<std::size_t>& rows, Front& front) {
  const RankTable ranks = ranks_of(table, rows);

  // Places in lexicographic order; of equal ones the first stands for all. place_of: of each compared row.
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto way = std::lexicographical_compare_three_way(ranks.of(a).begin(), ranks.of(a).end(), ranks.of(b).begin(),
                                                            ranks.of(b).end());
    return way != 0 ? way < 0 : a < b;
  });
  std::vector<std::size_t> distinct;
  std::vector<std::size_t> place_of(rows.size());
  for (const std::size_t place : order) {
    if (distinct.empty() || !equal_ranks(ranks, distinct.back(), place)) distinct.push_back(place);
    place_of[place] = distinct.back();
  }

  const std::vector<std::size_t> best = unbeaten(ranks, distinct);
  std::vector<bool> is_best(rows.size(), false);
  for (const std::size_t place : best) is_best[place] = true;
  const DominanceTree tree(ranks, 0, best);
  std::vector<std::optional<std::size_t>> beater(rows.size());
  for (const std::size_t place : distinct)
    if (!is_best[place]) beater[place] = tree.first_below(place);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& by = beater[place_of[i]];
    if (by) {
      front.beaten_by[rows[i]] = rows[*by];
    } else {
      front.rows.push_back(rows[i]);
    }
  }
}

}  // namespace

bool is_compared(const Row& row) { return row.state == State::done && row.allowed; }

int compare_figures(const std::optional<double>& a, const std::optional<double>& b, Sense sense) {
  const bool no_a = is_missing(a);
  const bool no_b = is_missing(b);
  if (no_a || no_b) return static_cast<int>(no_a) - static_cast<int>(no_b);
  const int order = static_cast<int>(*a > *b) - static_cast<int>(*a < *b);
  return sense == Sense::minimise ? order : -order;
}

std::vector<std::size_t> case_of(const SweepTable& table, const Row& row) {
  std::vector<std::size_t> values;
  for (std::size_t a = 0; a < table.axes.size(); ++a)
    if (table.axes[a].given) values.push_back(row.values.at(a));
  return values;
}

Front find_front(const SweepTable& table) {
  check_figures(table);
  Front front;
  front.compared.resize(table.rows.size());
  front.beaten_by.resize(table.rows.size());
  std::map<std::vector<std::size_t>, std::vector<std::size_t>> cases;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    front.compared[row] = is_compared(table.rows[row]);
    if (front.compared[row]) cases[case_of(table, table.rows[row])].push_back(row);
  }
  for (const auto& [values, rows] : cases) add_front(table, rows, front);
  std::sort(front.rows.begin(), front.rows.end());
  return front;
}

}  // namespace rastertlm::explore
