# What must be installed. Each failure is one sentence that says what to do.
find_package(PkgConfig QUIET)
if(NOT PKG_CONFIG_FOUND)
  message(FATAL_ERROR "rastertlm needs pkg-config: run scripts/install_dependencies, or apt-get install pkg-config.")
endif()

function(rastertlm_pkg prefix package)
  pkg_check_modules(${prefix} QUIET IMPORTED_TARGET GLOBAL ${ARGN})
  if(NOT ${prefix}_FOUND)
    message(FATAL_ERROR "rastertlm needs ${package}: run scripts/install_dependencies, or apt-get install ${package}.")
  endif()
  set(${prefix}_FOUND TRUE PARENT_SCOPE)
endfunction()

macro(rastertlm_find target package)
  find_package(${ARGN} QUIET)
  if(NOT TARGET ${target})
    message(FATAL_ERROR "rastertlm needs ${package}: run scripts/install_dependencies, or apt-get install ${package}.")
  endif()
endmacro()

rastertlm_pkg(SYSTEMC libsystemc-dev systemc tlm)
rastertlm_pkg(OIIO libopenimageio-dev OpenImageIO)
rastertlm_find(glm::glm libglm-dev glm)
rastertlm_find(fmt::fmt libfmt-dev fmt)
rastertlm_find(CLI11::CLI11 libcli11-dev CLI11)
rastertlm_find(tomlplusplus::tomlplusplus libtomlplusplus-dev tomlplusplus)
rastertlm_find(nlohmann_json::nlohmann_json nlohmann-json3-dev nlohmann_json)
# By pkg-config: Debian's CMake package of assimp names libz.so, which comes with another -dev package that it does not depend on.
rastertlm_pkg(ASSIMP libassimp-dev assimp)
rastertlm_find(OpenSSL::Crypto libssl-dev OpenSSL)
# Debian's chart.js is a folder; its file is whole, with its licence line.
find_file(RASTERTLM_CHART_JS chart.min.js PATHS /usr/share/javascript/chart.js NO_DEFAULT_PATH)
if(NOT RASTERTLM_CHART_JS OR NOT EXISTS "${RASTERTLM_CHART_JS}")
  message(FATAL_ERROR "rastertlm needs libjs-chart.js: run scripts/install_dependencies, or apt-get install libjs-chart.js.")
endif()
if(RASTERTLM_TESTS)
  rastertlm_find(GTest::gtest libgtest-dev GTest)
  rastertlm_find(GTest::gmock libgmock-dev GTest)
  rastertlm_find(rapidcheck librapidcheck-dev rapidcheck)
endif()

# Debian's SystemC is compiled as C++17 and checks at link time that its users say so: C++20 sources define
# SC_CPLUSPLUS=201703L in every translation unit that sees SystemC.
add_library(rastertlm_systemc INTERFACE)
target_compile_definitions(rastertlm_systemc INTERFACE SC_CPLUSPLUS=201703L SC_INCLUDE_DYNAMIC_PROCESSES)
target_link_libraries(rastertlm_systemc INTERFACE PkgConfig::SYSTEMC)
get_target_property(systemc_includes PkgConfig::SYSTEMC INTERFACE_INCLUDE_DIRECTORIES)
if(systemc_includes)
  target_include_directories(rastertlm_systemc SYSTEM INTERFACE ${systemc_includes})
endif()

include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_DEFINITIONS -DSC_CPLUSPLUS=201703L)
set(CMAKE_REQUIRED_LIBRARIES PkgConfig::SYSTEMC)
check_cxx_source_compiles("#include <systemc>
int sc_main(int, char**) { return 0; }
int main(int argc, char** argv) { return sc_core::sc_elab_and_sim(argc, argv); }" RASTERTLM_SYSTEMC_LINKS)
unset(CMAKE_REQUIRED_DEFINITIONS)
unset(CMAKE_REQUIRED_LIBRARIES)
if(NOT RASTERTLM_SYSTEMC_LINKS)
  message(FATAL_ERROR "The installed SystemC does not link as C++17 (SC_CPLUSPLUS=201703L): install Debian 12's libsystemc-dev, or rebuild SystemC with CMAKE_CXX_STANDARD=17.")
endif()
