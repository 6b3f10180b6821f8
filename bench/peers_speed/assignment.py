# SPDX-License-Identifier: Apache-2.0
"""assignment.py LIBRARY [--sizes N,...] [--seed N]: times of geoloc's assignment and of its peers; run.sh calls it."""
import argparse
import ctypes
import time

import lap
import numpy as np
from scipy.optimize import linear_sum_assignment

ROUND_S = 0.02  # how long a solver works on a small problem before it is the next one's turn
ROUNDS = 25
MOST_S = 40.0   # for one problem; large ones get fewer rounds
LIMIT = 1e6     # no pair is worse than none, but where pairs are gated
GATE = 1.0


def matrices(size, random):
    """{kind: (costs, the cost of leaving a row alone)}."""
    points, others = random.random((2, size, 2))
    near = points + random.normal(0.0, 0.1 / size**0.5, (size, 2))  # each point again, a tenth of the spacing away
    distances = lambda a, b: np.linalg.norm(a[:, None] - b[None], axis=2)
    return {"uniform": (random.random((size, size)), LIMIT),
            "distances in a plane": (distances(points, others), LIMIT),
            "integers 0-99": (random.integers(0, 100, (size, size)).astype(float), LIMIT),
            "uniform, 1 : 2": (random.random((size, 2 * size)), LIMIT),
            "uniform, 2 : 1": (random.random((2 * size, size)), LIMIT),
            "gated": (distances(points, near) * size**0.5, GATE)}


def load(library):
    shim = ctypes.CDLL(library)
    shim.assignment_solver.restype = ctypes.c_void_p
    shim.assignment_time_ns.restype = ctypes.c_double
    solver = ctypes.c_void_p(shim.assignment_solver())

    def geoloc(costs, limit, times):
        columns = np.empty(len(costs), dtype=np.int64)
        took_ns = shim.assignment_time_ns(solver, ctypes.c_void_p(costs.ctypes.data), *map(ctypes.c_long, costs.shape),
                                          ctypes.c_double(limit), ctypes.c_long(times), ctypes.c_void_p(columns.ctypes.data))
        return took_ns * 1e-9, (np.flatnonzero(columns >= 0), columns[columns >= 0])
    return geoloc


def timed(solve):
    """A peer as geoloc() is: its time from Python, the call included."""
    def run(costs, _, times):
        begin = time.perf_counter()
        for _ in range(times):
            result = solve(costs)
        return (time.perf_counter() - begin) / times, result
    return run


def lapjvx(costs):
    _, rows, columns = lap.lapjvx(costs, extend_cost=costs.shape[0] != costs.shape[1])
    return rows, columns


def measure(solvers, costs, limit):
    """{name: median time [s]}; raises where the sums differ."""
    capped = np.minimum(costs, limit)
    # Each in the order that its memory layout asks for: nobody pays for a copy.
    inputs = {name: np.asfortranarray(costs) if name == "geoloc" else np.ascontiguousarray(capped) for name in solvers}
    # What geoloc leaves alone costs the limit, as it does after capping.
    sums = {}
    times, rounds = {}, ROUNDS
    for name, solve in solvers.items():
        took, (rows, columns) = solve(inputs[name], limit, 1)
        sums[name] = capped[rows, columns].sum() + limit * (min(costs.shape) - len(rows))
        times[name] = max(1, int(ROUND_S / max(took, 1e-9)))
        rounds = min(rounds, max(3, int(MOST_S / len(solvers) / max(took, 1e-9))))
    if np.ptp(list(sums.values())) > 1e-9 * max(1.0, abs(sums["geoloc"])):
        raise SystemExit(f"the sums differ: {sums}")
    took = {name: [] for name in solvers}
    for _ in range(rounds):
        for name, solve in solvers.items():
            took[name].append(solve(inputs[name], limit, times[name])[0])
    return {name: np.median(values) for name, values in took.items()}


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("library")
    arguments.add_argument("--sizes", default="10,30,100,300,1000,3000")
    arguments.add_argument("--seed", type=int, default=0)
    options = arguments.parse_args()
    solvers = {"geoloc": load(options.library), "SciPy": timed(linear_sum_assignment), "lapx": timed(lapjvx)}
    print("| n | costs | geoloc [µs] | SciPy | lapx | geoloc / the best peer |\n|---|---|---|---|---|---|")
    for size in map(int, options.sizes.split(",")):
        for kind, (costs, limit) in matrices(size, np.random.default_rng(options.seed)).items():
            median = measure(solvers, costs, limit)
            ours = median.pop("geoloc")
            print(f"| {size} | {kind} | {ours * 1e6:,.1f} | {median['SciPy'] * 1e6:,.1f} | {median['lapx'] * 1e6:,.1f} "
                  f"| **{ours / min(median.values()):.2f}** |", flush=True)


if __name__ == "__main__":
    main()
