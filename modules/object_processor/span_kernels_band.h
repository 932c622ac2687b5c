// The spans of processors on the lines of a band.
#pragma once

#include "modules/object_processor/span_kernels_common.h"

namespace rastertlm::object_processor {
namespace {

#if defined(__AVX512BW__)

// The slope of a depth word, as the step of its value from pixel to pixel.
inline double step_of(const WordPlane& depth, std::uint32_t word_mask) {
  const std::uint32_t sign = word_mask ^ (word_mask >> 1);
  return static_cast<double>(depth.a & word_mask) -
         ((depth.a & sign) != 0 ? static_cast<double>(word_mask) + 1.0 : 0.0);
}

// What does not change from slot to slot.
struct BandVectors {
  explicit BandVectors(const BandRequest& request)
      : numbers(_mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(request.first_line)),
                                 _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7))),
        line(_mm512_cvtepi32_pd(numbers)),
        columns(_mm512_set1_pd(static_cast<double>(request.columns))),
        last(_mm512_set1_pd(static_cast<double>(request.columns) - 0.5)),
        nothing(_mm512_set1_pd(static_cast<double>(request.word_mask))),
        mask(_mm256_set1_epi32(static_cast<int>(request.word_mask))) {}
  __m256i numbers;
  __m512d line, columns, last, nothing;
  __m256i mask;
};

struct Eight {
  __m256i begin, end;  // both 0 where nothing is covered
  __mmask8 covers;
  __mmask8 doubtful;
};

