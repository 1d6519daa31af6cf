# blum_openvdb, if OpenVDB is there: for .vdb files and a benchmark, never needed. (The module that
# comes with it fails on Debian 12: it wants Boost's iostreams, which libopenvdb-dev does not bring.)
find_path(BLUM_OPENVDB_HEADER openvdb/openvdb.h)
find_library(BLUM_OPENVDB openvdb)
find_library(BLUM_TBB tbb)
find_path(BLUM_IMATH_HEADER half.h PATH_SUFFIXES Imath)
find_library(BLUM_IMATH NAMES Imath Imath-3_1)
mark_as_advanced(BLUM_OPENVDB_HEADER BLUM_OPENVDB BLUM_TBB BLUM_IMATH_HEADER BLUM_IMATH)
if(BLUM_OPENVDB_HEADER AND BLUM_OPENVDB AND BLUM_TBB AND BLUM_IMATH_HEADER AND BLUM_IMATH
   AND NOT TARGET blum_openvdb)
  add_library(blum_openvdb INTERFACE)
  target_include_directories(blum_openvdb SYSTEM INTERFACE ${BLUM_OPENVDB_HEADER}
                             ${BLUM_IMATH_HEADER})
  target_link_libraries(blum_openvdb INTERFACE ${BLUM_OPENVDB} ${BLUM_TBB} ${BLUM_IMATH})
endif()
