#include "modules/quadric_processor/quadric_logic.h"

#include <algorithm>

#include "modules/object_processor/microprogram.h"
#include "modules/object_processor/prenormaliser.h"
#include "modules/object_processor/second_order_program.h"
#include "modules/quadric_processor/quadric_pipeline.h"
#include "modules/quadric_processor/quadric_words.h"

namespace rastertlm::quadric_processor {

namespace {

// Of the interval logic: both roots against the entry, one of them against the exit (which one is the solid's), the
// roots against each other, entry against exit.
constexpr std::uint64_t kDepthComparators = 5;

// An accumulator: slices, RAM output, synchronisation registers, carries.
std::uint64_t accumulator_bits(std::uint64_t word, std::uint64_t slice, std::uint64_t slices) {
  std::uint64_t bits = 2 * word + (slices - 1);
  for (std::uint64_t i = 0; i + 1 < slices; ++i) bits += (slices - 1 - i) * slice;
  return bits;
}

// Registers of a word of which slice j, from 0, is made in clock `made` and last read in clock `read` (both + j times
// a step): it is held from one to the other.
struct Step {
  std::int64_t first = 0;
  std::int64_t a_slice = 0;
};
std::uint64_t held_bits(std::uint64_t word, std::uint64_t slice, Step made, Step read) {
  std::uint64_t bits = 0;
  for (std::uint64_t low = 0, j = 0; low < word; low += slice, ++j) {
    const auto clocks = read.first - made.first + (read.a_slice - made.a_slice) * static_cast<std::int64_t>(j);
    bits += std::min(slice, word - low) * static_cast<std::uint64_t>(std::max<std::int64_t>(clocks, 0));
  }
  return bits;
}

// A stage of more than a clock keeps what came in, what is subtracted already, and a borrow.
std::uint64_t root_register_bits(const QuadricParameters& parameters) {
  const object_processor::RootFormat root = parameters.root();
  const auto slice = static_cast<std::uint64_t>(parameters.slice_bits);
  std::uint64_t bits = object_processor::RootPipeline(root).register_bits();
  for (std::uint64_t stage = 1; stage <= root.stages(); ++stage) {
    const std::uint64_t came_in = 2 * (root.result_bits() - stage + 1) + (stage - 1) + stage;
    for (std::uint64_t clock = 1; clock < parameters.slices_of(subtracter_bits(stage)); ++clock)
      bits += came_in + clock * slice + 1;
  }
  return bits;
}

// The shifter, both sums and the interval logic. Clock 0 is the shifter's; each elementary processor begins when its
// word is needed.
std::uint64_t depth_register_bits(const QuadricParameters& parameters, const QuadricPipeline& pipeline) {
  const auto plane = static_cast<std::uint64_t>(parameters.plane_bits);
  const auto slice = static_cast<std::uint64_t>(parameters.slice_bits);
  const auto caps = static_cast<std::uint64_t>(parameters.caps);
  const auto slices = static_cast<std::int64_t>(pipeline.sum_cycles);
  const std::int64_t choice = 1 + slices + 1;
  const auto held = [&](Step made, Step read) { return held_bits(plane, slice, made, read); };
  std::uint64_t bits = held({1 - static_cast<std::int64_t>(pipeline.shifter_cycles)}, {1, 1});  // s
  bits += held({1}, {1, 1});                                                                    // l
  bits += 2 * (held({1, 1}, {choice}) + pipeline.sum_cycles - 1);                               // the roots
  bits += kDepthComparators * pipeline.sum_cycles;  // a borrow a slice, the last one the sign
  if (caps == 0) return bits;                       // the planes of the view stay
  // Caps wait for their highest slice's turn; of each choice of a tree its word, and for each slice which was higher.
  bits += caps * held({1}, {slices, -1});
  bits += 2 * caps * (plane + 2 * pipeline.sum_cycles);
  bits += held({2, -1}, {choice}) + held({2, -1}, {2, 1});  // entry until the choice, exit until it is compared
  // Where the root is soon found, it waits for the trees.
  const std::uint64_t found = pipeline.root_cycles + pipeline.shifter_cycles + pipeline.comparison_cycles;
  return bits + (pipeline.cap_cycles > found ? (pipeline.cap_cycles - found) * read_root_bits(parameters) : 0);
}

// Of one component.
std::uint64_t normal_register_bits(const QuadricParameters& parameters, const NormalRows& normal,
                                   const QuadricPipeline& pipeline) {
  const auto slice = static_cast<std::uint64_t>(parameters.slice_bits);
  const auto kept = [&](std::uint64_t done) { return done > normal.fraction ? done - normal.fraction : 0; };
  std::uint64_t bits = 0;
  for (std::uint64_t clock = 1; clock <= pipeline.row_cycles; ++clock) {
    const std::uint64_t done = std::min(clock * slice, normal.rows);
    bits += 2 * (normal.bits - done) + kept(done);
  }
  const auto join = static_cast<std::int64_t>(pipeline.join_cycles);
  if (join == 0) return bits;
  bits += 2 * held_bits(normal.joined(), slice, {1}, {1, 1});
  return bits + held_bits(normal.joined(), slice, {1, 1}, {1 + join}) + pipeline.join_cycles - 1 +
         kept(normal.rows) * pipeline.join_cycles;
}

// The root on its way down the rows, and until these begin; or depth until the normal is ready.
std::uint64_t waiting_register_bits(const QuadricParameters& parameters, const NormalRows& normal,
                                    const QuadricPipeline& pipeline, std::uint64_t depth_bits) {
  const auto slice = static_cast<std::uint64_t>(parameters.slice_bits);
  std::uint64_t bits = 0;
  for (std::uint64_t clock = 1; clock < pipeline.row_cycles; ++clock) bits += normal.rows - clock * slice;
  const std::uint64_t depth = pipeline.depth_cycles(), other = pipeline.root_cycles + pipeline.multiplier_cycles();
  return bits + (depth > other ? (depth - other) * read_root_bits(parameters) : (other - depth) * depth_bits);
}

}  // namespace

QuadricLogic quadric_logic(const QuadricParameters& parameters,
                           const object_processor::ObjectProcessorParameters& triangles, unsigned material_bits) {
  const auto word = static_cast<std::uint64_t>(parameters.word_bits);
  const auto plane = static_cast<std::uint64_t>(parameters.plane_bits);
  const auto normal = static_cast<std::uint64_t>(triangles.word_bits);
  const auto factor = static_cast<std::uint64_t>(parameters.multiplier_bits);
  const auto caps = static_cast<std::uint64_t>(parameters.caps);
  const std::uint64_t planes = 1 + caps;
  const object_processor::RootFormat root = parameters.root();
  const QuadricPipeline pipeline = quadric_pipeline(parameters, triangles);
  const NormalRows rows = normal_rows(parameters, triangles);

  QuadricLogic logic;
  constexpr unsigned kPartBits = 2, kShiftBits = 6, kCapBits = 2;
  logic.rams = {{"discriminant", object_processor::kSecondOrderWords, word, 3},
                {"depth and caps", 3 * planes, plane, planes},
                {"normal", 9, normal, 3},
                {"normal of root", 3, factor, 0},
                {"normals of caps", 3 * caps, normal, 0},
                {"control", 1, material_bits + kPartBits + kShiftBits + kCapBits * caps, 0}};

  const auto slice = static_cast<std::uint64_t>(parameters.slice_bits);
  const auto normal_slice = static_cast<std::uint64_t>(triangles.slice_bits);
  const std::uint64_t link_bits = normal + 3 * static_cast<std::uint64_t>(triangles.normal_bits) + material_bits;
  logic.register_bits = 2 * accumulator_bits(word, slice, parameters.slices()) +
                        planes * accumulator_bits(plane, slice, parameters.plane_slices()) +
                        3 * accumulator_bits(normal, normal_slice, triangles.slices()) +
                        root_register_bits(parameters) + depth_register_bits(parameters, pipeline) +
                        3 * normal_register_bits(parameters, rows, pipeline) +
                        waiting_register_bits(parameters, rows, pipeline, normal) +
                        static_cast<std::uint64_t>(parameters.output_cycles) * link_bits;

  // Two of the EP2, one an EP1; a subtracter a stage of the root; l - s and l + s; behind the rows of the normal.
  logic.adders = 2 * parameters.slices() + planes * parameters.plane_slices() + 3 * triangles.slices() +
                 pipeline.root_cycles + 2 * pipeline.sum_cycles + 3 * pipeline.join_cycles;
  std::uint64_t root_adder_bits = 0;
  for (std::uint64_t stage = 1; stage <= root.stages(); ++stage) root_adder_bits += subtracter_bits(stage);
  logic.adder_bits = 2 * word + planes * plane + 3 * normal + root_adder_bits + 2 * plane + 3 * rows.joined();
  logic.multipliers = 3;
  // Row i, from 0, adds from bit i on.
  logic.multiplier_bits = 3 * (rows.rows * rows.bits - rows.rows * (rows.rows - 1) / 2);
  // A tree of the caps for entry and one for exit; those of the interval; and that of depth, as a triangle's.
  logic.comparators = 2 * caps + kDepthComparators + 1;
  logic.root_stages = root.stages();
  logic.shifters =
      (parameters.scaling == Scaling::object ? 1 : 0) + 3 * object_processor::Prenormaliser(triangles).shifters();
  return logic;
}

Cycles line_start_cycles(const QuadricParameters& parameters, std::uint64_t lines, bool after_retrace) {
  return std::max(object_processor::second_order_line_cycles(parameters.slices(), lines - (after_retrace ? 1 : 0)),
                  object_processor::line_start_cycles(parameters.plane_slices(), lines));
}

Cycles line_step_cycles(const QuadricParameters& parameters, std::uint64_t lines, bool after_retrace) {
  return line_start_cycles(parameters, lines, after_retrace) -
         object_processor::second_order_line_cycles(parameters.slices(), 0);
}

}  // namespace rastertlm::quadric_processor
