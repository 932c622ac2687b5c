#define PLAIN_VARIANT avx2
#include "tests/benchmark/plain_solids.inc"
