# BLUM_JEMALLOC, if it is there and no sanitizer wants malloc for itself: the tool is linked with it,
# the libraries are not. It takes about a tenth off the processor time of the tool.
option(BLUM_WITH_JEMALLOC "Link the tool with jemalloc where it is found" ON)
find_library(BLUM_JEMALLOC jemalloc)
mark_as_advanced(BLUM_JEMALLOC)
if(BLUM_WITH_JEMALLOC AND BLUM_JEMALLOC AND NOT TARGET blum_jemalloc)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
  if(NOT BLUM_BUILD_FUZZ AND NOT "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${config}}" MATCHES "-fsanitize")
    add_library(blum_jemalloc INTERFACE)
    target_link_libraries(blum_jemalloc INTERFACE ${BLUM_JEMALLOC})
  endif()
endif()
