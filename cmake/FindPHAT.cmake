# PHAT, header-only persistent homology, used for Betti numbers.
find_path(PHAT_INCLUDE_DIR phat/boundary_matrix.h)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PHAT REQUIRED_VARS PHAT_INCLUDE_DIR)
if(PHAT_FOUND AND NOT TARGET blum_phat)
  add_library(blum_phat INTERFACE IMPORTED GLOBAL)
  target_include_directories(blum_phat SYSTEM INTERFACE ${PHAT_INCLUDE_DIR})
endif()
