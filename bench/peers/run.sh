#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bench/peers/run.sh [--seeds 0,1,2] [--sets stock,gnss] [--jobs N] [--tune]: geoloc, Stone Soup and the mean of all fixes
# on the same recordings; prints a table and writes it to build/peers/. See bench/peers/README.md.
set -euo pipefail
case " $* " in *" --help "* | *" -h "*)
  sed -n '3,4s/^# //p' "$0"
  echo "--tune searches Stone Soup's settings first; --jobs N runs at once (default: one per core)"
  exit 0 ;;
esac
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
cd "$ROOT"
mkdir -p build/peers
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}"

fail() { tail -n 20 "$1" >&2; echo "run.sh: $2; all of it is in $1" >&2; exit 1; }

if [ ! -f build/release/build.ninja ]; then
  say "Configuring"
  cmake --preset demo >build/peers/configure.log 2>&1 || fail build/peers/configure.log "cmake could not configure"
fi
say "Building"
cmake --build build/release --target geoloc_sim geoloc_replay >build/peers/build.log 2>&1 ||
  fail build/peers/build.log "the build failed"

install_from_pypi build/peers/venv bench/peers/requirements.txt  # Stone Soup, which needs Python 3.11 or newer

say "Running"
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1  # single-threaded runs, so that CPU time is comparable
exec nice -n 5 build/peers/venv/bin/python bench/peers/peers.py "$@"
