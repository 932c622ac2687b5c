// A quadric processor behind its elementary processors, register by register. Each step of a pixel reads what earlier
// clocks left and adds no more bits in a row than a slice has, as soon as its operands are there: so long does a
// fragment take, and it is what the pixel's logic says.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "modules/object_processor/square_root.h"
#include "modules/quadric_processor/quadric_pipeline.h"
#include "tests/modules/quadric_processor/any_solid.h"

namespace rastertlm::quadric_processor {
namespace {

using test::drawn;
using test::kScreen;

// Slices of a subtracter, lowest first: the difference so far, and whether it borrows.
struct Borrow {
  std::uint64_t difference = 0;
  bool borrows = false;
};

// A choice of the greater of two words, highest slice first.
struct Greater {
  std::uint64_t word = 0;
  std::size_t source = 0;      // of what came in, which one it is
  std::optional<bool> second;  // nothing: equal so far
};

// Words of one side of the interval, offset so that they compare without a sign: what a tree makes of caps and plane.
struct Side {
  std::vector<std::vector<Greater>> levels;  // 0: what comes in
  std::uint64_t word() const { return levels.back().front().word; }
};

enum Pair { near_entry, far_entry, root_last, near_far, entry_last, kPairs };

// All registers that a pixel passes.
struct Registers {
  std::uint64_t radicand = 0, remainder = 0, root = 0;
  Borrow stage;
  std::uint64_t half = 0;  // the root in depth words
  std::uint64_t near = 0, far = 0;
  bool near_borrows = false, far_carries = false;
  Side entry, last;
  std::array<bool, kPairs> borrows{};
  std::array<std::uint64_t, 3> sum{}, carry{};
  std::array<bool, 3> joins{};
  std::array<std::uint64_t, 3> normal{};
};

class Pipeline {
 public:
  Pipeline(const QuadricParameters& parameters, const QuadricWords& words, const PixelWords& pixel)
      : parameters_(parameters),
        words_(words),
        pixel_(pixel),
        slice_(static_cast<unsigned>(parameters.slice_bits)),
        plane_(static_cast<unsigned>(parameters.plane_bits)) {}

  // Clocks that it takes. Each part of the work begins when what it reads is there.
  std::size_t build() {
    const std::size_t root = add_root();
    const std::size_t trees = std::max(add_tree(registers_.entry, kScreen.range.near, CapKeeps::beyond, false),
                                       add_tree(registers_.last, kScreen.range.far, CapKeeps::before, true));
    const std::size_t compared = add_depths(add_shifter(root), trees);
    return std::max(compared, add_normals(root)) + static_cast<std::size_t>(parameters_.output_cycles);
  }

  QuadricPixel run() {
    for (const auto& clock : clocks_) {
      const Registers before = registers_;
      for (const auto& step : clock) step(before, registers_);
    }
    return choice();
  }

 private:
  using Step = std::function<void(const Registers&, Registers&)>;

  // Returns from when on what it makes can be read.
  std::size_t at(std::size_t clock, Step step) {
    if (clocks_.size() <= clock) clocks_.resize(clock + 1);
    clocks_[clock].push_back(std::move(step));
    return clock + 1;
  }

  unsigned slice_width(unsigned bits, unsigned low) const { return std::min(slice_, bits - low); }

  // Bits of a slice of a - b, or of a + b.
  std::uint64_t add_slice(std::uint64_t a, std::uint64_t b, unsigned low, unsigned width, bool& carry,
                          bool minus = true) const {
    RC_ASSERT(width >= 1U && width <= slice_);
    const std::uint64_t x = (a >> low) & low_mask(width), y = (b >> low) & low_mask(width);
    const std::uint64_t sum = minus ? x - y - (carry ? 1 : 0) : x + y + (carry ? 1 : 0);
    carry = ((sum >> width) & 1) != 0;
    return (sum & low_mask(width)) << low;
  }

  std::size_t add_root() {
    const object_processor::RootFormat format = parameters_.root();
    const unsigned bits = format.result_bits();
    registers_.radicand = format.radicand(std::min(pixel_.discriminant, format.largest_word()));
    std::size_t clock = 0;
    for (unsigned stage = 1; stage <= bits; ++stage)
      for (unsigned low = 0, width = stage + 2; low < width; low += slice_)
        clock = at(clock, [this, bits, stage, low, width](const Registers& was, Registers& now) {
          const std::uint64_t remainder = was.remainder << 2 | was.radicand >> (2 * (bits - stage));
          RC_ASSERT(remainder <= low_mask(width));
          bool borrows = low > 0 && was.stage.borrows;
          const std::uint64_t lower = low > 0 ? was.stage.difference : 0;
          now.stage.difference = lower | add_slice(remainder, was.root << 2 | 1, low, slice_width(width, low), borrows);
          now.stage.borrows = borrows;
          if (low + slice_ < width) return;
          now.remainder = borrows ? remainder : now.stage.difference;
          now.root = was.root << 1 | (borrows ? 0U : 1U);
          now.radicand = was.radicand & low_mask(2 * (bits - stage));
        });
    return clock;
  }

