// Where things are after a million frames. The derivation stands in configs/hard_cases/million_frames.toml.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/exact_number.h"
#include "src/base/mathematics.h"
#include "src/scene/animation.h"

namespace rastertlm::analysis {
namespace {

using Matrix = std::array<std::array<Quad, 3>, 3>;  // by columns

// Counter-clockwise about the axis by that many degrees: cos I + (1 - cos) n n^T + sin [n]x.
Matrix rotation(const parameter::Triple& axis, Quad degrees) {
  std::array<Quad, 3> n{axis[0], axis[1], axis[2]};
  const Quad length = square_root(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (Quad& component : n) component /= length;
  const Quad c = cosine_deg(degrees), s = sine_deg(degrees);
  Matrix m{};
  for (std::size_t column = 0; column < 3; ++column)
    for (std::size_t row = 0; row < 3; ++row) m[column][row] = (1 - c) * n[column] * n[row] + (column == row ? c : 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
    m[i][next] += s * n[last];
    m[next][i] -= s * n[last];
  }
  return m;
}

class AnimationCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", "the catalogue's figures"});
    table.integer("frames", frames_, {1, 1'000'000'000}, {"", "Of the animation.", "the catalogue's figures"});
  }
  std::string step(const run::Inputs::Content& /*machine*/) const override { return "animation.deg_per_frame"; }

  double try_us(const run::Inputs::Content& /*machine*/) const override { return 7.0; }
  Measured measure(Trial& trial) const override {
    Measurement worst{"", "ulps of 1", 0.0, 0.0, BoundKind::required};
    const std::int64_t tries = trial.tries_or(tries_);
    for (std::int64_t round = 0; round < tries; ++round) {
      scene::AnimationDescription animation;
      animation.axis = {trial.numbers.uniform(-1, 1), trial.numbers.uniform(-1, 1), trial.numbers.uniform(0.1, 1)};
      animation.deg_per_frame = trial.numbers.uniform(-10, 10);
      // The last frame first.
      const std::int64_t frame = round == 0 ? frames_ : trial.numbers.whole(0, frames_);
      compare(animation, frame, trial.tampering, worst);
    }
    worst.what = fmt::format("entry of a rotation's matrix, {} frames of {}", tries, frames_);
    return {{worst}, {}};
  }

 private:
  static void compare(const scene::AnimationDescription& animation, std::int64_t frame, const Tampering& tampering,
                      Measurement& worst) {
    constexpr double kUlp = std::numeric_limits<double>::epsilon();
    const glm::dmat4 shown =
        tampering.animate ? tampering.animate(animation, frame) : scene::animate(glm::dmat4(1.0), {animation}, frame);
    const Quad degrees = static_cast<Quad>(animation.deg_per_frame) * static_cast<Quad>(frame);
    const Matrix right = rotation(animation.axis, degrees);
    const double angle = std::fabs(to_double(degrees)) * mathematics::kPi / 180;
    double off = 0.0;
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row)
        off =
            std::max(off, to_double(absolute(shown[column][row] -
                                             right[static_cast<std::size_t>(column)][static_cast<std::size_t>(row)])));
    keep_worst(worst, off / kUlp, 1.5 * angle * (1 + 1e-9) + 20);
  }

  std::int64_t tries_ = 1000;
  std::int64_t frames_ = 1'000'000;
};

}  // namespace

std::unique_ptr<CaseKind> animation_case() { return std::make_unique<AnimationCase>(); }

}  // namespace rastertlm::analysis
