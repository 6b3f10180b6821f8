#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/results.sh: regenerates the figures and charts of docs/results.md: every flight, every sweep, and nine runs with
# rendered images. Takes about ten minutes on two cores. The sentences there are written by hand: check them afterwards.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
[ $# -eq 0 ] || { sed -n '3,4s/^# //p' "$0"; [ "$1" = --help ] && exit 0; exit 2; }

mkdir -p build
source scripts/packages.sh
install_packages "${BUILD_PACKAGES[@]}"
[ -f build/release/build.ninja ] || configure release "${PROGRAMS_ONLY[@]}"
say "Building"
cmake --build build/release --target geoloc_eval
say "Evaluating"
rm -rf build/results
build/release/bin/geoloc_eval --known-points 2 --sweep all --report build/results >/dev/null
build/release/bin/geoloc_eval --hills-m 1.5 --report build/results/hills >/dev/null
for flight in stock_path1 stock_path2 stock_path3; do
  build/release/bin/geoloc_eval --flights none --seeds 0 --method joint --rendered --rendered-flight "$flight" \
    --report "build/results/$flight" >/dev/null
done

say "Writing docs/results.md"
python3 - build/results docs/results.md <<'PYTHON'
import pathlib, re, sys

folder, page = (pathlib.Path(name) for name in sys.argv[1:])


def blocks_of(report):
    return dict(re.findall(r"<!-- begin (\w+) -->\n(.*?)<!-- end \1 -->\n", report.read_text(), re.DOTALL))


blocks = blocks_of(folder / "report.md")
rendered = [blocks_of(report)["rendered"] for report in sorted(folder.glob("stock_path*/report.md"))]
head = rendered[0].splitlines(keepends=True)[:2]
blocks["rendered"] = "".join(head + [row for block in rendered for row in block.splitlines(keepends=True)[2:]])
blocks["hills"] = blocks_of(folder / "hills" / "report.md")["table"].split("\n\n")[0] + "\n"
text, filled = re.subn(r"(<!-- begin (\w+) -->\n).*?(<!-- end \2 -->\n)",
                       lambda found: found[1] + blocks.pop(found[2]) + found[3], page.read_text(), flags=re.DOTALL)
if blocks or not filled:
    sys.exit(f"{page}: lacks the comments 'begin' and 'end' of: {', '.join(blocks)}")
page.write_text(text)
PYTHON
mkdir -p docs/images/results
rm -f docs/images/results/*.svg
cp build/results/*.svg docs/images/results/
say "Done. The page for reading: build/results/report.html"
