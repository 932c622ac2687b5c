// The triangle processor (004, section 5.2.3): seven EP1, a pre-normalisation unit, a depth comparator and a material
// register. Here is what the host loads into it and what it is made of.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "modules/object_processor/parameters.h"

namespace rastertlm::object_processor {

// The elementary processors in the order of their addresses.
inline constexpr std::size_t kEdge0 = 0;
inline constexpr std::size_t kDepth = 3;
inline constexpr std::size_t kNormalX = 4;
inline constexpr std::size_t kElementaryProcessors = 7;

// The address map of a processor's loading RAM on the host bus: word index = elementary processor * 3 + address (0 A, 1
// B, 2 C).
inline constexpr std::size_t kCoefficients = 3 * kElementaryProcessors;
inline constexpr std::size_t kMaterialIndex = kCoefficients;
inline constexpr std::size_t kWords = kCoefficients + 1;
constexpr std::size_t word_index(std::size_t elementary_processor, std::size_t address) {
  return 3 * elementary_processor + address;
}

using ProcessorWords = std::array<std::uint32_t, kWords>;

// A x + B (y + 1) + C modulo 2^word_bits on pixel (x, y); words of word_bits, two's complement.
struct LinearWords {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t c = 0;
  friend bool operator==(const LinearWords&, const LinearWords&) = default;
};

// A pixel is inside where the sign bit of all three edge words is 0.
struct TriangleWords {
  std::array<LinearWords, 3> edges{};
  LinearWords depth;                     // unsigned, smaller is nearer
  std::array<LinearWords, 3> normals{};  // x, y, z
  std::uint32_t material = 0;
  friend bool operator==(const TriangleWords&, const TriangleWords&) = default;
};

inline ProcessorWords to_words(const TriangleWords& triangle) { return std::bit_cast<ProcessorWords>(triangle); }
inline TriangleWords to_triangle(const ProcessorWords& words) { return std::bit_cast<TriangleWords>(words); }

// The words of a slot without an object: its edges are -1 everywhere, so it never covers a pixel.
TriangleWords parked_triangle(unsigned word_bits);

// A word that is negative on every pixel, whatever its line. An edge of a parked processor is one.
constexpr bool is_negative_constant(const LinearWords& words, unsigned word_bits) {
  return words.a == 0 && words.b == 0 && (words.c >> (word_bits - 1)) != 0;
}
// Whether an edge keeps the processor from ever covering a pixel.
bool is_parked(const TriangleWords& triangle, unsigned word_bits);

// What one triangle processor is made of, for the memory and logic budget.
struct ProcessorLogic {
  std::uint64_t ram_bits = 0;  // loading and backup RAMs of the seven EP1
  std::uint64_t register_bits =
      0;  // slice, synchronisation and RAM output registers, carry flip-flops, material, pre-normalised normal
  std::uint64_t adders = 0;  // slices
  std::uint64_t adder_bits = 0;
  std::uint64_t comparators = 0;  // of depth; deactivated in a tree
  std::uint64_t shifters = 0;     // of the pre-normalisation unit, three components
};
ProcessorLogic triangle_processor_logic(const ObjectProcessorParameters& parameters, unsigned material_bits);

}  // namespace rastertlm::object_processor
