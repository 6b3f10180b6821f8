#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/confidence_table.py [BIN]: the table of docs/method.md that shows what a detector's confidence is worth among false boxes.

Each cell is the targets found, the extra objects and the mean RMSE of four simulated flights with 30 targets each. Confidences that are all
alike say nothing, so that they stand for an estimator that knows none.
"""
import pathlib
import sys
import tempfile

from recorded_flights import BUILT, mean_rmse_m, replay, simulate

BIN = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else BUILT
FLIGHTS = "stock_path1", "stock_path3"
SEEDS = 1, 2
ROWS = (0.5, 0.05), (3, 0.05), (8, 0.05), (8, 0.5)  # false boxes in a frame, share of the true ones missing
ALIKE = "--confidence", "0.5,0.5", "--clutter-confidence", "0.5,0.5"
TELLING = "--confidence", "0.3,0.6", "--clutter-confidence", "0.25,0.35"


def score(flight, seed, clutter, missing, confidences):
    with tempfile.TemporaryDirectory(prefix="geoloc-confidence-") as folder:
        recording = pathlib.Path(folder) / "recording"
        simulate(BIN, recording, "--flight", flight, "--seed", seed, "--clutter-rate", clutter, "--miss-rate", missing, *confidences)
        return replay(BIN, recording)


def cell(clutter, missing, confidences):
    scores = [score(flight, seed, clutter, missing, confidences) for flight in FLIGHTS for seed in SEEDS]
    return f"{sum(s.found for s in scores)}, {sum(s.extra for s in scores)}, {mean_rmse_m(scores):.3f}"


def main():
    print("| false boxes in a frame | true boxes missing | all alike: found, extra, RMSE m | as drawn |\n|---|---|---|---|")
    for clutter, missing in ROWS:
        print(f"| {clutter} | {100 * missing:.0f} % | {cell(clutter, missing, ALIKE)} | {cell(clutter, missing, TELLING)} |", flush=True)


if __name__ == "__main__":
    main()
