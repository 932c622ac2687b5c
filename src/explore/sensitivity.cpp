#include "src/explore/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "src/explore/axis_order.h"
#include "src/explore/normal_equations.h"

namespace rastertlm::explore {
namespace {

struct Used {
  std::vector<const Row*> rows;
  std::vector<double> figures;                     // less the mean
  std::vector<std::vector<std::uint64_t>> points;  // of each axis's values
};

// How an axis enters the fit.
struct Columns {
  Effects effects = Effects::by_value;
  std::size_t first = 0;             // unknown
  std::vector<std::size_t> unknown;  // by_value: of each value that occurs
  std::vector<double> position;      // by_line: of each value, from -1 to 1
};

std::size_t occurring(const std::vector<std::uint64_t>& points) {
  return static_cast<std::size_t>(std::ranges::count_if(points, [](std::uint64_t n) { return n > 0; }));
}

void check_table(const SweepTable& table) {
  for (const Row& row : table.rows) {
    bool good = row.values.size() == table.axes.size() && row.figures.size() == table.objectives.size();
    for (std::size_t a = 0; good && a < row.values.size(); ++a) good = row.values[a] < table.axes[a].values.size();
    if (!good) throw std::invalid_argument("point " + std::to_string(row.number) + " does not fit the sweep's axes");
  }
}

Used used_points(const SweepTable& table, std::size_t objective, ObjectiveSensitivity& result) {
  Used used;
  for (const Axis& axis : table.axes) used.points.emplace_back(axis.values.size(), 0);
  for (const Row& row : table.rows) {
    const std::optional<double>& figure = row.figures[objective];
    if (row.state != State::done || !figure || std::isnan(*figure)) continue;
    if (std::isinf(*figure)) {
      ++result.infinite;
      continue;
    }
    used.rows.push_back(&row);
    used.figures.push_back(*figure);
    for (std::size_t a = 0; a < table.axes.size(); ++a) ++used.points[a][row.values[a]];
  }
  result.points = used.rows.size();
  if (used.rows.empty()) return used;
  const auto count = static_cast<double>(used.rows.size());
  for (const double figure : used.figures) result.mean += figure / count;
  for (double& figure : used.figures) figure -= result.mean;
  return used;
}

bool is_grid(const Used& used) {
  std::size_t combinations = 1;
  for (const auto& points : used.points) {
    combinations *= occurring(points);
    if (combinations > used.rows.size()) return false;
  }
  std::set<std::vector<std::size_t>> seen;
  for (const Row* row : used.rows) seen.insert(row->values);
  return seen.size() == combinations && used.rows.size() == combinations;
}

// One parameter alone is a grid, though no point leaves the baseline in more than it.
DesignKind design_of(const SweepTable& table, const Used& used) {
  if (is_grid(used)) return DesignKind::grid;
  if (table.baseline) {
    const auto& base = table.rows.at(*table.baseline).values;
    const bool one = std::ranges::all_of(used.rows, [&](const Row* row) {
      std::size_t differ = 0;
      for (std::size_t a = 0; a < base.size(); ++a) differ += row->values[a] != base[a] ? 1 : 0;
      return differ <= 1;
    });
    if (one) return DesignKind::one_at_a_time;
  }
  return DesignKind::scattered;
}

// Chooses which axes are lines, and numbers the unknowns; number 0 is the mean.
class Layout {
 public:
  Layout(const SweepTable& table, const Used& used) : columns_(table.axes.size()) {
    for (std::size_t a = 0; a < columns_.size(); ++a)
      if (occurring(used.points[a]) < 2) columns_[a].effects = Effects::undetermined;
    const std::size_t most = std::min(used.rows.size(), kMostUnknowns);
    while (needed(used) > most && straighten(table, used)) {
    }
    for (std::size_t a = 0; a < columns_.size(); ++a) place(table.axes[a], used.points[a], columns_[a]);
  }

  std::size_t unknowns() const { return unknowns_; }
  const Columns& of(std::size_t axis) const { return columns_[axis]; }

  std::vector<Term> terms_of(const Row& row) const {
    std::vector<Term> terms{{0, 1.0}};
    for (std::size_t a = 0; a < columns_.size(); ++a) add(terms, columns_[a], row.values[a], 1.0);
    return terms;
  }
  static void add(std::vector<Term>& terms, const Columns& columns, std::size_t value, double factor) {
    if (columns.effects == Effects::by_value) terms.push_back({columns.unknown[value], factor});
    if (columns.effects == Effects::by_line) terms.push_back({columns.first, factor * columns.position[value]});
  }

 private:
  // Of a value's effects one is free, as only differences count.
  std::size_t needed(const Used& used) const {
    std::size_t count = 1;
    for (std::size_t a = 0; a < columns_.size(); ++a) {
      if (columns_[a].effects == Effects::by_value) count += occurring(used.points[a]) - 1;
      if (columns_[a].effects == Effects::by_line) ++count;
    }
    return count;
  }

  // Makes a line of the axis of most values; where none is of numbers, an axis of too many names is given up.
  bool straighten(const SweepTable& table, const Used& used) {
    std::optional<std::size_t> longest;
    std::size_t most = 2;
    for (std::size_t a = 0; a < columns_.size(); ++a) {
      const std::size_t values = occurring(used.points[a]);
      if (columns_[a].effects != Effects::by_value || values <= most || !numbers_of(table.axes[a])) continue;
      most = values;
      longest = a;
    }
    if (longest) {
      columns_[*longest].effects = Effects::by_line;
      return true;
    }
    for (std::size_t a = 0; a < columns_.size(); ++a)
      if (columns_[a].effects == Effects::by_value && occurring(used.points[a]) > kMostUnknowns / 2) longest = a;
    if (!longest) return false;
    columns_[*longest].effects = Effects::undetermined;
    return true;
  }

