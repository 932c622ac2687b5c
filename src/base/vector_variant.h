// Which instruction set the vector kernels use. Every variant gives the same words; only time differs.
#pragma once

#include <string>
#include <vector>

namespace rastertlm {

// baseline: any x86-64. avx512: F, BW, VL, DQ, CD, VBMI and VPOPCNTDQ.
enum class VectorVariant { baseline, avx2, avx512 };

const char* name_of(VectorVariant variant);

// Those that this processor has, the best last.
std::vector<VectorVariant> available_vector_variants();

// The variant of this process: what the environment variable RASTERTLM_VECTOR names, or the best that the processor
// has. Throws InputError where the variable names none that it has.
VectorVariant vector_variant();

// What RASTERTLM_VECTOR would choose with that value; empty: the best.
VectorVariant vector_variant(const std::string& wanted);

}  // namespace rastertlm
