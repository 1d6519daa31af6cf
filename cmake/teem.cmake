# blum_teem, if Teem is there: `blum field` reads voxel images (NRRD) by it, nothing else needs it.
# By its names alone: its own configuration file names a path that Debian's package does not have.
find_path(BLUM_TEEM_HEADER teem/nrrd.h)
find_library(BLUM_TEEM teem)
mark_as_advanced(BLUM_TEEM_HEADER BLUM_TEEM)
if(BLUM_TEEM_HEADER AND BLUM_TEEM AND NOT TARGET blum_teem)
  add_library(blum_teem INTERFACE)
  target_include_directories(blum_teem SYSTEM INTERFACE ${BLUM_TEEM_HEADER})
  target_link_libraries(blum_teem INTERFACE ${BLUM_TEEM})
endif()
