#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/fleet_demo.sh [--http PORT] [--out DIR]
# A fleet on one computer: eight simulated drones over the same 30 targets, each with a receiver that is off by 0.7 m, send what they know
# to a broker (mosquitto), and geoloc_fuse makes one map of it, on a page and in a database (PostGIS). Meanwhile the broker is killed for
# 20 s, the service five times, and the database once; a ninth drone with a base 5 m off comes, and a sender of nonsense. It ends by itself
# with a table, some four minutes after the build, and compares the map with one that nothing has disturbed. Broker and database are its
# own, on the loopback, in a folder that is removed; the system's services are not touched.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
usage() { sed -n '3,8s/^# //p' "$0"; }

port= out=out/fleet-$(date +%Y%m%d-%H%M%S)
while [ $# -gt 0 ]; do
  case $1 in
    --help) usage; exit 0 ;;
    --http | --out) ;;
    *) echo "fleet_demo.sh: there is no option $1" >&2; usage >&2; exit 2 ;;
  esac
  [ $# -ge 2 ] || { echo "fleet_demo.sh: $1 needs a value" >&2; exit 2; }
  case $1 in --http) port=$2 ;; --out) out=$2 ;; esac
  shift 2
done

mkdir -p build
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${FLEET_SERVERS[@]}"
[ -f build/release/build.ninja ] || configure release "${PROGRAMS_ONLY[@]}"
say "Building"
cmake --build build/release --target geoloc_sim geoloc_replay geoloc_fuse
bin=$ROOT/build/release/bin

is_free() { ! (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }
free_port() { local at; for at in $(seq "$1" $(($1 + 99))); do is_free "$at" && break; done; echo "$at"; }
[ -n "$port" ] || port=$(free_port 8080)
broker_port=$(free_port 21883) database_port=$(free_port 25432)

mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d)
as_database=()  # PostgreSQL does not run as root
if [ "$(id -u)" -eq 0 ]; then
  as_database=(runuser -u postgres --)
  chmod 755 "$work"
fi
postgres=$(ls -d /usr/lib/postgresql/*/bin | sort -V | tail -n 1)
broker= service= drones=() began=$SECONDS
end_all() {
  for process in "$broker" "$service" "${drones[@]}"; do [ -z "$process" ] || kill -9 "$process" 2>/dev/null || true; done
  [ ! -f "$work/database/postmaster.pid" ] || database stop -m immediate >/dev/null 2>&1 || true
  rm -rf "$work"
}
trap end_all EXIT
trap 'exit 130' INT TERM

start_broker() {
  /usr/sbin/mosquitto -c "$work/mosquitto.conf" >>"$out/broker.log" 2>&1 &
  broker=$!
  while is_free "$broker_port"; do sleep 0.1; done
}
database() { (cd / && "${as_database[@]}" "$postgres/pg_ctl" -D "$work/database" "$@"); }
start_database() {
  database start -w -l "$work/database.log" -o "-p $database_port -c listen_addresses=127.0.0.1 -c unix_socket_directories=$work/database" >/dev/null
}
ask() { psql -X -q -A -t -h 127.0.0.1 -p "$database_port" -U postgres geoloc -c "$1"; }
start_service() {
  "$bin/geoloc_fuse" --mqtt "mqtt://127.0.0.1:$broker_port/demo" --postgis "postgresql://postgres@127.0.0.1:$database_port/geoloc" \
    --truth "$work/truth.geojson" --out "$out/map.geojson" --http "$port" >>"$out/service.log" 2>&1 &
  service=$!
}
kill_now() { kill -9 "$1" 2>/dev/null || true; wait "$1" 2>/dev/null || true; }

say "Broker and database on the loopback"
printf 'listener %s 127.0.0.1\nallow_anonymous true\nmessage_size_limit 16777216\n' "$broker_port" >"$work/mosquitto.conf"
start_broker
install -d "$work/database"
[ ${#as_database[@]} -eq 0 ] || chown postgres "$work/database"
(cd / && "${as_database[@]}" "$postgres/initdb" -D "$work/database" -A trust -U postgres --no-sync) >"$out/database.log" 2>&1
touch "$work/database.log" && { [ ${#as_database[@]} -eq 0 ] || chown postgres "$work/database.log"; }
start_database
createdb -h 127.0.0.1 -p "$database_port" -U postgres geoloc

# What each receiver is off by in the end was drawn with 0.5 m per axis (Python's random.Random(1)), 0.7 m in all. These are the
# differences to what the gnss flights' receivers are off by themselves; the seventh and eighth fly the first paths again.
say "Nine drones' flights"
shifts=("" "0.53 0.12" "-0.04 -0.64" "-0.58 0.04" "0.05 -0.50" "0.45 -0.26" "-0.32 0.22" "-0.08 -0.64" "-0.82 0.01" "4.0 3.0")
record() {  # DRONE
  local path=$((($1 - 1) % 6 + 1)) rate=10
  [ "$1" -le 6 ] || rate=9  # of frames: other misses, other noise
  "$bin/geoloc_sim" --record "$work/drone-$1" --flight "gnss_path$path" --scenario 2 --frame-rate "$rate" >/dev/null 2>&1
  # shellcheck disable=SC2086  # two numbers
  python3 scripts/shift_receiver.py "$work/drone-$1" ${shifts[$1]}
}
for drone in 1 2 3 4 5 6 7 8 9; do record "$drone"; done
cp "$work/drone-1/truth.geojson" "$work/truth.geojson"

speed=2
launch() {  # DRONE
  "$bin/geoloc_replay" "$work/drone-$1" --speed "$speed" --mqtt "mqtt://127.0.0.1:$broker_port/demo" --flight-id "drone-$1" \
    --summary "$out/drone-$1.fs" --out "$work/drone-$1.geojson" >"$out/drone-$1.log" 2>&1 &
  drones+=($!)
}
map_line() {
  local line
  line=$(grep -E 'geoloc_fuse: [0-9]+ flights, ' "$out/service.log" | tail -n 1) || return 0  # it has said nothing yet
  sed -E "s/^geoloc_fuse: ([0-9]+ flights, [0-9]+ objects); summaries: (.*); (found .*, RMSE [^(]*)\(.*/$(printf '%4d s' $((SECONDS - began)))  \1, \3 (summaries: \2)/" <<<"$line"
}
watch_for() {  # SECONDS
  local until=$((SECONDS + $1))
  while [ $SECONDS -lt $until ]; do sleep 5; map_line; done
}

