# The libraries that the engine links.
set(mesher_packages fmt TBB ZLIB Vulkan draco meshoptimizer PkgConfig)

# After those packages.
macro(mesher_find_pkgconfig_modules)
  pkg_check_modules(SPNG REQUIRED QUIET IMPORTED_TARGET spng)
  pkg_check_modules(WEBP REQUIRED QUIET IMPORTED_TARGET libwebpmux libwebp)
  pkg_check_modules(TURBOJPEG REQUIRED QUIET IMPORTED_TARGET libturbojpeg)
endmacro()
