option(BLUM_BUILD_TESTS "Build the test suite" ON)
option(BLUM_BUILD_BENCH "Build the benchmarks" ON)
# On by default where the tests are built and CGAL is there; off: nothing of CGAL is looked for.
find_package(CGAL QUIET)
option(BLUM_CGAL_ORACLES "Build blum-cgal-engine (needs CGAL's GPL packages)"
       "${CGAL_FOUND}")
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
