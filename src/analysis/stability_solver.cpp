// The solver of a triangle's colours in the numbers of the set-up processor, beside a running error bound: derived at
// the head of solver_bound.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/set_up/quadratic_solver.h"
#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/solver_bound.h"

namespace rastertlm::analysis {
namespace {

using set_up::Offsets;
using set_up::QuadraticForm;
using set_up::SetUpParameters;

constexpr int kParts = 4;  // points in fourths of v and w: exact in any of the numbers

// Well shaped; with the edge from corner 1 to corner 2 level, or almost; thin.
enum class TriangleFamily { well_shaped, level, near_level, sliver };

struct Triangles {
  TriangleFamily family = TriangleFamily::well_shaped;
  double size_pixels = 300.0;
  double aspect = 1.0;
  double height_pixels = 1.0;
};

// Random, of the case's family: corners 2 and 3 from corner 1.
Offsets<double> triangle(const Triangles& c, Numbers& numbers) {
  const auto any = [&] { return numbers.uniform(-c.size_pixels, c.size_pixels); };
  Offsets<double> at{any(), any(), any(), any()};
  if (c.family == TriangleFamily::level) at.y2 = 0.0;
  if (c.family == TriangleFamily::near_level) at.y2 = at.y2 < 0 ? -c.height_pixels : c.height_pixels;
  if (c.family == TriangleFamily::sliver) {
    const double part = numbers.uniform(0.2, 0.8), length = std::hypot(at.x2, at.y2);
    const double height = length / c.aspect;
    at.x3 = part * at.x2 - at.y2 / length * height;
    at.y3 = part * at.y2 + at.x2 / length * height;
  }
  return at;
}

bool is_of_family(const Triangles& c, const Offsets<double>& at) {
  if (!std::isfinite(at.x2 + at.y2 + at.x3 + at.y3)) return true;  // numbers that do not hold it never will
  const double area = std::fabs(at.x2 * at.y3 - at.y2 * at.x3);
  const double longest =
      std::max({std::hypot(at.x2, at.y2), std::hypot(at.x3, at.y3), std::hypot(at.x3 - at.x2, at.y3 - at.y2)});
  if (c.family == TriangleFamily::sliver) return area > 0.0;
  return area > 0.2 * longest * longest;
}

// What a set-up processor computes in: its numbers, its solver, and what is proved of it.
struct Floating {
  double u;  // half of the last place of 1
  double bound(const Offsets<double>& at, const Levels& levels, const Weights& p) const {
    return floating_bound(at, levels, p, u);
  }
};
struct Fixed {
  int fraction_bits;
  double bound(const Offsets<double>& at, const Levels& levels, const Weights& p) const {
    return fixed_bound(at, levels, p, fraction_bits);
  }
};

template <class T>
Offsets<T> held(const Offsets<double>& at) {
  return {static_cast<T>(at.x2), static_cast<T>(at.y2), static_cast<T>(at.x3), static_cast<T>(at.y3)};
}
template <class T>
Offsets<double> plain(const Offsets<T>& at) {
  using set_up::as_double;
  return {as_double(at.x2), as_double(at.y2), as_double(at.x3), as_double(at.y3)};
}
template <class T>
QuadraticForm<double> plain(const QuadraticForm<T>& form) {
  using set_up::as_double;
  return {as_double(form.t0), as_double(form.t1), as_double(form.t2),
          as_double(form.t3), as_double(form.t4), as_double(form.t5)};
}

class SolverBench {
 public:
  SolverBench(const Triangles& of, Trial& trial, std::int64_t tries)
      : of_(of), numbers_(trial.numbers), tampering_(trial.tampering), tries_(tries) {}

  template <class T, class Proof>
  void quadratic(set_up::Solver solver, const Proof& proof) {
    for_triangles<T>([&](const Offsets<T>& corners, const Offsets<double>& at, const Levels& levels) {
      QuadraticForm<double> form = plain(set_up::solve<T, 1>(solver, corners, {six<T>(levels)})[0]);
      if (tampering_.form) tampering_.form(form);
      compare([&](const Weights& p) { return error_of(form, at, levels, p); },
              [&](const Weights& p) { return proof.bound(at, levels, p); });
    });
  }

  void linear() {
    constexpr double kHalfPlace = std::numeric_limits<double>::epsilon() / 2;
    for_triangles<double>([&](const Offsets<double>& corners, const Offsets<double>& at, const Levels& levels) {
      const set_up::LinearSolver<double> solver(corners.x2, corners.y2, corners.x3, corners.y3);
      QuadraticForm<double> form = solver.solve(levels[0], levels[1], levels[2]);
      if (tampering_.form) tampering_.form(form);
      compare([&](const Weights& p) { return linear_error_of(form, at, levels, p); },
              [&](const Weights& p) { return floating_linear_bound(at, levels, p, kHalfPlace); });
    });
  }

