#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/bare/wheel.sh FOLDER: installs this Python's wheel from the folder with nothing but Python, then README's program in Python.
set -euo pipefail
cd "$(dirname "$0")/../.."
mkdir -p build
apt-get update -q >/dev/null
DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends python3-venv >build/apt.log 2>&1 || { tail build/apt.log; exit 1; }
if command -v g++ >/dev/null; then echo "This machine has a compiler" >&2; exit 1; fi
python3 -m venv build/wheel-venv
build/wheel-venv/bin/pip install --disable-pip-version-check --only-binary :all: 'numpy>=1.24'
# PyPI's geoloc is another project.
build/wheel-venv/bin/pip install --disable-pip-version-check --no-index --find-links "$1" geoloc
build/wheel-venv/bin/python tests/bare/readme_example.py README.md
