// The depth comparator along spans.
#pragma once

#include "modules/object_processor/span_kernels_common.h"

namespace rastertlm::object_processor {
namespace {

void fill_words(std::uint32_t* words, std::size_t count, std::uint32_t value) {
#if defined(__AVX512BW__)
  for (std::size_t x = 0; x < count; x += 16) _mm512_storeu_si512(words + x, all(value));
#else
  for (std::size_t x = 0; x < count; ++x) words[x] = value;
#endif
}

inline std::uint32_t start_of(const DrawRequest& request, const WordPlane& depth, std::uint32_t x) {
  return depth.a * x + depth.b * (request.line + 1) + depth.c;
}

#if defined(__AVX512BW__)

// Calls visit(x, lanes) for the 16 columns from each multiple of 16 that a span has any of: whole vectors, so that what
// one span has stored the next loads as it was stored.
template <class Visit>
inline void visit_vectors(const CoveredSpan& span, const Visit& visit) {
  const std::uint32_t end = span.end;
  std::uint32_t x = span.begin & ~15U;
  std::uint32_t covered = 0xFFFFU << (span.begin - x) & 0xFFFFU;
  for (; x + 16 < end; x += 16) {
    visit(x, static_cast<__mmask16>(covered));
    covered = 0xFFFFU;
  }
  visit(x, static_cast<__mmask16>(covered & (0xFFFFU >> (x + 16 - end))));
}

void draw_keys(const DrawRequest& request) {
  const unsigned up = 32 - request.word_bits;
  std::uint32_t* const keys = request.depth;
  const CoveredSpan* const spans = request.spans;
  const FragmentSource** const sources = request.sources + request.first_mark;
  const __m512i ramp = from_0_to_15();
  for (std::size_t i = 0; i < request.count; ++i) {
    const FragmentSource* source = spans[i].source;
    sources[i] = source;
    const std::uint32_t step = source->depth.a << up;
    const std::uint32_t mark = request.first_mark + static_cast<std::uint32_t>(i);
    const std::uint32_t start = start_of(request, source->depth, spans[i].begin & ~15U) << up | mark;
    __m512i key = _mm512_add_epi32(all(start), _mm512_mullo_epi32(all(step), ramp));
    const __m512i next = all(16 * step);
    visit_vectors(spans[i], [&](std::uint32_t x, __mmask16 covered) {
      const __m512i old = _mm512_load_si512(keys + x);
      _mm512_store_si512(keys + x, _mm512_mask_min_epu32(old, covered, old, key));
      key = _mm512_add_epi32(key, next);
    });
  }
}

void draw_apart(const DrawRequest& request) {
  std::uint32_t* const depths = request.depth;
  std::uint32_t* const winners = request.winner;
  const __m512i ramp = from_0_to_15();
  const __m512i word_mask = all(request.word_bits < 32 ? (1U << request.word_bits) - 1 : ~0U);
  for (std::size_t i = 0; i < request.count; ++i) {
    const FragmentSource* source = request.spans[i].source;
    const std::uint32_t mark = request.first_mark + static_cast<std::uint32_t>(i);
    request.sources[mark] = source;
    const WordPlane& depth = source->depth;
    __m512i word = _mm512_add_epi32(all(start_of(request, depth, request.spans[i].begin & ~15U)),
                                    _mm512_mullo_epi32(all(depth.a), ramp));
    const __m512i next = all(16 * depth.a);
    visit_vectors(request.spans[i], [&](std::uint32_t x, __mmask16 covered) {
      const __m512i here = _mm512_and_si512(word, word_mask);
      const __m512i old = _mm512_load_si512(depths + x);
      const __mmask16 nearer = _mm512_mask_cmplt_epu32_mask(covered, here, old);
      _mm512_store_si512(depths + x, _mm512_mask_mov_epi32(old, nearer, here));
      _mm512_mask_store_epi32(winners + x, nearer, all(mark));
      word = _mm512_add_epi32(word, next);
    });
  }
}

#else

void draw_keys(const DrawRequest& request) {
  const unsigned up = 32 - request.word_bits;
  for (std::size_t i = 0; i < request.count; ++i) {
    const CoveredSpan& span = request.spans[i];
    const std::uint32_t mark = request.first_mark + static_cast<std::uint32_t>(i);
    request.sources[mark] = span.source;
    const std::uint32_t step = span.source->depth.a << up;
    std::uint32_t key = start_of(request, span.source->depth, span.begin) << up | mark;
    std::uint32_t* __restrict keys = request.depth + span.begin;
    const std::size_t count = span.end - span.begin;
    for (std::size_t x = 0; x < count; ++x) {
      keys[x] = key < keys[x] ? key : keys[x];
      key += step;
    }
  }
}

// Word: as what depths are compared. Narrower ones than 32 bits are not negative, and vectors without unsigned
// comparisons do those faster as signed.
template <class Word>
void draw_as(const DrawRequest& request) {
  const std::uint32_t mask = request.word_bits < 32 ? (1U << request.word_bits) - 1 : ~0U;
  for (std::size_t i = 0; i < request.count; ++i) {
    const CoveredSpan& span = request.spans[i];
    const std::uint32_t mark = request.first_mark + static_cast<std::uint32_t>(i);
    request.sources[mark] = span.source;
    const std::uint32_t step = span.source->depth.a;
    std::uint32_t word = start_of(request, span.source->depth, span.begin);
    std::uint32_t* __restrict nearest = request.depth + span.begin;
    std::uint32_t* __restrict winner = request.winner + span.begin;
    const std::size_t count = span.end - span.begin;
    for (std::size_t x = 0; x < count; ++x) {
      const std::uint32_t here = word & mask;
      const bool wins = static_cast<Word>(here) < static_cast<Word>(nearest[x]);
      nearest[x] = wins ? here : nearest[x];
      winner[x] = wins ? mark : winner[x];
      word += step;
    }
  }
}

void draw_apart(const DrawRequest& request) {
  if (request.word_bits < 32)
    draw_as<std::int32_t>(request);
  else
    draw_as<std::uint32_t>(request);
}

#endif

void draw(const DrawRequest& request) {
  if (request.winner == nullptr)
    draw_keys(request);
  else
    draw_apart(request);
}

}  // namespace
}  // namespace rastertlm::object_processor