  // `numbers`: what the processor computes in.
  Measured found(const std::string& numbers) {
    Measured result;
    worst_.what = fmt::format("triangles of {} pixels in {}", of_.size_pixels, numbers);
    worst_.inputs = tries_ - unproved_;
    if (worst_.inputs > 0) result.measurements.push_back(worst_);
    if (unproved_ > 0)
      result.notes.push_back(fmt::format("nothing is proved of {} of {} triangles, which may leave the numbers of {}",
                                         unproved_, tries_, numbers));
    return result;
  }

 private:
  template <class T, class Body>
  void for_triangles(const Body& body) {
    for (std::int64_t round = 0; round < tries_; ++round) {
      Offsets<T> corners = held<T>(triangle(of_, numbers_));
      while (!is_of_family(of_, plain(corners))) corners = held<T>(triangle(of_, numbers_));
      Levels levels{};
      for (double& level : levels) level = static_cast<double>(numbers_.whole(0, 255));
      body(corners, plain(corners), levels);
    }
  }

  template <class Error, class Bound>
  void compare(const Error& error, const Bound& bound) {
    bool proved = true;
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; i + j <= kParts; ++j) {
        const Weights p{static_cast<double>(i) / kParts, static_cast<double>(j) / kParts};
        if (i + j == 0) continue;
        const double most = bound(p);
        proved = proved && !std::isinf(most);
        if (!std::isinf(most)) keep_worst(worst_, error(p), most);
      }
    unproved_ += proved ? 0 : 1;
  }

  const Triangles& of_;
  Numbers& numbers_;
  const Tampering& tampering_;
  std::int64_t tries_;
  std::int64_t unproved_ = 0;
  Measurement worst_{"", "levels", 0.0, 0.0, BoundKind::proved};
};

void solve_in_fixed(SolverBench& bench, const SetUpParameters& parameters) {
  switch (parameters.fixed_fraction_bits) {
    case 16:
      return bench.quadratic<set_up::FixedNumber<16>>(parameters.solver, Fixed{16});
    case 24:
      return bench.quadratic<set_up::FixedNumber<24>>(parameters.solver, Fixed{24});
    case 32:
      return bench.quadratic<set_up::FixedNumber<32>>(parameters.solver, Fixed{32});
    case 40:
      return bench.quadratic<set_up::FixedNumber<40>>(parameters.solver, Fixed{40});
    default:
      return bench.quadratic<set_up::FixedNumber<48>>(parameters.solver, Fixed{48});
  }
}

class QuadraticSolverCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", "the catalogue's figures"});
    table.choice("family", of_.family, {"well_shaped", "level", "near_level", "sliver"},
                 {"", "Which triangles are drawn at random.", "the catalogue's figures"});
    table.real("size_pixels", of_.size_pixels, {1e-6, 1e8}, {"pixels", "Longest side.", "the catalogue's figures"});
    table.real("aspect", of_.aspect, {1.0, 1e8},
               {"", "Of slivers: longest side by height.", "the catalogue's figures"});
    table.real("height_pixels", of_.height_pixels, {0.0, 1e6, true},
               {"pixels", "Of edges that are almost level: |Y2|.", "the catalogue's figures"});
  }
  std::string step(const run::Inputs::Content& /*machine*/) const override { return "set_up.solver"; }
  double try_us(const run::Inputs::Content& /*machine*/) const override { return 15.0; }

  Measured measure(Trial& trial) const override {
    const quadratic::Machine* machine = trial.span_machine();
    if (machine == nullptr) return {};
    const SetUpParameters& parameters = machine->set_up;
    SolverBench bench(of_, trial, trial.tries_or(tries_));
    if (parameters.linear()) {
      bench.linear();
      return bench.found("64 bits, linear");
    }
    switch (parameters.arithmetic) {
      case set_up::SetUpArithmetic::fixed:
        solve_in_fixed(bench, parameters);
        return bench.found(fmt::format("64 bits with a fixed point, {} behind it", parameters.fixed_fraction_bits));
      case set_up::SetUpArithmetic::single_precision:
        bench.quadratic<float>(parameters.solver, Floating{std::numeric_limits<float>::epsilon() / 2.0});
        return bench.found("32 bits");
      case set_up::SetUpArithmetic::double_precision:
        break;
    }
    bench.quadratic<double>(parameters.solver, Floating{std::numeric_limits<double>::epsilon() / 2});
    return bench.found("64 bits");
  }

 private:
  std::int64_t tries_ = 100;
  Triangles of_;
};

}  // namespace

std::unique_ptr<CaseKind> quadratic_solver_case() { return std::make_unique<QuadraticSolverCase>(); }

}  // namespace rastertlm::analysis
