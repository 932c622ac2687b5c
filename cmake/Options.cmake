# Language, warnings and sanitizers: the same for every target.
option(RASTERTLM_TESTS "Build the tests" ON)
set(RASTERTLM_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize= (address,undefined or thread)")
set(RASTERTLM_SANITIZE_WITHOUT "" CACHE STRING "Checks of these sanitizers to leave out, as for -fno-sanitize=")
option(RASTERTLM_FUZZ "Build the targets of tests/fuzz for libFuzzer (clang)" OFF)
option(RASTERTLM_COVERAGE "Instrument for gcov" OFF)
option(RASTERTLM_CCACHE "Compile through ccache where it is installed" ON)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

add_library(rastertlm_options INTERFACE)
# Contraction would let a picture depend on -march: products and sums are rounded apart, everywhere.
# Warnings are GCC's task: clang's own, of which SystemC's headers raise some in C++20, are no errors.
target_compile_options(rastertlm_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion $<$<CXX_COMPILER_ID:GNU>:-Werror> -ffp-contract=off)
target_include_directories(rastertlm_options INTERFACE "${CMAKE_SOURCE_DIR}")
if(RASTERTLM_SANITIZE)
  target_compile_options(rastertlm_options INTERFACE -fsanitize=${RASTERTLM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(rastertlm_options INTERFACE -fsanitize=${RASTERTLM_SANITIZE})
endif()
if(RASTERTLM_SANITIZE)
  # GCC 12 sees writes beyond strings in instrumented code that are not there; the other builds have these warnings as errors.
  target_compile_options(rastertlm_options INTERFACE -Wno-error)
endif()
if(RASTERTLM_SANITIZE AND RASTERTLM_SANITIZE_WITHOUT)
  target_compile_options(rastertlm_options INTERFACE -fno-sanitize=${RASTERTLM_SANITIZE_WITHOUT})
endif()
if(RASTERTLM_COVERAGE)
  target_compile_options(rastertlm_options INTERFACE --coverage)
  target_link_options(rastertlm_options INTERFACE --coverage)
endif()

# ccache takes a file with a precompiled header only if it may ignore the header's time stamps and macros, and if the compiler says
# in its preprocessed output which one it used.
if(RASTERTLM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(RASTERTLM_CCACHE_PROGRAM ccache)
  if(RASTERTLM_CCACHE_PROGRAM)
    set(CMAKE_CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${RASTERTLM_CCACHE_PROGRAM}")
    target_compile_options(rastertlm_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endif()

# What is called of libraries is found once, as a program starts: the processes of a sweep inherit it.
target_link_options(rastertlm_options INTERFACE -Wl,-z,now)

# Kernels that are compiled for several instruction sets and chosen at run time: what their sources may use.
# Square roots that set no errno are vectors as well. Aligned, a loop costs the same wherever the linker puts it.
set(RASTERTLM_BASELINE -fno-math-errno -falign-functions=64 -falign-loops=64)
set(RASTERTLM_AVX2 ${RASTERTLM_BASELINE} -mavx2 -mbmi -mbmi2 -mpopcnt)
set(RASTERTLM_AVX512 ${RASTERTLM_AVX2} -mavx512f -mavx512bw -mavx512vl -mavx512dq -mavx512cd -mavx512vbmi -mavx512vpopcntdq
  -mprefer-vector-width=512 -Wno-uninitialized -Wno-maybe-uninitialized)  # GCC 12 warns of its own intrinsics
