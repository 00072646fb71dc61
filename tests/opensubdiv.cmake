# The target opensubdiv_cpu: Debian's OpenSubdivConfig.cmake names static libraries that the package
# does not hold, and fails.
find_path(OPENSUBDIV_INCLUDE_DIR opensubdiv/far/topologyRefiner.h)
find_library(OPENSUBDIV_LIBRARY osdCPU)
if(NOT OPENSUBDIV_INCLUDE_DIR OR NOT OPENSUBDIV_LIBRARY)
  message(FATAL_ERROR "Tests and benchmarks of subdivision need OpenSubdiv (Debian: libosd-dev)")
endif()
add_library(opensubdiv_cpu UNKNOWN IMPORTED)
set_target_properties(opensubdiv_cpu PROPERTIES
  IMPORTED_LOCATION ${OPENSUBDIV_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${OPENSUBDIV_INCLUDE_DIR})
