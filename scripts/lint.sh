#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/lint.sh [FILE.cpp…]: formatting (clang-format) of all our sources, and static analysis (clang-tidy) of the files given,
# or of the programs and trackers: all files would take a quarter of an hour. Needs build/release configured: scripts/test.sh
# does that.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
mkdir -p build
source scripts/packages.sh
install_packages "${LINT_PACKAGES[@]}"

mapfile -t sources < <(git ls-files '*.cpp' '*.hpp')
say "clang-format on ${#sources[@]} files"
clang-format --dry-run --Werror "${sources[@]}"

units=("$@")
if [ $# -eq 0 ]; then
  mapfile -t units < <(git ls-files 'apps/app/*.cpp' 'apps/common/*.cpp' 'apps/eval/*.cpp' 'src/calibration/full_tracker.cpp' \
    'src/tracking/paper_tracker.cpp')
fi
say "clang-tidy on ${#units[@]} files"
clang-tidy --verify-config >/dev/null 2>&1 || clang-tidy --dump-config >/dev/null  # a file it cannot read would check nothing
printf '%s\n' "${units[@]}" | xargs -P "$(nproc)" -n 4 clang-tidy -p build/release --quiet
