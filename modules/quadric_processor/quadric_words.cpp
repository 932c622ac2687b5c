#include "modules/quadric_processor/quadric_words.h"

#include "src/base/fixed_point.h"

namespace rastertlm::quadric_processor {

namespace {

// Where the parts of a slot begin.
constexpr std::size_t kControl = 0;
constexpr std::size_t kDiscriminant = 1;
constexpr std::size_t kMiddle = 13;
constexpr std::size_t kNormal = 19;
constexpr std::size_t kNormalOfRoot = 28;

constexpr unsigned kPartBit = 8;
constexpr unsigned kShiftBit = 10;
constexpr unsigned kShiftBits = 6;
constexpr unsigned kCapsBit = 16;

void put_wide(std::uint64_t value, std::uint32_t* at) {
  at[0] = static_cast<std::uint32_t>(value);
  at[1] = static_cast<std::uint32_t>(value >> 32);
}
std::uint64_t wide(const std::uint32_t* at) { return at[0] | std::uint64_t{at[1]} << 32; }

void put_plane(const PlaneWords& plane, std::uint32_t* at) {
  put_wide(plane.a, at);
  put_wide(plane.b, at + 2);
  put_wide(plane.c, at + 4);
}
PlaneWords plane_at(const std::uint32_t* at) { return {wide(at), wide(at + 2), wide(at + 4)}; }

std::uint32_t control(const QuadricWords& words) {
  std::uint32_t word = words.material & 0xFF;
  word |= static_cast<std::uint32_t>(words.part) << kPartBit;
  word |= (static_cast<std::uint32_t>(words.root_shift) & static_cast<std::uint32_t>(low_mask(kShiftBits)))
          << kShiftBit;
  for (std::size_t i = 0; i < kMostCaps; ++i)
    word |= static_cast<std::uint32_t>(words.caps[i].keeps) << (kCapsBit + 2 * i);
  return word;
}

void take_control(std::uint32_t word, QuadricWords& words) {
  words.material = word & 0xFF;
  const std::uint32_t part = word >> kPartBit & 3U;
  words.part = part == 3 ? RayPart::all : static_cast<RayPart>(part);
  words.root_shift = static_cast<std::int32_t>(word << (32 - kShiftBit - kShiftBits)) >> (32 - kShiftBits);
  for (std::size_t i = 0; i < kMostCaps; ++i)
    words.caps[i].keeps = static_cast<CapKeeps>(word >> (kCapsBit + 2 * i) & 3U);
}

}  // namespace

QuadricWords parked_quadric(unsigned word_bits) {
  QuadricWords words;
  words.discriminant.v0 = low_mask(word_bits);
  return words;
}

QuadricImage to_image(const QuadricWords& words) {
  QuadricImage image{};
  const SecondOrderWords& d = words.discriminant;
  std::size_t at = kDiscriminant;
  for (const std::uint64_t value : {d.v0, d.dy, d.two_b, d.d0, d.c, d.two_a}) {
    put_wide(value, &image[at]);
    at += 2;
  }
  put_plane(words.middle, &image[kMiddle]);
  for (std::size_t i = 0; i < 3; ++i) {
    image[kNormal + 3 * i] = words.normal[i].a;
    image[kNormal + 3 * i + 1] = words.normal[i].b;
    image[kNormal + 3 * i + 2] = words.normal[i].c;
    image[kNormalOfRoot + i] = static_cast<std::uint32_t>(words.normal_of_root[i]);
  }
  image[kControl] = control(words);
  for (std::size_t i = 0; i < kMostCaps; ++i) {
    std::uint32_t* const cap = &image[kWordsWithoutCaps + i * kWordsOfCap];
    put_plane(words.caps[i].plane, cap);
    for (std::size_t k = 0; k < 3; ++k) cap[6 + k] = words.caps[i].normal[k];
  }
  return image;
}

QuadricWords to_quadric(std::span<const std::uint32_t, kMostWords> image) {
  QuadricWords words;
  const std::uint32_t* const at = image.data();
  const std::uint32_t* const d = at + kDiscriminant;
  words.discriminant = {wide(d), wide(d + 2), wide(d + 4), wide(d + 6), wide(d + 8), wide(d + 10)};
  words.middle = plane_at(at + kMiddle);
  for (std::size_t i = 0; i < 3; ++i) {
    words.normal[i] = {at[kNormal + 3 * i], at[kNormal + 3 * i + 1], at[kNormal + 3 * i + 2]};
    words.normal_of_root[i] = static_cast<std::int32_t>(at[kNormalOfRoot + i]);
  }
  take_control(at[kControl], words);
  for (std::size_t i = 0; i < kMostCaps; ++i) {
    const std::uint32_t* const cap = at + kWordsWithoutCaps + i * kWordsOfCap;
    words.caps[i].plane = plane_at(cap);
    for (std::size_t k = 0; k < 3; ++k) words.caps[i].normal[k] = cap[6 + k];
  }
  return words;
}

}  // namespace rastertlm::quadric_processor
