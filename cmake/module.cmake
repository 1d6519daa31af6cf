# blum_add_module(NAME PUBLIC_DEPENDS a;b PRIVATE_DEPENDS c;d HEADER_ONLY e)
# One static library blum_NAME (alias and exported as blum::NAME) from NAME/src/*.cpp; only
# NAME/include is visible to others, so an include against the dependency direction does not
# compile. HEADER_ONLY targets are needed to build the library, not to link with it: the installed
# package does not mention them.
function(blum_add_module name)
  cmake_parse_arguments(ARG "" "" "PUBLIC_DEPENDS;PRIVATE_DEPENDS;HEADER_ONLY" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${name}/src/*.cpp)
  add_library(blum_${name} STATIC ${sources})
  add_library(blum::${name} ALIAS blum_${name})
  set_target_properties(blum_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(blum_${name} PUBLIC cxx_std_20)
  # Filters derive their bounds from IEEE operations one by one: no contraction into fma.
  target_compile_options(blum_${name} PRIVATE -Wall -Wextra -ffp-contract=off
                         $<$<BOOL:${BLUM_WARNINGS_AS_ERRORS}>:-Werror>)
  target_include_directories(blum_${name}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/${name}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/${name}/src)
  foreach(dep IN LISTS ARG_PUBLIC_DEPENDS)
    if(dep)
      target_link_libraries(blum_${name} PUBLIC blum_${dep})
    endif()
  endforeach()
  foreach(dep IN LISTS ARG_PRIVATE_DEPENDS)
    target_link_libraries(blum_${name} PRIVATE ${dep})
  endforeach()
  foreach(dep IN LISTS ARG_HEADER_ONLY)
    target_link_libraries(blum_${name} PRIVATE $<BUILD_INTERFACE:${dep}>)
  endforeach()
  set_property(GLOBAL APPEND PROPERTY BLUM_MODULES ${name})
endfunction()
