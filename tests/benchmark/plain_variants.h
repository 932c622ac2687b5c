// The plain loop as it was compiled for each instruction set.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/benchmark/plain_frame.inc"

namespace plain {

namespace baseline {
std::unique_ptr<Loop> make(std::vector<Triangle> triangles, const Tables& tables);
}
namespace avx2 {
std::unique_ptr<Loop> make(std::vector<Triangle> triangles, const Tables& tables);
}
namespace avx512 {
std::unique_ptr<Loop> make(std::vector<Triangle> triangles, const Tables& tables);
}

// "baseline", "avx2" or "avx512": the best that this processor has.
inline std::string best_variant() {
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
      __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vpopcntdq"))
    return "avx512";
  return __builtin_cpu_supports("avx2") ? "avx2" : "baseline";
}

inline std::unique_ptr<Loop> make(const std::string& variant, std::vector<Triangle> triangles, const Tables& tables) {
  if (variant == "avx512") return avx512::make(std::move(triangles), tables);
  if (variant == "avx2") return avx2::make(std::move(triangles), tables);
  return baseline::make(std::move(triangles), tables);
}

}  // namespace plain