  std::uint64_t read(std::uint64_t root) const {
    return parameters_.root_reading == RootReading::half_unit ? 2 * root + 1 : root;
  }
  bool nowhere() const { return (pixel_.discriminant >> (parameters_.word_bits - 1)) != 0; }

  std::size_t add_shifter(std::size_t root) {
    const auto shift = [this](const Registers& was) {
      return static_cast<std::uint64_t>(shifted_root(nowhere() ? 0 : read(was.root), words_.root_shift)) &
             low_mask(plane_);
    };
    if (parameters_.scaling == Scaling::object)
      return at(root, [shift](const Registers& was, Registers& now) { now.half = shift(was); });
    // Wires, in the clock that finds the last bit.
    clocks_.at(root - 1).push_back([shift](const Registers&, Registers& now) { now.half = shift(now); });
    return root;
  }

  // As words that compare without their sign.
  std::uint64_t biased(std::int64_t depth) const {
    return (static_cast<std::uint64_t>(depth) + (std::uint64_t{1} << (plane_ - 1))) & low_mask(plane_);
  }

  // The least of words is the greatest of their complements.
  std::size_t add_tree(Side& side, std::int64_t plane_of_view, CapKeeps keeps, bool least) {
    const auto turned = [&](std::int64_t depth) { return least ? low_mask(plane_) - biased(depth) : biased(depth); };
    side.levels.emplace_back().push_back({turned(plane_of_view), 0, {}});
    for (std::size_t i = 0; i < static_cast<std::size_t>(parameters_.caps); ++i)
      side.levels[0].push_back({turned(words_.caps[i].keeps == keeps ? pixel_.caps[i] : plane_of_view), i + 1, {}});
    Side Registers::*const which = least ? &Registers::last : &Registers::entry;
    std::size_t clock = 0;
    const unsigned highest = (plane_ - 1) / slice_ * slice_;
    for (std::size_t level = 1; side.levels.back().size() > 1; ++level) {
      side.levels.emplace_back((side.levels.back().size() + 1) / 2);
      // A level is a clock behind the one before.
      for (unsigned low = highest, later = 0;; low -= slice_, ++later) {
        clock = at(level - 1 + later, [this, which, level, low](const Registers& was, Registers& now) {
          for (std::size_t i = 0; i < (was.*which).levels[level].size(); ++i)
            choose(was.*which, now.*which, level, i, low);
        });
        if (low == 0) break;
      }
    }
    return clock;
  }

  void choose(const Side& was, Side& now, std::size_t level, std::size_t i, unsigned low) const {
    const std::vector<Greater>& from = was.levels[level - 1];
    const unsigned width = slice_width(plane_, low);
    RC_ASSERT(width <= slice_);
    const auto part = [&](std::size_t k) { return k < from.size() ? (from[k].word >> low) & low_mask(width) : 0; };
    const std::uint64_t first = part(2 * i), other = 2 * i + 1 < from.size() ? part(2 * i + 1) : 0;
    Greater& greater = now.levels[level][i];
    std::optional<bool> second = was.levels[level][i].second;
    if (!second && first != other) second = other > first;
    greater.second = second;
    greater.word |= (second.value_or(false) ? other : first) << low;
    greater.source = from[second.value_or(false) ? 2 * i + 1 : 2 * i].source;
  }

  std::size_t add_depths(std::size_t shifted, std::size_t trees) {
    std::size_t sum = shifted, compared = 0;
    for (unsigned low = 0; low < plane_; low += slice_) {
      const unsigned width = slice_width(plane_, low);
      sum = at(sum, [this, low, width](const Registers& was, Registers& now) {
        const auto middle = static_cast<std::uint64_t>(pixel_.middle) & low_mask(plane_);
        now.near |= add_slice(middle, was.half, low, width, now.near_borrows);
        now.far |= add_slice(middle, was.half, low, width, now.far_carries, false);
      });
      compared = at(std::max({sum, trees, compared}), [this, low, width](const Registers& was, Registers& now) {
        const bool top = low + width == plane_;
        // A sign counts the other way round.
        const auto flipped = [&](std::uint64_t word) { return top ? word ^ std::uint64_t{1} << (plane_ - 1) : word; };
        const std::uint64_t near = flipped(was.near), far = flipped(was.far);
        const std::uint64_t entry = was.entry.word(), last = low_mask(plane_) - was.last.word();
        // Whether the first is below the second. Which of them it is depends on the solid, not on the pixel.
        using Words = std::pair<std::uint64_t, std::uint64_t>;
        const bool between = words_.part == RayPart::between;
        const std::array<Words, kPairs> words{between ? Words(entry, near) : Words(near, entry),
                                              between ? Words(far, entry) : Words(entry, far),
                                              Words(last, between ? near : far), Words(far, near), Words(last, entry)};
        for (std::size_t pair = 0; pair < kPairs; ++pair) {
          bool borrows = was.borrows[pair];
          add_slice(words[pair].first, words[pair].second, low, width, borrows);
          now.borrows[pair] = borrows;
        }
      });
    }
    return compared;
  }

