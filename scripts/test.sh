#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/test.sh [release|asan] [CMAKE-OPTION…]: installs what the tests need, builds, and runs all tests.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"

preset=${1:-release}
[ $# -eq 0 ] || shift
case $preset in release | asan) ;; *) sed -n 3p "$0"; exit 2 ;; esac

mkdir -p build
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${GDAL_PACKAGES[@]}" "${RUN_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
# The programs that read our outputs back get an environment of their own.
install_from_pypi build/consumers tests/apps/requirements.txt --only-binary :all: --no-deps
# The Python module is built and tested in another.
[ "$preset" = asan ] || install_from_pypi build/python tests/python/requirements.txt --only-binary :all: --no-deps
# So are the notebooks, as those who read them do.
[ "$preset" = asan ] || install_from_pypi build/notebooks examples/notebooks/requirements.txt --only-binary :all: --no-deps --no-compile
[ "$preset" = asan ] || bash scripts/openvino.sh  # with both back ends; the sanitizers check a build with OpenCV alone
configure "$preset" "$@"
say "Building ($preset)"
cmake --build "build/$preset"
say "Testing ($preset)"
# One more than there are processors, since many tests of programs wait for a clock or a peer.
ctest --test-dir "build/$preset" --output-on-failure --timeout 300 -j "$(($(nproc) + 1))"
