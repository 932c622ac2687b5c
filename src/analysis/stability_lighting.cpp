// Light at points, as machines with a span unit compute it on their host, beside the same in 113 bits.
//
// u = 2^-53. The components of both unit vectors are off by a part of at most 6 u (three squares, two sums, a root, a
// division and a product; the halfway vector is a sum first), their products and sum by 3 u more: a cosine c by at most
// 16 u, as the products of two unit vectors' components add up to 1 at most. A power by squaring is at most E - 1
// products deep: x^E is off by a part of (E - 1) u, and by E c^(E - 1) 16 u for its cosine. Three products and a sum,
// of at most 255 levels each, are 8 u.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/base/mathematics.h"

namespace rastertlm::analysis {
namespace {

__extension__ using Quad = __float128;

constexpr double kHalfPlace = 0x1p-53;
constexpr double kLevels = 255.0;

struct QuadVector {
  Quad x, y, z;
};
QuadVector widened(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
Quad dot(const QuadVector& a, const QuadVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Newton's iteration from the double's root doubles its 53 bits.
Quad root(Quad value) {
  const Quad start = std::sqrt(static_cast<double>(value));
  if (!(start > 0)) return 0;
  const Quad better = (start + value / start) / 2;
  return (better + value / better) / 2;
}

Quad power(Quad base, std::int64_t exponent) {
  Quad result = 1;
  for (std::int64_t i = 0; i < exponent; ++i) result *= base;
  return result;
}

glm::dvec3 random_vector(Numbers& numbers) {
  for (;;) {
    const glm::dvec3 v{numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(-1, 1)};
    const double square = v.x * v.x + v.y * v.y + v.z * v.z;
    if (square > 0.01 && square < 1.0) return v;
  }
}

glm::dvec3 unit(const glm::dvec3& v) { return v * (1.0 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z)); }

class LightingCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random normals.", "the catalogue's figures"});
    table.integer("exponent_from", from_, {1, 1000}, {"", "Lowest exponent.", "the catalogue's figures"});
    table.integer("exponent_to", to_, {1, 1000}, {"", "Highest exponent.", "the catalogue's figures"});
  }
  void check(const std::string& file, Diagnostics& diagnostics) const override {
    if (from_ > to_)
      diagnostics.add(
          {file, 0, "exponent_from", "is above exponent_to; a range from the lowest to the highest is expected"});
  }
  std::string step(const run::Inputs::Content& /*machine*/) const override { return "set_up.method"; }
  double try_us(const run::Inputs::Content& /*machine*/) const override { return 30.0; }
  Measured measure(Trial& trial) const override {
    const quadratic::Machine* machine = trial.span_machine();
    if (machine == nullptr) return {};
    const auto count = static_cast<std::size_t>(to_ - from_ + 1);
    std::vector<geometry::Reflectance> surfaces(count);
    for (std::size_t i = 0; i < count; ++i) {
      surfaces[i].exponent = static_cast<int>(from_) + static_cast<int>(i);
      surfaces[i].diffuse = glm::dvec3(0.25);
      surfaces[i].specular = glm::dvec3(0.75);
    }
    set_up::PointLighting lighting(machine->set_up, surfaces, {});
    Measurement worst{fmt::format("exponents {} to {}", from_, to_), "levels", 0.0, 0.0, BoundKind::proved};
    const std::int64_t tries = trial.tries_or(tries_);
    for (std::int64_t i = 0; i < tries; ++i) look_at(trial, i % 7, lighting, worst);
    return {{worst}, {}};
  }

 private:
  // `kind` 0: along the halfway vector; 1: at right angles to the light; others near to the highlight of the exponent.
  void look_at(Trial& trial, std::int64_t kind, set_up::PointLighting& lighting, Measurement& worst) const {
    Numbers& numbers = trial.numbers;
    geometry::LightSource light;
    light.vector = unit(random_vector(numbers));
    while (light.vector.z < -0.9) light.vector = unit(random_vector(numbers));
    lighting.set_lights({light}, false);
    const std::int64_t exponent = numbers.whole(from_, to_);
    const glm::dvec3 half = light.vector + glm::dvec3(0, 0, 1);
    set_up::LitPoint point;
    point.normal = half;
    const glm::dvec3 any = random_vector(numbers);
    if (kind == 1) {
      const double along = any.x * light.vector.x + any.y * light.vector.y + any.z * light.vector.z;
      point.normal = any - light.vector * along;
    } else if (kind > 1) {
      point.normal = unit(half) + any * numbers.uniform(0, 2 / std::sqrt(static_cast<double>(exponent)));
    }
    const set_up::LitPoint given = point;
    if (trial.tampering.lit_point) trial.tampering.lit_point(point);
    const double level = lighting.levels(point, static_cast<std::size_t>(exponent - from_)).x;
    const QuadVector n = widened(given.normal), l = widened(light.vector);
    const QuadVector h{l.x, l.y, l.z + 1};
    const Quad length = root(dot(n, n));
    if (!(length > 0)) return;
    const Quad towards = std::max<Quad>(0, dot(n, l) / length);
    const Quad halfway = std::max<Quad>(0, dot(n, h) / (length * root(dot(h, h))));
    const Quad exact = static_cast<Quad>(kLevels) * (towards / 4 + power(halfway, exponent) * 3 / 4);
    const double c = static_cast<double>(halfway), e = static_cast<double>(exponent);
    const double of_power = 16 * e * mathematics::pow(c, e - 1) + e * mathematics::pow(c, e);
    const double bound = kLevels * kHalfPlace * (16 + of_power + 8) * (1 + 1e-9);
    keep_worst(worst, std::fabs(static_cast<double>(level - std::min<Quad>(exact, kLevels))), bound);
  }

  std::int64_t tries_ = 10'000;
  std::int64_t from_ = 1;
  std::int64_t to_ = 1000;
};

}  // namespace

std::unique_ptr<CaseKind> lighting_case() { return std::make_unique<LightingCase>(); }

}  // namespace rastertlm::analysis
