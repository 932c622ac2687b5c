#define PLAIN_VARIANT baseline
#include "tests/benchmark/plain_solids.inc"
