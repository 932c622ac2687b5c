// Is EP2, stepped by its microprogram, A x^2 + B y^2 + C x y + D x + E y + F modulo 2^word_bits?
#include "modules/object_processor/second_order_processor.h"

#include <gtest/gtest.h>

#include <random>

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {
namespace {

struct Widths {
  unsigned word;
  unsigned slice;
};
constexpr Widths kWidths[] = {{24, 12}, {42, 12}, {52, 12}, {64, 16}, {64, 64}, {36, 7}, {16, 1}, {9, 4}};

// Coefficients, as integers of the last place.
struct Form {
  std::uint64_t a, b, c, d, e, f;
  std::uint64_t at(std::uint64_t x, std::uint64_t y) const {
    return a * x * x + b * y * y + c * x * y + d * x + e * y + f;
  }
  SecondOrderWords words() const { return {f, b + e, 2 * b, a + d, c, 2 * a}; }
};

Form random_form(std::mt19937_64& random) { return {random(), random(), random(), random(), random(), random()}; }

// Small coefficients: values that do not wrap, and carries that run through words of ones.
Form small_form(std::mt19937_64& random) {
  const auto part = [&] { return static_cast<std::uint64_t>(static_cast<std::int64_t>(random() % 65) - 32); };
  return {part(), part(), part(), part(), part(), part()};
}

// Steps a frame of which every `step`-th line is shown; calls visit(line, column, output) in every pixel cycle and
// returns the cycles.
template <class Visit>
std::uint64_t step_frame(SecondOrderProcessor& processor, std::uint64_t columns, std::uint64_t lines,
                         std::uint64_t step, const Visit& visit) {
  const unsigned slices = processor.slices();
  std::uint64_t cycles = second_order_frame_start().size();
  processor.run(second_order_frame_start());
  for (std::uint64_t line = 0; line < lines; line += step) {
    for (std::uint64_t passed = 0; line > 0 && passed < step; ++passed) {
      processor.run(second_order_line_step(slices));
      cycles += second_order_line_step(slices).size();
    }
    processor.run(second_order_line_start(slices));
    cycles += second_order_line_start(slices).size();
    for (std::uint64_t column = 0; column < columns; ++column) {
      visit(line, column, processor.output());
      processor.step(second_order_pixel(slices));
      ++cycles;
    }
  }
  return cycles;
}

int wrong_values(const Form& form, Widths widths, CarryClock clock, std::uint64_t step = 1) {
  SecondOrderProcessor processor(widths.word, widths.slice, clock);
  processor.load(form.words());
  int wrong = 0;
  step_frame(processor, 21, 9, step, [&](std::uint64_t line, std::uint64_t column, std::uint64_t output) {
    wrong += output == (form.at(column, line) & low_mask(widths.word)) ? 0 : 1;
  });
  return wrong;
}

TEST(SecondOrderProcessor, EqualsTheQuadraticFormWithWrapping) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 60; ++round) {
    const Form form = round % 3 == 0 ? small_form(random) : random_form(random);
    for (const Widths widths : kWidths)
      ASSERT_EQ(wrong_values(form, widths, CarryClock::clock1), 0)
          << "round " << round << ", words of " << widths.word << " bits in slices of " << widths.slice;
  }
}

TEST(SecondOrderProcessor, PassesLinesThatAreNotShown) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 20; ++round)
    EXPECT_EQ(wrong_values(random_form(random), {52, 12}, CarryClock::clock1, 2), 0);
}

// As in EP1, the text's clock of the carry flip-flop loses carries.
TEST(SecondOrderProcessor, LosesCarriesThatAreClockedLate) {
  std::mt19937_64 random(3);
  EXPECT_GT(wrong_values(random_form(random), {52, 12}, CarryClock::clock2), 50);
}

TEST(SecondOrderProcessor, ClosedFormEqualsTheQuadraticForm) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 10'000; ++round) {
    const Form form = random_form(random);
    const std::uint64_t x = random() % 16384, y = random() % 16384;
    for (const Widths widths : kWidths)
      ASSERT_EQ(second_order_value(form.words(), x, y, widths.word), form.at(x, y) & low_mask(widths.word));
  }
}

TEST(SecondOrderProcessor, TakesTheCyclesThatItSays) {
  for (const Widths widths : kWidths) {
    SecondOrderProcessor processor(widths.word, widths.slice);
    const unsigned slices = processor.slices();
    EXPECT_EQ(slices, (widths.word + widths.slice - 1) / widths.slice);
    for (const std::uint64_t step : {1U, 2U}) {
      const std::uint64_t lines = 8 / step;
      const std::uint64_t cycles = step_frame(processor, 5, 8, step, [](auto, auto, auto) {});
      EXPECT_EQ(cycles, second_order_frame_start_cycles().count() + second_order_line_cycles(slices, 0).count() +
                            (lines - 1) * second_order_line_cycles(slices, step).count() + 5 * lines);
    }
  }
}

// What the adders write back: the next line's words.
TEST(SecondOrderProcessor, KeepsTheNextLinesWords) {
  const Form form{3, 5, 7, 11, 13, 17};
  SecondOrderProcessor processor(40, 12);
  processor.load(form.words());
  step_frame(processor, 4, 3, 1, [](auto, auto, auto) {});
  EXPECT_EQ(processor.backup(SecondOrderWord::v0), form.at(0, 2));
  EXPECT_EQ(processor.backup(SecondOrderWord::dy), form.at(0, 3) - form.at(0, 2));
  EXPECT_EQ(processor.backup(SecondOrderWord::d0), form.at(1, 2) - form.at(0, 2));
  EXPECT_EQ(processor.backup(SecondOrderWord::two_a), 6U);
}

}  // namespace
}  // namespace rastertlm::object_processor
