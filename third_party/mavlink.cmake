# Target mavlink::mavlink: MAVLink's C headers, generated at configure time from the XML and the generator in a
# pinned pymavlink wheel. Nothing is installed and no third-party code is committed. All dialects are generated,
# because a receiver can check only frames whose message it knows, and ArduPilot sends many that are not in
# common.xml.
#   offline: -DMAVLINK_INCLUDE_DIR=<folder that holds all/mavlink.h>
#   offline: -DGEOLOC_PYMAVLINK_WHEEL=<the wheel named below>
include_guard(GLOBAL)
set(MAVLINK_INCLUDE_DIR "" CACHE PATH "Generated MAVLink 2 C headers (skips the download)")
set(GEOLOC_PYMAVLINK_WHEEL "" CACHE FILEPATH "A pymavlink wheel that was fetched beforehand (skips the download)")

set(_version 2.4.50)
set(_sha256 6c56a34ae4e6e9215f77cd4ad809b804611ad248290783d2d701904bb8db9772)
set(_root "${CMAKE_BINARY_DIR}/_mavlink")

# Debian packages pip separately from python3; the pip inside python3-venv works as well.
function(_geoloc_find_pip result)
  execute_process(COMMAND "${Python3_EXECUTABLE}" -m pip --version RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
  if(status EQUAL 0)
    set(${result} "${Python3_EXECUTABLE}" -m pip PARENT_SCOPE)
    return()
  endif()
  execute_process(COMMAND "${Python3_EXECUTABLE}" -m venv "${_root}/venv" RESULT_VARIABLE status OUTPUT_QUIET)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "MAVLink headers need pip: apt-get install python3-venv, or give -DMAVLINK_INCLUDE_DIR=")
  endif()
  set(${result} "${_root}/venv/bin/python" -m pip PARENT_SCOPE)
endfunction()

function(_geoloc_fetch_wheel result)
  if(GEOLOC_PYMAVLINK_WHEEL)
    file(SHA256 "${GEOLOC_PYMAVLINK_WHEEL}" actual)
    if(NOT actual STREQUAL _sha256)
      message(FATAL_ERROR "${GEOLOC_PYMAVLINK_WHEEL} is not pymavlink ${_version} (sha256 ${actual}, wanted ${_sha256})")
    endif()
    set(${result} "${GEOLOC_PYMAVLINK_WHEEL}" PARENT_SCOPE)
    return()
  endif()
  _geoloc_find_pip(pip)
  message(STATUS "Fetching pymavlink ${_version} for MAVLink's headers")
  file(WRITE "${_root}/requirements.txt" "pymavlink==${_version} --hash=sha256:${_sha256}\n")
  # The platform is fixed, whatever the host: only the wheel's Python and XML are used.
  execute_process(
    COMMAND ${pip} --disable-pip-version-check download -q --no-deps --only-binary :all:
      --implementation cp --python-version 3.11 --abi cp311
      --platform manylinux2014_x86_64 --platform manylinux_2_28_x86_64
      --require-hashes -r "${_root}/requirements.txt" -d "${_root}/download"
    RESULT_VARIABLE status)
  file(GLOB wheel "${_root}/download/pymavlink-${_version}-*.whl")
  if(NOT status EQUAL 0 OR NOT wheel)
    message(FATAL_ERROR "pip could not fetch pymavlink ${_version}. Without a network give -DMAVLINK_INCLUDE_DIR= or "
                        "-DGEOLOC_PYMAVLINK_WHEEL=")
  endif()
  set(${result} "${wheel}" PARENT_SCOPE)
endfunction()

function(_geoloc_generate_headers output)
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
  _geoloc_fetch_wheel(wheel)
  file(ARCHIVE_EXTRACT INPUT "${wheel}" DESTINATION "${_root}/package")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${_root}/package" PYTHONDONTWRITEBYTECODE=1 MDEF=
      "${Python3_EXECUTABLE}" -m pymavlink.tools.mavgen --lang=C --wire-protocol=2.0
      -o "${output}.partial" "${_root}/package/pymavlink/dialects/v20/all.xml"
    RESULT_VARIABLE status OUTPUT_QUIET)
  if(NOT status EQUAL 0 OR NOT EXISTS "${output}.partial/all/mavlink.h")
    message(FATAL_ERROR "pymavlink's generator failed on all.xml")
  endif()
  file(RENAME "${output}.partial" "${output}")
endfunction()

if(MAVLINK_INCLUDE_DIR)
  set(_include "${MAVLINK_INCLUDE_DIR}")
  if(NOT EXISTS "${_include}/all/mavlink.h")
    message(FATAL_ERROR "MAVLINK_INCLUDE_DIR=${_include} holds no all/mavlink.h")
  endif()
else()
  set(_include "${_root}/include-${_version}")
  if(NOT EXISTS "${_include}/all/mavlink.h")
    _geoloc_generate_headers("${_include}")
  endif()
endif()

add_library(mavlink INTERFACE)
add_library(mavlink::mavlink ALIAS mavlink)
target_include_directories(mavlink SYSTEM INTERFACE "${_include}")
