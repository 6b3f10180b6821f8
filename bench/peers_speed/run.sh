#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bench/peers_speed/run.sh [--sizes 10,30,100,300,1000,3000] [--seed N]: the time of geoloc's assignment beside SciPy's and lapx's, on the same
# matrices in one interleaved run; checks that all find the same sum. Prints the table of bench/README.md.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
cd "$ROOT"
case " $* " in *" --help "* | *" -h "*) sed -n '3,4s/^# //p' "$0"; exit 0 ;; esac
mkdir -p build
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" libbenchmark-dev
install_from_pypi build/peers_speed/venv bench/peers_speed/requirements.txt
configure release
say "Building"
cmake --build build/release --target assignment_shim >build/peers_speed/build.log
say "Running"
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
exec build/peers_speed/venv/bin/python bench/peers_speed/assignment.py build/release/lib/libassignment_shim.so "$@"
