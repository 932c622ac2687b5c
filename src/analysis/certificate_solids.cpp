// Quadric processors: the words of a solid's forms beside the forms, and the root of every word.
#include <algorithm>
#include <cmath>

#include "modules/object_processor/square_root.h"
#include "modules/quadric_processor/quadric_pixel.h"
#include "modules/set_up/anchored_words.h"
#include "src/analysis/certificate_steps.h"
#include "src/analysis/exact_number.h"

namespace rastertlm::analysis {
namespace {

using object_processor::RootFormat;
using object_processor::RootReading;
using report::ProofKind;

constexpr const char* kWords = "modules/set_up/anchored_words.h";
constexpr const char* kForm = "form, anchor and pixel of the screen";

// What doubles lose of values as large as those that are tried here, beside their rounding.
constexpr double kDouble = 0x1p-5;

struct Seen {
  double error = 0.0;
  std::uint64_t inputs = 0;
};

// In places of the root.
double root_error(std::uint64_t word, const RootFormat& format) {
  const auto scale = static_cast<int>(2 * format.guard_bits) - static_cast<int>(format.fraction_bits);
  const Extended root = std::sqrt(std::ldexp(static_cast<Extended>(word), scale));
  const auto read = static_cast<Extended>(quadric_processor::root_of(word, format));
  return std::fabs(static_cast<double>((format.reading == RootReading::half_unit ? read / 2 : read) - root));
}

// A root is read of all words from one to another; the root that is meant grows with them, so that the two ends are
// off the most. All roots.
Seen search_roots(const RootFormat& format) {
  const auto joined = static_cast<int>(2 * format.guard_bits) - static_cast<int>(format.fraction_bits);
  const auto first_word = [&](std::uint64_t radicand) {
    return joined <= 0 ? radicand << -joined : (radicand + (std::uint64_t{1} << joined) - 1) >> joined;
  };
  Seen seen;
  const std::uint64_t roots = std::uint64_t{1} << format.result_bits();
  for (std::uint64_t root = 0; root < roots; ++root) {
    const std::uint64_t first = first_word(root * root), beyond = first_word((root + 1) * (root + 1));
    if (first == beyond) continue;  // no word has it
    seen.error = std::max({seen.error, root_error(first, format), root_error(beyond - 1, format)});
    seen.inputs += 2;
  }
  return seen;
}

// Whole numbers with what rounding loses the most of, to one side; or anything.
double coefficient(double most, Numbers& numbers) {
  constexpr double kNearHalf = 0.499;
  const double any = numbers.uniform(-most, most);
  return numbers.whole(0, 1) == 0 ? any : std::floor(any) + kNearHalf;
}

struct Screen {
  std::int64_t columns, lines;
  set_up::Anchor any(Numbers& numbers) const { return {numbers.whole(0, columns - 1), numbers.whole(0, lines - 1)}; }
  // A corner every second time: two of them are as far apart as can be.
  set_up::Anchor far(Numbers& numbers) const {
    if (numbers.whole(0, 1) == 0) return any(numbers);
    return {numbers.whole(0, 1) * (columns - 1), numbers.whole(0, 1) * (lines - 1)};
  }
  double farthest() const { return static_cast<double>(columns - 1 + lines - 1); }
};

// The difference of a word from a value, modulo its range.
double apart(std::uint64_t word, Extended value, unsigned bits) {
  const Extended off = static_cast<Extended>(quadric_processor::sign_extended(word, bits)) - value;
  const Extended range = std::ldexp(Extended{1}, static_cast<int>(bits));
  return std::fabs(static_cast<double>(off - range * std::floor(off / range + Extended{0.5})));
}

Seen search_second_order(const Screen& screen, unsigned bits, Numbers& numbers, std::int64_t tries) {
  Seen seen;
  for (std::int64_t i = 0; i < tries; ++i) {
    // Values below 2^45, so that doubles hold them to 2^-8 and less.
    const double bend = coefficient(std::exp2(numbers.uniform(0, 24)), numbers);
    geometry::SecondOrderForm<double> form{bend / 2,
                                           coefficient(4 * std::fabs(bend), numbers) / 2,
                                           coefficient(4 * std::fabs(bend), numbers),
                                           coefficient(1e9, numbers),
                                           coefficient(1e9, numbers),
                                           coefficient(1e12, numbers)};
    const set_up::Anchor anchor = screen.far(numbers), at = screen.far(numbers);
    const auto words = set_up::anchored_second_order<double>(form, anchor, bits);
    const std::uint64_t word = object_processor::second_order_value(words, static_cast<std::uint64_t>(at.x),
                                                                    static_cast<std::uint64_t>(at.y), bits);
    const auto x = static_cast<Extended>(at.x), y = static_cast<Extended>(at.y);
    const Extended value = (form.xx * x + form.xy * y + form.x) * x + (form.yy * y + form.y) * y + form.one;
    seen.error = std::max(seen.error, apart(word, value, bits));
    ++seen.inputs;
  }
  return seen;
}

Seen search_planes(const Screen& screen, unsigned bits, Numbers& numbers, std::int64_t tries) {
  Seen seen;
  for (std::int64_t i = 0; i < tries; ++i) {
    const double slope = std::exp2(numbers.uniform(0, 26));
    const geometry::LinearForm<double> form{coefficient(slope, numbers), coefficient(slope, numbers),
                                            coefficient(0x1p36, numbers)};
    const set_up::Anchor anchor = screen.far(numbers), at = screen.far(numbers);
    const auto words = set_up::plane_words(set_up::anchored_plane<double>(form, anchor), bits);
    const auto word = static_cast<std::uint64_t>(
        quadric_processor::plane_at(words, static_cast<std::uint64_t>(at.x), static_cast<std::uint64_t>(at.y), bits));
    const auto x = static_cast<Extended>(at.x), y = static_cast<Extended>(at.y);
    seen.error = std::max(seen.error, apart(word, form.x * x + form.y * y + form.one, bits));
    ++seen.inputs;
  }
  return seen;
}

}  // namespace

void certify_solids(const imogene::Machine& machine, const CertifyOptions& options, report::Certificates& all) {
  if (machine.quadric.per_unit == 0) return;
  const quadric_processor::QuadricParameters& p = machine.quadric;
  const Screen screen{machine.video.columns, machine.video.lines};
  Numbers numbers(options.seed);
  const Seen discriminant = search_second_order(screen, static_cast<unsigned>(p.word_bits), numbers, options.tries);
  all.steps.push_back({"discriminant of a solid", "quadric_processor.fraction_bits", kForm, ProofKind::formula, kWords,
                       "last places", set_up::second_order_error(screen.farthest()) + kDouble, discriminant.error,
                       discriminant.inputs});
  const Seen plane = search_planes(screen, static_cast<unsigned>(p.plane_bits), numbers, options.tries);
  all.steps.push_back({"middle and caps of a solid", "quadric_processor.plane_bits", kForm, ProofKind::formula, kWords,
                       "units", set_up::linear_error(screen.farthest()) + kDouble, plane.error, plane.inputs});
  const Seen root = search_roots(p.root());
  all.steps.push_back({"root of a discriminant", "quadric_processor.root_guard_bits",
                       "every root, the ends of its words", ProofKind::exhaustive,
                       "modules/object_processor/square_root.h", "last places",
                       p.root_reading == RootReading::half_unit ? 0.5 : 1.0, root.error, root.inputs});
}

}  // namespace rastertlm::analysis
