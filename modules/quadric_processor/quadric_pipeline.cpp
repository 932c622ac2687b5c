#include "modules/quadric_processor/quadric_pipeline.h"

#include <algorithm>

#include "modules/quadric_processor/quadric_words.h"
#include "src/base/fixed_point.h"

namespace rastertlm::quadric_processor {

std::uint64_t QuadricPipeline::depth_cycles() const {
  return std::max(root_cycles + shifter_cycles + comparison_cycles, cap_cycles) + sum_cycles;
}

std::uint64_t QuadricPipeline::latency_cycles() const {
  return std::max(depth_cycles(), root_cycles + multiplier_cycles()) + output_cycles;
}

std::uint64_t read_root_bits(const QuadricParameters& parameters) {
  return parameters.root().result_bits() + (parameters.root_reading == RootReading::half_unit ? 1U : 0U);
}

NormalRows normal_rows(const QuadricParameters& parameters,
                       const object_processor::ObjectProcessorParameters& triangles) {
  const std::uint64_t fraction = static_cast<std::uint64_t>(parameters.multiplier_bits) - kMultiplierInteger;
  const std::uint64_t bits = fraction + static_cast<std::uint64_t>(triangles.word_bits);
  return {bits, fraction, std::min(read_root_bits(parameters), bits)};
}

QuadricPipeline quadric_pipeline(const QuadricParameters& parameters,
                                 const object_processor::ObjectProcessorParameters& triangles) {
  const auto slice = static_cast<std::uint64_t>(parameters.slice_bits);
  const NormalRows normal = normal_rows(parameters, triangles);
  const std::uint64_t stages = parameters.root().stages();
  QuadricPipeline pipeline;
  for (std::uint64_t stage = 1; stage <= stages; ++stage)
    pipeline.root_cycles += parameters.slices_of(subtracter_bits(stage));
  pipeline.shifter_cycles = parameters.scaling == Scaling::object ? 1 : 0;
  pipeline.sum_cycles = parameters.plane_slices();
  // A tree of the caps and a plane of the view: as many levels as the caps' number has bits.
  if (parameters.caps > 0)
    pipeline.cap_cycles = bit_length(static_cast<std::uint64_t>(parameters.caps)) + pipeline.sum_cycles - 1;
  pipeline.row_cycles = parameters.slices_of(normal.rows);
  pipeline.join_cycles = parameters.slices_of(normal.joined());
  pipeline.output_cycles = static_cast<std::uint64_t>(parameters.output_cycles);
  pipeline.longest = {std::min(slice, subtracter_bits(stages)),
                      std::min(slice, static_cast<std::uint64_t>(parameters.plane_bits)),
                      std::min(slice, std::max(normal.rows, normal.joined()))};
  return pipeline;
}

}  // namespace rastertlm::quadric_processor