inline Eight eight_spans(const Borders& borders, const Interval& lines, const WordPlane& depth, std::uint32_t word_mask,
                         const BandVectors& v) {
  const auto border = [&](int i) {
    return _mm512_add_pd(_mm512_mul_pd(_mm512_set1_pd(borders.slope[i]), v.line), _mm512_set1_pd(borders.offset[i]));
  };
  const __m512d left =
      _mm512_min_pd(_mm512_max_pd(_mm512_max_pd(border(0), border(1)), _mm512_setzero_pd()), v.columns);
  const __m512d right = _mm512_max_pd(_mm512_min_pd(_mm512_min_pd(border(2), border(3)), v.last), _mm512_set1_pd(-1.0));
  const __m256i one = _mm256_set1_epi32(1);
  const __m256i begin = _mm512_cvt_roundpd_epi32(left, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
  const __m256i end = _mm256_add_epi32(_mm512_cvt_roundpd_epi32(right, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC), one);
  const __mmask8 covers = _mm256_cmplt_epi32_mask(begin, end) &
                          _mm256_cmpge_epi32_mask(v.numbers, _mm256_set1_epi32(lines.begin)) &
                          _mm256_cmplt_epi32_mask(v.numbers, _mm256_set1_epi32(lines.end));
  // Depth at both ends, as it runs without a wrap: between 0 and all ones, ends not included, none can be reached.
  const __m256i along = _mm256_mullo_epi32(_mm256_set1_epi32(static_cast<int>(depth.a)), begin);
  const __m256i down =
      _mm256_mullo_epi32(_mm256_set1_epi32(static_cast<int>(depth.b)), _mm256_add_epi32(v.numbers, one));
  const __m256i first = _mm256_and_si256(
      _mm256_add_epi32(_mm256_add_epi32(along, down), _mm256_set1_epi32(static_cast<int>(depth.c))), v.mask);
  const __m512d start = _mm512_cvtepu32_pd(first);
  const __m512d steps = _mm512_cvtepi32_pd(_mm256_sub_epi32(_mm256_sub_epi32(end, begin), one));
  const __m512d last = _mm512_add_pd(start, _mm512_mul_pd(_mm512_set1_pd(step_of(depth, word_mask)), steps));
  const __mmask8 safe = _mm512_cmp_pd_mask(last, _mm512_setzero_pd(), _CMP_GE_OQ) &
                        _mm512_cmp_pd_mask(last, v.nothing, _CMP_LT_OQ) &
                        _mm512_cmp_pd_mask(start, v.nothing, _CMP_LT_OQ);
  return {_mm256_maskz_mov_epi32(covers, begin), _mm256_maskz_mov_epi32(covers, end), covers,
          static_cast<__mmask8>(covers & ~safe)};
}

#else

struct Eight {
  std::uint32_t begin[kBandLines], end[kBandLines];
  std::uint32_t doubtful;
};

inline double step_of(const WordPlane& depth, std::uint32_t word_mask) {
  const std::uint32_t sign = word_mask ^ (word_mask >> 1);
  return static_cast<double>(depth.a & word_mask) -
         ((depth.a & sign) != 0 ? static_cast<double>(word_mask) + 1.0 : 0.0);
}

inline Eight eight_spans(const Borders& borders, const Interval& lines, const WordPlane& depth,
                         const BandRequest& request) {
  const auto columns = static_cast<double>(request.columns);
  const auto nothing = static_cast<double>(request.word_mask);
  const double step = step_of(depth, request.word_mask);
  Eight out{};
  for (std::uint32_t i = 0; i < kBandLines; ++i) {
    const std::uint32_t number = request.first_line + i;
    const auto line = static_cast<double>(number);
    const double left0 = borders.slope[0] * line + borders.offset[0];
    const double left1 = borders.slope[1] * line + borders.offset[1];
    const double right0 = borders.slope[2] * line + borders.offset[2];
    const double right1 = borders.slope[3] * line + borders.offset[3];
    double left = left0 > left1 ? left0 : left1;
    double right = right0 < right1 ? right0 : right1;
    left = left > 0.0 ? (left < columns ? left : columns) : 0.0;
    right = right < columns - 0.5 ? (right > -1.0 ? right : -1.0) : columns - 0.5;
    // Neither is negative once moved: truncation rounds down.
    auto begin = static_cast<std::uint32_t>(left);
    begin += static_cast<double>(begin) < left ? 1 : 0;
    const auto end = static_cast<std::uint32_t>(right + 1.0);
    const bool covers = begin < end && static_cast<std::int32_t>(number) >= lines.begin &&
                        static_cast<std::int32_t>(number) < lines.end;
    if (!covers) continue;
    out.begin[i] = begin;
    out.end[i] = end;
    const auto start = static_cast<double>((depth.a * begin + depth.b * (number + 1) + depth.c) & request.word_mask);
    const double last = start + step * static_cast<double>(end - begin - 1);
    if (!(last >= 0.0 && last < nothing && start < nothing)) out.doubtful |= 1U << i;
  }
  return out;
}

#endif

#if defined(__AVX512BW__)

inline __m512i lanes_64(__m256i words) { return _mm512_cvtepu32_epi64(words); }

// Bits of the columns from each lane's on, of a word that starts at column `first`.
inline __m512i bits_from(__m512i columns, std::size_t first) {
  const __m512i distance = _mm512_sub_epi64(columns, _mm512_set1_epi64(static_cast<long long>(first)));
  return _mm512_sllv_epi64(_mm512_set1_epi64(-1), _mm512_max_epi64(distance, _mm512_setzero_si512()));
}

// A word of 64 columns for each line of the band together.
inline void mark_seen(const Eight& eight, __m512i begin, __m512i end, std::uint64_t* seen) {
  const auto first =
      static_cast<std::size_t>(_mm512_mask_reduce_min_epi32(eight.covers, _mm512_castsi256_si512(eight.begin)));
  const auto last =
      static_cast<std::size_t>(_mm512_mask_reduce_max_epi32(eight.covers, _mm512_castsi256_si512(eight.end)));
  for (std::size_t word = first / 64; 64 * word < last; ++word) {
    std::uint64_t* lines = seen + kBandLines * word;
    const __m512i bits = _mm512_andnot_si512(bits_from(end, 64 * word), bits_from(begin, 64 * word));
    _mm512_storeu_si512(lines, _mm512_or_si512(_mm512_loadu_si512(lines), bits));
  }
}

constexpr std::size_t kAhead = 3;  // slots, whose words are asked for

void band(const BandRequest& request, BandLines& out) {
  const BandVectors vectors(request);
  frame::CoveredSpan* next[kBandLines];
  for (std::uint32_t k = 0; k < kBandLines; ++k) next[k] = out.line[k].spans;
  for (std::size_t w = 0; w < request.seen_words; ++w)
    _mm512_storeu_si512(request.seen + kBandLines * w, _mm512_setzero_si512());
  __m256i fragments = _mm256_setzero_si256();
  std::uint32_t doubtful = 0;
  for (std::size_t i = 0; i < request.count; ++i) {
    const std::uint32_t slot = request.slots[i];
    const FragmentSource* source = request.sources + slot;
    const std::uint32_t later = request.slots[i + kAhead < request.count ? i + kAhead : i];
    __builtin_prefetch(request.borders + later);
    __builtin_prefetch(request.sources + later);
    const Eight eight =
        eight_spans(request.borders[slot], request.lines[slot], source->depth, request.word_mask, vectors);
    if (eight.covers == 0) continue;
    doubtful |= eight.doubtful;
    fragments = _mm256_add_epi32(fragments, _mm256_sub_epi32(eight.end, eight.begin));
    const __m512i begin = lanes_64(eight.begin);
    const __m512i end = lanes_64(eight.end);
    alignas(64) std::uint64_t columns[kBandLines];  // as a span begins: begin, then end
    _mm512_store_si512(columns, _mm512_or_si512(begin, _mm512_slli_epi64(end, 32)));
    for (std::uint32_t k = 0; k < kBandLines; ++k) {
      __builtin_memcpy(static_cast<void*>(next[k]), &columns[k], sizeof(columns[k]));
      next[k]->source = source;
      next[k] += eight.covers >> k & 1U;
    }
    mark_seen(eight, begin, end, request.seen);
  }
  __m512i seen = _mm512_setzero_si512();
  for (std::size_t w = 0; w < request.seen_words; ++w)
    seen = _mm512_add_epi64(seen, _mm512_popcnt_epi64(_mm512_loadu_si512(request.seen + kBandLines * w)));
  alignas(64) std::uint64_t seen_pixels[kBandLines];
  alignas(32) std::uint32_t pixels[kBandLines];
  _mm512_store_si512(seen_pixels, seen);
  _mm256_store_si256(reinterpret_cast<__m256i*>(pixels), fragments);
  for (std::uint32_t k = 0; k < kBandLines; ++k) {
    out.line[k].count = static_cast<std::size_t>(next[k] - out.line[k].spans);
    out.line[k].fragments = pixels[k];
    out.line[k].seen_pixels = seen_pixels[k];
  }
  out.doubtful = doubtful;
}

#else

// Bits of a word that starts at column `first`, from `column` on.
inline std::uint64_t bits_from(std::uint32_t column, std::uint32_t first) {
  if (column <= first) return ~std::uint64_t{0};
  return column - first >= 64 ? 0 : ~std::uint64_t{0} << (column - first);
}

void band(const BandRequest& request, BandLines& out) {
  for (std::size_t w = 0; w < kBandLines * request.seen_words; ++w) request.seen[w] = 0;
  for (BandLine& line : out.line) line.count = line.fragments = line.seen_pixels = 0;
  out.doubtful = 0;
  for (std::size_t i = 0; i < request.count; ++i) {
    const std::uint32_t slot = request.slots[i];
    const FragmentSource* source = request.sources + slot;
    const Eight eight = eight_spans(request.borders[slot], request.lines[slot], source->depth, request);
    out.doubtful |= eight.doubtful;
    for (std::uint32_t k = 0; k < kBandLines; ++k) {
      const std::uint32_t begin = eight.begin[k];
      const std::uint32_t end = eight.end[k];
      if (begin >= end) continue;
      BandLine& line = out.line[k];
      line.spans[line.count++] = {begin, end, source};
      line.fragments += end - begin;
      for (std::uint32_t w = begin / 64; w <= (end - 1) / 64; ++w)
        request.seen[kBandLines * w + k] |= bits_from(begin, 64 * w) & ~bits_from(end, 64 * w);
    }
  }
  for (std::size_t w = 0; w < request.seen_words; ++w)
    for (std::uint32_t k = 0; k < kBandLines; ++k)
      out.line[k].seen_pixels += static_cast<std::uint64_t>(__builtin_popcountll(request.seen[kBandLines * w + k]));
}

#endif

}  // namespace
}  // namespace rastertlm::object_processor
