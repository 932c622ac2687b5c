// Quadric processors as they step: an EP2 by its microprogram, planes by additions, the root through its pipeline. A
// board shows the same, wherever words wrap.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <deque>
#include <vector>

#include "modules/object_processor/second_order_processor.h"
#include "modules/quadric_processor/quadric_board.h"
#include "tests/modules/quadric_processor/any_solid.h"

namespace rastertlm::quadric_processor {
namespace {

using object_processor::RootPipeline;
using object_processor::SecondOrderProcessor;
using test::drawn;
using test::kColumns;
using test::kLines;
using test::kScreen;

// A plane's register: B before each line, A after each pixel, modulo its word.
class PlaneSteps {
 public:
  PlaneSteps(const PlaneWords& words, unsigned bits) : words_(words), bits_(bits), line_(words.c) {}
  void begin_line(std::uint32_t passed) {
    for (; passed > 0; --passed) line_ += words_.b;
    value_ = line_;
  }
  std::int64_t pixel() {
    const std::int64_t shown = sign_extended(value_, bits_);
    value_ += words_.a;
    return shown;
  }

 private:
  PlaneWords words_;
  unsigned bits_;
  std::uint64_t line_;
  std::uint64_t value_ = 0;
};

class Stepped {
 public:
  Stepped(const QuadricWords& words, const QuadricParameters& parameters)
      : words_(words),
        parameters_(parameters),
        ep2_(static_cast<unsigned>(parameters.word_bits), static_cast<unsigned>(parameters.slice_bits)),
        middle_(words.middle, static_cast<unsigned>(parameters.plane_bits)),
        logic_(parameters, kScreen.depth_bits, kScreen.range) {
    for (const CapWords& cap : words.caps) caps_.emplace_back(cap.plane, static_cast<unsigned>(parameters.plane_bits));
    ep2_.load(words.discriminant);
    ep2_.run(object_processor::second_order_frame_start());
  }

  // `passed`: lines from the one that was shown before; of an EP2 none for line 0.
  std::vector<std::uint32_t> line(std::uint32_t passed, bool first) {
    for (std::uint32_t i = first ? 1 : 0; i < passed; ++i)
      ep2_.run(object_processor::second_order_line_step(ep2_.slices()));
    ep2_.run(object_processor::second_order_line_start(ep2_.slices()));
    middle_.begin_line(passed);
    for (PlaneSteps& cap : caps_) cap.begin_line(passed);
    RootPipeline pipeline(parameters_.root());
    std::vector<std::uint32_t> depths;
    std::deque<PixelWords> waiting;  // for their roots
    for (std::uint32_t clock = 0; depths.size() < kColumns; ++clock) {
      std::uint64_t entering = 0;
      if (clock < kColumns) {
        PixelWords pixel;
        pixel.discriminant = ep2_.output();
        pixel.middle = middle_.pixel();
        for (std::size_t i = 0; i < kMostCaps; ++i) pixel.caps[i] = caps_[i].pixel();
        waiting.push_back(pixel);
        ep2_.step(object_processor::second_order_pixel(ep2_.slices()));
        entering = std::min(pixel.discriminant, parameters_.root().largest_word());
      }
      const std::uint64_t root = pipeline.clock(entering);
      if (clock + 1 < parameters_.root().stages()) continue;
      const PixelWords& pixel = waiting.front();
      const bool inside = (pixel.discriminant >> (parameters_.word_bits - 1)) == 0;
      if (inside) RC_ASSERT(root == root_of(pixel.discriminant, parameters_.root()));
      const QuadricPixel shown = logic_(words_, pixel);
      depths.push_back(shown.covered ? shown.depth : (1U << kScreen.depth_bits) - 1);
      waiting.pop_front();
    }
    return depths;
  }

 private:
  QuadricWords words_;
  QuadricParameters parameters_;
  SecondOrderProcessor ep2_;
  PlaneSteps middle_;
  std::vector<PlaneSteps> caps_;
  QuadricPixelLogic logic_;
};

void board_shows_the_steps(const QuadricWords& words, const QuadricParameters& parameters, std::uint32_t fields) {
  QuadricBoard board(parameters, kScreen, 1, 0);
  board.write(0, words);
  board.copy();
  const std::uint32_t field = fields == 1 ? 0 : drawn(0U, 2U);
  Stepped stepped(words, parameters);
  for (std::uint32_t line = field; line < kLines; line += fields) {
    const bool first = line == field;
    const std::vector<std::uint32_t> expected = stepped.line(first ? field + 1 : fields, first);
    std::vector<std::uint32_t> shown(kColumns, (1U << kScreen.depth_bits) - 1);
    const frame::CoveredLine* covered = nullptr;
    board.cover_lines(line, 1, fields, &covered);
    for (std::size_t i = 0; i < covered->solid_count; ++i) {
      const frame::SolidSpan& span = covered->solids[i];
      for (std::uint32_t column = span.begin; column < span.end; ++column)
        shown[column] = std::min(shown[column], span.depth[column - span.begin]);
    }
    RC_ASSERT(shown == expected);
  }
}

QuadricParameters sliced() {
  QuadricParameters parameters = test::any_parameters();
  parameters.slice_bits = drawn<std::int64_t>((parameters.word_bits + 31) / 32, parameters.word_bits + 1);
  return parameters;
}

RC_GTEST_PROP(QuadricStepsTest, ABoardShowsWhatTheMicroprogramSteps, ()) {
  const QuadricParameters parameters = sliced();
  board_shows_the_steps(test::any_solid(parameters), parameters, drawn(1U, 3U));
}

RC_GTEST_PROP(QuadricStepsTest, AlsoWhereWordsWrap, ()) {
  const QuadricParameters parameters = sliced();
  board_shows_the_steps(test::any_bits(parameters), parameters, drawn(1U, 3U));
}

}  // namespace
}  // namespace rastertlm::quadric_processor
