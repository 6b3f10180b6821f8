#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/bare/pip.sh: pip install . with the packages that README names for it, then README's program in Python.
set -euo pipefail
cd "$(dirname "$0")/../.."
mkdir -p build
packages=$(tr '\n' ' ' <README.md | grep -o 'apt-get install g++ python3-dev[^`]*' | cut -d ' ' -f 3-)
[ -n "$packages" ] || { echo "README.md names no packages for pip install ." >&2; exit 1; }
apt-get update -q >/dev/null
# shellcheck disable=SC2086 # names are words
DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $packages >build/apt.log 2>&1 || { tail build/apt.log; exit 1; }
python3 -m venv build/bare-venv
build/bare-venv/bin/pip install --disable-pip-version-check .
build/bare-venv/bin/python tests/bare/readme_example.py README.md
