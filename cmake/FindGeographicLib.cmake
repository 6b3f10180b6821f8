# Finds GeographicLib::GeographicLib. Debian's libgeographiclib-dev carries no CMake package, only a find module
# outside CMake's path; upstream installs a package. This finds either, and is installed beside geoloc's own
# package.
find_package(GeographicLib CONFIG QUIET)
if(NOT TARGET GeographicLib::GeographicLib)
  find_path(GeographicLib_INCLUDE_DIR GeographicLib/LocalCartesian.hpp)
  find_library(GeographicLib_LIBRARY NAMES GeographicLib Geographic)
  include(FindPackageHandleStandardArgs)
  find_package_handle_standard_args(GeographicLib REQUIRED_VARS GeographicLib_LIBRARY GeographicLib_INCLUDE_DIR)
  if(GeographicLib_FOUND)
    add_library(GeographicLib::GeographicLib UNKNOWN IMPORTED)
    set_target_properties(GeographicLib::GeographicLib PROPERTIES
      IMPORTED_LOCATION "${GeographicLib_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${GeographicLib_INCLUDE_DIR}")
  endif()
endif()
