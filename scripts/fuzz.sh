#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/fuzz.sh [SECONDS]: builds the fuzz targets with clang and runs each for SECONDS (default 60), as many at a time as
# there are cores. Inputs that broke one are in build/fuzz/broken.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
export SECONDS_EACH=${1:-60}
mkdir -p build
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}" "${GDAL_PACKAGES[@]}" "${LINT_PACKAGES[@]}"
say "Configuring (fuzz)"
cmake --preset fuzz >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
say "Building (fuzz)"
cmake --build build/fuzz --target fuzzers

# A target starts from well-formed inputs and from those that earlier runs found here.
fuzz() {
  local name=$1 corpus=build/fuzz/corpus/$1 log=build/fuzz/$1.log seeds=()
  case $name in
    mavlink | tlog) seeds=(tests/data/mavlink) ;;
    stills) seeds=(tests/data/stills) ;;
    picture) seeds=(tests/data/detection) ;;
    onnx_metadata) seeds=(tests/data/onnx) ;;
    *) [ ! -d "tests/fuzz/seeds/$name" ] || seeds=("tests/fuzz/seeds/$name") ;;
  esac
  mkdir -p "$corpus" build/fuzz/broken
  "build/fuzz/bin/${name}_fuzz" -max_total_time="$SECONDS_EACH" -max_len=4096 -timeout=10 -rss_limit_mb=2048 \
    -print_final_stats=1 -artifact_prefix="build/fuzz/broken/$name-" "$corpus" "${seeds[@]}" 2>"$log" ||
    { tail -n 40 "$log"; return 1; }
  echo "$name: $(grep -o 'number_of_executed_units: .*' "$log")"
}
export -f fuzz
targets=(build/fuzz/bin/*_fuzz)
say "Fuzzing ${#targets[@]} targets, $SECONDS_EACH s each"
printf '%s\n' "${targets[@]}" | sed 's#.*/##; s#_fuzz$##' | xargs -P "$(nproc)" -I{} bash -c 'fuzz {}'
