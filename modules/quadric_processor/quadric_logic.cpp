#include "modules/quadric_processor/quadric_logic.h"

#include <algorithm>

#include "modules/object_processor/microprogram.h"
#include "modules/object_processor/prenormaliser.h"
#include "modules/object_processor/second_order_program.h"
#include "modules/quadric_processor/quadric_words.h"

namespace rastertlm::quadric_processor {

namespace {

// An accumulator: slices, RAM output, synchronisation registers, carries.
std::uint64_t accumulator_bits(std::uint64_t word, std::uint64_t slice, std::uint64_t slices) {
  std::uint64_t bits = 2 * word + (slices - 1);
  for (std::uint64_t i = 0; i + 1 < slices; ++i) bits += (slices - 1 - i) * slice;
  return bits;
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
  const std::uint64_t root_bits = root.result_bits() + (root.reading == RootReading::half_unit ? 1 : 0);

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
                        object_processor::RootPipeline(root).register_bits() +
                        static_cast<std::uint64_t>(parameters.output_cycles) * link_bits;

  // Two of the EP2, one an EP1; a subtracter a stage of the root; l - s and l + s; three sums of the normal.
  logic.adders =
      2 * parameters.slices() + planes * parameters.plane_slices() + 3 * triangles.slices() + root.stages() + 2 + 3;
  std::uint64_t root_adder_bits = 0;
  for (std::uint64_t stage = 1; stage <= root.stages(); ++stage) root_adder_bits += stage + 2;
  logic.adder_bits = 2 * word + planes * plane + 3 * normal + root_adder_bits + 2 * plane + 3 * normal;
  logic.multipliers = 3;
  logic.multiplier_bits = 3 * factor * root_bits;
  // Each cap and the near plane against the entry, each cap and the far plane against the exit, entry against exit;
  // and the comparator of depth, as a triangle's.
  logic.comparators = 2 * (caps + 1) + 1 + 1;
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
