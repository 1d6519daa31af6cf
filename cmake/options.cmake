option(BLUM_BUILD_TESTS "Build the test suite" ON)
option(BLUM_BUILD_BENCH "Build the benchmarks" ON)
option(BLUM_BUILD_FUZZ "Build the fuzz targets with libFuzzer (needs clang 16)" OFF)
# blum-cgal-engine uses GPL packages of CGAL. Nothing links it, it is not installed, and where this
# is off nothing of CGAL is looked for.
find_path(BLUM_CGAL_HEADER CGAL/Arr_algebraic_segment_traits_2.h)
find_library(BLUM_MPFI mpfi)
mark_as_advanced(BLUM_CGAL_HEADER BLUM_MPFI)
if(BLUM_CGAL_HEADER AND BLUM_MPFI)
  set(cgal_is_here ON)
else()
  set(cgal_is_here OFF)
endif()
option(BLUM_CGAL_ORACLES "Build blum-cgal-engine (needs CGAL, with GPL packages, and MPFI)"
       ${cgal_is_here})
option(BLUM_WARNINGS_AS_ERRORS "Treat warnings as errors" OFF)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
list(APPEND CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR}/cmake)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(BLUM_CCACHE ccache)
if(BLUM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${BLUM_CCACHE})
endif()

if(BLUM_BUILD_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "BLUM_BUILD_FUZZ needs clang: cmake --preset fuzz")
  endif()
  # Everything is instrumented; the targets alone link libFuzzer's main.
  set(BLUM_FUZZ_FLAGS -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined)
  add_compile_options(${BLUM_FUZZ_FLAGS})
  add_link_options(-fsanitize=address,undefined)
endif()
