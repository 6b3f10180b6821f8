# SPDX-License-Identifier: Apache-2.0
"""Chooses Stone Soup's settings on a seed that is never scored."""

import json
import sys
from dataclasses import asdict, replace
from functools import partial
from itertools import product
from pathlib import Path

import numpy as np
from experiments import OUT, Experiment, all_experiments, for_all, record_and_replay, track_cached
from generic_tracker import TrackerSettings
from scoring import Score, score, tuning_cost_m

TUNED = Path(__file__).with_name("tuned.json")
SEED = 7
PATHS = (1, 3, 6)
GATE = 3.0
NOISES_M = (0.65, 0.8, 1.0, 1.3, 1.7, 2.2)
CONFIRM_HITS = (3, 6, 12, 24)
HOLDS_S = (0.5, 2.0, 8.0)
DRIFTS_M = (0.0, 0.02)

Candidates = dict[str, list[TrackerSettings]]  # per set of flights


def read_tuned() -> dict[str, TrackerSettings]:
    """The settings chosen per set of flights."""
    if not TUNED.exists():
        raise RuntimeError(f"{TUNED} is missing: git checkout it, or make it anew with run.sh --tune")
    return {name: TrackerSettings(**values) for name, values in json.loads(TUNED.read_text()).items()}


def try_candidates(
    candidates: Candidates, experiment: Experiment
) -> list[tuple[str, TrackerSettings, Score]]:
    """The score of each candidate on one recording."""
    run, _ = record_and_replay(experiment)
    name = experiment.set_name
    return [(name, settings, score(track_cached(run, settings)[0], run.targets)) for settings in candidates[name]]


def choose(candidates: Candidates, jobs: int, lines: list[str]) -> dict[str, TrackerSettings]:
    """The candidate with the least mean cost per set; adds one line per candidate to the table."""
    scored = list(for_all(partial(try_candidates, candidates), all_experiments(candidates, [SEED], PATHS), jobs))
    best = {}
    for set_name, settings_of_set in candidates.items():
        costs = {}
        for settings in settings_of_set:
            results = [result for name, tried, result in scored if (name, tried) == (set_name, settings)]
            costs[settings] = np.mean([tuning_cost_m(result) for result in results])
            found, extra = sum(result.found for result in results), sum(result.extra for result in results)
            targets = sum(result.targets for result in results)
            rmse_m = np.mean([result.rmse_m for result in results])
            lines.append(
                f"| {set_name} | {' | '.join(map(str, asdict(settings).values()))} "
                f"| {costs[settings]:.3f} | {rmse_m:.3f} | {found}/{targets} | {extra} |"
            )
        best[set_name] = min(costs, key=costs.get)
    return best


def tune(sets: list[str], jobs: int) -> None:
    """Noise and hits first, holding time and drift around the best of them; writes tuned.json and tuning.md."""
    lines = [
        "| set | noise m | gate | hits | hold s | drift m/√s | cost m | RMSE m | found | extra |",
        "|---" * 10 + "|",
    ]
    grid = [TrackerSettings(noise_m, GATE, hits, 2.0, 0.0) for noise_m, hits in product(NOISES_M, CONFIRM_HITS)]
    best = choose(dict.fromkeys(sets, grid), jobs, lines)
    around = {
        name: [replace(settings, hold_s=hold_s, drift_m=drift_m) for hold_s, drift_m in product(HOLDS_S, DRIFTS_M)]
        for name, settings in best.items()
    }
    tuned = (read_tuned() if TUNED.exists() else {}) | choose(around, jobs, lines)
    TUNED.write_text(json.dumps({name: asdict(settings) for name, settings in tuned.items()}, indent=2) + "\n")
    (OUT / "tuning.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    print(f"Written to {TUNED} and {OUT / 'tuning.md'}", file=sys.stderr)
