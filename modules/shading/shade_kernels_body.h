// The kernels themselves, compiled once for each instruction set into the table that RASTERTLM_KERNELS names. Where
// there is no AVX-512 the compiler's own vectors are used.
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
inline __m128i count_of(unsigned shift) { return _mm_cvtsi32_si128(static_cast<int>(shift)); }

// 16-bit lanes a pixel. Wider ones are in two vectors as unpacking leaves them, and packing puts them back in order.
struct Pair {
  __m512i low;
  __m512i high;
};
inline Pair widened(__m512i words) {
  const __m512i zero = _mm512_setzero_si512();
  return {_mm512_unpacklo_epi16(words, zero), _mm512_unpackhi_epi16(words, zero)};
}

// One step of Newton's from the processor's estimate: near enough to be right at all but a few addresses.
inline __m512i root_of(const RootArithmetic& arithmetic, __m512i address) {
  const __m512 value = _mm512_add_ps(_mm512_cvtepi32_ps(address), _mm512_set1_ps(0.5F));
  const __m512 estimate = _mm512_rsqrt14_ps(value);
  const __m512 square = _mm512_mul_ps(_mm512_mul_ps(value, estimate), estimate);
  const __m512 factor =
      _mm512_fnmadd_ps(square, _mm512_set1_ps(0.5F * arithmetic.scale), _mm512_set1_ps(1.5F * arithmetic.scale));
  return _mm512_min_epu32(_mm512_cvtps_epi32(_mm512_mul_ps(estimate, factor)), all_32(arithmetic.limit));
}

inline __m512i root_at(const ShadeRequest& request, __m512i address) {
  if (!request.roots.usable) return _mm512_and_si512(_mm512_i32gather_epi32(address, request.root, 2), all_32(0xFFFF));
  __m512i root = root_of(request.roots, address);
  for (std::uint32_t i = 0; i < request.roots.exceptions; ++i)
    root = _mm512_mask_mov_epi32(root, _mm512_cmpeq_epi32_mask(address, all_32(request.roots.address[i])),
                                 all_32(request.roots.root[i]));
  return root;
}

struct Normals {
  __m512i component[3];  // 2 n + 1, lifted
  __m512i sign[3];       // all ones where negative
  __mmask32 zero;
  __mmask32 is_short;
};

inline Normals normalise(const ShadeRequest& request, std::size_t x) {
  Normals normals;
  const __m512i sign_bit = all_16(static_cast<int>(1U << request.magnitude_bits));
  const __m512i one = all_16(1);
  __m512i magnitude[3];
  __m512i any = _mm512_setzero_si512();
  Pair squares{any, any};
  for (int i = 0; i < 3; ++i) {
    const __m512i word = _mm512_loadu_si512(request.normal[i] + x);
    normals.sign[i] = _mm512_movm_epi16(_mm512_test_epi16_mask(word, sign_bit));
    magnitude[i] = _mm512_and_si512(word, _mm512_sub_epi16(sign_bit, one));
    any = _mm512_or_si512(any, magnitude[i]);
    const __m512i more = _mm512_add_epi16(magnitude[i], one);  // m (m + 1)
    const __m512i low = _mm512_mullo_epi16(magnitude[i], more);
    const __m512i high = _mm512_mulhi_epu16(magnitude[i], more);
    squares.low = _mm512_add_epi32(squares.low, _mm512_unpacklo_epi16(low, high));
    squares.high = _mm512_add_epi32(squares.high, _mm512_unpackhi_epi16(low, high));
  }
  normals.zero = _mm512_testn_epi16_mask(any, any);
  const __m128i shift = count_of(request.root_shift);
  const Pair address{_mm512_srl_epi32(squares.low, shift), _mm512_srl_epi32(squares.high, shift)};
  normals.is_short = _mm512_cmplt_epu16_mask(_mm512_packus_epi32(address.low, address.high),
                                             all_16(static_cast<int>(request.short_address))) &
                     ~normals.zero;
  const __m512i root = _mm512_packus_epi32(root_at(request, address.low), root_at(request, address.high));
  // (2 m + 1) << lift
  const __m128i product_lift = count_of(request.product_lift + 1);
  const __m128i entry_lift = count_of(request.entry_lift + 1);
  const __m512i product_half = all_16(1 << request.product_lift);
  const __m512i entry_half = all_16(1 << request.entry_lift);
  for (int i = 0; i < 3; ++i) {
    const __m512i twice = _mm512_add_epi16(_mm512_sll_epi16(magnitude[i], product_lift), product_half);
    const __m512i n = _mm512_min_epu16(_mm512_mulhi_epu16(twice, root), all_16(request.component_limit));
    normals.component[i] = _mm512_add_epi16(_mm512_sll_epi16(n, entry_lift), entry_half);
  }
  return normals;
}

