#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/demo.sh [--fast] [--method joint|paper] [--flight NAME] [--scenario 1|2|3] [--seed N] [--out DIR] [--http PORT]
# The whole system on one computer: a simulated drone sends MAVLink over UDP and its camera over RTSP; geoloc_app finds
# 30 targets in the video and locates them, and shows them on a page at http://127.0.0.1:8080 (or the next free port).
# --fast flies at up to six times real time, as fast as this computer's detector can follow. On a terminal, the page stays after the flight
# until Ctrl-C.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
usage() { sed -n '3,7s/^# //p' "$0"; }

fast= flight=stock_path1 scenario=1 seed=1 out=out/$(date +%Y%m%d-%H%M%S) port= method=()
while [ $# -gt 0 ]; do
  case $1 in
    --fast) fast=yes; shift; continue ;;
    --help) usage; exit 0 ;;
    --method | --flight | --scenario | --seed | --out | --http) ;;
    *) echo "demo.sh: there is no option $1" >&2; usage >&2; exit 2 ;;
  esac
  [ $# -ge 2 ] || { echo "demo.sh: $1 needs a value" >&2; usage >&2; exit 2; }
  case $1 in
    --method) method=(--method "$2") ;;
    --flight) flight=$2 ;;
    --scenario) scenario=$2 ;;
    --seed) seed=$2 ;;
    --out) out=$2 ;;
    --http) port=$2 ;;
  esac
  shift 2
done

is_free() { ! (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }
if [ -z "$port" ]; then
  for port in $(seq 8080 8099); do is_free "$port" && break; done
fi
page=http://127.0.0.1:$port/
bin=build/release/bin

mkdir -p build
source scripts/packages.sh
say "The page with the flight will be at $page"
install_packages "${BUILD_PACKAGES[@]}" "${RUN_PACKAGES[@]}"
[ -f build/release/build.ninja ] || configure release "${PROGRAMS_ONLY[@]}"
say "Building"
cmake --build build/release --target geoloc_app geoloc_sim

speed=1
if [ -n "$fast" ]; then
  # All targets are found where some 350 pictures of the 210 s are searched, and beside the simulated drone a picture takes 1.6 times as
  # long as on its own.
  picture_ms=$("$bin/geoloc_app" --time-detector | sed 's/ ms per picture.*//')
  speed=$(awk -v ms="$picture_ms" 'BEGIN { x = int(210e3 / 350 / (1.6 * (ms + 1))); print (x < 1 ? 1 : (x > 6 ? 6 : x)) }')
  say "The detector takes $picture_ms ms per picture: flying at $speed times real time"
fi

say "Flying. The page is at $page"
nice -n 19 cmake --build build/release --target geoloc_replay >build/replay.log 2>&1 &  # for the page after the flight
bash scripts/fly.sh "$bin" "$out" --flight "$flight" --scenario "$scenario" --seed "$seed" --speed "$speed" -- \
  --http "$port" "${method[@]}"
wait $! || { cat build/replay.log >&2; exit 1; }
again=("$bin/geoloc_replay" "$out/recording" --http "$port")
say "The flight again, on the page: ${again[*]}"
[ -t 1 ] || exit 0
exec "${again[@]}" --speed 0 >/dev/null
