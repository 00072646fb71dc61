# Packages for Debian: `cpack -G DEB` in a build folder makes one per component. Configure with
# -DCMAKE_INSTALL_PREFIX=/usr, so that libraries go where Debian has them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "mesher maintainers <maintainers@mesher.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime library development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME mesher)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
"The program: opens triangle meshes, repairs defects and reports each repair.
Simplifies, subdivides and compares meshes and makes progressive meshes, in a
window and on the command line.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libmesher${soversion})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"The shared library: loads, repairs, simplifies, subdivides, compares and
renders triangle meshes.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmesher-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"The files for development: headers, the static library, and what CMake and
pkg-config need.")
# The packages after the first are those of the static library, and of pkg-config's Requires.private.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libmesher${soversion} (= ${PROJECT_VERSION}), libdraco-dev, libfmt-dev, libmeshoptimizer-dev, \
libspng-dev, libtbb-dev, libturbojpeg0-dev, libvulkan-dev, libwebp-dev, pkgconf | pkg-config, \
zlib1g-dev")

install(FILES LICENSE RENAME copyright COMPONENT runtime DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/mesher)
install(FILES CHANGELOG.md COMPONENT runtime DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/mesher)
install(FILES LICENSE RENAME copyright COMPONENT library
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libmesher${soversion})
install(FILES LICENSE RENAME copyright COMPONENT development
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libmesher-dev)
install(DIRECTORY docs/examples COMPONENT development
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libmesher-dev)
include(CPack)
