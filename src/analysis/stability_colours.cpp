// The registers of a colour on their longest path.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/span_unit/span_registers.h"
#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

// A path of line steps, then of pixel steps. Constants in 1/64 of the registers' last bit, so that all of it is exact
// in integers.
struct Path {
  std::int64_t start, line_step, pixel_step, line_line, line_pixel, pixel_pixel;
};
constexpr std::int64_t kPart = 64;

// Above the fraction: as many that the error of the fewest fraction bits, thousands of levels, does not wrap itself.
constexpr unsigned kWholeBits = 16;

// The error at the path's end, in steps of the last bit, of registers of that width: sums wrap, the error does not.
double error_of(const Path& exact, std::int64_t lines, std::int64_t pixels, unsigned word_bits,
                const Tampering& tampering) {
  const auto word = [&](std::int64_t parts) {
    const auto rounded = static_cast<std::uint64_t>(floor_div(parts + kPart / 2, kPart));
    return tampering.colour_word ? tampering.colour_word(rounded) : rounded;
  };
  span_unit::ColourRegisters registers(word_bits);
  registers.load({word(exact.start), word(exact.line_step), word(exact.pixel_step), word(exact.line_line),
                  word(exact.line_pixel), word(exact.pixel_pixel)});
  for (std::int64_t k = 0; k < lines; ++k) registers.step_line(false);
  for (std::int64_t k = 0; k < pixels; ++k) registers.step_pixel();
  const std::int64_t value = exact.start + lines * exact.line_step + lines * (lines - 1) / 2 * exact.line_line +
                             pixels * (exact.pixel_step + lines * exact.line_pixel) +
                             pixels * (pixels - 1) / 2 * exact.pixel_pixel;
  const std::uint64_t off = registers.i() * kPart - static_cast<std::uint64_t>(value);
  return std::fabs(static_cast<double>(sign_extend(off, word_bits + bit_length(kPart) - 1))) / kPart;
}

// Of the first two paths every constant is half of the last bit off, or 31/64 of it the other way.
constexpr std::array<std::int64_t, 2> kWorstPaths{kPart / 2 - 1, -kPart / 2};

// In levels: the most that was seen, of those paths and of random ones.
double worst_of_paths(std::int64_t steps, std::int64_t bits, Trial& trial, std::int64_t tries) {
  const unsigned word_bits = static_cast<unsigned>(bits) + kWholeBits;
  double worst = 0.0;
  for (const std::int64_t off : kWorstPaths)
    worst = std::max(
        worst, error_of({off, off, off, off, off, off}, steps / 2, steps - steps / 2, word_bits, trial.tampering));
  for (std::int64_t round = 0; round < tries; ++round) {
    const auto part = [&] { return trial.numbers.whole(-100'000, 100'000); };
    const Path path{part(), part(), part(), part(), part(), part()};
    const std::int64_t lines = trial.numbers.whole(0, steps);
    worst = std::max(worst, error_of(path, lines, steps - lines, word_bits, trial.tampering));
  }
  return std::ldexp(worst, -static_cast<int>(bits));
}

class ForwardDifferences : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", "the catalogue's figures"});
    table.integer("steps", steps_, {1, 65536},
                  {"", "Steps of the longest path, lines and pixels.", "the catalogue's figures"});
    table.integer("bits_from", bits_from_, {0, 30}, {"bits", "Fewest fraction bits tried.", "the catalogue's figures"});
    table.integer("bits_to", bits_to_, {0, 30}, {"bits", "Most fraction bits tried.", "the catalogue's figures"});
    table.real("limit_levels", limit_levels_, {0.0, 255.0, true},
               {"levels", "The most that a colour of this machine may be off on its screen.", "the verdict"});
  }
  void check(const std::string& file, Diagnostics& diagnostics) const override {
    if (bits_from_ > bits_to_)
      diagnostics.add({file, 0, "bits_from", "is above bits_to; a range from the fewest to the most bits is expected"});
  }
  std::string step(const run::Inputs::Content& /*machine*/) const override { return "span_unit.fraction_bits"; }
  double try_us(const run::Inputs::Content& /*machine*/) const override {
    return 0.0007 * static_cast<double>(steps_ * (bits_to_ - bits_from_ + 2));
  }
  Measured measure(Trial& trial) const override;

 private:
  std::int64_t tries_ = 100;
  std::int64_t steps_ = 2048;
  std::int64_t bits_from_ = 8;
  std::int64_t bits_to_ = 24;
  double limit_levels_ = 1.0;
};

Measured ForwardDifferences::measure(Trial& trial) const {
  const quadratic::Machine* machine = trial.span_machine();
  if (machine == nullptr) return {};
  const std::int64_t tries = trial.tries_or(tries_);
  Measured found;
  found.inputs_apart = true;
  for (std::int64_t bits = bits_from_; bits <= bits_to_; ++bits)
    found.measurements.push_back(
        {fmt::format("{} steps, {} fraction bits", steps_, bits), "levels", worst_of_paths(steps_, bits, trial, tries),
         span_unit::fraction_bound(bits, static_cast<std::uint64_t>(steps_)), BoundKind::proved});
  const span_unit::SpanUnitParameters& unit = machine->span_unit;
  const std::int64_t on_screen =
      machine->video.columns + machine->video.lines * (unit.start_edge == span_unit::StartEdge::lattice ? 2 : 1);
  found.measurements.push_back({fmt::format("{} steps of this screen, its {} bits", on_screen, unit.fraction_bits),
                                "levels", worst_of_paths(on_screen, unit.fraction_bits, trial, tries), limit_levels_,
                                BoundKind::required});
  for (Measurement& m : found.measurements) m.inputs = static_cast<std::int64_t>(kWorstPaths.size()) + tries;
  return found;
}

}  // namespace

std::unique_ptr<CaseKind> forward_differences_case() { return std::make_unique<ForwardDifferences>(); }

}  // namespace rastertlm::analysis
