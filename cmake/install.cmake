# `cmake --install`: the libraries, their headers, the command line tool and the package files, so
# that find_package(blum) works from outside (proofs_tests/consumer does it).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/blum)

get_property(modules GLOBAL PROPERTY BLUM_MODULES)
foreach(module IN LISTS modules)
  install(TARGETS blum_${module} EXPORT blum_targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${module}/include/
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.hpp)
endforeach()
install(TARGETS blum_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET blum_vdb)
  install(TARGETS blum_vdb LIBRARY DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(EXPORT blum_targets NAMESPACE blum:: FILE blum_targets.cmake DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/blum-config.cmake.in
                              ${PROJECT_BINARY_DIR}/blum-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/blum-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/blum-config.cmake
              ${PROJECT_BINARY_DIR}/blum-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindFlintArb.cmake
        DESTINATION ${package_dir})
