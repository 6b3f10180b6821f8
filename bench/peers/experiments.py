# SPDX-License-Identifier: Apache-2.0
"""Runs the simulator and geoloc, several at once, and caches Stone Soup's results."""

import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from importlib.metadata import version
from itertools import product
from pathlib import Path

import generic_tracker
import numpy as np
from generic_tracker import TrackerSettings, track_objects
from recordings import Run, read_points_deg, read_run
from scoring import Score

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "build" / "peers"
BIN = ROOT / "build" / "release" / "bin"
SUMMARY = re.compile(
    r"found (\d+) / (\d+), RMSE ([\d.]+) m \(relative ([\d.]+) m\), extra (\d+), merged pairs (\d+)"
)


@dataclass(frozen=True)
class Experiment:
    set_name: str
    path: int
    scenario: int
    seed: int

    @property
    def name(self) -> str:
        return f"{self.set_name}_path{self.path}_scenario{self.scenario}_seed{self.seed}"


def all_experiments(
    sets: Iterable[str], seeds: Iterable[int], paths: Iterable[int] = range(1, 7)
) -> list[Experiment]:
    return [Experiment(*key) for key in product(sets, paths, (1, 2, 3), seeds)]


@dataclass(frozen=True)
class Replayed:
    """geoloc's results for a recording."""

    method: str
    objects_deg: np.ndarray  # (n, 2) longitude, latitude
    printed: Score
    cpu_s: float  # of the whole program


def run_program(*command: str | Path) -> tuple[str, float]:
    """Standard error of a program that must succeed, and its CPU time [s]."""
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        text = errors.read().decode(errors="replace")
    if process.returncode != 0:
        raise RuntimeError(f"'{' '.join(map(str, command))}' ended with {process.returncode}: {text.strip()}")
    return text, usage.ru_utime + usage.ru_stime


def replay(recording: Path, method: str, *options: str | Path) -> Replayed:
    out = recording.parent / f"{method}.geojson"
    text, cpu_s = run_program(BIN / "geoloc_replay", recording, "--method", method, "--out", out, *options)
    printed = SUMMARY.search(text)
    if printed is None:
        raise RuntimeError(f"SUMMARY in {__file__} must follow what geoloc_replay prints: {text.strip()}")
    found, targets, rmse_m, relative_m, extra, merged = printed.groups()
    score = Score(float(rmse_m), float(relative_m), int(found), int(targets), int(extra), int(merged))
    return Replayed(f"geoloc {method}", read_points_deg(out), score, cpu_s)


def record_and_replay(experiment: Experiment) -> tuple[Run, list[Replayed]]:
    """The fixes of a new recording, located by the paper's method, and geoloc's objects by both methods."""
    with tempfile.TemporaryDirectory(prefix="run-", dir=OUT) as name:
        recording, raw = Path(name, "recording"), Path(name, "raw.csv")
        flight = f"{experiment.set_name}_path{experiment.path}"
        scenario, seed = str(experiment.scenario), str(experiment.seed)
        run_program(
            *(BIN / "geoloc_sim", "--record", recording, "--flight", flight, "--scenario", scenario, "--seed", seed)
        )
        replayed = [replay(recording, "paper", "--raw", raw), replay(recording, "joint")]
        return read_run(recording, raw, ROOT / "data" / "flights"), replayed


def track_cached(run: Run, settings: TrackerSettings) -> tuple[np.ndarray, float]:
    """Stone Soup's objects [m] and CPU time [s]; from build/peers/cache if it holds the same input."""
    key = hashlib.sha256(Path(generic_tracker.__file__).read_bytes())
    key.update(json.dumps([asdict(settings), version("stonesoup"), [str(time) for time in run.times]]).encode())
    for fixes in run.fixes:
        key.update(fixes.tobytes() + b"|")
    cache = OUT / "cache" / f"{key.hexdigest()[:32]}.json"
    if cache.exists():
        known = json.loads(cache.read_text())
        return np.array(known["objects"]).reshape(-1, 2), known["cpu_s"]
    objects, cpu_s = track_objects(run.times, run.fixes, settings)
    cache.parent.mkdir(parents=True, exist_ok=True)
    beside = cache.with_suffix(f".{os.getpid()}")
    beside.write_text(json.dumps({"objects": objects.tolist(), "cpu_s": cpu_s}))
    beside.replace(cache)
    return objects, cpu_s


def for_all(work: Callable[[Experiment], list], experiments: list[Experiment], jobs: int) -> Iterator:
    """The results of `work`, from several processes, in the order of the experiments; shows progress."""
    results = {}
    with ProcessPoolExecutor(jobs) as pool:
        waiting = {pool.submit(work, experiment): experiment for experiment in experiments}
        for done, future in enumerate(as_completed(waiting), start=1):
            try:
                results[waiting[future]] = future.result()
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
            end = "\r" if sys.stderr.isatty() and done < len(waiting) else "\n"
            line = f"{done}/{len(waiting)} {waiting[future].name}"
            print(f"{line:<50}", end=end, file=sys.stderr, flush=True)
    for experiment in experiments:
        yield from results[experiment]
