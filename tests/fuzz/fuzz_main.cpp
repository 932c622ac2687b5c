// libFuzzer with a main of our own: its own is in an archive, and libsystemc has one that would be taken instead.
#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerRunDriver(int* argc, char*** argv, int (*target)(const std::uint8_t*, std::size_t));

extern "C" int sc_main(int, char**) { return 0; }

int main(int argc, char** argv) { return LLVMFuzzerRunDriver(&argc, &argv, LLVMFuzzerTestOneInput); }
