// The shading processor on normals and lights that break such machines: every level beside what interval arithmetic
// says of that very normal (chain_bound.h), in every exponent of the machine.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/chain_tables.h"
#include "src/analysis/shading_proofs.h"
#include "src/analysis/shading_search.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using shading::Direction;

// zero: no direction. unit: words of -1, 0 and 1. short_ones: below half of the link's magnitude. full_scale: at the
// ends of the word. grazing: the light, or the halfway vector, at right angles, up to a few steps of the sum. straight:
// the normal along the light and the halfway vector. any: near to the highlight.
enum class Normals { zero, unit, short_ones, full_scale, grazing, straight, any };

double dot(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Direction scaled(const Direction& v, double by) { return {v[0] * by, v[1] * by, v[2] * by}; }
Direction sum_of(const Direction& a, const Direction& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Direction unit(const Direction& v) { return scaled(v, 1 / std::sqrt(dot(v, v))); }

Direction random_direction(Numbers& numbers) {
  for (;;) {
    const Direction v{numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(-1, 1)};
    if (dot(v, v) > 0.01 && dot(v, v) < 1.0) return unit(v);
  }
}

NormalWords words_of(const Direction& v) { return {round_half_up(v[0]), round_half_up(v[1]), round_half_up(v[2])}; }

class Lighting {
 public:
  Lighting(const imogene::Machine& machine, Normals normals, Trial& trial)
      : bench_(machine.shading, machine.object_processor, quantities_of(machine.shading)),
        bound_(machine.shading, machine.object_processor.normal_bits),
        normals_(normals),
        trial_(trial),
        limit_(std::int64_t{1} << (machine.object_processor.word_bits - 1)),
        step_(std::ldexp(1.0, -static_cast<int>(machine.shading.dot_table_output_bits))),
        display_(display_rounding(machine.shading)) {
    for (std::size_t q = 0; q < bench_.quantities().size(); ++q) {
      const Quantity& quantity = bench_.quantities()[q];
      curves_.push_back(q == 0 ? diffuse_curve(1) : specular_curve(1, quantity.exponent));
    }
    const auto& exponents = machine.shading.exponents;
    worst_.push_back({"diffuse", "levels", 0.0, 0.0, BoundKind::proved});
    if (normals == Normals::any) {
      for (const std::int64_t e : exponents)
        worst_.push_back({fmt::format("exponent {}", e), "levels", 0.0, 0.0, BoundKind::proved});
    } else {
      worst_.push_back(
          {fmt::format("highlights of {} exponents", exponents.size()), "levels", 0.0, 0.0, BoundKind::proved});
    }
  }

  Measured measure(std::int64_t tries) {
    constexpr std::int64_t kNormalsALight = 50;
    for (std::int64_t i = 0; i < tries; ++i) {
      if (i % kNormalsALight == 0) next_light();
      look_at(next_normal(i));
    }
    Measured found{worst_, {}};
    found.measurements.push_back({fmt::format("{} levels of normals that are zero", zeros_), "levels beside ambient",
                                  static_cast<double>(lit_zeros_), 0.0, BoundKind::proved});
    found.measurements.push_back({fmt::format("{} sums above full scale", above_), "indices beside the last",
                                  static_cast<double>(wrapped_), 0.0, BoundKind::proved});
    if (normals_ == Normals::any) found.measurements.push_back(tables_as_filled());
    if (zeros_ > 0 && normals_ != Normals::zero)
      found.notes.emplace_back(
          "components of -1 are 0 in one's complement: normals of 0 and -1 alone have no direction.");
    if (shorts_ > 0)
      found.notes.push_back(
          fmt::format("{} of {} normals are short: they darken, as their bound says.", shorts_, tries));
    return found;
  }

 private:
  // The bounds above take tables as they were filled: here each entry, of every constant, is held against its formula.
  Measurement tables_as_filled() const {
    const shading::ShadingParameters& p = std::as_const(bench_).shader().parameters();
    Measurement worst{"tables, every entry of every constant", "levels", 0.0, 0.0, BoundKind::proved};
    const Proof diffuse = prove_diffuse_tables(p);
    keep_worst(worst, diffuse.worst, diffuse.closed_form);
    for (const std::int64_t exponent : p.exponents) {
      const Proof specular = prove_specular_tables(p, exponent);
      keep_worst(worst, specular.worst, specular.closed_form);
    }
    return worst;
  }

  static std::vector<Quantity> quantities_of(const shading::ShadingParameters& p) {
    std::vector<Quantity> list{{"diffuse", 0, 1, 0, p.exponents.front()}};
    for (const std::int64_t e : p.exponents) list.push_back({fmt::format("exponent {}", e), 0, 0, 1, e});
    return list;
  }

  void next_light() {
    Direction light = random_direction(trial_.numbers);
    while (light[2] < -0.9) light = random_direction(trial_.numbers);
    // Straight on: every other light is where the viewer is, so that N, L and H are parallel.
    if (normals_ == Normals::straight && trial_.numbers.whole(0, 1) == 0) light = {0, 0, 1};
    bench_.set_light(light);
    // Tables of materials do not change with the light's direction: the bounds take them as they were filled.
    for (std::size_t q = tables_.size(); q < curves_.size(); ++q)
      tables_.emplace_back(q == 0 ? diffuse_table(bench_, q) : specular_table(bench_, q));
    if (trial_.tampering.shading_tables) trial_.tampering.shading_tables(bench_.shader().front());
  }

  NormalWords next_normal(std::int64_t i) {
    Numbers& numbers = trial_.numbers;
    const auto any_length = [&] { return numbers.uniform(0.26, 0.99) * static_cast<double>(limit_); };
    const Direction& target = i % 2 == 0 ? bench_.light().towards : bench_.light().halfway;
    switch (normals_) {
      case Normals::zero:
        return {0, 0, 0};
      case Normals::unit:
        return {numbers.whole(-1, 1), numbers.whole(-1, 1), numbers.whole(-1, 1)};
      case Normals::short_ones: {
        const double half = std::ldexp(1.0, static_cast<int>(bench_.normal_bits()) - 2);
        return words_of(scaled(random_direction(numbers), numbers.uniform(1, half)));
      }
      case Normals::full_scale: {
        NormalWords words{};
        const auto end = [&] { return numbers.whole(0, 1) == 0 ? -limit_ : limit_ - 1; };
        for (std::int64_t& word : words) word = numbers.whole(0, 2) == 0 ? numbers.whole(-limit_, limit_ - 1) : end();
        return words;
      }
      case Normals::grazing: {
        const Direction v = random_direction(numbers);
        const Direction across = sum_of(v, scaled(target, -dot(v, target)));
        if (dot(across, across) < 1e-3) return next_normal(i + 1);
        const double lift = step_ * static_cast<double>(numbers.whole(-8, 8)) / 2;
        return words_of(scaled(unit(sum_of(unit(across), scaled(target, lift))), any_length()));
      }
      case Normals::straight:
        return words_of(scaled(target, any_length()));
      case Normals::any:
        break;
    }
    const Direction beside = scaled(random_direction(numbers), numbers.uniform(0, 0.6));
    return words_of(scaled(unit(sum_of(target, beside)), any_length()));
  }

  void look_at(const NormalWords& words) {
    ShadingBench::Pixel pixel = bench_.pixel(words);
    const ShadingBench::Pixel given = pixel;
    if (trial_.tampering.link_normal) trial_.tampering.link_normal(pixel.link);
    shorts_ += given.is_short && !given.is_zero ? 1 : 0;
    for (std::size_t q = 0; q < curves_.size(); ++q) {
      const int level = bench_.level(pixel, q);
      if (given.is_zero) {
        ++zeros_;
        lit_zeros_ += level != 0 ? 1 : 0;
        continue;
      }
      const double cosine = q == 0 ? given.towards : given.halfway;
      const Range range = level_range(bound_.sum_at(cosine, given.squares), tables_[q], curves_[q]);
      const double exact = bench_.exact_level(given, q);
      keep_largest(worst_[std::min(q, worst_.size() - 1)], std::fabs(level - exact),
                   std::max(exact - range.low, range.high - exact) + display_);
    }
    look_at_sums(pixel);
  }

  // What the terminate adder makes of sums above full scale: a wrapped index would be a dark dot in a highlight.
  void look_at_sums(const ShadingBench::Pixel& pixel) {
    const shading::DeferredShader& shader = std::as_const(bench_).shader();
    const auto normal = shader.normaliser().normalise(pixel.link[0], pixel.link[1], pixel.link[2]);
    const shading::DotProduct& unit = shader.dot_product();
    const auto last = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(shader.parameters().index_bits)));
    const shading::LightTables& tables = shader.front().lights[0];
    for (const shading::DotTables* dots : {&tables.diffuse, &tables.specular}) {
      std::int32_t terms = 0;
      for (std::size_t i = 0; i < 3; ++i)
        terms += shading::DotProduct::signed_term(dots->products[i][normal.magnitude[i]],
                                                  normal.negative[i] != dots->negative[i]);
      if (!unit.saturates(unit.sum(terms, 0, 0))) continue;
      ++above_;
      wrapped_ += unit.evaluate(*dots, normal) != last ? 1 : 0;
    }
  }

  ShadingBench bench_;
  CosineBound bound_;
  Normals normals_;
  Trial& trial_;
  std::int64_t limit_;
  double step_;     // of the dot products' sum
  double display_;  // what a display of fewer bits rounds, levels
  std::vector<Curve> curves_;
  std::vector<LevelTable> tables_;
  std::vector<Measurement> worst_;  // diffuse, then highlights: an exponent each, or all of them together
  std::uint64_t zeros_ = 0, lit_zeros_ = 0, above_ = 0, wrapped_ = 0, shorts_ = 0;
};

class ShadingCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random normals.", "the catalogue's figures"});
    table.choice("normals", normals_, {"zero", "unit", "short", "full_scale", "grazing", "straight", "any"},
                 {"", "Which normals are drawn at random.", "the catalogue's figures"});
  }
  std::string step(const run::Inputs::Content& /*machine*/) const override {
    switch (normals_) {
      case Normals::grazing:
      case Normals::straight:
        return "shading.dot_table_output_bits";
      case Normals::any:
        return "shading.index_bits";
      default:
        return "object_processor.normal_bits";
    }
  }
  double try_us(const run::Inputs::Content& /*machine*/) const override { return 3.0; }
  Measured measure(Trial& trial) const override {
    const imogene::Machine* machine = trial.object_machine();
    if (machine == nullptr) return {};
    return Lighting(*machine, normals_, trial).measure(trial.tries_or(tries_));
  }

 private:
  std::int64_t tries_ = 10'000;
  Normals normals_ = Normals::any;
};

}  // namespace

std::unique_ptr<CaseKind> shading_case() { return std::make_unique<ShadingCase>(); }

}  // namespace rastertlm::analysis
