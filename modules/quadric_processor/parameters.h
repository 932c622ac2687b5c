// What an architect may choose of the quadric processors.
#pragma once

#include <cstdint>
#include <string>

#include "modules/object_processor/parameters.h"
#include "modules/object_processor/square_root.h"
#include "src/base/errors.h"
#include "src/parameter/table.h"

namespace rastertlm::quadric_processor {

using object_processor::RootReading;

// Whether the host scales each solid's discriminant by a power of 4, so that its root fills the extractor, or leaves it
// in depth units. A scale costs a shifter between the root and the adder of depth.
enum class Scaling { object, fixed };

// A fragment of a quadric is later than a triangle's by the root: quadric processors start their lines earlier, or
// triangles wait in registers.
enum class Alignment { early_start, delay };

// What happens to a solid that the words cannot show.
enum class OnRefusal { error, drop };

// The widest words that a machine can have.
inline constexpr std::int64_t kMostWordBits = 60;
inline constexpr std::int64_t kMostPlaneBits = 48;
inline constexpr std::int64_t kMostRootIntegerBits = 16;
inline constexpr std::int64_t kMostRootBits = 24;  // with guard bits

struct QuadricParameters {
  std::int64_t per_unit = 0;        // quadric processors a computation unit
  std::int64_t word_bits = 48;      // of an EP2: the discriminant
  std::int64_t fraction_bits = 12;  // of its words
  std::int64_t plane_bits = 40;     // of the EP1s of depth and caps, in units of the depth word
  std::int64_t slice_bits = 12;     // of one adder of these, and the longest chain of full adders anywhere
  std::int64_t caps = 2;            // planes that may cut a solid
  std::int64_t root_integer_bits = 10;
  std::int64_t root_guard_bits = 6;
  RootReading root_reading = RootReading::half_unit;
  std::int64_t multiplier_bits = 24;  // of the constant that the root is multiplied with, for the normal
  Scaling scaling = Scaling::object;
  Alignment alignment = Alignment::early_start;
  OnRefusal on_refusal = OnRefusal::error;
  std::int64_t output_cycles = 1;  // register stages of the interval logic's choice, behind its comparators

  object_processor::RootFormat root() const;
  unsigned slices_of(std::uint64_t bits) const;  // of an adder of that many bits: ceil(bits / slice_bits)
  unsigned slices() const;                       // of the EP2's adders
  unsigned plane_slices() const;                 // of the wide EP1s'

  void declare(parameter::Table& table);
  // What one range cannot say: `file` names the machine file in the diagnostics.
  void check(const object_processor::ObjectProcessorParameters& triangles, Diagnostics& diagnostics,
             const std::string& file) const;
};

// Depth words a depth unit, as a power of 2: the screen is about as deep as it is wide, so that a unit is about a pixel
// of depth. 15 for words of 24 bits and 512 columns.
int depth_fraction_bits(int depth_bits, std::size_t columns, std::size_t lines);

}  // namespace rastertlm::quadric_processor
