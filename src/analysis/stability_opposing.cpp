// Normals that oppose each other at two corners of a triangle: what is interpolated between them vanishes on the way,
// and close to there it has the direction of what rounding left.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/object_processor/line_evaluator.h"
#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/chain_tables.h"
#include "src/analysis/plane_bounds.h"
#include "src/analysis/shading_search.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using geometry::SnappedPoint;
using shading::Direction;

double dot(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Direction random_unit(Numbers& numbers) {
  for (;;) {
    const Direction v{numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(-1, 1)};
    const double length = std::sqrt(dot(v, v));
    if (length > 0.1 && length < 1.0) return {v[0] / length, v[1] / length, v[2] / length};
  }
}

class Opposing {
 public:
  Opposing(const imogene::Machine& machine, Trial& trial)
      : trial_(trial),
        format_{static_cast<int>(machine.object_processor.word_bits), static_cast<std::size_t>(machine.video.columns),
                static_cast<std::size_t>(machine.video.lines), machine.object_processor.edges},
        grid_(imogene::snap_grids(machine).on_screen),
        word_(static_cast<unsigned>(format_.word_bits)),
        bench_(machine.shading, machine.object_processor, quantities_of(machine.shading)),
        bound_(machine.shading, machine.object_processor.normal_bits),
        curve_(specular_curve(1, bench_.quantities()[1].exponent)),
        display_(display_rounding(machine.shading)) {
    if (format_.edges == set_up::EdgeForm::scaled) grid_.fraction_bits = set_up::kScaledFractionBits;
  }

  Measured measure(std::int64_t tries) {
    constexpr int kPixels = 20;
    for (std::int64_t i = 0; i < tries; ++i) {
      if (!next_triangle()) continue;
      bench_.set_light(random_light());
      tables_ = {diffuse_table(bench_, 0), specular_table(bench_, 1)};
      for (int k = 0; k < kPixels; ++k) look_at_pixel();
    }
    return {{diffuse_, specular_, zero_},
            {fmt::format("{} of {} pixels have no normal at all: ambient light alone.", zeros_, pixels_)}};
  }

 private:
  static std::vector<Quantity> quantities_of(const shading::ShadingParameters& p) {
    const std::int64_t last = *std::max_element(p.exponents.begin(), p.exponents.end());
    return {{"diffuse", 0, 1, 0, last}, {"highlight", 0, 0, 1, last}};
  }

  Direction random_light() {
    Direction light = random_unit(trial_.numbers);
    while (light[2] < -0.9) light = random_unit(trial_.numbers);
    return light;
  }

  // Front faces, wholly on the screen; the normal of corner 1 opposes that of corner 0, but for a thousandth at most.
  bool next_triangle() {
    Numbers& numbers = trial_.numbers;
    const int q = grid_.fraction_bits;
    const auto last_x = static_cast<std::int64_t>(format_.columns - 1) << q;
    const auto last_y = static_cast<std::int64_t>(format_.lines - 1) << q;
    for (SnappedPoint& p : corners_) p = {numbers.whole(0, last_x), numbers.whole(0, last_y)};
    // Two thirds of them: two corners to both sides of a sample where next to nothing is left of a normal; a few pixels
    // apart, or across the screen.
    const std::int64_t family = numbers.whole(0, 2);
    if (family > 0) put_around_sample(family == 1);
    area_ = geometry::doubled_area(corners_[0], corners_[1], corners_[2]);
    if (area_ == 0) return false;
    if (area_ > 0) std::swap(corners_[0], corners_[1]);
    area_ = std::llabs(area_);
    const Direction first = random_unit(numbers), third = random_unit(numbers);
    const double off = family > 0 || numbers.whole(0, 1) == 0 ? 0.0 : 0.001;
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<std::size_t>(c);
      screen_[0].normal[c] = first[i];
      screen_[1].normal[c] = std::clamp(-first[i] + numbers.uniform(-off, off), -1.0, 1.0);
      screen_[2].normal[c] = third[i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      screen_[i].x = std::ldexp(static_cast<double>(corners_[i].x), -q);
      screen_[i].y = std::ldexp(static_cast<double>(corners_[i].y), -q);
    }
    const auto result = set_up::set_up_triangle<double>(screen_, 0, false, grid_, format_);
    words_ = result.words;
    if (trial_.tampering.object_words) trial_.tampering.object_words(words_);
    return result.outcome == set_up::Outcome::drawn;
  }

  void put_around_sample(bool near) {
    Numbers& numbers = trial_.numbers;
    constexpr std::int64_t kNear = 4, kSteps = 3;
    const auto columns = static_cast<std::int64_t>(format_.columns), lines = static_cast<std::int64_t>(format_.lines);
    const std::int64_t x = numbers.whole(kNear, columns - 1 - kNear), y = numbers.whole(kNear, lines - 1 - kNear);
    const std::int64_t reach_x = near ? kNear : std::min(x, columns - 1 - x) - 1;
    const std::int64_t reach_y = near ? kNear : std::min(y, lines - 1 - y) - 1;
    const std::int64_t dx = numbers.whole(0, reach_x), dy = numbers.whole(-reach_y, reach_y);
    const int q = grid_.fraction_bits;
    corners_[0] = {(x - dx) << q, (y - dy) << q};
    // A few steps of the grid beside the opposite place: what is left is a part of a pixel's change.
    corners_[1] = {((x + dx) << q) + (near ? 0 : numbers.whole(0, kSteps)), (y + dy) << q};
    if (near) corners_[2] = {(x + numbers.whole(-kNear, kNear)) << q, (y + numbers.whole(-kNear, kNear)) << q};
  }

  // Along the edge between the two, mostly where the normal vanishes, and a little inside.
  void look_at_pixel() {
    Numbers& numbers = trial_.numbers;
    const double along = numbers.whole(0, 3) == 0 ? numbers.uniform(0, 1) : 0.5 + numbers.uniform(-0.003, 0.003);
    const double in = numbers.whole(0, 1) == 0 ? 0.0 : numbers.uniform(0, 0.003);
    const auto at = [&](double a, double b, double c) { return (1 - in) * ((1 - along) * a + along * b) + in * c; };
    const std::int64_t x = round_half_up(at(screen_[0].x, screen_[1].x, screen_[2].x));
    const std::int64_t y = round_half_up(at(screen_[0].y, screen_[1].y, screen_[2].y));
    const SnappedPoint sample{x << grid_.fraction_bits, y << grid_.fraction_bits};
    std::array<double, 3> weight{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t part = -geometry::doubled_area(corners_[(i + 1) % 3], corners_[(i + 2) % 3], sample);
      if (part < 0) return;  // outside
      weight[i] = static_cast<double>(part) / static_cast<double>(area_);
    }
    const auto unit = static_cast<double>(set_up::normal_unit(format_));
    Direction exact{};
    NormalWords normal{};
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<std::size_t>(c);
      for (std::size_t k = 0; k < 3; ++k) exact[i] += weight[k] * screen_[k].normal[c] * unit;
      normal[i] = sign_extend(word_.at(words_.normals[i], static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)),
                              word_.bits());
    }
    compare(normal, exact, plane_error(x, y));
  }

  // Of the words at that pixel: by the distance from the middle of the box. An eighth of a unit more is for the exact
  // plane itself, which is summed in double here.
  double plane_error(std::int64_t x, std::int64_t y) const {
    const auto [left, right] = std::minmax({screen_[0].x, screen_[1].x, screen_[2].x});
    const auto [top, bottom] = std::minmax({screen_[0].y, screen_[1].y, screen_[2].y});
    const double distance =
        std::fabs(static_cast<double>(x) - (left + right) / 2) + std::fabs(static_cast<double>(y) - (top + bottom) / 2);
    const double largest = 2 * static_cast<double>(set_up::normal_unit(format_));
    return 0.5 * (distance + 1) + plane_bound(format_, grid_, false, largest, static_cast<double>(area_)).computing +
           0.125;
  }

  void compare(const NormalWords& normal, const Direction& exact, double plane) {
    ++pixels_;
    const ShadingBench::Pixel pixel = bench_.pixel(normal);
    const double length = std::sqrt(dot(exact, exact));
    if (pixel.is_zero) {  // words of 0 and -1 are such
      ++zeros_;
      keep_worst(zero_, std::max({std::fabs(exact[0]), std::fabs(exact[1]), std::fabs(exact[2])}), plane + 1);
      return;
    }
    if (!(length > 0.0)) return;
    const double half_box = 0.5 + std::ldexp(plane, -static_cast<int>(pixel.shift));
    const double towards = dot(exact, bench_.light().towards) / length;
    const double halfway = dot(exact, bench_.light().halfway) / length;
    const auto keep = [&](Measurement& worst, std::size_t q, double cosine, const Curve& curve) {
      const Range range = level_range(bound_.sum_at(cosine, pixel.squares, half_box), tables_[q], curve);
      const double level = bench_.level(pixel, q), wanted = bench_.quantities()[q].exact(towards, halfway);
      // Where nothing is known of the direction, the whole range is no finding.
      if (range.high - range.low > 254.0) return;
      keep_largest(worst, std::fabs(level - wanted), std::max(wanted - range.low, range.high - wanted) + display_);
    };
    keep(diffuse_, 0, towards, diffuse_curve(1));
    keep(specular_, 1, halfway, curve_);
  }

  Trial& trial_;
  set_up::WordFormat format_;
  geometry::SnapGrid grid_;
  object_processor::WordFormat word_;
  ShadingBench bench_;
  CosineBound bound_;
  Curve curve_;
  double display_;  // what a display of fewer bits rounds, levels
  std::array<LevelTable, 2> tables_;
  std::array<SnappedPoint, 3> corners_{};
  set_up::ScreenTriangle<double> screen_{};
  std::int64_t area_ = 0;
  object_processor::TriangleWords words_;
  Measurement diffuse_{"diffuse light of the interpolated normal", "levels", 0.0, 0.0, BoundKind::proved};
  Measurement specular_{"highlight of the largest exponent", "levels", 0.0, 0.0, BoundKind::proved};
  Measurement zero_{"interpolated normals that are zero in the machine", "units of EP1", 0.0, 0.0, BoundKind::proved};
  std::uint64_t pixels_ = 0, zeros_ = 0;
};

class OpposingNormalsCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random triangles.", "the catalogue's figures"});
  }
  std::string step(const run::Inputs::Content& /*machine*/) const override { return "object_processor.word_bits"; }
  double try_us(const run::Inputs::Content& /*machine*/) const override { return 15.0; }
  Measured measure(Trial& trial) const override {
    const imogene::Machine* machine = trial.object_machine();
    if (machine == nullptr) return {};
    return Opposing(*machine, trial).measure(trial.tries_or(tries_));
  }

 private:
  std::int64_t tries_ = 500;
};

}  // namespace

std::unique_ptr<CaseKind> opposing_normals_case() { return std::make_unique<OpposingNormalsCase>(); }

}  // namespace rastertlm::analysis
