// The inner loops of object boards, compiled for several instruction sets. All give the same words; which one is used
// is chosen at run time (src/base/vector_variant.h). The sources of the kernels include this header and nothing that
// other code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/object_processor/interval.h"
#include "src/base/vector_variant.h"
#include "src/frame/covered_line.h"

namespace rastertlm::object_processor {

// The borders of a triangle, linear functions slope * line + offset: pixels are at or right of 0 and 1, and at or left
// of 2 and 3. Offsets are moved by a quarter of the least distance of a column from an edge, so that rounding in double
// errs nowhere.
struct alignas(64) Borders {
  double slope[4];
  double offset[4];
};

struct BandRequest {
  const std::uint32_t* slots = nullptr;  // in the order of their numbers
  std::size_t count = 0;
  // By slot:
  const Borders* borders = nullptr;
  const Interval* lines = nullptr;  // that it can touch
  const frame::FragmentSource* sources = nullptr;
  std::uint32_t first_line = 0;  // of the band
  std::uint32_t columns = 0;
  std::uint32_t word_mask = 0;
  std::uint64_t* seen = nullptr;  // room for a bit a column and line
  std::size_t seen_words = 0;     // of a line
};

struct BandLine {
  frame::CoveredSpan* spans = nullptr;  // room for one a slot
  std::size_t count = 0;
  std::uint64_t fragments = 0;    // pixels of the spans
  std::uint64_t seen_pixels = 0;  // of their union
};
struct BandLines {
  BandLine line[kBandLines];
  std::uint32_t doubtful =
      0;  // bit i: on line i a depth may reach the word that says "nothing"; its counts mean nothing
};

// Where depth and mark share 32 bits, the nearest is the least of such keys: depth above, the mark below, so that equal
// depth keeps the lower mark. Depth begins at bit 32 - word_bits.
inline constexpr unsigned kMarkBits = 8;
inline constexpr std::uint32_t kMarkMask = (1U << kMarkBits) - 1;

struct DrawRequest {
  const frame::CoveredLine* const* boards = nullptr;  // in the order of processor numbers
  std::size_t count = 0;                              // of them
  std::uint32_t line = 0;
  unsigned word_bits = 24;
  // The first span's mark is 1, each has the next.
  const frame::FragmentSource** sources = nullptr;  // written, by mark
  // At multiples of 64 bytes, 32 words to spare:
  std::uint32_t* depth = nullptr;   // nearest so far
  std::uint32_t* winner = nullptr;  // mark of the nearest; null: depth holds keys
};

// A solid's span against what is nearest so far; as DrawRequest's.
struct SolidDrawRequest {
  const frame::SolidSpan* span = nullptr;
  std::uint32_t mark = 0;
  unsigned word_bits = 24;
  std::uint32_t* depth = nullptr;
  std::uint32_t* winner = nullptr;
};

// The normals of a solid where it is seen, before normalisation: from those at the middle of the ray, which its source
// has given, to those of its surface.
struct SolidNormalRequest {
  const frame::SolidSpan* span = nullptr;
  std::uint32_t mark = 0;
  const std::uint32_t* winner = nullptr;  // as ResolveRequest's
  std::uint32_t mark_mask = 0;
  std::uint32_t* normal[3] = {};  // read and written, with room for 16 more
};

struct ResolveRequest {
  const std::uint32_t* winner = nullptr;  // marks, in the bits of mark_mask
  std::uint32_t mark_mask = 0;
  std::uint32_t columns = 0;
  std::uint32_t line = 0;
  const frame::FragmentSource* const* sources = nullptr;  // by mark; 0 is nobody, whose words are 0
  unsigned word_bits = 24;
  unsigned normal_bits = 12;
  // Written, with room for 32 pixels more. `normal` as before normalisation, where `link` is null.
  std::uint32_t* normal[3] = {};
  std::uint16_t* link[3] = {};
  std::uint8_t* material = nullptr;
  std::uint32_t* object = nullptr;  // 0 where nobody is seen; the other words then mean nothing
};

inline constexpr unsigned kNormalisedBits = 25;  // of the widest word that the kernels normalise

struct PrenormaliseRequest {
  const std::uint32_t* normal[3] = {};  // words of word_bits; 16 to spare, as for link
  std::uint16_t* link[3] = {};
  std::size_t count = 0;
  unsigned word_bits = 24;  // at most kNormalisedBits
  unsigned normal_bits = 12;
};

struct SpanKernels {
  // Spans of processors whose edges cannot wrap, on the lines of a band.
  void (*band)(const BandRequest& request, BandLines& out);
  // `count` words, and 16 to spare.
  void (*fill)(std::uint32_t* words, std::size_t count, std::uint32_t value);
  // The depth comparator along spans, in order: strictly nearer wins.
  void (*draw)(const DrawRequest& request);
  void (*draw_solid)(const SolidDrawRequest& request);
  void (*solid_normal)(const SolidNormalRequest& request);
  // Words of the winners, pre-normalised. Returns how many pixels have one.
  std::uint64_t (*resolve)(const ResolveRequest& request);
  // The pre-normalisation unit.
  void (*prenormalise)(const PrenormaliseRequest& request);
};

const SpanKernels& span_kernels(VectorVariant variant);

}  // namespace rastertlm::object_processor
