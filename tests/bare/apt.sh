#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/bare/apt.sh FOLDER: installs the Debian packages in the folder on a machine that has nothing, and does with them what users do.
set -euo pipefail
cd "$(dirname "$0")/../.."
say() { printf '\033[1m== %s\033[0m\n' "$*" >&2; }
fail() { echo "FAILED: $*" >&2; exit 1; }
install() { DEBIAN_FRONTEND=noninteractive apt-get install -y -q "$@" >build/apt.log 2>&1 || { tail build/apt.log; exit 1; }; }
packages=$(cd "$1" && pwd) work=build/bare
rm -rf "$work"
mkdir -p "$work"
apt-get update -q >/dev/null

say "apt-get install libgeoloc-dev: the library alone, for C and C++"
install --no-install-recommends "$packages"/libgeoloc*.deb gcc libc6-dev
gcc -std=c99 examples/03_from_c.c -lgeoloc_c -lm -o "$work/from_c"
"$work/from_c" | tee "$work/from_c.txt"
grep -q '^object 1: 47\.397969' "$work/from_c.txt" || fail "the C example found no object"
ldd "$work/from_c" | grep -q 'libgeoloc_c\.so\.0 => /\(usr/\)\?lib/' || fail "the C example runs with another library"

say "Consumers by pkg-config and by CMake"
install --no-install-recommends g++ cmake make pkg-config
# shellcheck disable=SC2046 # flags are words
g++ -std=c++17 tests/install/consumer/main.cpp $(pkg-config --cflags --libs geoloc) -o "$work/by_pkg_config"
"$work/by_pkg_config"
# shellcheck disable=SC2046
gcc -std=c99 examples/03_from_c.c $(pkg-config --cflags --libs geoloc_c) -lm -o "$work/c_by_pkg_config"
"$work/c_by_pkg_config" | cmp - "$work/from_c.txt"
for consumer in consumer c_consumer; do
  cp -r "tests/install/$consumer" "$work/$consumer"
  [ -f "$work/$consumer/main.cpp" ] || cp examples/03_from_c.c "$work/$consumer/main.c"
  cmake -S "$work/$consumer" -B "$work/$consumer/build" >"$work/$consumer.log"
  cmake --build "$work/$consumer/build" >>"$work/$consumer.log"
  "$work/$consumer/build/consumer" >/dev/null
done

say "apt-get install geoloc: the programs"
install "$packages"/geoloc_*.deb
for program in geoloc_app geoloc_detect geoloc_eval geoloc_fuse geoloc_import geoloc_replay geoloc_sim; do
  [ "$(command -v "$program")" = "/usr/bin/$program" ] || fail "$program is not installed"
  "$program" --help >"$work/help.txt" || fail "$program --help"
  grep -q 'Usage: ' "$work/help.txt" || fail "$program has no help"
done

say "A flight on the loopback, its model and its telemetry found below /usr/share"
# Three pictures a second, so that a slow computer keeps up; one that is busy besides may still miss some targets.
(cd "$work" && bash ../../scripts/fly.sh /usr/bin flight --frame-rate 3 -- --jsonl /dev/null) 2>&1 | tee "$work/fly.log"
found='found (2[5-9]|30) / 30, RMSE 0\.[01].*extra 0, merged pairs 0'
grep -Eq "$found" "$work/fly.log" || fail "the flight's targets were not found"
geoloc_replay "$work/flight/recording" --out "$work/again.geojson" 2>&1 | grep -Eq "$found" || fail "the replay found others"
geoloc_replay "$work/flight/recording" --klv "$work/again.ts" >/dev/null || fail "--klv"
[ "$(head -c 1 "$work/again.ts")" = G ] || fail "--klv writes no transport stream"

say "apt-get install python3-geoloc: README's program in Python"
install --no-install-recommends "$packages"/python3-geoloc_*.deb
python3 tests/bare/readme_example.py README.md

say "Manual, completions, service"
install --no-install-recommends man-db zsh fish systemd
man geoloc_replay | grep -q -- '--known-points FILE' || fail "man geoloc_replay"
completed=$(bash -c 'source /usr/share/bash-completion/completions/geoloc_app; COMP_WORDS=(geoloc_app --me) COMP_CWORD=1; _geoloc_app
                     echo "${COMPREPLY[*]}"')
[ "$completed" = --method ] || fail "bash completes --me to $completed"
completed=$(bash -c 'source /usr/share/bash-completion/completions/geoloc_import; COMP_WORDS=(geoloc_import stills --layout yolov) COMP_CWORD=3
                     _geoloc_import; echo "${COMPREPLY[*]}"')
[ "$completed" = yolov5 ] || fail "bash completes --layout yolov to $completed"
fish -c 'complete -C "geoloc_app --me"' | grep -q '^--method' || fail "fish completes --me to nothing"
fish -c 'complete -C "geoloc_import vi"' | grep -q '^video' || fail "fish knows no commands"
# Without a terminal, zsh shows what it would complete to functions that take _arguments' place.
for file in /usr/share/zsh/vendor-completions/_geoloc_*; do
  zsh -f -c '_arguments() { print -rl -- "$@" }; _describe() { print -rl -- "$@" }; CURRENT=2; f() { source $1 }; f $1' zsh "$file" >"$work/zsh.txt" ||
    fail "$file"
  grep -q -- '^--help\[' "$work/zsh.txt" || fail "$file knows no --help"
done
systemd-analyze verify /lib/systemd/system/geoloc.service || fail "the service"

say "apt-get purge geoloc leaves nothing"
apt-get purge -y -q geoloc >/dev/null 2>&1
left=$(ls -d /usr/share/geoloc /etc/geoloc /usr/share/doc/geoloc /usr/bin/geoloc_* 2>/dev/null || true)
[ -z "$left" ] || fail "left: $left"
say "The packages do what they promise"
