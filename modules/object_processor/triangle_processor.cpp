#include "modules/object_processor/triangle_processor.h"

#include <cstddef>

#include "modules/object_processor/prenormaliser.h"
#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

// The words of a triangle stand in the order of their addresses.
static_assert(sizeof(TriangleWords) == sizeof(ProcessorWords));
static_assert(offsetof(TriangleWords, depth) == sizeof(std::uint32_t) * word_index(kDepth, 0));
static_assert(offsetof(TriangleWords, normals) == sizeof(std::uint32_t) * word_index(kNormalX, 0));
static_assert(offsetof(TriangleWords, material) == sizeof(std::uint32_t) * kMaterialIndex);

TriangleWords parked_triangle(unsigned word_bits) {
  const auto all_ones = static_cast<std::uint32_t>(low_mask(word_bits));
  TriangleWords triangle;
  triangle.edges.fill({0, 0, all_ones});
  triangle.depth = {0, 0, all_ones};
  return triangle;
}

bool is_parked(const TriangleWords& triangle, unsigned word_bits) {
  return std::any_of(triangle.edges.begin(), triangle.edges.end(),
                     [word_bits](const LinearWords& edge) { return is_negative_constant(edge, word_bits); });
}

ProcessorLogic triangle_processor_logic(const ObjectProcessorParameters& parameters, unsigned material_bits) {
  const auto word = static_cast<std::uint64_t>(parameters.word_bits);
  const auto slice = static_cast<std::uint64_t>(parameters.slice_bits);
  const std::uint64_t slices = parameters.slices();
  std::uint64_t synchronisation = 0;
  for (std::uint64_t i = 0; i + 1 < slices; ++i) synchronisation += (slices - 1 - i) * slice;
  const auto prenormalisation_bits = 3 * static_cast<std::uint64_t>(parameters.normal_bits) *
                                     static_cast<std::uint64_t>(parameters.prenormalisation_cycles);

  ProcessorLogic logic;
  logic.ram_bits = kElementaryProcessors * 2 * 3 * word;
  logic.register_bits =
      kElementaryProcessors * (2 * word + synchronisation + (slices - 1)) + prenormalisation_bits + material_bits;
  logic.adders = kElementaryProcessors * slices;
  logic.adder_bits = kElementaryProcessors * word;
  logic.comparators = 1;
  logic.shifters = 3 * Prenormaliser(parameters).shifters();
  return logic;
}

}  // namespace rastertlm::object_processor
