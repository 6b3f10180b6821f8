#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/openvino.sh: installs OpenVINO, the faster of the two detection back ends, into build/openvino (PyPI, pinned version, 60
# MB download). Builds configured afterwards include it; without it everything except --backend openvino works.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
[ $# -eq 0 ] || { sed -n '3,4s/^# //p' "$0"; [ "$1" = --help ] && exit 0; exit 2; }
mkdir -p build
source scripts/packages.sh
install_packages python3 python3-venv

venv=build/openvino wanted="openvino==$OPENVINO_VERSION"
[ "$(cat "$venv/installed.txt" 2>/dev/null)" != "$wanted" ] || exit 0
say "Installing $wanted into $venv"
rm -rf "$venv"
python3 -m venv "$venv"
# The C++ library needs none of the packages that the Python module needs.
"$venv/bin/pip" install --quiet --disable-pip-version-check --no-deps "$wanted" >build/openvino.log 2>&1 ||
  { tail -n 20 build/openvino.log >&2; echo "pip could not install $wanted, which needs PyPI" >&2; exit 1; }
echo "$wanted" >"$venv/installed.txt"
