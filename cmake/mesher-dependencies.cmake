# The libraries that the engine links. The build includes this file, and so does the installed
# package for users of the static library.
set(mesher_packages fmt TBB ZLIB Vulkan draco meshoptimizer PkgConfig)

# After those packages.
macro(mesher_find_pkgconfig_modules)
  pkg_check_modules(SPNG REQUIRED QUIET IMPORTED_TARGET spng)
  pkg_check_modules(WEBP REQUIRED QUIET IMPORTED_TARGET libwebpmux libwebp)
  pkg_check_modules(TURBOJPEG REQUIRED QUIET IMPORTED_TARGET libturbojpeg)
endmacro()

# What every object of the engine may need, in the order of linking.
set(mesher_link_libraries
  PkgConfig::SPNG PkgConfig::WEBP PkgConfig::TURBOJPEG draco::draco meshoptimizer::meshoptimizer
  ZLIB::ZLIB fmt::fmt TBB::tbb Vulkan::Vulkan)
