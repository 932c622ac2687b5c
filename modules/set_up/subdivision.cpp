#include "modules/set_up/subdivision.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "modules/set_up/highlight_classifier.h"
#include "src/base/fixed_point.h"

namespace rastertlm::set_up {
namespace {

using Number = geometry::Counted<double>;

constexpr int kEdgeBits = 6;    // a highlight's place on an edge: 64ths of it
constexpr int kCentreBits = 6;  // and inside: 64ths of the corners' grid

constexpr std::size_t index_of(std::size_t row, std::size_t column) { return row * (row + 1) / 2 + column; }

}  // namespace

SubdivisionCounts& SubdivisionCounts::operator+=(const SubdivisionCounts& other) {
  divided += other.divided;
  parts += other.parts;
  centres += other.centres;
  beside += other.beside;
  unfound += other.unfound;
  inserted += other.inserted;
  at_limit += other.at_limit;
  at_grid_limit += other.at_grid_limit;
  return *this;
}

Subdivision::Subdivision(const SetUpParameters& parameters, PointLighting& lighting)
    : parameters_(parameters), lighting_(lighting) {}

void Subdivision::lit(LitCorner& corner, std::uint32_t material) {
  corner.levels = lighting_.levels(corner.point, material);
}

void Subdivision::light(std::vector<LitCorner>& corners, std::uint32_t material) {
  std::array<LitPoint, kLightLanes> points;
  std::array<PointLighting::Levels, kLightLanes> levels;
  for (std::size_t i = 0; i < corners.size(); i += kLightLanes) {
    const std::size_t count = std::min(kLightLanes, corners.size() - i);
    for (std::size_t k = 0; k < count; ++k) points[k] = corners[i + k].point;
    lighting_.levels({points.data(), count}, material, levels);
    for (std::size_t k = 0; k < count; ++k) corners[i + k].levels = levels[k];
  }
}

// Parts of 4^n, n the least for which they are smaller than the threshold: the area is that of the whole, halved twice
// a level. Every point of the grid of (2^n + 1) (2^n + 2) / 2 is lit once.
void Subdivision::regular(const LitTriangle& triangle, std::uint32_t material, std::vector<LitTriangle>& out) {
  const auto& [a, b, c] = triangle;
  const double unit = 1.0 / static_cast<double>(std::int64_t{1} << parameters_.corner_bits());
  const double area =
      std::fabs(static_cast<double>(geometry::doubled_area(a.point.at, b.point.at, c.point.at))) * 0.5 * unit * unit;
  operations_.integer += 5;
  operations_.integer_multiply += 2;
  operations_.convert += 1;
  std::int64_t levels = 0;
  for (double part = area; part >= parameters_.area_pixels; part *= 0.25) ++levels;
  operations_.multiply += static_cast<std::uint64_t>(levels);
  operations_.compare += static_cast<std::uint64_t>(levels) + 1;
  if (levels > parameters_.depth_limit) {
    levels = parameters_.depth_limit;
    ++counts_.at_limit;
  }
  if (levels == 0) {
    out.push_back(triangle);
    return;
  }
  const std::int64_t sides = std::int64_t{1} << levels;
  grid_.clear();
  for (std::int64_t row = 0; row <= sides; ++row)
    for (std::int64_t column = 0; column <= row; ++column) {
      const std::array<std::int64_t, 3> share{sides - row, row - column, column};
      LitCorner& corner = grid_.emplace_back();
      const double scale = 1.0 / static_cast<double>(sides);
      std::array<double, 3> weights{};
      for (std::size_t i = 0; i < 3; ++i) weights[i] = static_cast<double>(share[i]) * scale;
      corner.point = lighting_.inside({&a.point, &b.point, &c.point}, weights);
      corner.point.at = {(a.point.at.x * share[0] + b.point.at.x * share[1] + c.point.at.x * share[2]) >> levels,
                         (a.point.at.y * share[0] + b.point.at.y * share[1] + c.point.at.y * share[2]) >> levels};
      corner.depth = a.depth * weights[0] + b.depth * weights[1] + c.depth * weights[2];
    }
  operations_.multiply += 3 * grid_.size();
  operations_.add += 2 * grid_.size();
  operations_.integer += 10 * grid_.size();
  light(grid_, material);
  for (std::size_t row = 0; row < static_cast<std::size_t>(sides); ++row)
    for (std::size_t column = 0; column <= row; ++column) {
      const LitCorner &top = grid_[index_of(row, column)], &left = grid_[index_of(row + 1, column)],
                      &right = grid_[index_of(row + 1, column + 1)];
      out.push_back({top, left, right});
      if (column < row) out.push_back({top, right, grid_[index_of(row, column + 1)]});
    }
  ++counts_.divided;
  counts_.parts += static_cast<std::uint64_t>(sides * sides);
}

void Subdivision::highlight(const LitTriangle& triangle, std::uint32_t material, std::vector<LitTriangle>& out) {
  if (!lighting_.shines(material)) {
    out.push_back(triangle);
    return;
  }
  sources_ = highlight_sources({lighting_.lights(), lighting_.viewer_at_eye()}, glm::dmat4(1.0));
  const std::size_t before = out.size();
  const int spare = parameters_.corner_bits() - static_cast<int>(parameters_.snap_bits);
  for_lights_from(0, {triangle, spare}, material, out);
  const std::size_t parts = out.size() - before;
  if (parts < 2) return;
  ++counts_.divided;
  counts_.parts += parts;
}

// Light after light: parts that may hold the next one's highlight are cut again.
void Subdivision::for_lights_from(std::size_t light, const Part& part, std::uint32_t material,
                                  std::vector<LitTriangle>& out) {
  for (; light < sources_.size(); ++light) {
    const geometry::OperationCounts before = geometry::operation_counts;
    std::array<std::uint8_t, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i) {
      const SurfacePoint<Number> corner = surface_point(part.corners[i].point);
      sides[i] = highlight_sides<Number>(sources_[light], corner.position, corner.normal);
    }
    const bool may_be = may_be_highlighted(sides[0], sides[1], sides[2]);
    const auto found = may_be ? search(part.corners, sources_[light]) : std::nullopt;
    operations_ += geometry::operation_counts - before;
    if (!may_be) continue;
    if (!found) {
      ++counts_.unfound;
      continue;
    }
    if (part.spare_bits < kEdgeBits) {
      ++counts_.at_limit;
      ++counts_.at_grid_limit;
      continue;
    }
    const double least = std::min({found->centre[0].value(), found->centre[1].value(), found->centre[2].value()});
    return least > 0.0 ? at_centre(*found, light, part, material, out) : on_edge(*found, light, part, material, out);
  }
  out.push_back(part.corners);
}

