// The kernel itself, compiled once for each instruction set under the name RASTERTLM_KERNEL. Where there is no AVX-512
// the compiler's own vectors are used.
#include "modules/shading/shade_kernels.h"

#if defined(__AVX512BW__)
#include <immintrin.h>
#endif

namespace rastertlm::shading {
namespace {

constexpr std::size_t kBlock = 32;  // pixels

#if defined(__AVX512BW__)

inline __m512i all_16(int word) { return _mm512_set1_epi16(static_cast<short>(word)); }
inline __m512i all_32(std::uint32_t word) { return _mm512_set1_epi32(static_cast<int>(word)); }

// 16-bit lanes of a block, in the order in which packing two vectors of 32-bit lanes leaves them: lanes of both halves
// by turns of four.
struct Normals {
  __m512i component[3];  // 2 n + 1, lifted
  __m512i sign[3];       // all ones where negative
  __mmask16 zero[2];     // by half, in the order of pixels
};

struct Half {
  __m512i magnitude[3];
  __m512i word[3];
  __m512i root;
  __mmask16 zero;
  __mmask16 is_short;
};

inline Half half_of(const ShadeRequest& request, std::size_t at) {
  Half half;
  const __m512i mask = all_32((1U << request.magnitude_bits) - 1);
  const __m512i one = all_32(1);
  __m512i squares = _mm512_setzero_si512();
  __m512i any = squares;
  for (int i = 0; i < 3; ++i) {
    half.word[i] = _mm512_cvtepu16_epi32(
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(request.normal[i] + at)));
    half.magnitude[i] = _mm512_and_si512(half.word[i], mask);
    any = _mm512_or_si512(any, half.magnitude[i]);
    // m (m + 1): the upper 16 bits of both are 0.
    squares = _mm512_add_epi32(squares,
                               _mm512_madd_epi16(half.magnitude[i], _mm512_add_epi32(half.magnitude[i], one)));
  }
  half.zero = _mm512_testn_epi32_mask(any, any);
  half.is_short = static_cast<__mmask16>(_mm512_cmplt_epu32_mask(squares, all_32(request.short_limit)) & ~half.zero);
  const __m512i address = _mm512_srl_epi32(squares, _mm_cvtsi32_si128(static_cast<int>(request.root_shift)));
  half.root = _mm512_and_si512(_mm512_i32gather_epi32(address, request.root, 2), all_32(0xFFFF));
  return half;
}

inline __m512i dot(const ShadeRequest& request, const ShadeLight& light, int k, const Normals& normals) {
  __m512i sum = _mm512_setzero_si512();
  for (int i = 0; i < 3; ++i) {
    const __m512i entry = _mm512_mulhi_epu16(normals.component[i], all_16(light.word[k][i]));
    const __m512i flip = _mm512_xor_si512(normals.sign[i], all_16(light.flip[k][i]));
    sum = _mm512_add_epi16(sum, _mm512_xor_si512(entry, flip));
  }
  sum = _mm512_add_epi16(_mm512_add_epi16(sum, sum), all_16(3));
  sum = _mm512_min_epi16(_mm512_max_epi16(sum, _mm512_setzero_si512()), all_16(request.full_scale));
  return _mm512_srl_epi16(sum, _mm_cvtsi32_si128(static_cast<int>(request.index_shift)));
}

struct Levels {
  __m512i sum;
  __mmask16 saturated;
};

inline void add(Levels& levels, __m512i more, __mmask16 where) {
  const __m512i wide = _mm512_add_epi8(levels.sum, more);
  const __m512i sum = _mm512_adds_epu8(levels.sum, more);
  levels.saturated |= _mm512_mask_cmpneq_epi32_mask(where, wide, sum);
  levels.sum = _mm512_mask_mov_epi32(levels.sum, where, sum);
}

inline void store(std::uint8_t* rgb, __m512i levels, std::size_t pixels) {
  const __m512i bytes = _mm512_set_epi8(  // of four bytes a pixel the first three
      63, 59, 55, 51, 47, 43, 39, 35, 31, 27, 23, 19, 15, 11, 7, 3, 62, 61, 60, 58, 57, 56, 54, 53, 52, 50, 49, 48, 46,
      45, 44, 42, 41, 40, 38, 37, 36, 34, 33, 32, 30, 29, 28, 26, 25, 24, 22, 21, 20, 18, 17, 16, 14, 13, 12, 10, 9, 8,
      6, 5, 4, 2, 1, 0);
  const __m512i packed = _mm512_permutexvar_epi8(bytes, levels);
  if (pixels >= 16) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(rgb), _mm512_castsi512_si256(packed));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(rgb + 32), _mm512_extracti32x4_epi32(packed, 2));
  } else {
    _mm512_mask_storeu_epi8(rgb, (std::uint64_t{1} << (3 * pixels)) - 1, packed);
  }
}

