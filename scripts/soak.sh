#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/soak.sh [MINUTES]: what docs/reliability.md promises, over hours, with build/release as scripts/test.sh makes it: a run of
# MINUTES (default 60) through one flight after the other, 100 restarts of the stream, 100 kills, and 1e9 bytes of hostile MAVLink. Beside the
# MINUTES it takes some 30. Do nothing else on the computer meanwhile: latencies are part of it.
set -euo pipefail
cd "$(dirname "$0")/.."
export GEOLOC_BIN_DIR=$PWD/build/release/bin GEOLOC_SOURCE_DIR=$PWD PYTHONPATH=$PWD/tests/apps:$PWD/tests/faults
export PYTHONDONTWRITEBYTECODE=1 PYTHONUNBUFFERED=1
faults=0
check() { printf '\033[1m== %s\033[0m\n' "$1"; shift; "$@" || faults=$((faults + 1)); }

check "${1:-60} minutes of flights" python3 tests/faults/soak.py "${1:-60}"
check "100 restarts of the stream" \
  env GEOLOC_STREAM_RESTARTS=100 GEOLOC_STREAM_RETURN_S=1 python3 tests/faults/stream_restarts_test.py
check "100 kills" env GEOLOC_KILLS=100 python3 tests/faults/power_cut_test.py PowerCut.test_kills
check "10^9 hostile bytes" bash scripts/flood.sh 1e9
echo "$faults faults"
[ "$faults" -eq 0 ]
