#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/test_packages.sh [apt|pip|wheel|arm64…]: makes what users install, in one bare Debian, and installs and uses it in another
# (tests/bare). All take some 30 minutes on two cores; logs are in build/packages_test. FRESH_MACHINE names a program that runs its
# arguments in a clean clone of HEAD on a bare machine, as root; SUITE is the Debian.
set -euo pipefail
cd "$(dirname "$0")/.."
fresh_machine=${FRESH_MACHINE:-../shared/tools/fresh_machine.sh}
[ -f "$fresh_machine" ] || { echo "$fresh_machine is missing: name it with FRESH_MACHINE" >&2; exit 2; }
logs=build/packages_test
mkdir -p "$logs"
[ $# -gt 0 ] || set -- apt pip wheel arm64
say() { printf '\033[1m== %s\033[0m\n' "$*" >&2; }

# on_bare_machine NAME COMMAND…: its messages go to a log, whose end is shown if it fails.
on_bare_machine() {
  say "$1: $logs/$1.log"
  bash "$fresh_machine" bash -c "${@:2}" 2>"$logs/$1.log" || { tail -n 30 "$logs/$1.log" >&2; return 1; }
}

# What was made travels from one machine to the other as an archive by stdout and stdin.
for what in "$@"; do
  case $what in
    apt)
      on_bare_machine deb 'exec 3>&1 1>&2; set -e; apt-get update -q; apt-get install -y -q --no-install-recommends lintian man-db
        bash scripts/packages_deb.sh -DGEOLOC_WARNINGS_AS_ERRORS=ON; lintian --fail-on error out/packages/*.deb; tar c -C out/packages . >&3' >"$logs/debs.tar"
      on_bare_machine apt 'exec 1>&2; mkdir -p out/packages; tar x -C out/packages; bash tests/bare/apt.sh out/packages' <"$logs/debs.tar"
      ;;
    pip)
      on_bare_machine pip 'exec 1>&2; bash tests/bare/pip.sh'
      ;;
    wheel)
      on_bare_machine wheels 'exec 3>&1 1>&2; set -e; apt-get update -q
        apt-get install -y -q --no-install-recommends g++ python3-dev python3-venv libeigen3-dev libgeographiclib-dev binutils
        bash scripts/wheels.sh; tar c -C out/wheels . >&3' >"$logs/wheels.tar"
      on_bare_machine wheel 'exec 1>&2; mkdir -p out/wheels; tar x -C out/wheels; bash tests/bare/wheel.sh out/wheels' <"$logs/wheels.tar"
      ;;
    arm64)
      on_bare_machine arm64 'exec 1>&2; bash scripts/cross_arm64.sh'
      on_bare_machine wheel_arm64 'exec 1>&2; bash scripts/wheel_arm64.sh'
      on_bare_machine programs_arm64 'exec 1>&2; bash scripts/programs_arm64.sh'
      ;;
    *) sed -n '3,5s/^# //p' "$0" >&2; exit 2 ;;
  esac
done
say "Packages that were made on one bare machine work on another: $*"
