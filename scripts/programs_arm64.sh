#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/programs_arm64.sh: geoloc's Debian package (the programs) for 64-bit Arm in out/packages, cross-built; then the same flight, and the
# same picture, on both processors, this one's and Arm's by qemu: objects and boxes must agree. As root on Debian, which becomes one of two
# architectures: scripts/test_packages.sh arm64 takes a machine of its own for it.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
work=build/arm64-programs
rm -rf "$work"
mkdir -p "$work" out/packages
source scripts/packages.sh

install_packages "${BUILD_PACKAGES[@]}" qemu-user-static
configure release "${PROGRAMS_ONLY[@]}" -B build/native-programs -DCMAKE_DISABLE_FIND_PACKAGE_OpenVINO=ON
say "Building (build/native-programs)"
cmake --build build/native-programs --target geoloc_detect geoloc_replay geoloc_sim

say "A recording, its replay, and the boxes of a picture on this processor"
native=$PWD/build/native-programs/bin picture=tests/data/detection/targets.jpg
"$native/geoloc_sim" --flight stock_path1 --record "$work/recording" >/dev/null 2>&1
"$native/geoloc_replay" "$work/recording" --csv "$work/native.csv" >/dev/null
"$native/geoloc_detect" "$picture" --json - >"$work/native_boxes.txt"

add_arm64
# Those of Arm take the place of this processor's where both have the same files.
mapfile -t of_arm < <(printf '%s:arm64\n' "${BUILD_PACKAGES[@]}" "${GDAL_PACKAGES[@]}" | grep '^lib.*-dev:' | grep -vE '^lib(eigen3|cli11|boost)-dev:')
install_packages g++-aarch64-linux-gnu dpkg-dev file "${of_arm[@]}"

export PKG_CONFIG_LIBDIR=/usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig
configure release "${PROGRAMS_ONLY[@]}" -B "$work/build" -DCMAKE_TOOLCHAIN_FILE="$ROOT/cmake/aarch64-linux-gnu.cmake" -DCMAKE_INSTALL_PREFIX=/usr \
  -DCMAKE_DISABLE_FIND_PACKAGE_OpenVINO=ON
say "Building ($work/build)"
cmake --build "$work/build"
say "Packing"
(cd "$work/build" && DEB_HOST_ARCH=arm64 cpack -G DEB -D CPACK_DEBIAN_PACKAGE_ARCHITECTURE=arm64 -B "$ROOT/$work/_deb" >"$ROOT/build/cpack.log") ||
  { tail -n 20 build/cpack.log; exit 1; }
package=$(ls "$work"/_deb/geoloc_*_arm64.deb)
cp "$package" out/packages/
apt-get install --simulate -q "./$package" >"$work/apt.log" || { tail "$work/apt.log"; exit 1; }  # what it needs is to be had

say "The same by the package's programs on Arm"
dpkg -x "$package" "$work/installed"
on_arm64() { qemu-aarch64-static "$work/installed/usr/bin/$1" "${@:2}"; }
for program in "$work"/installed/usr/bin/*; do
  [[ $(file "$program") == *'ARM aarch64'* ]]
  on_arm64 "$(basename "$program")" --help >"$work/help.txt"
  grep -q 'Usage: ' "$work/help.txt"
done
on_arm64 geoloc_replay "$work/recording" --csv "$work/arm64.csv" >/dev/null
on_arm64 geoloc_detect "$picture" --json - >"$work/arm64_boxes.txt"
python3 tests/bare/same_numbers.py "$work/native.csv" "$work/arm64.csv"
python3 tests/bare/same_numbers.py "$work/native_boxes.txt" "$work/arm64_boxes.txt" 0.01
ls -l out/packages/geoloc_*_arm64.deb >&2
say "Both processors agree"
