#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/demo.sh [--fast] [--method NAME] [--flight NAME] [--scenario 1|2|3] [--seed N] [--out DIR]
# The whole system on one computer: a simulated drone sends MAVLink over UDP and its camera over RTSP; geoloc_app finds
# 30 targets in the video and locates them. --fast flies at six times real time.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"

speed=1 flight=stock_path1 scenario=1 seed=1 out= method=()
while [ $# -gt 0 ]; do
  case $1 in
    --fast) speed=6 ;;
    --method) method=(--method "$2"); shift ;;
    --flight) flight=$2; shift ;;
    --scenario) scenario=$2; shift ;;
    --seed) seed=$2; shift ;;
    --out) out=$2; shift ;;
    *) sed -n '3,5s/^# //p' "$0"; [ "$1" = --help ] && exit 0; exit 2 ;;
  esac
  shift
done

mkdir -p build
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${RUN_PACKAGES[@]}"
if [ ! -f build/release/build.ninja ]; then
  say "Configuring"
  cmake --preset demo >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
fi
say "Building"
cmake --build build/release --target geoloc_app geoloc_sim

exec bash scripts/fly.sh build/release/bin "${out:-out/$(date +%Y%m%d-%H%M%S)}" \
  --flight "$flight" --scenario "$scenario" --seed "$seed" --speed "$speed" -- "${method[@]}"
