# SPDX-License-Identifier: Apache-2.0
"""One recording: its key, and what a worker makes of it."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import pathlib
import signal
import stat
from collections.abc import Iterator
from dataclasses import dataclass

from .. import _core
from ._store import read_result, write_result

OBJECTS, SUMMARY = "objects.geojson", "summary.fs"
#: All of a recording that its objects depend on (docs/formats.md), and not its video.
_INPUTS = ("camera.json", "frames.jsonl", "telemetry.tlog", "config.json", "class_names.json", "counts.json", "truth.geojson")
_CHUNK = 1 << 20


@dataclass(frozen=True)
class Task:
    """What all recordings of a run have in common."""

    results: str
    """The folder of results, one per key."""
    settings: str
    """JSON: over each recording's own."""
    keep_going: bool
    """Bad lines of frames are skipped."""
    version: str
    """Of the package where the run was started."""
    limit_s: float
    """A recording that takes longer fails."""


@dataclass(frozen=True)
class Outcome:
    """What a worker answers of a recording."""

    key: str = ""
    is_kept: bool = False
    """An earlier run had done it."""
    reason: str = ""
    """Why it failed; empty where it did not."""


@functools.cache
def has_geoid() -> bool:
    """Whether objects get heights above the ellipsoid on this computer; asking reads the geoid."""
    return _core.has_geoid()


def _state(recording: pathlib.Path) -> list[tuple[int, int] | None]:
    """Changes with the files."""
    state: list[tuple[int, int] | None] = []
    for name in _INPUTS:
        try:
            about = os.stat(recording / name)
        except FileNotFoundError:
            state.append(None)
            continue
        # A pipe or a device may never end, and is no recording; its reader says so.
        state.append((about.st_size, about.st_mtime_ns) if stat.S_ISREG(about.st_mode) else None)
    return state


def _sum_of(file: pathlib.Path) -> bytes:
    digest = hashlib.sha256()
    with open(file, "rb") as content:
        while chunk := content.read(_CHUNK):
            digest.update(chunk)
    return digest.digest()


def key_of(task: Task, recording: pathlib.Path) -> str:
    """The same for the same files, settings and version, wherever the recording lies; 128 bits of a SHA-256, as text."""
    digest = hashlib.sha256()
    told = (task.version, task.settings, str(task.keep_going), f"geoid {has_geoid()}")
    for part in told:
        digest.update(hashlib.sha256(part.encode()).digest())
    for name, state in zip(_INPUTS, _state(recording)):
        digest.update(bytes(32) if state is None else _sum_of(recording / name))
    return digest.hexdigest()[:32]


@contextlib.contextmanager
def _limited(limit_s: float) -> Iterator[None]:
    """Raises TimeoutError when the time is over: the estimator looks for signals every few frames."""

    def end(*_: object) -> None:
        raise TimeoutError(f"took longer than {limit_s:g} s")

    before = signal.signal(signal.SIGALRM, end)
    signal.setitimer(signal.ITIMER_REAL, limit_s)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def _work(task: Task, recording: pathlib.Path) -> Outcome:
    if _core.version() != task.version:
        raise RuntimeError(f"this worker has geoloc {_core.version()}, and the run was started by {task.version}")
    if os.fsencode(recording).decode(errors="replace") != os.fspath(recording):
        raise ValueError("its name is not UTF-8")
    before = _state(recording)
    key = key_of(task, recording)
    place = pathlib.Path(task.results, key)
    if read_result(place) is not None:
        return Outcome(key, is_kept=True)
    run = _core.Run(os.fspath(recording), task.keep_going, task.settings)
    summary = run.flight_summary("", "")
    files = {OBJECTS: run.geojson().encode()}
    if summary is not None:
        files[SUMMARY] = summary.to_bytes()
    if _state(recording) != before:
        raise RuntimeError("it was changed while it was read")
    flight = None if summary is None else summary.flight
    write_result(place, files, {"version": task.version, "flight": flight, "class_names": run.class_names(), "said": run.summary()})
    return Outcome(key)


def work(task: Task, recording: str) -> Outcome:
    """Does a recording, unless that is done. What it raises is its reason to have failed. To be called in a process's main thread."""
    try:
        with _limited(task.limit_s):
            return _work(task, pathlib.Path(recording))
    except Exception as error:  # of whatever kind: it must fail this recording alone
        return Outcome(reason=str(error) or type(error).__name__)
