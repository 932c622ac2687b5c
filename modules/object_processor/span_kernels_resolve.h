// Words of the nearest, and the pre-normalisation unit.
#pragma once

#include "modules/object_processor/span_kernels_common.h"

namespace rastertlm::object_processor {
namespace {

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
      const std::uint32_t mark =
          request.winner[x + static_cast<std::uint32_t>(__builtin_ctz(open))] & request.mark_mask;
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
// leading zeros nor a shift of their own: a magnitude of up to 24 bits is exact in a float, and so is its product with
// a power of two.
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
}  // namespace rastertlm::object_processor
