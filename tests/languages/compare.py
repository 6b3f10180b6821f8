# SPDX-License-Identifier: Apache-2.0
"""compare.py ONE OTHER: whether two answers to a feed (feed.py) agree: the same frames and objects, and numbers to 1e-9 of 1, or of their size."""

import pathlib
import sys

from feed import doubles

TOLERANCE = 1e-9
WHOLE = {"F": 3, "O": 6}  # so many words of a line are to be the same


def main(one, other):
    lines = [pathlib.Path(path).read_text().splitlines() for path in (one, other)]
    if len(lines[0]) != len(lines[1]) or not any(line.startswith("O") for line in lines[0]):
        sys.exit(f"{one} has {len(lines[0])} lines, {other} {len(lines[1])}")
    worst = 0.0
    for a, b in zip(*lines):
        whole = WHOLE[a[0]]
        if a.split()[:whole] != b.split()[:whole]:
            sys.exit(f"{one}: {a}\n{other}: {b}")
        for x, y in zip(doubles(a.split()[whole:]), doubles(b.split()[whole:])):
            worst = max(worst, abs(x - y) / max(1.0, abs(x)))
    if not worst <= TOLERANCE:
        sys.exit(f"numbers differ by {worst:.2g}, more than {TOLERANCE:g}")
    objects = sum(line.startswith("O") for line in lines[0])
    print(f"{len(lines[0]) - objects} frames and {objects} objects agree, numbers to {worst:.2g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
