#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/wheel_arm64.sh: the Python package's wheel for 64-bit Arm in out/wheels, cross-built for this machine's Python; then README's
# example and one flight by both wheels, this processor's and Arm's by qemu: numbers must agree to 1e-9. As root on Debian, which becomes one
# of two architectures: scripts/test_packages.sh arm64 takes a machine of its own for it.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
work=build/arm64-wheel
rm -rf "$work"
mkdir -p "$work" out/wheels
source scripts/packages.sh
install_packages g++ cmake ninja-build libeigen3-dev libgeographiclib-dev pkg-config python3-dev python3-venv binutils
version=$(python3 -c 'import sys; print("%d.%d" % sys.version_info[:2])')

bash scripts/wheels.sh
native=$(ls out/wheels/geoloc-*x86_64.whl)
python3 -m zipfile -e "$native" "$work/native"

add_arm64
# GeographicLib's takes the place of this processor's; Python's headers stand beside them.
install_packages g++-aarch64-linux-gnu libgeographiclib-dev:arm64 "libpython$version-dev:arm64" qemu-user-static

say "Building for aarch64"
install_from_pypi "$work/tools" tests/python/requirements.txt --only-binary :all: --no-deps
export CCACHE_BASEDIR=$ROOT CCACHE_NOHASHDIR=true
_PYTHON_HOST_PLATFORM=linux-aarch64 SETUPTOOLS_EXT_SUFFIX=".cpython-${version/./}-aarch64-linux-gnu.so" \
  "$work/tools/bin/pip" wheel --quiet --disable-pip-version-check --no-deps --no-build-isolation . -w "$work" \
  --config-settings=build-dir="$work/build" \
  --config-settings=cmake.define.CMAKE_UNITY_BUILD=ON --config-settings=cmake.define.CMAKE_UNITY_BUILD_BATCH_SIZE=16 \
  --config-settings=cmake.define.CMAKE_TOOLCHAIN_FILE="$ROOT/cmake/aarch64-linux-gnu.cmake" \
  --config-settings=cmake.define.GEOLOC_PYTHON_STUB="$ROOT/$work/native/geoloc/_core.pyi"
PATH="$ROOT/build/wheel-tools/bin:$PATH" build/wheel-tools/bin/auditwheel repair -w out/wheels "$work"/geoloc-*aarch64.whl
arm=$(ls out/wheels/geoloc-*aarch64.whl)
python3 -m zipfile -e "$arm" "$work/arm64"

say "Arm's Python and NumPy, which qemu runs"
(cd "$work" && apt-get download -q "python$version-minimal:arm64" >/dev/null && dpkg -x "python$version-minimal"_*_arm64.deb interpreter)
for platform in x86_64:native aarch64:arm64; do
  "$work/tools/bin/pip" install --quiet --disable-pip-version-check --no-deps --only-binary :all: --python-version "$version" \
    --platform "manylinux_2_28_${platform%:*}" --target "$work/${platform#*:}" numpy==2.4.6
done
on_native() { PYTHONPATH=$work/native python3 "$@"; }
on_arm64() { PYTHONPATH=$work/arm64 qemu-aarch64-static "$work/interpreter/usr/bin/python$version" "$@"; }
[ "$(on_arm64 -c 'import platform; print(platform.machine())')" = aarch64 ]

say "README's example and a minute of flight on both processors"
sed -n '/^```python$/,/^```$/{/^```/!p}' README.md >"$work/example.py"
python3 tests/languages/synthetic_feed.py >"$work/feed.txt"
for processor in native arm64; do
  "on_$processor" "$work/example.py" | tee "$work/example_$processor.txt"
  "on_$processor" tests/languages/estimate.py "$work/feed.txt" >"$work/flight_$processor.txt"
done
cmp "$work/example_native.txt" "$work/example_arm64.txt"
python3 tests/languages/compare.py "$work/flight_native.txt" "$work/flight_arm64.txt"
ls -l out/wheels >&2
say "Both processors agree"
