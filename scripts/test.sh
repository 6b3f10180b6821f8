#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/test.sh [release|asan] [CMAKE-OPTION…]: installs what the tests need, builds, and runs all tests.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"

# The programs that read our outputs back get an environment of their own.
install_consumers() {
  local venv=build/consumers wanted=tests/apps/requirements.txt
  ! cmp -s "$wanted" "$venv/installed.txt" || return 0
  say "Installing consumers of the outputs into $venv"
  rm -rf "$venv"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check --only-binary :all: --no-deps -r "$wanted" \
    >build/consumers.log 2>&1 || { tail -n 20 build/consumers.log >&2; return 1; }
  cp "$wanted" "$venv/installed.txt"
}

preset=${1:-release}
[ $# -eq 0 ] || shift
case $preset in release | asan) ;; *) sed -n 3p "$0"; exit 2 ;; esac

mkdir -p build
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${GDAL_PACKAGES[@]}" "${RUN_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
install_consumers
[ "$preset" = asan ] || bash scripts/openvino.sh  # with both back ends; the sanitizers check a build with OpenCV alone
configure "$preset" "$@"
say "Building ($preset)"
cmake --build "build/$preset"
say "Testing ($preset)"
ctest --test-dir "build/$preset" --output-on-failure --timeout 300 -j "$(nproc)"
