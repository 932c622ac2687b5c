# Configure fails with one clear sentence. Run as: cmake -D SOURCE=.. -D WORK=.. -D CASE=.. [-D NAME=.. -D PACKAGE=..] -P configure_test.cmake
#   find_package        CMake's package NAME, of Debian's PACKAGE, is not found
#   pkg_config          pkg-config's module NAME, of Debian's PACKAGE, is not found
#   file                the file in the variable NAME, of Debian's PACKAGE, is not there
#   no_pkg_config       pkg-config itself is not found
#   systemc_standard    SystemC is found, but was compiled as C++20
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
set(environment)
set(arguments)
set(missing "rastertlm needs ${PACKAGE}: run scripts/install_dependencies, or apt-get install ${PACKAGE}.")
find_program(pkg_config NAMES pkg-config REQUIRED)

# A folder of pkg-config modules: all that the build asks for, but not `NAME`.
function(copy_modules_without name)
  foreach(module systemc tlm OpenImageIO assimp)
    if(NOT module STREQUAL name)
      execute_process(COMMAND ${pkg_config} --variable=pcfiledir ${module} OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE
        COMMAND_ERROR_IS_FATAL ANY)
      file(COPY "${folder}/${module}.pc" DESTINATION "${WORK}/modules")
    endif()
  endforeach()
endfunction()

# SystemC's own library under the same names, but for the symbol in which it says its C++ standard: as if it had been compiled as C++20.
function(make_systemc_of_another_standard)
  execute_process(COMMAND ${pkg_config} --variable=libarchdir systemc OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE)
  execute_process(COMMAND sed "s/cxx201703L/cxx202002L/g" "${folder}/libsystemc.so" OUTPUT_FILE "${WORK}/libsystemc.so"
    COMMAND_ERROR_IS_FATAL ANY)
  file(SHA256 "${folder}/libsystemc.so" before)
  file(SHA256 "${WORK}/libsystemc.so" after)
  if(before STREQUAL after)
    message(FATAL_ERROR "SystemC's library does not name the C++ standard as this test expects")
  endif()
  copy_modules_without("")
  file(READ "${WORK}/modules/systemc.pc" text)
  string(REGEX REPLACE "Libs: [^\n]*" "Libs: ${WORK}/libsystemc.so" text "${text}")
  file(WRITE "${WORK}/modules/systemc.pc" "${text}")
endfunction()

if(CASE STREQUAL "find_package")
  list(APPEND arguments -D CMAKE_DISABLE_FIND_PACKAGE_${NAME}=ON)
  set(sentence "${missing}")
elseif(CASE STREQUAL "pkg_config")
  copy_modules_without(${NAME})
  list(APPEND environment PKG_CONFIG_LIBDIR=${WORK}/modules)
  set(sentence "${missing}")
elseif(CASE STREQUAL "file")
  list(APPEND arguments -D ${NAME}=${WORK}/none)
  set(sentence "${missing}")
elseif(CASE STREQUAL "no_pkg_config")
  list(APPEND arguments -D PKG_CONFIG_EXECUTABLE=${WORK}/none)
  set(sentence "${missing}")
elseif(CASE STREQUAL "systemc_standard")
  make_systemc_of_another_standard()
  list(APPEND environment PKG_CONFIG_LIBDIR=${WORK}/modules)
  set(sentence "The installed SystemC does not link as C++17 (SC_CPLUSPLUS=201703L): install Debian 12's libsystemc-dev, or rebuild SystemC with CMAKE_CXX_STANDARD=17.")
else()
  message(FATAL_ERROR "unknown case '${CASE}'")
endif()

execute_process(
  COMMAND ${CMAKE_COMMAND} -E env ${environment} ${CMAKE_COMMAND} -S "${SOURCE}" -B "${WORK}/build" -G Ninja ${arguments}
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)

# CMake breaks long lines.
string(REGEX REPLACE "[ \n\t]+" " " words "${errors}")
string(FIND "${words}" "${sentence}" position)
string(REGEX MATCHALL "CMake Error" found "${words}")
list(LENGTH found count)
if(result EQUAL 0 OR position EQUAL -1 OR NOT count EQUAL 1)
  message(FATAL_ERROR "exit code ${result}, ${count} errors; expected the one sentence\n  ${sentence}\nbut got\n${output}${errors}")
endif()
file(REMOVE_RECURSE "${WORK}")
