// Whether EP1 counts right: every word that leaves it, where carries go through every slice.
#include <fmt/format.h>

#include "modules/object_processor/elementary_processor.h"
#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

namespace ep = object_processor;

constexpr std::uint32_t kColumns = 32, kLines = 16;

std::int64_t wrong_words(const ep::ObjectProcessorParameters& parameters, const ep::LinearWords& words) {
  const auto mask = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.word_bits)));
  ep::ElementaryProcessor processor(parameters);
  processor.write_loading(0, words.a);
  processor.write_loading(1, words.b);
  processor.write_loading(2, words.c);
  processor.run(ep::frame_start_program());
  std::int64_t wrong = 0;
  for (std::uint64_t line = 0; line < kLines; ++line) {
    processor.run(ep::line_start_program(parameters.slices()));
    for (std::uint64_t column = 0; column < kColumns; ++column) {
      const std::uint64_t exact = (words.a * column + words.b * (line + 1) + words.c) & mask;
      wrong += processor.output() != exact ? 1 : 0;
      processor.step(ep::pixel_instruction(parameters.slices()));
    }
  }
  return wrong;
}

class LinearFormCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", "the catalogue's figures"});
  }
  std::string step(const run::Inputs::Content& /*machine*/) const override { return "ep1.carry_clock"; }
  double try_us(const run::Inputs::Content& /*machine*/) const override { return 8.0; }
  Measured measure(Trial& trial) const override {
    const imogene::Machine* machine = trial.object_machine();
    if (machine == nullptr) return {};
    const ep::ObjectProcessorParameters& parameters = machine->object_processor;
    const auto mask = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.word_bits)));
    const std::int64_t tries = trial.tries_or(tries_);
    std::int64_t wrong = 0;
    for (std::int64_t round = 0; round < tries; ++round) {
      // Every fourth: words of ones, whose carries go through all slices.
      const auto word = [&] {
        return round % 4 == 0 ? mask : static_cast<std::uint32_t>(trial.numbers.whole(0, mask));
      };
      const std::uint32_t a = word(), b = word(), c = word();
      wrong += wrong_words(parameters, {a, b, c});
    }
    return {{{fmt::format("{} words of {} bits", tries * kColumns * kLines, parameters.word_bits), "words",
              static_cast<double>(wrong), 0.0, BoundKind::proved}},
            {}};
  }

 private:
  std::int64_t tries_ = 100;
};

}  // namespace

std::unique_ptr<CaseKind> linear_form_case() { return std::make_unique<LinearFormCase>(); }

}  // namespace rastertlm::analysis