say "The page is at http://127.0.0.1:$port/ - flying at $speed times real time"
began=$SECONDS
: >"$out/service.log"
start_service
for drone in 1 2 3 4; do launch "$drone"; done
watch_for 20
say "The service is killed"
kill_now "$service"; start_service
for drone in 5 6 7 8; do launch "$drone"; done
watch_for 15
say "The broker is killed, for 20 s"
kill_now "$broker"
sleep 10
say "The service is killed, too"
kill_now "$service"; start_service
sleep 10
start_broker
launch 9
say "The broker is back; a drone with its base 5 m off flies, and someone sends nonsense"
python3 - "$broker_port" <<'PYTHON'
import os, socket, struct, sys
def text(value): return struct.pack(">H", len(value)) + value
def packet(kind, body):
    size, left = b"", len(body)
    while True:
        size, left = size + bytes([left % 128 | (128 if left > 127 else 0)]), left // 128
        if not left: return bytes([kind]) + size + body
with socket.create_connection(("127.0.0.1", int(sys.argv[1]))) as broker:
    broker.sendall(packet(0x10, text(b"MQTT") + b"\x04\x02\x00\x3c" + text(b"nonsense")))
    broker.recv(4)
    for topic, payload in ((b"geoloc/v1/demo/intruder/summary", os.urandom(5000)), (b"geoloc/v1/demo/drone-1/summary", b"geolocFS" + bytes(200))):
        broker.sendall(packet(0x31, text(topic) + payload))
    broker.sendall(packet(0xE0, b""))
PYTHON
watch_for 15
say "The database is restarted"
database restart -m immediate -w -l "$work/database.log" >/dev/null
watch_for 5
for i in 3 4 5; do
  say "The service is killed again ($i)"
  kill_now "$service"; start_service
  watch_for 5
done
while [ "$(jobs -rp | grep -cxF "$(printf '%s\n' "${drones[@]}")")" -gt 0 ]; do watch_for 5; done
drones=()
sleep 5  # what was sent last is fused
say "All have landed; the service is told to end"
kill -INT "$service"; wait "$service" || true
service=

say "The same, undisturbed"
"$bin/geoloc_fuse" "$out"/drone-[1-9].fs --truth "$work/truth.geojson" --out "$out/undisturbed.geojson" 2>"$out/undisturbed.log"
"$bin/geoloc_fuse" "$out"/drone-[1-8].fs --truth "$work/truth.geojson" --out "$work/eight.geojson" 2>"$work/eight.log"
ask "SELECT id, ST_Y(position::geometry), ST_X(position::geometry) FROM geoloc.objects WHERE fleet = 'demo' AND status = 'present'" >"$work/rows"
ask "SELECT count(*) FILTER (WHERE status = 'retracted'), (SELECT count(*) FROM geoloc.history) FROM geoloc.objects" >"$work/changes"
python3 scripts/fleet_table.py "$out" "$work"
sed -n '/^flight /,$p' "$out/undisturbed.log"
echo "map         $out/map.geojson"
echo "logs        $out/*.log"
