# SPDX-License-Identifier: Apache-2.0
"""docs/formats.md's scoring, and the cost that the tuning minimises."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

FARTHEST_MATCH_M = 3.0


@dataclass(frozen=True)
class Score:
    rmse_m: float
    relative_rmse_m: float
    found: int
    targets: int
    extra: int
    merged_pairs: int


def score(objects: np.ndarray, targets: np.ndarray) -> Score:
    """Objects (n, 2) matched one-to-one to targets (m, 2), east and north [m], at minimum total distance within 3 m."""
    objects = np.asarray(objects, dtype=float).reshape(-1, 2)
    distances = cdist(objects, targets)
    rows, columns = linear_sum_assignment(np.minimum(distances, FARTHEST_MATCH_M))
    near = distances[rows, columns] <= FARTHEST_MATCH_M
    rows, columns = rows[near], columns[near]
    errors = objects[rows] - targets[columns]
    lost = np.setdiff1d(np.arange(len(targets)), columns)
    beside_found = cdist(targets[lost], targets[columns]) <= FARTHEST_MATCH_M
    return Score(
        rmse_m=root_mean_square(errors),
        relative_rmse_m=root_mean_square(errors - errors.mean(axis=0)) if len(errors) else 0.0,
        found=len(rows),
        targets=len(targets),
        extra=len(objects) - len(rows),
        merged_pairs=int(beside_found.any(axis=1).sum()),
    )


def root_mean_square(errors: np.ndarray) -> float:
    """RMS of the lengths of errors (n, 2) [m]; 0 if there are none."""
    return float(np.sqrt((errors**2).sum() / len(errors))) if len(errors) else 0.0


def tuning_cost_m(result: Score) -> float:
    """GOSPA (order 2, cut-off 3 m) per target [m]: a missed target and an extra object each cost half of (3 m)^2."""
    wrong = result.targets - result.found + result.extra
    total = result.found * result.rmse_m**2 + 0.5 * FARTHEST_MATCH_M**2 * wrong
    return float(np.sqrt(total / result.targets))
