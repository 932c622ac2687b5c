// What the host loads into a quadric processor, and where it stands on the bus.
//
// A processor shows a solid as depth along the ray of each pixel: Z = l -/+ s, s the root of the discriminant that its
// EP2 makes, l linear on the screen (one EP1). Caps are planes, each an EP1 that shows the depth at which the ray meets
// it. Normals are E -/+ k s, E three EP1s, k three constants.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "modules/object_processor/second_order_processor.h"
#include "modules/object_processor/triangle_processor.h"

namespace rastertlm::quadric_processor {

using object_processor::LinearWords;
using object_processor::SecondOrderWords;

// A x + B (y + 1) + C modulo 2^plane_bits on pixel (x, y), two's complement, in units of the depth word.
struct PlaneWords {
  std::uint64_t a = 0;
  std::uint64_t b = 0;
  std::uint64_t c = 0;
  friend bool operator==(const PlaneWords&, const PlaneWords&) = default;
};

// Which part of a ray is inside the quadric, from the sign of a (src/geometry/quadric.h).
enum class RayPart : std::uint8_t {
  between,  // a > 0: from l - s to l + s; nothing where the discriminant is negative
  outside,  // a < 0: up to l - s, and from l + s on; all of it where the discriminant is negative
  all,      // rays along rulings (a = 0 and L = 0): all of it or, where the discriminant is negative, nothing
};

// What remains of a solid at a cap.
enum class CapKeeps : std::uint8_t {
  everything,  // no cap
  beyond,      // depths from the plane's on
  before,      // depths up to the plane's
  side,        // a plane along the rays: the pixels where the word's sign bit is 0
};

struct CapWords {
  CapKeeps keeps = CapKeeps::everything;
  PlaneWords plane;
  std::array<std::uint32_t, 3> normal{};  // words as those of an EP1 of the normal
  friend bool operator==(const CapWords&, const CapWords&) = default;
};

inline constexpr std::size_t kMostCaps = 6;

struct QuadricWords {
  SecondOrderWords discriminant;        // word_bits, fraction_bits of them fraction: d 4^k in square depth units
  PlaneWords middle;                    // l
  std::array<LinearWords, 3> normal{};  // E, words of the triangles' EP1s
  std::array<std::int32_t, 3> normal_of_root{};  // k of multiplier_bits, kMultiplierInteger bits of them integer: of
                                                 // the normal's word a unit of the root's last place
  std::array<CapWords, kMostCaps> caps{};
  RayPart part = RayPart::between;
  // A root's last place is 2^root_shift depth words: -31..31.
  std::int32_t root_shift = 0;
  std::uint32_t material = 0;  // 0..255
  friend bool operator==(const QuadricWords&, const QuadricWords&) = default;
};

// Integer bits of a multiplier constant, sign included; the others are fraction.
inline constexpr unsigned kMultiplierInteger = 8;

// The words of a slot without a solid: its discriminant is -1 everywhere.
QuadricWords parked_quadric(unsigned word_bits);

// On the bus, in words of 32 bits: a word of control (material 0..7, part 8..9, root_shift 10..15 in two's complement,
// caps from 16 on, two bits each); the discriminant's six, two each; l's three, two each; nine of E; three k; then nine
// of each cap, plane and normal.
inline constexpr std::size_t kWordsWithoutCaps = 1 + 12 + 6 + 9 + 3;
inline constexpr std::size_t kWordsOfCap = 6 + 3;
inline constexpr std::size_t kMostWords = kWordsWithoutCaps + kMostCaps * kWordsOfCap;
constexpr std::size_t words_of_slot(std::size_t caps) { return kWordsWithoutCaps + caps * kWordsOfCap; }
inline constexpr unsigned kQuadricShift =
    9;  // of a slot's address on the bus: 128 words of 4 bytes, and 2^23 slots a board
inline constexpr std::size_t kParkWords = 13;  // control and discriminant

using QuadricImage = std::array<std::uint32_t, kMostWords>;
QuadricImage to_image(const QuadricWords& words);
QuadricWords to_quadric(std::span<const std::uint32_t, kMostWords> image);

}  // namespace rastertlm::quadric_processor
