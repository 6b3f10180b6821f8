#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/packages_deb.sh [CMAKE-OPTION…]: Debian packages in out/packages: libgeoloc0, libgeoloc-dev, geoloc and python3-geoloc, for the Debian
# and the processor that this runs on. Installs what the build needs. scripts/test_packages.sh tests them on bare machines.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
mkdir -p build out/packages
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${GDAL_PACKAGES[@]}" dpkg-dev file python3-dev
install_from_pypi build/python tests/python/requirements.txt --only-binary :all: --no-deps  # builds Python's module

LDFLAGS=$(DEB_BUILD_MAINT_OPTIONS=hardening=+bindnow dpkg-buildflags --get LDFLAGS)
export LDFLAGS
configure release "${PROGRAMS_ONLY[@]}" -B build/packages -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_DISABLE_FIND_PACKAGE_OpenVINO=ON -DGEOLOC_BUILD_PYTHON=ON \
  -DPython_EXECUTABLE="$ROOT/build/python/bin/python" -DGEOLOC_PYTHON_FOLDER=lib/python3/dist-packages/geoloc "$@"
say "Building (build/packages)"
cmake --build build/packages
say "Packing"
rm -f out/packages/*.deb
(cd build/packages && cpack -G DEB -B "$ROOT/build/packages/_deb" >"$ROOT/build/cpack.log") || { tail -n 20 build/cpack.log; exit 1; }
cp build/packages/_deb/*.deb out/packages/
ls -l out/packages/*.deb >&2
