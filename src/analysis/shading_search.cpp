#include "src/analysis/shading_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/fixed_point.h"
#include "src/geometry/lighting.h"

namespace rastertlm::analysis {
namespace {

using shading::Direction;

double dot(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Direction unit(const Direction& v) {
  const double length = std::sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

// Uniform on the sphere.
Direction random_direction(Numbers& numbers) {
  for (;;) {
    const Direction v{numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(-1, 1)};
    const double square = dot(v, v);
    if (square > 0.01 && square < 1.0) return unit(v);
  }
}

Direction near_to(const Direction& centre, double spread, Numbers& numbers) {
  const Direction away = random_direction(numbers);
  const double by = spread * numbers.uniform(0, 1);
  return unit({centre[0] + by * away[0], centre[1] + by * away[1], centre[2] + by * away[2]});
}

// A light whose halfway vector exists; a third lies in a plane of the axes, or along one.
Direction random_light(Numbers& numbers) {
  for (;;) {
    Direction light = random_direction(numbers);
    const std::int64_t kind = numbers.whole(0, 8);
    if (kind < 3) light[static_cast<std::size_t>(kind)] = 0.0;
    if (kind == 0) light[1] = 0.0;
    if (dot(light, light) < 1e-6) continue;
    light = unit(light);
    if (light[2] > -0.9) return light;
  }
}

// With the largest component's top bit set in one of the shifts, and of any length above.
NormalWords words_of(const Direction& direction, const ShadingBench& bench, Numbers& numbers) {
  const auto lowest = static_cast<int>(bench.normal_bits()) - 1;
  const auto highest = static_cast<int>(bench.word_bits()) - 2;
  const int bits = static_cast<int>(numbers.whole(std::min(lowest, highest), highest));
  const double largest = std::max({std::fabs(direction[0]), std::fabs(direction[1]), std::fabs(direction[2])});
  const double length = std::ldexp(numbers.uniform(0.51, 0.99), bits) / largest;
  NormalWords words{};
  for (std::size_t i = 0; i < 3; ++i) words[i] = round_half_up(direction[i] * length);
  return words;
}

std::uint64_t ones_complement(std::int64_t word) { return static_cast<std::uint64_t>(word < 0 ? ~word : word); }

// By which pre-normalisation has to shift.
unsigned right_shift(const NormalWords& normal, unsigned normal_bits) {
  unsigned bits = 0;
  for (const std::int64_t word : normal) bits = std::max(bits, bit_length(ones_complement(word)));
  return bits < normal_bits ? 0 : bits - (normal_bits - 1);
}

struct Worst {
  double error = -1.0;
  Direction light{0, 0, 1};
  NormalWords normal{};
};

class Search {
 public:
  Search(ShadingBench& bench, Numbers& numbers) : bench_(bench), numbers_(numbers), worst_(bench.quantities().size()) {
    seen_.levels.assign(worst_.size(), 0.0);
  }

  void try_light(const Direction& light, std::int64_t normals) {
    bench_.set_light(light);
    for (const double component : {light[0], light[1], light[2]}) observe_light_word(component);
    for (std::int64_t i = 0; i < normals; ++i) {
      const Direction& centre = i % 4 == 1 ? bench_.light().towards : bench_.light().halfway;
      const Direction direction =
          i % 4 == 0 ? random_direction(numbers_) : near_to(centre, i % 4 == 2 ? 0.1 : 0.6, numbers_);
      const ShadingBench::Pixel pixel = bench_.pixel(words_of(direction, bench_, numbers_));
      if (pixel.is_short || pixel.is_zero) continue;
      ++seen_.normals;
      observe_steps(pixel);
      for (std::size_t q = 0; q < worst_.size(); ++q) observe_level(pixel, q);
    }
  }

  // The worst of a quantity, moved a little at a time: lights by a part of their word, normals by parts of theirs.
  void climb(std::size_t quantity, std::int64_t rounds) {
    constexpr int kNormalsALight = 24;
    for (std::int64_t round = 0; round < rounds; ++round) {
      const Worst from = worst_[quantity];
      if (from.error < 0.0) return;
      const double turn = std::ldexp(1.0, static_cast<int>(-numbers_.whole(3, 13)));
      bench_.set_light(round % 4 == 0 ? from.light : near_to(from.light, turn, numbers_));
      for (int i = 0; i < kNormalsALight; ++i) {
        NormalWords words = from.normal;
        for (std::int64_t& word : words) {
          const double step = std::ldexp(numbers_.uniform(-1, 1), static_cast<int>(numbers_.whole(0, 8)));
          word += round_half_up(step * std::ldexp(1.0, static_cast<int>(shift_of(from.normal))));
        }
        if (!fits(words)) continue;
        const ShadingBench::Pixel pixel = bench_.pixel(words);
        if (!pixel.is_short && !pixel.is_zero) observe_level(pixel, quantity);
      }
    }
  }

  const ShadingSeen& seen() const { return seen_; }

 private:
  bool fits(const NormalWords& words) const {
    const std::int64_t limit = std::int64_t{1} << (bench_.word_bits() - 1);
    return std::all_of(words.begin(), words.end(), [&](std::int64_t w) { return w >= -limit && w < limit; });
  }

  unsigned shift_of(const NormalWords& words) const { return bench_.pixel(words).shift; }

  void observe_light_word(double component) {
    const shading::ShadingParameters& p = bench_.shader().parameters();
    const double one = std::ldexp(1.0, static_cast<int>(p.dot_table_output_bits));
    const double exact = std::fabs(component) * (p.arithmetic == shading::Arithmetic::centred ? one : one - 1);
    seen_.light_word = std::max(seen_.light_word, std::fabs(bench_.shader().light_word(component) - exact));
  }

  void observe_steps(const ShadingBench::Pixel& pixel) {
    const shading::Normaliser& normaliser = bench_.shader().normaliser();
    const shading::ShadingParameters& p = bench_.shader().parameters();
    const bool centred = p.arithmetic == shading::Arithmetic::centred;
    Direction box{}, word{};
    for (std::size_t i = 0; i < 3; ++i) {
      word[i] = std::ldexp(static_cast<double>(pixel.normal[i]), -static_cast<int>(pixel.shift));
      box[i] = 0.5 * object_processor::half_units(pixel.link[i], bench_.normal_bits());
      seen_.normal_word = std::max(seen_.normal_word, std::fabs(word[i] - box[i]));
    }
    const double length = std::sqrt(dot(box, box));
    const Direction across{box[1] * word[2] - box[2] * word[1], box[2] * word[0] - box[0] * word[2],
                           box[0] * word[1] - box[1] * word[0]};
    seen_.direction = std::max(seen_.direction, std::sqrt(dot(across, across)) / (length * std::sqrt(dot(word, word))));
    const double root = normaliser.inverse_root(pixel.squares);
    seen_.inverse_root = std::max(seen_.inverse_root, std::fabs(root * length / normaliser.root_scale() - 1));
    const shading::NormalisedNormal n = normaliser.normalise(pixel.link[0], pixel.link[1], pixel.link[2]);
    const double full = std::ldexp(1.0, static_cast<int>(p.dot_table_address_bits));
    for (std::size_t i = 0; i < 3; ++i)
      seen_.component = std::max(seen_.component,
                                 std::fabs(n.magnitude[i] + (centred ? 0.5 : 0.0) - full * std::fabs(box[i]) / length));
    observe_sums(n, pixel);
    const double by_normal = dot(box, bench_.light().towards) / length;
    seen_.normal_diffuse =
        std::max(seen_.normal_diffuse, 255 * std::fabs(std::max(0.0, by_normal) - std::max(0.0, pixel.towards)));
  }

  void observe_sums(const shading::NormalisedNormal& n, const ShadingBench::Pixel& pixel) {
    const shading::LightTables& tables = std::as_const(bench_).shader().front().lights[0];
    const shading::DotProduct& unit = bench_.shader().dot_product();
    const shading::ShadingParameters& p = bench_.shader().parameters();
    const double one =
        std::ldexp(p.arithmetic == shading::Arithmetic::centred ? 2.0 : 1.0, static_cast<int>(p.dot_table_output_bits));
    const double place = std::ldexp(1.0, static_cast<int>(p.dot_table_output_bits));
    const auto sum = [&](const shading::DotTables& dots) {
      std::array<std::int32_t, 3> term{};
      for (std::size_t i = 0; i < 3; ++i)
        term[i] = shading::DotProduct::signed_term(dots.products[i][n.magnitude[i]], n.negative[i] != dots.negative[i]);
      return unit.sum(term[0], term[1], term[2]) / one;
    };
    seen_.sum = std::max({seen_.sum, place * std::fabs(sum(tables.diffuse) - pixel.towards),
                          place * std::fabs(sum(tables.specular) - pixel.halfway)});
  }

  void observe_level(const ShadingBench::Pixel& pixel, std::size_t quantity) {
    ++seen_.pixels;
    const double error = std::fabs(bench_.level(pixel, quantity) - bench_.exact_level(pixel, quantity));
    seen_.levels[quantity] = std::max(seen_.levels[quantity], error);
    Worst& worst = worst_[quantity];
    if (error > worst.error) worst = {error, bench_.light().towards, pixel.normal};
  }

  ShadingBench& bench_;
  Numbers& numbers_;
  ShadingSeen seen_;
  std::vector<Worst> worst_;
};

shading::ShadingParameters for_bench(shading::ShadingParameters p, const std::vector<Quantity>& quantities) {
  p.lights = 1;
  p.specular_tables = 1;
  p.materials = static_cast<std::int64_t>(quantities.size());
  return p;
}

}  // namespace

double Quantity::exact(double towards, double halfway) const {
  const double power = halfway > 0.0 ? geometry::integer_power(halfway, static_cast<int>(exponent)) : 0.0;
  return 255 * std::min(1.0, ambient + diffuse * std::max(0.0, towards) + specular * power);
}

ShadingBench::ShadingBench(const shading::ShadingParameters& parameters,
                           const object_processor::ObjectProcessorParameters& object_processor,
                           std::vector<Quantity> quantities)
    : word_bits_(static_cast<unsigned>(object_processor.word_bits)),
      normal_bits_(static_cast<unsigned>(object_processor.normal_bits)),
      prenormaliser_(object_processor),
      quantities_(std::move(quantities)),
      shader_(for_bench(parameters, quantities_), object_processor.normal_bits) {
  for (std::size_t m = 0; m < quantities_.size(); ++m) {
    const Quantity& q = quantities_[m];
    shader_.set_material(m, {{1, 1, 1}, q.ambient, q.diffuse, q.specular, q.exponent});
  }
}

void ShadingBench::set_light(const Direction& towards) {
  light_ = {towards, unit({towards[0], towards[1], towards[2] + 1.0}), {1, 1, 1}};
  shader_.set_light(0, light_);
  shader_.load();
}

ShadingBench::Pixel ShadingBench::pixel(const NormalWords& normal) const {
  Pixel pixel;
  pixel.normal = normal;
  std::array<std::uint32_t, 3> words{};
  for (std::size_t i = 0; i < 3; ++i) words[i] = static_cast<std::uint32_t>(wrap_unsigned(normal[i], word_bits_));
  pixel.link = prenormaliser_(words);
  pixel.shift = right_shift(normal, normal_bits_);
  // Of the words as they should arrive, not as they do: what may be short, and how far it may then be off, is not for
  // the unit to say whose work is looked at.
  const shading::Normaliser& normaliser = shader_.normaliser();
  pixel.is_zero = true;
  for (const std::int64_t word : normal) {
    const std::uint64_t magnitude = ones_complement(word) >> pixel.shift;
    pixel.squares += normaliser.square(static_cast<std::uint32_t>(magnitude), word < 0 ? 1 : 0);
    pixel.is_zero = pixel.is_zero && magnitude == 0;
  }
  pixel.is_short = normaliser.is_short(pixel.squares);
  const Direction n{static_cast<double>(normal[0]), static_cast<double>(normal[1]), static_cast<double>(normal[2])};
  const double length = std::sqrt(dot(n, n));
  if (length > 0.0) {
    pixel.towards = dot(n, light_.towards) / length;
    pixel.halfway = dot(n, light_.halfway) / length;
  }
  return pixel;
}

int ShadingBench::level(const Pixel& pixel, std::size_t quantity) const {
  shading::ShadingCounters counters;
  return shader_.shade_pixel(pixel.link[0], pixel.link[1], pixel.link[2], static_cast<std::uint32_t>(quantity),
                             counters)[0];
}

double ShadingBench::exact_level(const Pixel& pixel, std::size_t quantity) const {
  return quantities_[quantity].exact(pixel.towards, pixel.halfway);
}

ShadingSeen search_shading(ShadingBench& bench, Numbers& numbers, std::int64_t lights, std::int64_t normals) {
  Search search(bench, numbers);
  for (std::int64_t i = 0; i < lights; ++i) search.try_light(random_light(numbers), normals);
  // A tenth of all normals, a quantity.
  const std::int64_t rounds = std::clamp<std::int64_t>(lights * normals / 10, 10, 20'000);
  for (std::size_t q = 0; q < bench.quantities().size(); ++q) search.climb(q, rounds);
  return search.seen();
}

}  // namespace rastertlm::analysis
