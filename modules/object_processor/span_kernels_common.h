// What the kernels of spans share. Included by span_kernels_body.h alone: compiled once for each instruction set.
#pragma once

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

#endif

}  // namespace
}  // namespace rastertlm::object_processor