std::optional<FoundHighlight<Subdivision::Number>> Subdivision::search(const LitTriangle& corners,
                                                                       const HighlightSource& source) {
  const std::array<SurfacePoint<Number>, 3> surface{surface_point(corners[0].point), surface_point(corners[1].point),
                                                    surface_point(corners[2].point)};
  return HighlightSearch<Number>(source, surface).find(static_cast<int>(parameters_.refinements));
}

// A new corner at the centre, three parts.
void Subdivision::at_centre(const FoundHighlight<Number>& found, std::size_t light, const Part& part,
                            std::uint32_t material, std::vector<LitTriangle>& out) {
  ++counts_.centres;
  const auto& corners = part.corners;
  LitCorner centre = inside(corners, {found.centre[0].value(), found.centre[1].value(), found.centre[2].value()},
                            part.spare_bits - kCentreBits);
  lit(centre, material);
  for (std::size_t i = 0; i < 3; ++i)
    along_edges(light, {{centre, corners[i], corners[(i + 1) % 3]}, part.spare_bits - kCentreBits}, material, out);
}

// A new corner on the edge where H1 is met nearest to the centre, two parts.
void Subdivision::on_edge(const FoundHighlight<Number>& found, std::size_t light, const Part& part,
                          std::uint32_t material, std::vector<LitTriangle>& out) {
  ++counts_.beside;
  const auto& corners = part.corners;
  const std::size_t apex = found.apex, next = (apex + 1) % 3, after = (apex + 2) % 3;
  // In the plane of the weights; the nearer of q and r.
  const auto away = [&](std::size_t to, double t) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = found.centre[i].value() - (i == apex ? 1.0 - t : (i == to ? t : 0.0));
      sum += d * d;
    }
    return sum;
  };
  operations_.multiply += 6;
  operations_.add += 14;
  operations_.compare += 1;
  const bool takes_q = away(next, found.q.value()) <= away(after, found.r.value());
  const std::size_t to = takes_q ? next : after;
  const LitCorner &a = corners[apex], &b = corners[to];
  // From a share of the surface to one of the screen, on the grid; never a corner itself.
  const double t = takes_q ? found.q.value() : found.r.value();
  double on_screen = t;
  if (parameters_.attributes == Attributes::perspective)
    on_screen = t * a.point.inverse_w / (t * a.point.inverse_w + (1.0 - t) * b.point.inverse_w);
  constexpr std::int64_t kParts = std::int64_t{1} << kEdgeBits;
  const std::int64_t share = std::clamp<std::int64_t>(round_half_up(on_screen * kParts), 1, kParts - 1);
  LitCorner corner = between(a, b, share, kEdgeBits);
  lit(corner, material);
  const int spare = part.spare_bits - kEdgeBits;
  // Both parts start at the new corner, turned as the whole is.
  const std::size_t opposite = takes_q ? after : next;
  const LitCorner& c = corners[opposite];
  if (takes_q) {
    along_edges(light, {{corner, b, c}, spare}, material, out);
    along_edges(light, {{corner, c, a}, spare}, material, out);
  } else {
    along_edges(light, {{corner, a, c}, spare}, material, out);
    along_edges(light, {{corner, c, b}, spare}, material, out);
  }
}

