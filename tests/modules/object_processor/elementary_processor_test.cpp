// Is the elementary processor, stepped by the published microprogram, A x + B (y + 1) + C modulo 2^word_bits?
#include "modules/object_processor/elementary_processor.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "modules/object_processor/line_evaluator.h"

namespace rastertlm::object_processor {
namespace {

struct Widths {
  std::int64_t word;
  std::int64_t slice;
};
constexpr Widths kWidths[] = {{24, 12}, {24, 24}, {24, 8}, {16, 4}, {32, 16}, {25, 7}, {8, 1}, {32, 32}};

ObjectProcessorParameters with(Widths widths, CarryClock clock = CarryClock::clock1) {
  ObjectProcessorParameters parameters;
  parameters.word_bits = widths.word;
  parameters.slice_bits = widths.slice;
  parameters.carry_clock = clock;
  return parameters;
}

// Steps a frame; calls visit(line, column, output) in every pixel cycle.
template <class Visit>
void step_frame(const ObjectProcessorParameters& parameters, const LinearWords& words, std::uint32_t columns,
                std::uint32_t lines, Visit visit) {
  ElementaryProcessor processor(parameters);
  processor.write_loading(0, words.a);
  processor.write_loading(1, words.b);
  processor.write_loading(2, words.c);
  processor.run(frame_start_program());
  for (std::uint32_t line = 0; line < lines; ++line) {
    processor.run(line_start_program(parameters.slices()));
    for (std::uint32_t column = 0; column < columns; ++column) {
      visit(line, column, processor.output());
      processor.step(pixel_instruction(parameters.slices()));
    }
  }
}

std::uint32_t exact(const LinearWords& words, std::uint32_t line, std::uint32_t column, std::int64_t word_bits) {
  const std::uint64_t sum = std::uint64_t{words.a} * column + std::uint64_t{words.b} * (line + 1) + words.c;
  return static_cast<std::uint32_t>(sum % (std::uint64_t{1} << word_bits));
}

RC_GTEST_PROP(ElementaryProcessor, EqualsTheLinearFormWithWrapping,
              (std::uint32_t a, std::uint32_t b, std::uint32_t c)) {
  for (const Widths widths : kWidths) {
    const auto mask = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(widths.word)));
    const LinearWords words{a & mask, b & mask, c & mask};
    const WordFormat format(static_cast<unsigned>(widths.word));
    step_frame(with(widths), words, 23, 9, [&](std::uint32_t line, std::uint32_t column, std::uint32_t output) {
      RC_ASSERT(output == exact(words, line, column, widths.word));
      RC_ASSERT(format.at(words, column, line) == output);
    });
  }
}

LinearWords random_words(std::mt19937& random, std::uint32_t mask) {
  const auto word = [&] { return static_cast<std::uint32_t>(random()) & mask; };
  return {word(), word(), word()};
}

// Coefficients of full width: rapidcheck's own grow slowly.
TEST(ElementaryProcessor, EveryValueOfRandomFramesIsRight) {
  std::mt19937 random(1);
  int right = 0;
  int values = 0;
  for (int frame = 0; frame < 21; ++frame) {
    const LinearWords words = random_words(random, 0xFFFFFF);
    step_frame(with({24, 12}), words, 30, 20, [&](std::uint32_t line, std::uint32_t column, std::uint32_t output) {
      ++values;
      right += output == exact(words, line, column, 24) ? 1 : 0;
    });
  }
  EXPECT_EQ(values, 12600);
  EXPECT_EQ(right, values);
}

// Erratum 7: the text's clock for the carry flip-flop loses carries.
TEST(ElementaryProcessor, CarryOnClock2IsWrong) {
  std::mt19937 random(2);
  int right = 0;
  int values = 0;
  for (int frame = 0; frame < 21; ++frame) {
    const LinearWords words = random_words(random, 0xFFFFFF);
    step_frame(with({24, 12}, CarryClock::clock2), words, 30, 20,
               [&](std::uint32_t line, std::uint32_t column, std::uint32_t output) {
                 ++values;
                 right += output == exact(words, line, column, 24) ? 1 : 0;
               });
  }
  EXPECT_LT(right, values / 2);
}

TEST(ElementaryProcessor, CarryClockDoesNotMatterWithoutCarries) {
  const LinearWords words{0x001001, 0x002002, 0x003003};
  step_frame(with({24, 12}, CarryClock::clock2), words, 30, 20,
             [&](std::uint32_t line, std::uint32_t column, std::uint32_t output) {
               ASSERT_EQ(output, exact(words, line, column, 24));
             });
}

