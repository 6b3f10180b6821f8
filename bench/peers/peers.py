# SPDX-License-Identifier: Apache-2.0
"""geoloc and its competitors on the same fixes. Started by run.sh; see README.md."""

import argparse
import json
import os
import sys
from dataclasses import asdict, replace
from functools import partial
from importlib.metadata import version
from time import process_time

import numpy as np
from experiments import OUT, Experiment, all_experiments, for_all, record_and_replay, track_cached
from generic_tracker import TrackerSettings
from recordings import CLUTTER, Run, to_metres
from scoring import Score, score
from tuning import SEED as TUNING_SEED
from tuning import read_tuned, tune


def mean_of_fixes(run: Run) -> tuple[np.ndarray, float]:
    """Mean of all fixes of each target that was ever seen [m], and the CPU time [s]."""
    begin = process_time()
    fixes, labels = np.concatenate(run.fixes), np.concatenate(run.labels)
    means = [fixes[labels == target].mean(axis=0) for target in np.unique(labels[labels != CLUTTER])]
    return np.array(means), process_time() - begin


def require_agreement(name: str, ours: Score, printed: Score) -> None:
    """Our scorer against geoloc's own, which prints millimetres."""
    counts_differ = replace(ours, rmse_m=0, relative_rmse_m=0) != replace(printed, rmse_m=0, relative_rmse_m=0)
    apart_m = max(abs(ours.rmse_m - printed.rmse_m), abs(ours.relative_rmse_m - printed.relative_rmse_m))
    if counts_differ or apart_m > 0.001:
        raise RuntimeError(
            f"{name}: bench/peers/scoring.py and geoloc_replay disagree, one of them is wrong: {ours}, {printed}"
        )


def compare(tuned: dict[str, TrackerSettings], experiment: Experiment) -> list[dict]:
    """One row per method for one recording."""
    run, replayed = record_and_replay(experiment)
    results = []
    for geoloc in replayed:
        result = score(to_metres(geoloc.objects_deg, run.origin_deg), run.targets)
        require_agreement(f"{experiment.name}, {geoloc.method}", result, geoloc.printed)
        results.append((geoloc.method, result, geoloc.cpu_s))
    objects, cpu_s = track_cached(run, tuned[experiment.set_name])
    results.append(("Stone Soup GNN", score(objects, run.targets), cpu_s))
    objects, cpu_s = mean_of_fixes(run)
    results.append(("mean of fixes, associations known", score(objects, run.targets), cpu_s))
    return [asdict(experiment) | {"method": name} | asdict(s) | {"cpu_s": cpu_s} for name, s, cpu_s in results]


def to_markdown(rows: list[dict]) -> str:
    """Means over the runs of RMSE and CPU time, sums of the counts."""
    lines = [
        "| set | method | runs | RMSE m | relative RMSE m | found | extra | merged pairs | CPU s per run |",
        "|---" * 9 + "|",
    ]
    for key in dict.fromkeys((row["set_name"], row["method"]) for row in rows):
        group = [row for row in rows if (row["set_name"], row["method"]) == key]
        total = {name: sum(row[name] for row in group) for name in Score.__annotations__ | {"cpu_s": float}}
        mean = {name: value / len(group) for name, value in total.items()}
        lines.append(
            f"| {' | '.join(key)} | {len(group)} | {mean['rmse_m']:.3f} | {mean['relative_rmse_m']:.3f} "
            f"| {total['found']}/{total['targets']} | {total['extra']} | {total['merged_pairs']} "
            f"| {mean['cpu_s']:.3f} |"
        )
    return "\n".join(lines) + "\n"


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="run.sh", description=__doc__)
    parser.add_argument("--seeds", default="0,1,2", help="seeds of targets and errors [%(default)s]")
    parser.add_argument("--sets", default="stock,gnss", help="sets of flights [%(default)s]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at once [%(default)s]")
    parser.add_argument("--tune", action="store_true", help=f"choose Stone Soup's settings, on seed {TUNING_SEED}")
    options = parser.parse_args()
    options.sets = options.sets.split(",")
    if not set(options.sets) <= {"stock", "gnss"}:
        parser.error("--sets takes stock, gnss, or both with a comma between them")
    try:
        options.seeds = [int(seed) for seed in options.seeds.split(",")]
    except ValueError:
        parser.error("--seeds takes whole numbers with commas between them, such as 0,1,2")
    if min(options.seeds) < 0 or options.jobs < 1:
        parser.error("--seeds takes numbers from 0 on, --jobs from 1 on")
    if TUNING_SEED in options.seeds:
        parser.error(f"Stone Soup was tuned on seed {TUNING_SEED}; take others")
    return options


def main() -> None:
    options = parse_arguments()
    if options.tune:
        tune(options.sets, options.jobs)
        return
    tuned = read_tuned()
    experiments = all_experiments(options.sets, options.seeds)
    rows = list(for_all(partial(compare, tuned), experiments, options.jobs))
    table = to_markdown(rows)
    settings = {name: asdict(values) for name, values in tuned.items()}
    document = {"stone_soup": version("stonesoup"), "settings": settings, "runs": rows}
    (OUT / "peers.md").write_text(table)
    (OUT / "peers.json").write_text(json.dumps(document, indent=1) + "\n")
    print(table, end="")
    print(f"Written to {OUT / 'peers.md'} and {OUT / 'peers.json'}", file=sys.stderr)


if __name__ == "__main__":
    try:
        main()
    except (RuntimeError, OSError, ValueError) as error:
        sys.exit(f"run.sh: {error}")
