# Debian packages, which `cpack -G DEB` in the build folder makes: libgeoloc0 has the shared library for C, libgeoloc-dev all that one
# compiles with, geoloc the programs, python3-geoloc the module for Debian's Python. Configure with -DCMAKE_INSTALL_PREFIX=/usr for Debian's folders; scripts/packages_deb.sh does.
set(GEOLOC_PACKAGE_CONTACT "geoloc maintainers <maintainers@geoloc.invalid>" CACHE STRING "Maintainer that packages name")

set(CPACK_PACKAGE_NAME geoloc)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "${GEOLOC_PACKAGE_CONTACT}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL lib dev)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

set(_debian "${PROJECT_SOURCE_DIR}/packaging/debian")
set(_lib_package "libgeoloc${PROJECT_VERSION_MAJOR}")
set(CPACK_DEBIAN_LIB_PACKAGE_NAME "${_lib_package}")
set(CPACK_DEBIAN_LIB_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIB_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIB_PACKAGE_CONTROL_EXTRA "${_debian}/triggers")
set(CPACK_COMPONENT_LIB_DESCRIPTION
  "The library for C, and for all languages that call C: telemetry and\ndetections in, objects with their uncertainty out.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libgeoloc-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${_lib_package} (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.3), libgeographiclib-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION
  "What one compiles with, in C++ and in C: headers, the static library for C++,\nand the files of CMake and pkg-config.")

# A package can only need what Debian has, so programs that use PyPI's OpenVINO go into none.
get_property(_libraries_elsewhere GLOBAL PROPERTY GEOLOC_INSTALL_RPATH)
if(TARGET geoloc_app AND TARGET geoloc_pages AND CMAKE_INSTALL_PREFIX STREQUAL "/usr" AND NOT _libraries_elsewhere)
  list(APPEND CPACK_COMPONENTS_ALL programs)
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME geoloc)
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
  # GStreamer loads these at run time: RTP, the parser of H.264, its decoder, video files, transport streams; and, to make video, x264.
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS
    "gstreamer1.0-plugins-base, gstreamer1.0-plugins-good, gstreamer1.0-plugins-bad, gstreamer1.0-libav")
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "gstreamer1.0-plugins-ugly")
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_CONTROL_EXTRA "${_debian}/postinst;${_debian}/postrm;${_debian}/conffiles")
  set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION
    "The programs: geoloc_app for live flights, others for recordings, pictures\nand simulation; with a detector, and flights to try them on.")
  install(FILES "${PROJECT_SOURCE_DIR}/packaging/options" DESTINATION /etc/geoloc COMPONENT programs)
  file(GLOB _doc_pages CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/docs/*.md")
  install(FILES ${_doc_pages} "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/geoloc" COMPONENT programs)
endif()

get_property(_python_version GLOBAL PROPERTY GEOLOC_PYTHON_VERSION)
if(_python_version)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-geoloc)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  string(REGEX REPLACE "^3\\." "" _minor "${_python_version}")
  math(EXPR _next_minor "${_minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${_python_version}~), python3 (<< 3.${_next_minor}~), python3-numpy (>= 1:1.24)")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "The Python package: own detections and poses, recordings and experiments,\nin NumPy.")
endif()

configure_file("${PROJECT_SOURCE_DIR}/packaging/debian/changelog.in" "${PROJECT_BINARY_DIR}/changelog" @ONLY)
execute_process(COMMAND gzip -9nf "${PROJECT_BINARY_DIR}/changelog" COMMAND_ERROR_IS_FATAL ANY)
foreach(_component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER "${_component}" _upper)
  install(FILES "${PROJECT_SOURCE_DIR}/packaging/debian/copyright" "${PROJECT_BINARY_DIR}/changelog.gz"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${_upper}_PACKAGE_NAME}" COMPONENT ${_component})
endforeach()
include(CPack)
