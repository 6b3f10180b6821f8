#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/test_onboard.sh [COMPILER:STANDARD:KIND…]: the library as autopilots take it, without exceptions and run-time types: by gcc
# and clang, as C++17 and C++20, static and shared (default: g++:17:static g++:20:shared clang++:17:shared clang++:20:static).
# Each is installed to a folder, where a program of the same kind finds it, runs, and is told why where it builds what cannot be.
# All four take some minutes on two cores.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
mkdir -p build
source scripts/packages.sh
install_packages "${LIBRARY_PACKAGES[@]}" clang
export CCACHE_BASEDIR=$ROOT CCACHE_NOHASHDIR=true
[ $# -gt 0 ] || set -- g++:17:static g++:20:shared clang++:17:shared clang++:20:static

flags="-fno-exceptions -fno-rtti"
for kind in "$@"; do
  IFS=: read -r compiler standard linkage <<<"$kind"
  build=build/onboard/$compiler-$standard-$linkage
  shared=OFF
  [ "$linkage" = static ] || shared=ON
  say "Building ($build)"
  rm -rf "$build/CMakeCache.txt" "$build/installed" "$build/consumer"
  options=(-DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_STANDARD="$standard" -DCMAKE_CXX_FLAGS="$flags")
  cmake -S . -B "$build" -G Ninja "${options[@]}" -DBUILD_SHARED_LIBS="$shared" -DCMAKE_INSTALL_PREFIX="$ROOT/$build/installed" \
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 \
    -DGEOLOC_BUILD_C=OFF -DGEOLOC_BUILD_IO=OFF -DGEOLOC_BUILD_SIM=OFF -DGEOLOC_BUILD_APPS=OFF -DGEOLOC_BUILD_TESTS=OFF \
    -DGEOLOC_BUILD_EXAMPLES=OFF -DGEOLOC_WARNINGS_AS_ERRORS=ON >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
  cmake --build "$build"
  cmake --install "$build" >/dev/null
  cmake -S tests/install/onboard -B "$build/consumer" -G Ninja "${options[@]}" -DCMAKE_PREFIX_PATH="$ROOT/$build/installed" \
    -DCMAKE_BUILD_TYPE=Release >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
  cmake --build "$build/consumer"
  "$build/consumer/onboard"
  status=0
  ("$build/consumer/onboard" without asking) 2>"$build/refused.txt" || status=$?
  if [ "$status" -ne 134 ] || ! grep -q '^geoloc: max_detections .*; joint.gate ' "$build/refused.txt"; then
    echo "What cannot be built is not refused with the reason, but ends with $status:" >&2
    cat "$build/refused.txt" >&2
    exit 1
  fi
done
say "The library works without exceptions and run-time types: $*"
