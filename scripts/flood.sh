#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/flood.sh [BYTES]: a flight among BYTES (default 1e9) of damaged, forged and repeated MAVLink, in one process, with
# build/release as scripts/test.sh makes it: no crash, no false state, no growing memory. 1e9 take some minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
GEOLOC_FLOOD_BYTES=${1:-1e9} exec build/release/tests/io/mavlink/io_mavlink_test --gtest_filter='Flood.*'
