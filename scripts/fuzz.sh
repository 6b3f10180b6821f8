#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/fuzz.sh [SECONDS]: builds the fuzz targets with clang and runs each for so long (default 60).
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
seconds=${1:-60}
mkdir -p build
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${LINT_PACKAGES[@]}"
cmake --preset fuzz >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
cmake --build build/fuzz
for target in build/fuzz/bin/*_fuzz; do
  say "$(basename "$target") for $seconds s"
  corpus="build/fuzz/corpus/$(basename "$target")"
  mkdir -p "$corpus"
  "$target" -max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 "$corpus" \
    2>build/fuzz/log.txt || { tail -n 40 build/fuzz/log.txt; exit 1; }
  grep -E 'number_of_executed_units' build/fuzz/log.txt
done
