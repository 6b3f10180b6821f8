#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/lint.sh [FILE.cpp…]: checks formatting (clang-format) of all our sources, and runs static analysis (clang-tidy) on the
# files given, or on every file that build/release compiles: library, programs, examples, tests and benchmarks, with those of our
# headers that they include. Only most fuzz targets, the Python module, the installation test's consumer, apps/sim/no_live_mode.cpp,
# src/io/json/no_camera_yaml.cpp, src/io/klv/no_transport_stream.cpp and src/io/live_page/no_http_server.cpp are left out. Needs build/release configured, as scripts/test.sh does. Takes five minutes
# on two idle cores.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
mkdir -p build
source scripts/packages.sh
install_packages "${LINT_PACKAGES[@]}"

mapfile -t sources < <(git ls-files '*.cpp' '*.hpp')
say "clang-format on ${#sources[@]} files"
clang-format --dry-run --Werror "${sources[@]}"

say "clang-tidy"
clang-tidy --verify-config >/dev/null 2>&1 || clang-tidy --dump-config >/dev/null  # an unreadable file would check nothing
python3 scripts/tidy.py build/release "$@"
