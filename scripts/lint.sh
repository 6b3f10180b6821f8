#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/lint.sh: formatting (clang-format) and static analysis (clang-tidy) of all our sources.
# Needs build/release configured: scripts/test.sh does that.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
source scripts/packages.sh
install_packages "${LINT_PACKAGES[@]}"

mapfile -t sources < <(git ls-files '*.cpp' '*.hpp')
say "clang-format on ${#sources[@]} files"
clang-format --dry-run --Werror "${sources[@]}"

mapfile -t units < <(git ls-files 'src/*.cpp' 'apps/*.cpp' 'examples/*.cpp')
say "clang-tidy on ${#units[@]} files"
printf '%s\n' "${units[@]}" | xargs -P "$(nproc)" -n 4 clang-tidy -p build/release --quiet 2>/dev/null