inline __m512i dot(const ShadeRequest& request, const ShadeLight& light, int k, const Normals& normals) {
  __m512i sum = all_16(1);  // (2 sum + 3) >> shift is (sum + 1) >> (shift - 1)
  for (int i = 0; i < 3; ++i) {
    const __m512i entry = _mm512_mulhi_epu16(normals.component[i], all_16(light.word[k][i]));
    constexpr int kExclusiveOr = 0x96;  // of three
    sum = _mm512_add_epi16(sum,
                           _mm512_ternarylogic_epi32(entry, normals.sign[i], all_16(light.flip[k][i]), kExclusiveOr));
  }
  const __m512i index = _mm512_sra_epi16(sum, count_of(request.index_shift - 1));
  return _mm512_min_epi16(_mm512_max_epi16(index, _mm512_setzero_si512()),
                          all_16(request.full_scale >> request.index_shift));
}

inline __m512i by_material(const std::uint16_t* words, __m512i material) {
  return _mm512_permutexvar_epi16(material, _mm512_loadu_si512(words));
}

inline __m512i looked_up(const std::uint8_t* table, __m512i address, __mmask32 where) {
  const Pair wide = widened(address);
  const Pair there = widened(_mm512_maskz_mov_epi16(where, all_16(-1)));
  const __m512i zero = _mm512_setzero_si512();
  const __mmask16 low = _mm512_test_epi32_mask(there.low, there.low);
  const __mmask16 high = _mm512_test_epi32_mask(there.high, there.high);
  const __m512i levels = _mm512_packus_epi32(
      low != 0 ? _mm512_and_si512(_mm512_mask_i32gather_epi32(zero, low, wide.low, table, 1), all_32(0xFF)) : zero,
      high != 0 ? _mm512_and_si512(_mm512_mask_i32gather_epi32(zero, high, wide.high, table, 1), all_32(0xFF)) : zero);
  return levels;
}

inline void add_light(const ShadeRequest& request, const ShadeLight& light, const Normals& normals, __m512i material,
                      __mmask32 lit, __m512i (&sum)[3]) {
  const __m512i diffuse = dot(request, light, 0, normals);
  const __m512i specular = dot(request, light, 1, normals);
  const __m512i ramp = _mm512_add_epi16(_mm512_sll_epi16(diffuse, count_of(request.diffuse_lift + 1)),
                                        all_16(1 << request.diffuse_lift));
  for (int c = 0; c < 3; ++c) {
    const __m512i level = _mm512_mulhrs_epi16(ramp, by_material(light.diffuse[c], material));
    sum[c] = _mm512_mask_add_epi16(sum[c], lit, sum[c], level);
  }
  const __mmask32 shines = _mm512_mask_cmpge_epu16_mask(lit, specular, by_material(light.first_shining, material));
  if (shines == 0) return;
  const __m512i address = _mm512_add_epi16(_mm512_sll_epi16(material, count_of(request.index_bits)), specular);
  __m512i level = looked_up(light.specular[0], address, shines);
  for (int c = 0; c < 3; ++c) {
    if (c > 0 && light.specular[c] != light.specular[0]) level = looked_up(light.specular[c], address, shines);
    sum[c] = _mm512_add_epi16(sum[c], level);
  }
}

// Three 8-bit levels a pixel from 16-bit lanes.
inline void store(std::uint8_t* rgb, const __m512i (&levels)[3], std::size_t pixels) {
  alignas(64) static constexpr std::uint8_t kFirst[64] = {
      0,  1,  64, 2,  3,  66, 4,  5,  68, 6,  7,  70, 8,   9,  72, 10,  11, 74, 12,  13, 76, 14,
      15, 78, 16, 17, 80, 18, 19, 82, 20, 21, 84, 22, 23,  86, 24, 25,  88, 26, 27,  90, 28, 29,
      92, 30, 31, 94, 32, 33, 96, 34, 35, 98, 36, 37, 100, 38, 39, 102, 40, 41, 104, 42};
  alignas(64) static constexpr std::uint8_t kSecond[64] = {43,  106, 44,  45,  108, 46,  47,  110, 48,  49, 112,
                                                           50,  51,  114, 52,  53,  116, 54,  55,  118, 56, 57,
                                                           120, 58,  59,  122, 60,  61,  124, 62,  63,  126};
  const __m512i red_green = _mm512_or_si512(levels[0], _mm512_slli_epi16(levels[1], 8));
  const __m512i first = _mm512_permutex2var_epi8(red_green, _mm512_load_si512(kFirst), levels[2]);
  const __m512i second = _mm512_permutex2var_epi8(red_green, _mm512_load_si512(kSecond), levels[2]);
  if (pixels >= kBlock) {
    _mm512_storeu_si512(rgb, first);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(rgb + 64), _mm512_castsi512_si256(second));
    return;
  }
  const std::size_t bytes = 3 * pixels;
  const std::uint64_t in_first = bytes >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bytes) - 1;
  const std::uint64_t in_second = bytes <= 64 ? 0 : (std::uint64_t{1} << (bytes - 64)) - 1;
  _mm512_mask_storeu_epi8(rgb, in_first, first);
  _mm512_mask_storeu_epi8(rgb + 64, in_second, second);
}

