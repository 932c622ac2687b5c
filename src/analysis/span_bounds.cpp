#include "src/analysis/span_bounds.h"

#include <cmath>
#include <limits>

namespace rastertlm::analysis {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kDouble = 0x1p-53;
constexpr double kSingle = 0x1p-24;
constexpr double kSlopes = 2 * 1020;           // |c2| + |c3|
constexpr double kBends = 1020 + 2040 + 1020;  // |q2| + |c23| + |q3|
constexpr double kLinearSlopes = 2 * 255;      // of colours at three corners
constexpr int kRoundings = 40;

double diagonal(const quadratic::Machine& machine) {
  return std::hypot(static_cast<double>(machine.video.columns) - 1, static_cast<double>(machine.video.lines) - 1);
}

// From corner 1 to the start, along the edge to the line, along the line to the pixel.
double longest_way(const quadratic::Machine& machine) {
  return 4 * static_cast<double>(machine.video.columns) + 3 * static_cast<double>(machine.video.lines);
}

}  // namespace

double thinnest_on_grid(const quadratic::Machine& machine) {
  return std::ldexp(1.0, -2 * machine.set_up.corner_bits()) / diagonal(machine);
}

double solver_bound(const quadratic::Machine& machine, double altitude) {
  const set_up::SetUpParameters& p = machine.set_up;
  if (!p.clamp_knots) return kInfinite;
  const double thin = diagonal(machine) / altitude;
  // Linear colours are solved in double.
  if (p.linear()) return 9 * kDouble * kLinearSlopes * thin * (1 + 1e-9);
  if (p.solver != set_up::Solver::barycentric || p.arithmetic == set_up::SetUpArithmetic::fixed) return kInfinite;
  const double u = p.arithmetic == set_up::SetUpArithmetic::single_precision ? kSingle : kDouble;
  const double e = (thin * u + u) / (1 - u);
  if (!(e < 0.5)) return kInfinite;
  const double eta = (e + u) / (1 - e);
  const double gamma = 7 * u / (1 - 7 * u);
  return (gamma * (kSlopes * thin + kBends * thin * thin) * (1 + eta) * (1 + eta) + eta * 1020 +
          (2 * eta + eta * eta) * 1020) *
         (1 + 1e-9);
}

std::uint64_t longest_path(const quadratic::Machine& machine) {
  return span_unit::longest_iteration(machine.span_unit, static_cast<std::uint64_t>(machine.video.columns),
                                      static_cast<std::uint64_t>(machine.video.lines));
}

double register_bound(const quadratic::Machine& machine, std::int64_t fraction_bits, double altitude) {
  if (machine.span_unit.start_edge != span_unit::StartEdge::lattice) return kInfinite;
  const double way = longest_way(machine) / altitude;
  if (machine.set_up.linear())
    return span_unit::linear_fraction_bound(fraction_bits, longest_path(machine)) +
           kRoundings * kDouble * kLinearSlopes * way;
  return span_unit::fraction_bound(fraction_bits, longest_path(machine)) +
         kRoundings * kDouble * (kSlopes * way + kBends * way * way);
}

double depth_bound(const quadratic::Machine& machine, double altitude) {
  if (machine.span_unit.start_edge != span_unit::StartEdge::lattice) return kInfinite;
  const double range = std::ldexp(1.0, static_cast<int>(machine.span_unit.depth_bits));
  return 1.0 + span_unit::linear_fraction_bound(machine.span_unit.depth_fraction_bits, longest_path(machine)) +
         kRoundings * kDouble * 2 * range * longest_way(machine) / altitude;
}

}  // namespace rastertlm::analysis
