#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/cross_arm64.sh: libgeoloc's Debian packages for 64-bit Arm in out/packages, cross-built; then the examples and one flight on
# both processors, this one's and Arm's by qemu: numbers must agree to 1e-9. As root on Debian, which becomes one of two architectures:
# scripts/test_packages.sh arm64 takes a machine of its own for it.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
mkdir -p build out/packages
source scripts/packages.sh
install_packages g++ cmake ninja-build libeigen3-dev libgeographiclib-dev pkg-config dpkg-dev file python3-minimal

library=(-DCMAKE_BUILD_TYPE=Release -DGEOLOC_BUILD_IO=OFF -DGEOLOC_BUILD_SIM=OFF -DGEOLOC_BUILD_APPS=OFF -DGEOLOC_BUILD_TESTS=OFF
  -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16)
export CCACHE_BASEDIR=$ROOT CCACHE_NOHASHDIR=true
# build_in FOLDER [CMAKE-OPTION…]
build_in() {
  say "Building ($1)"
  cmake -S . -B "$1" -G Ninja "${library[@]}" "${@:2}" >build/configure.log 2>&1 || { cat build/configure.log; return 1; }
  cmake --build "$1"
}
# build_estimators PREFIX-OF-THE-COMPILERS FOLDER
build_estimators() {
  "$1g++" -std=c++17 -O2 -Iinclude -isystem /usr/include/eigen3 tests/languages/estimate.cpp "$2/src/libgeoloc.a" -lGeographicLib \
    -o "$2/estimate_in_cpp"
  "$1gcc" -std=c99 -O2 -Iinclude tests/languages/estimate.c -L"$2/c" -lgeoloc_c -Wl,-rpath,"$ROOT/$2/c" -o "$2/estimate_in_c"
}
build_in build/native
build_estimators "" build/native

add_arm64
install_packages g++-aarch64-linux-gnu libgeographiclib-dev:arm64 qemu-user-static  # takes the place of this processor's
build_in build/arm64 -DCMAKE_TOOLCHAIN_FILE="$ROOT/cmake/aarch64-linux-gnu.cmake"
build_estimators aarch64-linux-gnu- build/arm64
file -L build/arm64/c/libgeoloc_c.so | grep -q 'ARM aarch64'

say "Packing"
(cd build/arm64 && DEB_HOST_ARCH=arm64 cpack -G DEB -D CPACK_DEBIAN_PACKAGE_ARCHITECTURE=arm64 -B "$ROOT/build/arm64/_deb" >"$ROOT/build/cpack.log") ||
  { tail -n 20 build/cpack.log; exit 1; }
cp build/arm64/_deb/*_arm64.deb out/packages/
ls -l out/packages/*_arm64.deb >&2

say "The packages are installed, and the example in C is built against them"
apt-get install -y -q --no-install-recommends ./out/packages/libgeoloc0_*_arm64.deb >build/apt.log 2>&1 || { tail build/apt.log; exit 1; }
aarch64-linux-gnu-gcc -std=c99 -Iinclude examples/03_from_c.c -l:libgeoloc_c.so.0 -lm -o build/arm64/from_c
examples=("01_autopilot" "02_gimbal" "03_from_c")
for example in "${examples[@]}"; do
  "build/native/examples/example_$example" >"build/native/$example.txt"
  qemu-aarch64-static "build/arm64/examples/example_$example" >"build/arm64/$example.txt"
  diff "build/native/$example.txt" "build/arm64/$example.txt"
done
qemu-aarch64-static build/arm64/from_c | diff "build/native/03_from_c.txt" -

say "A minute of flight on both processors"
feed=build/native/feed.txt
python3 tests/languages/synthetic_feed.py >"$feed"
build/native/estimate_in_cpp "$feed" >build/native/flight.txt
for language in cpp c; do
  qemu-aarch64-static "build/arm64/estimate_in_$language" "$feed" >"build/arm64/flight_$language.txt"
  python3 tests/languages/compare.py build/native/flight.txt "build/arm64/flight_$language.txt"
done
cmp build/arm64/flight_cpp.txt build/arm64/flight_c.txt
say "Both processors agree"