struct Masks {
  __mmask16 seen[2];
};

inline void shade_block(const ShadeRequest& request, std::size_t x, const Masks& masks, ShadeTotals& totals) {
  const Half halves[2] = {half_of(request, x), half_of(request, x + 16)};
  Normals normals;
  const __m512i root = _mm512_packus_epi32(halves[0].root, halves[1].root);
  const __m512i sign_bit = all_16(static_cast<int>(1U << request.magnitude_bits));
  const __m128i product_lift = _mm_cvtsi32_si128(static_cast<int>(request.product_lift));
  const __m128i entry_lift = _mm_cvtsi32_si128(static_cast<int>(request.entry_lift));
  for (int i = 0; i < 3; ++i) {
    const __m512i word = _mm512_packus_epi32(halves[0].word[i], halves[1].word[i]);
    const __m512i magnitude = _mm512_andnot_si512(sign_bit, word);
    normals.sign[i] = _mm512_movm_epi16(_mm512_test_epi16_mask(word, sign_bit));
    const __m512i twice = _mm512_add_epi16(_mm512_add_epi16(magnitude, magnitude), all_16(1));
    const __m512i product = _mm512_mulhi_epu16(_mm512_sll_epi16(twice, product_lift), root);
    const __m512i n = _mm512_min_epu16(product, all_16(request.component_limit));
    normals.component[i] = _mm512_sll_epi16(_mm512_add_epi16(_mm512_add_epi16(n, n), all_16(1)), entry_lift);
  }
  __m512i base[2], ambient[2];
  Levels levels[2];
  const __m128i index_bits = _mm_cvtsi32_si128(static_cast<int>(request.index_bits));
  for (std::size_t h = 0; h < 2; ++h) {
    const __m512i material = _mm512_min_epu32(
        _mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(request.material + x + 16 * h))),
        all_32(request.last_material));
    base[h] = _mm512_sll_epi32(material, index_bits);
    ambient[h] = material;
    levels[h] = {_mm512_setzero_si512(), 0};
  }
  const __m512i zero = _mm512_setzero_si512();
  for (std::size_t l = 0; l < request.light_count; ++l) {
    const ShadeLight& light = request.lights[l];
    const __m512i diffuse = dot(request, light, 0, normals);
    const __m512i specular = dot(request, light, 1, normals);
    const __m512i d[2] = {_mm512_unpacklo_epi16(diffuse, zero), _mm512_unpackhi_epi16(diffuse, zero)};
    const __m512i s[2] = {_mm512_unpacklo_epi16(specular, zero), _mm512_unpackhi_epi16(specular, zero)};
    for (std::size_t h = 0; h < 2; ++h) {
      const __mmask16 seen = masks.seen[h];
      if (seen == 0) continue;
      const __m512i dl =
          _mm512_mask_i32gather_epi32(zero, seen, _mm512_add_epi32(base[h], d[h]), light.diffuse, 4);
      const __m512i sl =
          _mm512_mask_i32gather_epi32(zero, seen, _mm512_add_epi32(base[h], s[h]), light.specular, 4);
      add(levels[h], dl, seen);
      levels[h].saturated |= _mm512_test_epi32_mask(dl, all_32(0xFF000000U));
      add(levels[h], sl, seen);
    }
  }
  for (std::size_t h = 0; h < 2; ++h) {
    const __mmask16 seen = masks.seen[h];
    const auto dark = static_cast<__mmask16>(halves[h].zero & seen);
    if (dark != 0) {
      levels[h].sum = _mm512_mask_i32gather_epi32(levels[h].sum, dark, ambient[h], request.ambient, 4);
      levels[h].saturated &= static_cast<__mmask16>(~dark);
    }
    totals.pixels += static_cast<std::uint64_t>(__builtin_popcount(seen));
    totals.zero_normals += static_cast<std::uint64_t>(__builtin_popcount(dark));
    totals.short_normals += static_cast<std::uint64_t>(__builtin_popcount(halves[h].is_short & seen));
    totals.saturated_pixels += static_cast<std::uint64_t>(__builtin_popcount(levels[h].saturated & seen));
    const std::size_t at = x + 16 * h;
    if (at < request.count)
      store(request.rgb + 3 * at, _mm512_mask_mov_epi32(all_32(request.background), seen, levels[h].sum),
            request.count - at);
  }
}