inline std::uint64_t bits_of(__mmask32 mask) { return static_cast<std::uint64_t>(__builtin_popcount(mask)); }

inline void shade_block(const ShadeRequest& request, const ShadeLight& first_light, std::size_t x, __mmask32 seen,
                        __m512i material, ShadeTotals& totals) {
  const Normals normals = normalise(request, x);
  const __mmask32 lit = seen & ~normals.zero;
  __m512i sum[3];
  for (int c = 0; c < 3; ++c) sum[c] = by_material(request.ambient[c], material);
  add_light(request, first_light, normals, material, lit, sum);
  for (std::size_t l = 1; l < request.light_count; ++l)
    add_light(request, request.lights[l], normals, material, lit, sum);
  const __m512i full = all_16(255);
  const __mmask32 saturated = _mm512_cmpgt_epu16_mask(_mm512_max_epu16(_mm512_max_epu16(sum[0], sum[1]), sum[2]), full);
  __m512i levels[3];
  for (int c = 0; c < 3; ++c) {
    levels[c] = _mm512_mask_min_epu16(all_16(request.background[c]), seen, sum[c], full);
  }
  totals.pixels += bits_of(seen);
  if (((normals.zero | normals.is_short | saturated) & seen) != 0) {
    totals.zero_normals += bits_of(normals.zero & seen);
    totals.short_normals += bits_of(normals.is_short & seen);
    totals.saturated_pixels += bits_of(saturated & seen);
  }
  store(request.rgb + 3 * x, levels, request.count - x);
}

ShadeTotals shade(const ShadeRequest& given) {
  // Copies that nothing points to: what is stored cannot change them, so they stay in registers.
  const ShadeRequest request = given;
  const ShadeLight first_light = request.lights[0];
  ShadeTotals totals;
  const __m512i background[3] = {all_16(request.background[0]), all_16(request.background[1]),
                                 all_16(request.background[2])};
  const __m512i last_material = all_16(static_cast<int>(request.last_material));
  __m512i largest = _mm512_setzero_si512();
  for (std::size_t x = 0; x < request.count; x += kBlock) {
    const std::size_t left = request.count - x;
    const __mmask32 present = left >= kBlock ? ~__mmask32{0} : (__mmask32{1} << left) - 1;
    const __m512i low = _mm512_loadu_si512(request.object + x);
    const __m512i high = _mm512_loadu_si512(request.object + x + 16);
    const __mmask32 seen =
        (_mm512_test_epi32_mask(low, low) | static_cast<__mmask32>(_mm512_test_epi32_mask(high, high)) << 16) & present;
    if (seen == 0) {
      store(request.rgb + 3 * x, background, left);
      continue;
    }
    const __m512i material =
        _mm512_cvtepu8_epi16(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(request.material + x)));
    largest = _mm512_mask_max_epu16(largest, seen, largest, material);
    shade_block(request, first_light, x, seen, _mm512_min_epu16(material, last_material), totals);
  }
  alignas(64) std::uint16_t materials[32];
  _mm512_store_si512(materials, largest);
  for (const std::uint16_t material : materials)
    totals.largest_material = material > totals.largest_material ? material : totals.largest_material;
  return totals;
}

void roots(const RootArithmetic& arithmetic, std::uint32_t count, std::uint32_t* out) {
  const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  for (std::uint32_t first = 0; first < count; first += 16)
    _mm512_storeu_si512(out + first, root_of(arithmetic, _mm512_add_epi32(all_32(first), lanes)));
}

#else

// What the stages hand on, a block of pixels at a time.
struct Block {
  std::uint32_t component[3][kBlock];  // magnitude; then 2 n + 1, lifted
  std::uint32_t sign[3][kBlock];       // all ones where negative
  std::uint32_t squares[kBlock];
  std::uint32_t root[kBlock];
  std::uint32_t any[kBlock];  // 0 where the normal is zero
  std::uint32_t material[kBlock];
  std::uint32_t index[2][kBlock];
  std::uint32_t sum[3][kBlock];
};

