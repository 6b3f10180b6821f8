#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/fly.sh BIN_FOLDER OUT_FOLDER [OPTION-OF-GEOLOC_SIM…] -- [OPTION-OF-GEOLOC_APP…]
# Runs geoloc_sim and geoloc_app together over the loopback. If either ends early, the other is stopped and the reason
# is shown.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '3,5s/^# //p' "$0" >&2; exit 2; }
say() { printf '\033[1m== %s\033[0m\n' "$*" >&2; }

bin=$1 out=$2 sim_options=() app_options=()
shift 2
while [ $# -gt 0 ] && [ "$1" != -- ]; do sim_options+=("$1"); shift; done
[ $# -eq 0 ] || { shift; app_options=("$@"); }
[ ! -e "$out" ] || { echo "$out exists already; name another folder with --out" >&2; exit 2; }
mkdir -p "$out"
udp_port=$((20000 + RANDOM % 10000)) rtsp_port=$((30000 + RANDOM % 10000))

sim= app=
# Both get the time to write what they have, unless the flight has failed anyway.
patience_us=10000000
stop_all() {
  local until=$((${EPOCHREALTIME/[^0-9]/} + patience_us))
  for child in $app $sim; do kill -INT "$child" 2>/dev/null || true; done
  while [ "${EPOCHREALTIME/[^0-9]/}" -lt "$until" ]; do
    kill -0 $app $sim 2>/dev/null || return 0
    sleep 0.05
  done
  kill -KILL $app $sim 2>/dev/null || true
}
trap stop_all EXIT
trap 'exit 130' INT TERM

# fail PROGRAM STATUS [LOG]: ends the script. geoloc_app has given its reason on stderr already.
fail() {
  patience_us=1000000
  say "$1 ended early, with status $2${3:+:}"
  [ -z "${3:-}" ] || grep -v '^[[:space:]]*$' "$3" | tail -n 5 >&2 || echo "(it said nothing)" >&2
  exit 1
}

"$bin/geoloc_sim" "${sim_options[@]}" --udp "127.0.0.1:$udp_port" --rtsp-port "$rtsp_port" \
  --truth "$out/truth.geojson" 2>"$out/sim.log" &
sim=$!
# On a computer's first flight, GStreamer looks at all of its plugins: that took 20 s on a busy one.
for _ in $(seq 600); do [ -s "$out/truth.geojson" ] && break; kill -0 "$sim" 2>/dev/null || break; sleep 0.1; done

if [ -s "$out/truth.geojson" ]; then
  "$bin/geoloc_app" --udp "127.0.0.1:$udp_port" --rtsp "rtsp://127.0.0.1:$rtsp_port/cam" "${app_options[@]}" \
    --truth "$out/truth.geojson" --out "$out/objects.geojson" --raw "$out/raw.csv" --picture "$out/picture.svg" \
    --record "$out/recording" &
  app=$!
fi

status=0 ended=
wait -n -p ended $sim $app || status=$?
if [ "$ended" != "$sim" ]; then
  app=
  fail geoloc_app "$status"
fi
sim=
[ "$status" -eq 0 ] && [ -n "$app" ] || fail geoloc_sim "$status" "$out/sim.log"
sleep 1  # the last frames
kill -INT "$app" 2>/dev/null || true
wait "$app" || status=$?
app=
[ "$status" -eq 0 ] || fail geoloc_app "$status"

say "Done"
printf '%-11s %s\n' objects "$out/objects.geojson" recording "$out/recording" picture "$out/picture.svg" \
  'raw fixes' "$out/raw.csv"
