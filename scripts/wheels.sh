#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/wheels.sh [PYTHON…]: wheels of the Python package in out/wheels, by the interpreters given (default: python3), each with the
# libraries that it needs inside. They run on Linuxes whose C library is no older than this one's; that of Python 3.12 or a later one
# serves every later Python, too. Needs what pip install . needs.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
source scripts/packages.sh
mkdir -p build out/wheels
tools=build/wheel-tools
install_from_pypi "$tools" scripts/wheels_requirements.txt --only-binary :all: --no-deps

export CCACHE_BASEDIR=$ROOT CCACHE_NOHASHDIR=true  # the library is compiled once for all interpreters
[ $# -gt 0 ] || set -- python3
for python in "$@"; do
  version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
  say "Building for Python $version"
  rm -rf "build/wheels/$version"
  "$python" -m venv "build/wheels/$version"
  "build/wheels/$version/bin/pip" wheel --quiet --disable-pip-version-check --no-deps . -w "build/wheels/$version"
  PATH="$ROOT/$tools/bin:$PATH" "$tools/bin/auditwheel" repair -w out/wheels "build/wheels/$version"/geoloc-*.whl
done