void normalise(const ShadeRequest& request, std::size_t x, Block& block) {
  const std::uint32_t mask = (1U << request.magnitude_bits) - 1;
  for (std::size_t k = 0; k < kBlock; ++k) block.squares[k] = block.any[k] = 0;
  for (int i = 0; i < 3; ++i) {
    const std::uint16_t* word = request.normal[i] + x;
    for (std::size_t k = 0; k < kBlock; ++k) {
      const std::uint32_t m = word[k] & mask;
      block.component[i][k] = m;
      block.any[k] |= m;
      block.sign[i][k] = 0U - ((word[k] >> request.magnitude_bits) & 1U);
      block.squares[k] += m * (m + 1);
    }
  }
  for (std::size_t k = 0; k < kBlock; ++k) block.root[k] = request.root[block.squares[k] >> request.root_shift];
  const std::uint32_t limit = request.component_limit;
  for (auto& component : block.component)
    for (std::size_t k = 0; k < kBlock; ++k) {
      const std::uint32_t n = (((2 * component[k] + 1) << request.product_lift) * block.root[k]) >> 16;
      component[k] = (2 * (n < limit ? n : limit) + 1) << request.entry_lift;
    }
}

void dot(const ShadeRequest& request, const ShadeLight& light, int which, Block& block) {
  const std::int32_t full = request.full_scale;
  std::uint32_t flip[3];
  for (int i = 0; i < 3; ++i) flip[i] = light.flip[which][i] != 0 ? ~0U : 0U;
  for (std::size_t k = 0; k < kBlock; ++k) {
    std::int32_t sum = 0;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t entry = (block.component[i][k] * light.word[which][i]) >> 16;
      sum += static_cast<std::int32_t>(entry ^ block.sign[i][k] ^ flip[i]);
    }
    sum = 2 * sum + 3;
    sum = sum < 0 ? 0 : sum;
    block.index[which][k] = static_cast<std::uint32_t>(sum < full ? sum : full) >> request.index_shift;
  }
}

void add_light(const ShadeRequest& request, const ShadeLight& light, Block& block) {
  dot(request, light, 0, block);
  dot(request, light, 1, block);
  for (int c = 0; c < 3; ++c) {
    const std::uint16_t* constants = light.diffuse[c];
    const std::uint8_t* specular = light.specular[c];
    for (std::size_t k = 0; k < kBlock; ++k) {
      const std::uint32_t m = block.material[k];
      const std::uint32_t ramp = (2 * block.index[0][k] + 1) << request.diffuse_lift;
      const std::uint32_t level =
          ((ramp * constants[m] + (1U << 14)) >> 15) + specular[(m << request.index_bits) + block.index[1][k]];
      block.sum[c][k] += block.any[k] != 0 ? level : 0;
    }
  }
}

// `count` pixels of the block.
void finish(const ShadeRequest& request, std::size_t x, std::size_t count, const Block& block, ShadeTotals& totals) {
  for (std::size_t k = 0; k < count; ++k) {
    std::uint8_t* rgb = request.rgb + 3 * (x + k);
    if (request.object[x + k] == 0) {
      for (int c = 0; c < 3; ++c) rgb[c] = static_cast<std::uint8_t>(request.background[c]);
      continue;
    }
    bool saturated = false;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t sum = block.sum[c][k];
      saturated = saturated || sum > 255;
      rgb[c] = static_cast<std::uint8_t>(sum < 255 ? sum : 255);
    }
    const std::uint32_t material = request.material[x + k];
    totals.largest_material = material > totals.largest_material ? material : totals.largest_material;
    totals.pixels += 1;
    totals.zero_normals += block.any[k] == 0 ? 1 : 0;
    totals.short_normals += block.any[k] != 0 && block.squares[k] >> request.root_shift < request.short_address ? 1 : 0;
    totals.saturated_pixels += saturated ? 1 : 0;
  }
}

ShadeTotals shade(const ShadeRequest& request) {
  ShadeTotals totals;
  Block block;
  for (std::size_t x = 0; x < request.count; x += kBlock) {
    const std::size_t count = request.count - x < kBlock ? request.count - x : kBlock;
    std::uint32_t seen = 0;
    for (std::size_t k = 0; k < count; ++k) seen |= request.object[x + k];
    if (seen != 0) {
      normalise(request, x, block);
      for (std::size_t k = 0; k < kBlock; ++k) {
        const std::uint32_t m = request.material[x + k];
        block.material[k] = m < request.last_material ? m : request.last_material;
        for (int c = 0; c < 3; ++c) block.sum[c][k] = request.ambient[c][block.material[k]];
      }
      for (std::size_t l = 0; l < request.light_count; ++l) add_light(request, request.lights[l], block);
    }
    finish(request, x, count, block, totals);
  }
  return totals;
}

constexpr void (*roots)(const RootArithmetic&, std::uint32_t, std::uint32_t*) = nullptr;

#endif

}  // namespace

extern const ShadeKernels RASTERTLM_KERNELS;
const ShadeKernels RASTERTLM_KERNELS{shade, roots};

}  // namespace rastertlm::shading
