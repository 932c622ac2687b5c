// The kernels themselves, compiled once for each instruction set into the table that RASTERTLM_KERNELS names. Where
// there is no AVX-512 the compiler's own vectors are used. Vectors may run over the end of an array into what it has to
// spare, and over the end of a run into the next, which is written after it.
#include "modules/object_processor/span_kernels.h"

#if defined(__AVX512BW__)
#include <immintrin.h>
#endif

namespace rastertlm::object_processor {
namespace {

using frame::CoveredSpan;
using frame::FragmentSource;
using frame::WordPlane;

#if defined(__AVX512BW__)

inline __m512i all(std::uint32_t word) { return _mm512_set1_epi32(static_cast<int>(word)); }
inline __m512i from_0_to_15() { return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15); }

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

inline Eight eight_spans(const Borders& borders, const Interval& lines, const WordPlane& depth,
                         std::uint32_t word_mask, const BandVectors& v) {
  const auto border = [&](int i) {
    return _mm512_add_pd(_mm512_mul_pd(_mm512_set1_pd(borders.slope[i]), v.line), _mm512_set1_pd(borders.offset[i]));
  };
  const __m512d left =
      _mm512_min_pd(_mm512_max_pd(_mm512_max_pd(border(0), border(1)), _mm512_setzero_pd()), v.columns);
  const __m512d right =
      _mm512_max_pd(_mm512_min_pd(_mm512_min_pd(border(2), border(3)), v.last), _mm512_set1_pd(-1.0));
  const __m256i one = _mm256_set1_epi32(1);
  const __m256i begin = _mm512_cvt_roundpd_epi32(left, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
  const __m256i end =
      _mm256_add_epi32(_mm512_cvt_roundpd_epi32(right, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC), one);
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
  const auto first = static_cast<std::size_t>(
      _mm512_mask_reduce_min_epi32(eight.covers, _mm512_castsi256_si512(eight.begin)));
  const auto last = static_cast<std::size_t>(
      _mm512_mask_reduce_max_epi32(eight.covers, _mm512_castsi256_si512(eight.end)));
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
      out.line[k].seen_pixels +=
          static_cast<std::uint64_t>(__builtin_popcountll(request.seen[kBandLines * w + k]));
}

#endif

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

#if defined(__AVX512BW__)

// The pre-normalisation unit on 16 pixels.
class Normalising {
 public:
  Normalising(unsigned word_bits, unsigned normal_bits)
      : up_(_mm_cvtsi32_si128(static_cast<int>(32 - word_bits))),
        at_least_(all((1U << (normal_bits - 1)) - 1)),
        zeros_(all(32 - (normal_bits - 1))),
        sign_bit_(all(1U << (normal_bits - 1))) {}

  void operator()(const __m512i (&word)[3], __m256i (&link)[3]) const {
    __m512i magnitude[3], sign[3];
    __m512i together = at_least_;
    for (int i = 0; i < 3; ++i) {
      const __m512i high = _mm512_sll_epi32(word[i], up_);
      sign[i] = _mm512_srai_epi32(high, 31);
      magnitude[i] = _mm512_xor_si512(_mm512_sra_epi32(high, up_), sign[i]);
      together = _mm512_or_si512(together, magnitude[i]);
    }
    const __m512i shift = _mm512_sub_epi32(zeros_, _mm512_lzcnt_epi32(together));
    for (int i = 0; i < 3; ++i) {
      link[i] = _mm512_cvtepi32_epi16(
          _mm512_ternarylogic_epi32(_mm512_srlv_epi32(magnitude[i], shift), sign[i], sign_bit_, kOrAnd));
    }
  }

 private:
  static constexpr int kOrAnd = 0xF8;  // a or (b and c)
  __m128i up_;
  __m512i at_least_, zeros_, sign_bit_;
};

// Sixteen pixels at a time: each winner among them computes all, and keeps its own.
std::uint64_t resolve(const ResolveRequest& given) {
  const ResolveRequest request = given;  // nothing that is stored can change it
  const Normalising normalising(request.word_bits, request.normal_bits);
  const __m512i mask = all(request.mark_mask);
  const std::uint32_t line = request.line + 1;
  const __m512i lanes = from_0_to_15();
  std::uint64_t seen = 0;
  for (std::uint32_t x = 0; x < request.columns; x += 16) {
    const __m512i marks = _mm512_and_si512(_mm512_loadu_si512(request.winner + x), mask);
    const std::uint32_t left = request.columns - x;
    std::uint32_t open = _mm512_test_epi32_mask(marks, marks);
    open &= left >= 16 ? 0xFFFFU : (1U << left) - 1;
    __m512i object = _mm512_setzero_si512();
    if (open == 0) {
      _mm512_storeu_si512(request.object + x, object);
      continue;
    }
    seen += static_cast<std::uint64_t>(__builtin_popcount(open));
    const __m512i columns = _mm512_add_epi32(lanes, all(x));
    __m512i word[3] = {object, object, object};
    __m512i material = object;
    do {
      const std::uint32_t mark = request.winner[x + static_cast<std::uint32_t>(__builtin_ctz(open))] & request.mark_mask;
      const __mmask16 own = _mm512_cmpeq_epu32_mask(marks, all(mark));
      const FragmentSource& source = *request.sources[mark];
      for (int i = 0; i < 3; ++i) {
        const WordPlane& plane = source.normal[i];
        word[i] = _mm512_mask_add_epi32(word[i], own, _mm512_mullo_epi32(columns, all(plane.a)),
                                        all(plane.b * line + plane.c));
      }
      object = _mm512_mask_mov_epi32(object, own, all(source.object));
      material = _mm512_mask_mov_epi32(material, own, all(source.material));
      open &= ~static_cast<std::uint32_t>(own);
    } while (open != 0);
    _mm512_storeu_si512(request.object + x, object);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(request.material + x), _mm512_cvtepi32_epi8(material));
    if (request.link[0] == nullptr) {
      for (int i = 0; i < 3; ++i) _mm512_storeu_si512(request.normal[i] + x, word[i]);
      continue;
    }
    __m256i link[3];
    normalising(word, link);
    for (int i = 0; i < 3; ++i) _mm256_storeu_si256(reinterpret_cast<__m256i*>(request.link[i] + x), link[i]);
  }
  return seen;
}

void prenormalise(const PrenormaliseRequest& request) {
  const Normalising normalising(request.word_bits, request.normal_bits);
  for (std::size_t x = 0; x < request.count; x += 16) {
    __m512i word[3];
    __m256i link[3];
    for (int i = 0; i < 3; ++i) word[i] = _mm512_loadu_si512(request.normal[i] + x);
    normalising(word, link);
    for (int i = 0; i < 3; ++i) _mm256_storeu_si256(reinterpret_cast<__m256i*>(request.link[i] + x), link[i]);
  }
}

#else

constexpr unsigned kFloatFraction = 23;
constexpr std::int32_t kFloatBias = 127;

inline std::int32_t as_bits(float value) { return __builtin_bit_cast(std::int32_t, value); }
inline float as_float(std::int32_t bits) { return __builtin_bit_cast(float, bits); }

// The float's exponent is the bit length and its product the shift, so that lanes of a vector need neither a count of
// leading zeros nor a shift of their own: a magnitude of up to 24 bits is exact in a float, and so is its product with a
// power of two.
void prenormalise(const PrenormaliseRequest& request) {
  const std::uint32_t* __restrict x = request.normal[0];
  const std::uint32_t* __restrict y = request.normal[1];
  const std::uint32_t* __restrict z = request.normal[2];
  std::uint16_t* __restrict link_x = request.link[0];
  std::uint16_t* __restrict link_y = request.link[1];
  std::uint16_t* __restrict link_z = request.link[2];
  const std::size_t count = request.count;
  const int up = static_cast<int>(32 - request.word_bits);
  const auto magnitude_bits = static_cast<std::int32_t>(request.normal_bits - 1);
  // So that the bit length is never below magnitude_bits, and the shift not below 0.
  const std::int32_t at_least = (1 << magnitude_bits) - 1;
  const auto sign_bit = std::int32_t{1} << magnitude_bits;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t nx = static_cast<std::int32_t>(x[i] << up) >> up;
    const std::int32_t ny = static_cast<std::int32_t>(y[i] << up) >> up;
    const std::int32_t nz = static_cast<std::int32_t>(z[i] << up) >> up;
    const std::int32_t mx = nx ^ (nx >> 31);
    const std::int32_t my = ny ^ (ny >> 31);
    const std::int32_t mz = nz ^ (nz >> 31);
    const std::int32_t exponent =
        as_bits(static_cast<float>(mx | my | mz | at_least)) >> kFloatFraction;  // bit length + 126
    const std::int32_t shift = exponent - (kFloatBias - 1) - magnitude_bits;
    const float scale = as_float((kFloatBias - shift) << kFloatFraction);  // 2^-shift
    const auto kx = static_cast<std::int32_t>(static_cast<float>(mx) * scale);
    const auto ky = static_cast<std::int32_t>(static_cast<float>(my) * scale);
    const auto kz = static_cast<std::int32_t>(static_cast<float>(mz) * scale);
    link_x[i] = static_cast<std::uint16_t>(kx | ((nx >> 31) & sign_bit));
    link_y[i] = static_cast<std::uint16_t>(ky | ((ny >> 31) & sign_bit));
    link_z[i] = static_cast<std::uint16_t>(kz | ((nz >> 31) & sign_bit));
  }
}

