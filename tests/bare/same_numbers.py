# SPDX-License-Identifier: Apache-2.0
"""same_numbers.py ONE OTHER [TOLERANCE]: whether two texts have the same words, and numbers that differ by at most TOLERANCE (1e-9) of 1 or
of their size, or by one in the last digit that is written, which rounding may turn."""

import pathlib
import re
import sys

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def last_digit(text):
    digits, _, exponent = text.lower().partition("e")
    return 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))


def main(one, other, tolerance=1e-9):
    texts = [pathlib.Path(path).read_text() for path in (one, other)]
    words, numbers = [NUMBER.split(text) for text in texts], [NUMBER.findall(text) for text in texts]
    if words[0] != words[1]:
        at = next((i for i, (a, b) in enumerate(zip(*words)) if a != b), "the end")
        sys.exit(f"{one} and {other} differ in more than numbers, after number {at}")
    worst = 0.0
    for a, b in zip(*numbers):
        difference = abs(float(a) - float(b))
        if difference > max(float(tolerance) * max(1.0, abs(float(a))), 1.01 * last_digit(a)):
            sys.exit(f"{one} has {a} where {other} has {b}")
        worst = max(worst, difference)
    if not numbers[0]:
        sys.exit(f"{one} has no numbers")
    print(f"{len(numbers[0])} numbers of {one} agree, to {worst:.2g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
