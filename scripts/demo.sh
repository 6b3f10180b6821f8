#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/demo.sh [--fast] [--method NAME] [--flight NAME] [--scenario 1|2|3] [--seed N] [--out DIR]
# The whole system on one computer: a simulated drone sends MAVLink over UDP and its camera over RTSP; geoloc_app finds
# 30 targets in the video and says where they are. --fast flies six times as fast.
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

out=${out:-out/$(date +%Y%m%d-%H%M%S)}
[ ! -e "$out" ] || { echo "$out exists already; name another folder with --out" >&2; exit 2; }
mkdir -p "$out"
bin=build/release/bin
udp_port=$((20000 + RANDOM % 10000)) rtsp_port=$((30000 + RANDOM % 10000))

sim= app=
stop_all() { for child in $app $sim; do kill -INT "$child" 2>/dev/null || true; done; wait; }
trap stop_all EXIT

say "Flying $flight over scenario $scenario, $speed x"
"$bin/geoloc_sim" --flight "$flight" --scenario "$scenario" --seed "$seed" --speed "$speed" \
  --udp "127.0.0.1:$udp_port" --rtsp-port "$rtsp_port" --truth "$out/truth.geojson" 2>"$out/sim.log" &
sim=$!
for _ in $(seq 100); do [ -s "$out/truth.geojson" ] && break; kill -0 "$sim" 2>/dev/null || break; sleep 0.1; done
[ -s "$out/truth.geojson" ] || { cat "$out/sim.log" >&2; exit 1; }

"$bin/geoloc_app" --udp "127.0.0.1:$udp_port" --rtsp "rtsp://127.0.0.1:$rtsp_port/cam" "${method[@]}" \
  --truth "$out/truth.geojson" --out "$out/objects.geojson" --raw "$out/raw.csv" --picture "$out/picture.svg" \
  --record "$out/recording" --http 0 2> >(tee "$out/app.log" >&2) &
app=$!

sim_status=0
wait "$sim" || sim_status=$?
sim=
[ "$sim_status" -eq 0 ] || { tail -n 5 "$out/sim.log" >&2; exit 1; }
sleep 1  # the last frames
kill -INT "$app"
app_status=0
wait "$app" || app_status=$?
app=
[ "$app_status" -eq 0 ] || exit 1

say "Done: $(tr '\r' '\n' <"$out/app.log" | grep -o 'found [0-9]* / [0-9]*, RMSE.*' | tail -n 1)"
printf '%-11s %s\n' objects "$out/objects.geojson" recording "$out/recording" picture "$out/picture.svg" \
  'raw fixes' "$out/raw.csv"
echo "Again, from the recording: cmake --build build/release --target geoloc_replay && $bin/geoloc_replay $out/recording --out again.geojson"
