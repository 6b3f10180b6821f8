#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/test_library.sh [CMAKE-OPTION…]: the library alone, as onboard software takes it. Installs g++, CMake, Eigen,
# GeographicLib and GoogleTest, builds in build/library and runs the library's tests; the last of them install to a folder
# there, and build and run a consumer by find_package and by pkg-config. All else that may be installed is hidden from CMake.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
mkdir -p build
source scripts/packages.sh
install_packages "${LIBRARY_PACKAGES[@]}"

build=build/library
options=(-DGEOLOC_BUILD_IO=OFF -DGEOLOC_BUILD_SIM=OFF -DGEOLOC_BUILD_APPS=OFF)
for hidden in Boost fmt nlohmann_json OpenCV OpenVINO PkgConfig Python3 yaml-cpp ZLIB; do  # PkgConfig finds GStreamer
  options+=("-DCMAKE_DISABLE_FIND_PACKAGE_$hidden=ON")
done
export CCACHE_BASEDIR=$ROOT CCACHE_NOHASHDIR=true
say "Configuring ($build)"
rm -rf "$build/CMakeCache.txt" "$build/tests/install"
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "${options[@]}" --no-warn-unused-cli "$@" \
  >build/configure_library.log 2>&1 || { cat build/configure_library.log; exit 1; }
if grep -iE '^[a-z_]*(opencv|gstreamer|rtsp)' "$build/CMakeCache.txt" | grep -v '^CMAKE_DISABLE_FIND_PACKAGE_'; then
  echo "The library alone looks for what only io and sim need" >&2
  exit 1
fi
# Without exceptions it is built by scripts/test_onboard.sh, which takes longer: what that would trip over is seen here.
if grep -nwE 'throw|try|catch|dynamic_cast|typeid' -r --include='*.[ch]pp' src/{calibration,camera,fleet,geometry,pipeline,projection,settings,state,tracking} \
  include/geoloc/{calibration,camera,fleet,geometry,pipeline,projection,state,tracking} | grep -vE ':[0-9]+: *//|^src/geometry/refuse.cpp:'; then
  echo "The library refuses by refuse() alone (geometry/refuse.hpp)" >&2
  exit 1
fi
say "Building ($build)"
cmake --build "$build"
say "Testing ($build)"
ctest --test-dir "$build" --output-on-failure --timeout 300 -j "$(nproc)"
if [ ! -x "$build/tests/install/pkg_config_consumer" ]; then
  echo "No consumer was built by pkg-config" >&2
  exit 1
fi