  // E 2^f -/+ k s, in which minus is plus the complement of k, the root once more, and ones in the fraction of E: so
  // that what is cut off is that of E - floor(k s).
  std::size_t add_normals(std::size_t root) {
    const unsigned fraction = static_cast<unsigned>(parameters_.multiplier_bits) - kMultiplierInteger;
    const unsigned bits = fraction + kScreen.depth_bits;
    const unsigned of_root =
        parameters_.root().result_bits() + (parameters_.root_reading == RootReading::half_unit ? 1 : 0);
    const bool minus = words_.part == RayPart::between;
    std::size_t clock = root;
    for (unsigned first = 0; first < std::min(of_root, bits); first += slice_, ++clock)
      at(clock, [this, first, of_root, bits, fraction, minus](const Registers& was, Registers& now) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (first == 0) {
            now.sum[i] = std::uint64_t{pixel_.normal[i]} << fraction | (minus ? low_mask(fraction) : 0);
            now.carry[i] = minus ? (nowhere() ? 0 : read(was.root)) & low_mask(bits) : 0;
          }
          for (unsigned row = first; row < std::min({first + slice_, of_root, bits}); ++row)
            add_row(now, i, row, nowhere() ? 0 : read(was.root), minus, bits);
        }
      });
    const unsigned rows = std::min(of_root, bits);
    for (unsigned low = rows; low < bits; low += slice_)
      clock = at(clock, [this, low, bits](const Registers& was, Registers& now) {
        for (std::size_t i = 0; i < 3; ++i) {
          bool carry = was.joins[i];
          const unsigned width = slice_width(bits, low);
          now.normal[i] |= add_slice(was.sum[i], was.carry[i], low, width, carry, false);
          now.joins[i] = carry;
        }
      });
    at(clock - 1, [rows, fraction, this](const Registers&, Registers& now) {
      for (std::size_t i = 0; i < 3; ++i) now.normal[i] = (now.normal[i] | (now.sum[i] & low_mask(rows))) >> fraction;
    });
    return clock;
  }

  // Carry-save: below the row's place the sum is final, and there is no carry.
  void add_row(Registers& now, std::size_t i, unsigned row, std::uint64_t root, bool minus, unsigned bits) const {
    const auto k = static_cast<std::uint64_t>(std::int64_t{words_.normal_of_root[i]});
    const std::uint64_t product = ((root >> row & 1) != 0 ? (minus ? ~k : k) << row : 0) & low_mask(bits);
    const std::uint64_t above = low_mask(bits) & ~low_mask(row);
    const std::uint64_t a = now.sum[i] & above, b = now.carry[i] & above;
    RC_ASSERT((now.carry[i] & low_mask(row)) == 0U);
    now.sum[i] = (now.sum[i] & low_mask(row)) | (a ^ b ^ product);
    now.carry[i] = (((a & b) | (a & product) | (b & product)) << 1) & low_mask(bits);
  }

  // Signs alone decide.
  QuadricPixel choice() const {
    const auto below = [this](Pair pair) { return registers_.borrows[pair]; };
    bool inside = !below(entry_last), by_near = false, by_far = false;
    switch (words_.part) {
      case RayPart::between:
        by_near = below(near_entry);
        inside = inside && !nowhere() && !below(far_entry) && !below(root_last) && !below(near_far);
        break;
      case RayPart::outside:
        if (nowhere() || (inside && !below(near_entry))) break;
        by_far = below(far_entry);
        inside = inside && !below(root_last);
        break;
      case RayPart::all:
        inside = inside && !nowhere();
        break;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(parameters_.caps); ++i)
      if (words_.caps[i].keeps == CapKeeps::side && pixel_.caps[i] < 0) inside = false;
    QuadricPixel shown;
    if (!inside) return shown;
    const std::size_t source = registers_.entry.levels.back().front().source;
    const std::uint64_t entry = registers_.entry.word() ^ std::uint64_t{1} << (plane_ - 1);
    shown.covered = true;
    shown.depth = static_cast<std::uint32_t>(by_near ? registers_.near : by_far ? registers_.far : entry);
    if (by_near || by_far) {
      shown.surface = by_near ? Surface::near_root : Surface::far_root;
      for (std::size_t i = 0; i < 3; ++i) shown.normal[i] = static_cast<std::uint32_t>(registers_.normal[i]);
    } else if (source > 0) {
      shown.surface = Surface::cap;
      shown.cap = static_cast<std::uint8_t>(source - 1);
      shown.normal = words_.caps[source - 1].normal;
    } else {
      shown.normal = {0, 0, 1U << (kScreen.depth_bits - 2)};
    }
    return shown;
  }