void fill_run(const ResolveRequest& request, const FragmentSource* source, std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t number = source != nullptr ? source->object : 0;
  std::uint32_t* __restrict objects = request.object;
  for (std::uint32_t x = begin; x < end; ++x) objects[x] = number;
  if (source == nullptr) return;
  const auto index = static_cast<std::uint8_t>(source->material);
  std::uint8_t* __restrict materials = request.material;
  for (std::uint32_t x = begin; x < end; ++x) materials[x] = index;
  for (int i = 0; i < 3; ++i) {
    const WordPlane& plane = source->normal[i];
    const std::uint32_t step = plane.a;
    std::uint32_t word = plane.a * begin + plane.b * (request.line + 1) + plane.c;
    std::uint32_t* __restrict words = request.normal[i];
    for (std::uint32_t x = begin; x < end; ++x) {
      words[x] = word;
      word += step;
    }
  }
}

// By runs of one winner.
std::uint64_t resolve(const ResolveRequest& request) {
  const std::uint32_t* const winner = request.winner;
  const std::uint32_t columns = request.columns;
  const std::uint32_t mask = request.mark_mask;
  std::uint64_t seen = 0;
  std::uint32_t begin = 0;
  for (std::uint32_t x = 1; x <= columns; ++x) {
    if (x < columns && ((winner[x] ^ winner[begin]) & mask) == 0) continue;
    const FragmentSource* source = request.sources[winner[begin] & mask];
    seen += source != nullptr ? x - begin : 0;
    fill_run(request, source, begin, x);
    begin = x;
  }
  if (request.link[0] != nullptr)
    prenormalise({{request.normal[0], request.normal[1], request.normal[2]},
                  {request.link[0], request.link[1], request.link[2]},
                  columns,
                  request.word_bits,
                  request.normal_bits});
  return seen;
}

#endif

}  // namespace

extern const SpanKernels RASTERTLM_KERNELS;
const SpanKernels RASTERTLM_KERNELS{band, fill_words, draw, resolve, prenormalise};

}  // namespace rastertlm::object_processor
