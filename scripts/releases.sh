#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/releases.sh [bookworm|trixie…]: runs README's two commands on a bare machine of each Debian release, with warnings
# as errors. Takes some 20 minutes each. Logs: build/releases. FRESH_MACHINE names a program that runs its arguments in a
# clean clone of HEAD on such a machine, with SUITE in its environment.
set -euo pipefail
cd "$(dirname "$0")/.."
fresh_machine=${FRESH_MACHINE:-../shared/tools/fresh_machine.sh}
[ -x "$fresh_machine" ] || [ -f "$fresh_machine" ] || { echo "$fresh_machine is missing: name it with FRESH_MACHINE" >&2; exit 2; }
[ $# -gt 0 ] || set -- bookworm trixie
mkdir -p build/releases
failed=0
for suite in "$@"; do
  log=build/releases/$suite.log
  echo "== $suite: $log" >&2
  SUITE=$suite bash "$fresh_machine" bash -c \
    'bash scripts/demo.sh --fast && bash scripts/test.sh release -DGEOLOC_WARNINGS_AS_ERRORS=ON' >"$log" 2>&1 ||
    { failed=1; echo "$suite FAILED" >&2; tail -n 20 "$log" >&2; }
  grep -h -E '^found |tests passed' "$log" || true
done
exit "$failed"
