# FLINT (fmpz, fmpq polynomials) and Arb (ball arithmetic), as Debian packages them.
# The installed package reuses this file, so the imported target is made here.
find_path(FLINT_INCLUDE_DIR flint/fmpz.h)
find_library(FLINT_LIBRARY flint)
find_path(ARB_INCLUDE_DIR arb.h)
find_library(ARB_LIBRARY NAMES flint-arb arb)
find_library(GMP_LIBRARY gmp)
find_library(MPFR_LIBRARY NAMES mpfr libmpfr.so.6)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FlintArb REQUIRED_VARS FLINT_INCLUDE_DIR FLINT_LIBRARY
                                  ARB_INCLUDE_DIR ARB_LIBRARY GMP_LIBRARY)
if(FlintArb_FOUND AND NOT TARGET blum_flint_arb)
  add_library(blum_flint_arb INTERFACE IMPORTED GLOBAL)
  target_include_directories(blum_flint_arb SYSTEM INTERFACE ${FLINT_INCLUDE_DIR}
                             ${FLINT_INCLUDE_DIR}/flint ${ARB_INCLUDE_DIR})
  target_link_libraries(blum_flint_arb INTERFACE ${ARB_LIBRARY} ${FLINT_LIBRARY} ${GMP_LIBRARY})
endif()
