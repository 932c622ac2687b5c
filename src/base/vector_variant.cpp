#include "src/base/vector_variant.h"

#include <cstdlib>

#include "src/base/errors.h"

namespace rastertlm {

const char* name_of(VectorVariant variant) {
  switch (variant) {
    case VectorVariant::avx2:
      return "avx2";
    case VectorVariant::avx512:
      return "avx512";
    default:
      return "baseline";
  }
}

std::vector<VectorVariant> available_vector_variants() {
  std::vector<VectorVariant> available{VectorVariant::baseline};
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                    __builtin_cpu_supports("popcnt");
  if (!avx2) return available;
  available.push_back(VectorVariant::avx2);
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512vbmi") &&
                      __builtin_cpu_supports("avx512vpopcntdq");
  if (avx512) available.push_back(VectorVariant::avx512);
  return available;
}

VectorVariant vector_variant(const std::string& wanted) {
  const std::vector<VectorVariant> available = available_vector_variants();
  if (wanted.empty()) return available.back();
  std::string names;
  for (const VectorVariant variant : available) {
    if (wanted == name_of(variant)) return variant;
    names += (names.empty() ? "" : ", ") + std::string(name_of(variant));
  }
  throw InputError(Diagnostic{"", 0, "RASTERTLM_VECTOR", "is \"" + wanted + "\"; this processor has: " + names});
}

VectorVariant vector_variant() {
  const char* wanted = std::getenv("RASTERTLM_VECTOR");
  static const VectorVariant variant = vector_variant(std::string(wanted != nullptr ? wanted : ""));
  return variant;
}

}  // namespace rastertlm