  const QuadricParameters& parameters_;
  const QuadricWords& words_;
  const PixelWords& pixel_;
  unsigned slice_, plane_;
  Registers registers_;
  std::vector<std::vector<Step>> clocks_;
};

QuadricParameters any_pipeline() {
  QuadricParameters parameters = test::any_parameters();
  parameters.slice_bits = drawn<std::int64_t>((parameters.word_bits + 31) / 32, parameters.word_bits + 1);
  parameters.root_integer_bits = drawn(1, 13);
  parameters.scaling = *rc::gen::element(Scaling::object, Scaling::fixed);
  parameters.output_cycles = drawn(1, 4);
  return parameters;
}

void steps_are_the_logic(const QuadricWords& words, const QuadricParameters& parameters) {
  const QuadricPixelLogic logic(parameters, kScreen.depth_bits, kScreen.range);
  object_processor::ObjectProcessorParameters triangles;
  triangles.word_bits = kScreen.depth_bits;
  for (int i = 0; i < 8; ++i) {
    const PixelWords pixel =
        pixel_words(words, drawn(0U, test::kColumns), drawn(0U, test::kLines), parameters, kScreen.depth_bits);
    Pipeline pipeline(parameters, words, pixel);
    RC_ASSERT(pipeline.build() == quadric_pipeline(parameters, triangles).latency_cycles());
    const QuadricPixel stepped = pipeline.run();
    const QuadricPixel expected = logic(words, pixel);
    RC_ASSERT(stepped.covered == expected.covered);
    RC_ASSERT(stepped.depth == expected.depth);
    RC_ASSERT(stepped.surface == expected.surface);
    RC_ASSERT(stepped.cap == expected.cap);
    RC_ASSERT(stepped.normal == expected.normal);
  }
}

RC_GTEST_PROP(QuadricPipelineTest, StepsAreTheLogicInTheirTime, ()) {
  const QuadricParameters parameters = any_pipeline();
  steps_are_the_logic(test::any_solid(parameters), parameters);
}

RC_GTEST_PROP(QuadricPipelineTest, AlsoWhereWordsWrap, ()) {
  const QuadricParameters parameters = any_pipeline();
  steps_are_the_logic(test::any_bits(parameters), parameters);
}

// Ten stages of 3 .. 12 bits and six of 13 .. 18, in slices of 12. The root, the shifter, four slices of 40 bits and a
// clock more; 17 rows of 16 + 24 bits in two clocks, and the 23 bits above in two. Six caps and a plane: three levels,
// and three slices behind the highest.
TEST(QuadricPipelineTest, OfTheDefaultMachine) {
  QuadricParameters parameters;
  parameters.caps = 6;
  const QuadricPipeline pipeline = quadric_pipeline(parameters, {});
  EXPECT_EQ(pipeline.root_cycles, 10U + 6 * 2);
  EXPECT_EQ(pipeline.depth_cycles(), 22U + 1 + 4 + 1);
  EXPECT_EQ(pipeline.multiplier_cycles(), 2U + 2);
  EXPECT_EQ(pipeline.cap_cycles, 3U + 3);
  EXPECT_EQ(pipeline.latency_cycles(), 28U + 1);
  EXPECT_EQ(pipeline.longest.root, 12U);
  EXPECT_EQ(pipeline.longest.sums, 12U);
  EXPECT_EQ(pipeline.longest.normal, 12U);
}

// No part is longer than its own words, however wide a slice is.
TEST(QuadricPipelineTest, ASliceThatHoldsEverything) {
  QuadricParameters parameters;
  parameters.slice_bits = 60;
  const QuadricPipeline pipeline = quadric_pipeline(parameters, {});
  EXPECT_EQ(pipeline.root_cycles, 16U);
  EXPECT_EQ(pipeline.depth_cycles(), 16U + 1 + 1 + 1);
  EXPECT_EQ(pipeline.multiplier_cycles(), 1U + 1);
  EXPECT_EQ(pipeline.longest.root, 18U);
  EXPECT_EQ(pipeline.longest.sums, 40U);
  EXPECT_EQ(pipeline.longest.normal, 23U);
}

}  // namespace
}  // namespace rastertlm::quadric_processor
