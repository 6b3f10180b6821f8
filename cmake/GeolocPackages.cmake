# Debian packages of the library, which `cpack -G DEB` in the build folder makes: libgeoloc0 has the shared library for C, libgeoloc-dev
# all that one compiles with. Configure with -DCMAKE_INSTALL_PREFIX=/usr for Debian's folders.
set(GEOLOC_PACKAGE_CONTACT "geoloc maintainers <maintainers@geoloc.invalid>" CACHE STRING "Maintainer that packages name")

set(CPACK_PACKAGE_NAME geoloc)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "${GEOLOC_PACKAGE_CONTACT}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL lib dev)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(_lib_package "libgeoloc${PROJECT_VERSION_MAJOR}")
set(CPACK_DEBIAN_LIB_PACKAGE_NAME "${_lib_package}")
set(CPACK_DEBIAN_LIB_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIB_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIB_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_COMPONENT_LIB_DESCRIPTION "${PROJECT_DESCRIPTION}: the library for C")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libgeoloc-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${_lib_package} (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.3), libgeographiclib-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION "${PROJECT_DESCRIPTION}: headers, the static library for C++, CMake's and pkg-config's files")

foreach(_component IN ITEMS lib dev)
  string(TOUPPER "${_component}" _upper)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" RENAME copyright
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${_upper}_PACKAGE_NAME}" COMPONENT ${_component})
endforeach()
include(CPack)