  void place(const Axis& axis, const std::vector<std::uint64_t>& points, Columns& columns) {
    columns.first = unknowns_;
    if (columns.effects == Effects::by_line) {
      columns.position = numbers_of(axis).value();
      // Twice the reciprocal of the range: a line's weight is then comparable with a value's.
      const auto [least, most] = std::ranges::minmax(columns.position);
      for (double& x : columns.position) x = most > least ? (2.0 * x - least - most) / (most - least) : 0.0;
      ++unknowns_;
    }
    if (columns.effects == Effects::by_value) {
      columns.unknown.resize(points.size());
      for (std::size_t v = 0; v < points.size(); ++v)
        if (points[v] > 0) columns.unknown[v] = unknowns_++;
    }
  }

  std::vector<Columns> columns_;
  std::size_t unknowns_ = 1;
};

void find_span(Sensitivity& result) {
  std::optional<std::size_t> least;
  std::optional<std::size_t> most;
  std::size_t known = 0;
  for (std::size_t v = 0; v < result.differences.size(); ++v) {
    const auto& own = result.differences[v];
    if (!own) continue;
    ++known;
    if (!least || *own < *result.differences[*least]) least = v;
    if (!most || *own > *result.differences[*most]) most = v;
  }
  if (known < 2) return;
  result.least_at = *least;
  result.most_at = *most;
  result.span = *result.differences[*most] - *result.differences[*least];
}

void find_share(Sensitivity& result, double variance) {
  if (variance <= 0.0) return;
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t v = 0; v < result.points.size(); ++v) {
    if (result.points[v] == 0) continue;
    if (!result.differences[v]) return;
    const auto n = static_cast<double>(result.points[v]);
    count += n;
    sum += n * *result.differences[v];
  }
  if (count == 0.0) return;
  for (std::size_t v = 0; v < result.points.size(); ++v) {
    if (result.points[v] == 0) continue;
    const double apart = *result.differences[v] - sum / count;
    squares += static_cast<double>(result.points[v]) * apart * apart;
  }
  result.share = squares / count / variance;
}

Sensitivity axis_sensitivity(const SweepTable& table, std::size_t axis, const Used& used, const Columns& columns,
                             const NormalEquations& fit, double variance) {
  Sensitivity result;
  result.axis = axis;
  result.effects = columns.effects;
  result.points = used.points[axis];
  result.differences.resize(result.points.size());
  const auto first = std::ranges::find_if(result.points, [](std::uint64_t n) { return n > 0; });
  if (first == result.points.end()) return result;
  result.reference = static_cast<std::size_t>(first - result.points.begin());
  if (table.baseline) {
    const std::size_t base = table.rows.at(*table.baseline).values[axis];
    if (result.points[base] > 0) result.reference = base;
  }
  for (std::size_t v = 0; v < result.points.size(); ++v) {
    if (result.points[v] == 0) continue;
    if (v == result.reference) {
      result.differences[v] = 0.0;
      continue;
    }
    std::vector<Term> terms;
    Layout::add(terms, columns, v, 1.0);
    Layout::add(terms, columns, result.reference, -1.0);
    if (!terms.empty()) result.differences[v] = fit.value(terms);
  }
  find_span(result);
  if (result.span) {
    find_share(result, variance);
  } else {
    result.effects = Effects::undetermined;
  }
  return result;
}

ObjectiveSensitivity objective_sensitivity(const SweepTable& table, std::size_t objective) {
  ObjectiveSensitivity result;
  const Used used = used_points(table, objective, result);
  result.design = design_of(table, used);
  const Layout layout(table, used);
  NormalEquations fit(layout.unknowns());
  for (std::size_t i = 0; i < used.rows.size(); ++i) fit.observe(layout.terms_of(*used.rows[i]), used.figures[i]);
  fit.solve();
  result.unknowns = fit.rank();

  double total = 0.0;
  double left = 0.0;
  for (std::size_t i = 0; i < used.rows.size(); ++i) {
    const double apart = used.figures[i] - fit.fitted(layout.terms_of(*used.rows[i]));
    total += used.figures[i] * used.figures[i];
    left += apart * apart;
  }
  // What rounding leaves of the mean's digits is no variation.
  const double noise = static_cast<double>(used.rows.size()) * std::pow(1e-13 * std::abs(result.mean), 2);
  if (total <= noise) total = 0.0;
  if (total > 0.0 && result.unknowns < result.points) result.unexplained = left / total;
  const double variance = used.rows.empty() ? 0.0 : total / static_cast<double>(used.rows.size());
  for (std::size_t a = 0; a < table.axes.size(); ++a)
    result.axes.push_back(axis_sensitivity(table, a, used, layout.of(a), fit, variance));
  return result;
}

}  // namespace

std::vector<ObjectiveSensitivity> find_sensitivity(const SweepTable& table) {
  check_table(table);
  std::vector<ObjectiveSensitivity> results;
  results.reserve(table.objectives.size());
  for (std::size_t o = 0; o < table.objectives.size(); ++o) results.push_back(objective_sensitivity(table, o));
  return results;
}

}  // namespace rastertlm::explore
