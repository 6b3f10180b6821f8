#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/test.sh [release|asan] [CMAKE-OPTION…]: installs what the tests need, builds, and runs all of them.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
preset=${1:-release}
[ $# -eq 0 ] || shift
case $preset in release | asan) ;; *) sed -n 3p "$0"; exit 2 ;; esac

mkdir -p build
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${RUN_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
[ "$preset" = asan ] || bash scripts/openvino.sh  # with both back ends; the sanitizers see a build with OpenCV alone
say "Configuring ($preset)"
cmake --preset "$preset" "$@" >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
say "Building ($preset)"
cmake --build "build/$preset"
say "Testing ($preset)"
ctest --test-dir "build/$preset" --output-on-failure --timeout 300 -j "$(nproc)"