ShadeTotals shade(const ShadeRequest& request) {
  ShadeTotals totals;
  const __m512i background = all_32(request.background);
  __m256i materials = _mm256_setzero_si256();
  for (std::size_t x = 0; x < request.count; x += kBlock) {
    Masks masks;
    for (std::size_t h = 0; h < 2; ++h) {
      const std::size_t at = x + 16 * h;
      const std::size_t left = at < request.count ? request.count - at : 0;
      const auto present = static_cast<__mmask16>(left >= 16 ? 0xFFFFU : (1U << left) - 1);
      const __m512i object = _mm512_loadu_si512(request.object + at);
      masks.seen[h] = _mm512_mask_test_epi32_mask(present, object, object);
    }
    const std::uint32_t seen = masks.seen[0] | static_cast<std::uint32_t>(masks.seen[1]) << 16;
    if (seen == 0) {
      store(request.rgb + 3 * x, background, request.count - x);
      if (x + 16 < request.count) store(request.rgb + 3 * (x + 16), background, request.count - x - 16);
      continue;
    }
    const __m256i material = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(request.material + x));
    materials = _mm256_max_epu8(materials, _mm256_maskz_mov_epi8(seen, material));
    shade_block(request, x, masks, totals);
  }
  alignas(32) std::uint8_t largest[32];
  _mm256_store_si256(reinterpret_cast<__m256i*>(largest), materials);
  for (const std::uint8_t material : largest)
    totals.largest_material = material > totals.largest_material ? material : totals.largest_material;
  return totals;
}

#else

// What the stages hand on, a block of pixels at a time.
struct Block {
  std::uint32_t magnitude[3][kBlock];
  std::uint32_t sign[3][kBlock];  // all ones where negative
  std::uint32_t squares[kBlock];
  std::uint32_t root[kBlock];
  std::uint32_t index[2][kBlock];
};

void normalise(const ShadeRequest& request, std::size_t x, Block& block) {
  const std::uint32_t mask = (1U << request.magnitude_bits) - 1;
  for (std::size_t k = 0; k < kBlock; ++k) block.squares[k] = 0;
  for (int i = 0; i < 3; ++i) {
    const std::uint16_t* word = request.normal[i] + x;
    for (std::size_t k = 0; k < kBlock; ++k) {
      const std::uint32_t m = word[k] & mask;
      block.magnitude[i][k] = m;
      block.sign[i][k] = 0U - ((word[k] >> request.magnitude_bits) & 1U);
      block.squares[k] += m * (m + 1);
    }
  }
  for (std::size_t k = 0; k < kBlock; ++k) block.root[k] = request.root[block.squares[k] >> request.root_shift];
  const std::uint32_t limit = request.component_limit;
  for (auto& component : block.magnitude)
    for (std::size_t k = 0; k < kBlock; ++k) {
      const std::uint32_t n = (((2 * component[k] + 1) << request.product_lift) * block.root[k]) >> 16;
      component[k] = (2 * (n < limit ? n : limit) + 1) << request.entry_lift;
    }
}