TEST(ElementaryProcessor, ClosedFormOfTheLateCarryEqualsTheMicroprogram) {
  std::mt19937 random(3);
  for (const Widths widths : kWidths) {
    const ObjectProcessorParameters parameters = with(widths, CarryClock::clock2);
    const auto mask = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(widths.word)));
    for (int frame = 0; frame < 50; ++frame) {
      const LinearWords words = random_words(random, mask);
      step_frame(parameters, words, 11, 12, [&](std::uint32_t line, std::uint32_t column, std::uint32_t output) {
        const LateCarryLine late = late_carry_line(words, parameters, line);
        ASSERT_EQ(output, column == 0 ? late.first : (late.start + words.a * column) & mask);
      });
    }
  }
}

TEST(ElementaryProcessor, SecondFrameStartsFromTheLoadingRam) {
  const ObjectProcessorParameters parameters;
  ElementaryProcessor processor(parameters);
  processor.write_loading(0, 3);
  processor.write_loading(1, 5);
  processor.write_loading(2, 7);
  for (int frame = 0; frame < 2; ++frame) {
    processor.run(frame_start_program());
    processor.run(line_start_program(2));
    EXPECT_EQ(processor.output(), 12U);
    EXPECT_EQ(processor.backup(2), 12U);
    processor.run(line_start_program(2));
    EXPECT_EQ(processor.output(), 17U);
    EXPECT_EQ(processor.loading(2), 7U);
  }
}

// Interlaced video: the line start runs once for every line that is passed, with the host's words of any other screen.
TEST(ElementaryProcessor, SkipsLinesByStartingThemTwice) {
  std::mt19937 random(4);
  for (const Widths widths : kWidths) {
    const ObjectProcessorParameters parameters = with(widths);
    const LinearWords words =
        random_words(random, static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(widths.word))));
    const Microprogram line_start = line_start_program(parameters.slices());
    ElementaryProcessor processor(parameters);
    for (unsigned address = 0; address < 3; ++address)
      processor.write_loading(address, address == 0 ? words.a : address == 1 ? words.b : words.c);
    for (std::uint32_t field = 0; field < 2; ++field) {
      processor.run(frame_start_program());
      for (std::uint32_t line = field; line < 12; line += 2) {
        std::size_t cycles = 0;
        for (std::uint32_t passed = line == 0 ? 1 : 2; passed > 0; --passed) {
          processor.run(line_start);
          cycles += line_start.size();
        }
        EXPECT_EQ(cycles, line_start_cycles(parameters.slices(), line == 0 ? 1 : 2).count());
        for (std::uint32_t column = 0; column < 9; ++column) {
          ASSERT_EQ(processor.output(), exact(words, line, column, widths.word)) << line << ' ' << column;
          processor.step(pixel_instruction(parameters.slices()));
        }
      }
    }
  }
}

TEST(Microprogram, PublishedCycles) {
  EXPECT_EQ(frame_start_program().size(), 8U);
  EXPECT_EQ(line_start_program(2).size(), 9U);
  EXPECT_EQ(line_start_program(1).size(), 7U);
  EXPECT_EQ(frame_start_cycles().count(), 8U);
  EXPECT_EQ(pixel_cycles().count(), 1U);
}

TEST(Microprogram, LineStartTakesTwoCyclesASliceAndFive) {
  for (unsigned slices = 1; slices <= 32; ++slices)
    EXPECT_EQ(line_start_program(slices).size(), line_start_cycles(slices).count()) << slices;
}

// 004, section 5.2.2: the listed lines of the paper, one by one.
TEST(Microprogram, IsThePublishedListing) {
  const Microprogram line = line_start_program(2);
  EXPECT_TRUE(line[0].clear);
  EXPECT_EQ(line[1].ram, RamOperation::read_backup);
  EXPECT_EQ(line[1].address, 2);
  EXPECT_EQ(line[2].clocks, 0b11U);
  EXPECT_EQ(line[3].ram, RamOperation::read_backup);
  EXPECT_EQ(line[3].address, 1);
  EXPECT_EQ(line[4].clocks, 0b01U);
  EXPECT_EQ(line[5].clocks, 0b10U);
  EXPECT_EQ(line[6].ram, RamOperation::write_backup);
  EXPECT_EQ(line[6].address, 2);
  EXPECT_EQ(line[7].ram, RamOperation::read_backup);
  EXPECT_EQ(line[7].address, 0);
  EXPECT_EQ(line[8].clocks, 0b01U);
  EXPECT_EQ(pixel_instruction(2).clocks, 0b11U);
  const Microprogram frame = frame_start_program();
  EXPECT_EQ(frame.front().select, Select::loading_ram);
  EXPECT_EQ(frame.back().select, Select::registers);
}

}  // namespace
}  // namespace rastertlm::object_processor
