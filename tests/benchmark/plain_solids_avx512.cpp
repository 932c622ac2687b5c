#define PLAIN_VARIANT avx512
#include "tests/benchmark/plain_solids.inc"