void dot(const ShadeRequest& request, const ShadeLight& light, int which, Block& block) {
  const std::int32_t full = request.full_scale;
  for (std::size_t k = 0; k < kBlock; ++k) {
    std::int32_t sum = 0;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t entry = (block.magnitude[i][k] * light.word[which][i]) >> 16;
      const std::uint32_t flip = light.flip[which][i] != 0 ? ~0U : 0U;
      sum += static_cast<std::int32_t>(entry ^ block.sign[i][k] ^ flip);
    }
    sum = 2 * sum + 3;
    sum = sum < 0 ? 0 : sum;
    block.index[which][k] = static_cast<std::uint32_t>(sum < full ? sum : full) >> request.index_shift;
  }
}

// Four bytes a word, added apart; the highest of the result is not 0 where one of the others saturates.
inline std::uint32_t add(std::uint32_t levels, std::uint32_t more) {
  std::uint32_t result = 0;
  for (unsigned shift = 0; shift < 24; shift += 8) {
    const std::uint32_t sum = ((levels >> shift) & 0xFFU) + ((more >> shift) & 0xFFU);
    result |= (sum < 255 ? sum : 255) << shift;
    result |= sum > 255 ? 1U << 24 : 0U;
  }
  return result | ((levels | more) & 0xFF000000U);
}

ShadeTotals shade(const ShadeRequest& request) {
  ShadeTotals totals;
  Block block;
  std::uint32_t levels[kBlock];
  std::uint8_t dark[kBlock];
  for (std::size_t x = 0; x < request.count; x += kBlock) {
    const std::size_t count = request.count - x < kBlock ? request.count - x : kBlock;
    const std::uint32_t* object = request.object + x;
    const std::uint8_t* material = request.material + x;
    normalise(request, x, block);
    const std::uint32_t mask = (1U << request.magnitude_bits) - 1;
    for (std::size_t k = 0; k < count; ++k) {
      levels[k] = 0;
      const std::uint32_t any =
          (request.normal[0][x + k] | request.normal[1][x + k] | request.normal[2][x + k]) & mask;
      dark[k] = any == 0;
    }
    for (std::size_t l = 0; l < request.light_count; ++l) {
      const ShadeLight& light = request.lights[l];
      dot(request, light, 0, block);
      dot(request, light, 1, block);
      for (std::size_t k = 0; k < count; ++k) {
        if (object[k] == 0) continue;
        const std::uint32_t m = material[k] < request.last_material ? material[k] : request.last_material;
        const std::uint32_t base = m << request.index_bits;
        levels[k] = add(add(levels[k], light.diffuse[base + block.index[0][k]]),
                        light.specular[base + block.index[1][k]]);
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      std::uint32_t out = request.background;
      if (object[k] != 0) {
        const std::uint32_t m = material[k] < request.last_material ? material[k] : request.last_material;
        totals.largest_material = material[k] > totals.largest_material ? material[k] : totals.largest_material;
        out = dark[k] != 0 ? request.ambient[m] : levels[k];
        totals.pixels += 1;
        totals.zero_normals += dark[k];
        totals.short_normals += dark[k] == 0 && block.squares[k] < request.short_limit ? 1 : 0;
        totals.saturated_pixels += out >> 24 != 0 ? 1 : 0;
      }
      for (std::size_t c = 0; c < 3; ++c) request.rgb[3 * (x + k) + c] = static_cast<std::uint8_t>(out >> (8 * c));
    }
  }
  return totals;
}

#endif

}  // namespace

ShadeTotals RASTERTLM_KERNEL(const ShadeRequest& request);
ShadeTotals RASTERTLM_KERNEL(const ShadeRequest& request) { return shade(request); }

}  // namespace rastertlm::shading