// Cuts at the middle of an edge that leaves the bright corner while light there is too far from its ends' mean, nearer
// and nearer to the bright corner. Edges are looked at on their own, so that parts on both sides of one agree.
void Subdivision::along_edges(std::size_t light, Part part, std::uint32_t material, std::vector<LitTriangle>& out) {
  bool first_done = false, second_done = false;
  for (std::int64_t depth = 0; !first_done || !second_done; ++depth) {
    if (depth >= parameters_.depth_limit || part.spare_bits < 1) {
      ++counts_.at_limit;
      counts_.at_grid_limit += depth < parameters_.depth_limit ? 1 : 0;
      break;
    }
    auto& [bright, a, b] = part.corners;
    const auto on_first = first_done ? std::nullopt : inserted(bright, a, material);
    const auto on_second = second_done ? std::nullopt : inserted(bright, b, material);
    first_done = first_done || !on_first;
    second_done = second_done || !on_second;
    part.spare_bits -= 1;
    if (on_first) {
      for_lights_from(light + 1, {{*on_first, a, b}, part.spare_bits}, material, out);
      a = *on_first;
    }
    if (on_second) {
      for_lights_from(light + 1, {{*on_second, a, b}, part.spare_bits}, material, out);
      b = *on_second;
    }
  }
  for_lights_from(light + 1, part, material, out);
}

std::optional<LitCorner> Subdivision::inserted(const LitCorner& bright, const LitCorner& other,
                                               std::uint32_t material) {
  LitCorner middle = between(bright, other, 1, 1);
  lit(middle, material);
  operations_.add += 6;
  operations_.multiply += 3;
  operations_.divide += 3;
  operations_.compare += 6;
  for (int c = 0; c < 3; ++c) {
    const double linear = (bright.levels[c] + other.levels[c]) * 0.5;
    // A level at least: of next to nothing every difference is large.
    if (std::fabs(linear - middle.levels[c]) > parameters_.intensity_error * std::max(middle.levels[c], 1.0)) {
      ++counts_.inserted;
      return middle;
    }
  }
  return std::nullopt;
}

// At `share` of 2^bits from a to b on the screen, exactly on the edge.
LitCorner Subdivision::between(const LitCorner& a, const LitCorner& b, std::int64_t share, int bits) {
  const double t = std::ldexp(static_cast<double>(share), -bits);
  LitCorner corner;
  corner.point = lighting_.inside({&a.point, &b.point, &b.point}, {1.0 - t, t, 0.0});
  corner.point.at = {a.point.at.x + ((share * (b.point.at.x - a.point.at.x)) >> bits),
                     a.point.at.y + ((share * (b.point.at.y - a.point.at.y)) >> bits)};
  corner.depth = a.depth + t * (b.depth - a.depth);
  operations_.add += 2;
  operations_.multiply += 1;
  operations_.integer += 6;
  operations_.integer_multiply += 2;
  return corner;
}

// At `weights` of the surface, moved to the grid that leaves `bits` spare ones.
LitCorner Subdivision::inside(const LitTriangle& corners, const std::array<double, 3>& weights, int bits) {
  std::array<double, 3> on_screen = weights;
  if (parameters_.attributes == Attributes::perspective) {
    // Weights of the surface are proportional to weights of the screen times 1 / w.
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) sum += on_screen[i] /= corners[i].point.inverse_w;
    for (double& weight : on_screen) weight /= sum;
    operations_.divide += 6;
    operations_.add += 2;
  }
  LitCorner corner;
  corner.point = lighting_.inside({&corners[0].point, &corners[1].point, &corners[2].point}, on_screen);
  double x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    x += on_screen[i] * static_cast<double>(corners[i].point.at.x);
    y += on_screen[i] * static_cast<double>(corners[i].point.at.y);
    corner.depth += on_screen[i] * corners[i].depth;
  }
  operations_.multiply += 9;
  operations_.add += 6;
  operations_.convert += 2;
  const std::int64_t unit = std::int64_t{1} << bits;
  const auto moved = [unit](double v) { return round_half_up(v / static_cast<double>(unit)) * unit; };
  corner.point.at = {moved(x), moved(y)};
  return corner;
}

}  // namespace rastertlm::set_up
