#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/notebooks.sh [NOTEBOOK…]: executes the notebooks of examples/notebooks as a reader would, with the Python package of this source
# and recordings of geoloc_sim. What they show is in out/notebooks: the notebooks, and their pictures, to be looked at.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
mkdir -p build out
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${RUN_PACKAGES[@]}" python3-dev
[ -f build/release/build.ninja ] || configure release "${PROGRAMS_ONLY[@]}"
say "Building"
cmake --build build/release --target geoloc_sim
install_from_pypi build/notebooks examples/notebooks/requirements.txt --only-binary :all: --no-deps
build/notebooks/bin/pip install --quiet --disable-pip-version-check .

say "Recording flights"
rm -rf out/notebooks
mkdir -p out/notebooks
build/release/bin/geoloc_sim --record out/notebooks/flight
build/release/bin/geoloc_sim --record out/notebooks/flight_with_video --video --start-s 60 --end-s 130 --frame-rate 2.5
[ $# -gt 0 ] || set -- examples/notebooks/*.ipynb
say "Executing"
build/notebooks/bin/python scripts/notebooks.py out/notebooks "$@"
