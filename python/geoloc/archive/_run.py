# SPDX-License-Identifier: Apache-2.0
"""The run over an archive."""

from __future__ import annotations

import collections
import json
import os
import pathlib
import time
from collections.abc import Iterable, Mapping
from typing import Any

from .. import _core
from .._settings import to_json
from ._job import Task
from ._maps import write_maps
from ._progress import Progress
from ._recordings import find_recordings
from ._report import Entry, Report
from ._store import lock, remove_partial
from ._workers import Processes, RayWorkers, Workers

_LOOK_S = 0.2  # how often the progress may be shown


def _settings(settings: Mapping[str, Any]) -> str:
    """Canonical, and without names of files, so that every worker has the same. Raises ValueError that names every fault."""
    own = json.loads(to_json(settings))
    if own.setdefault("method", "joint") != "joint":
        raise ValueError('method must be "joint": another one does not know what its objects are off by in common, and cannot be fused')
    complete = json.loads(_core.complete_settings(json.dumps(own)))
    if "camera" in own:
        own["camera"] = complete["camera"]
    return json.dumps(own, sort_keys=True)


def _work_off(entries: list[Entry], workers: Workers, tries: int, progress: Progress) -> None:
    """Until every recording is done, or has failed so often. One that failed goes to the end of the queue."""
    queue = collections.deque(entries)
    running: dict[str, Entry] = {}
    while queue or running:
        for _ in range(min(workers.room(), len(queue))):
            entry = queue.popleft()
            entry.tries += 1
            running[entry.recording] = entry
            workers.start(entry.recording)
        for recording, outcome in workers.wait(_LOOK_S):
            entry = running.pop(recording)
            entry.key, entry.reason = outcome.key, outcome.reason
            if outcome.reason and entry.tries < tries:
                queue.append(entry)
                continue
            entry.state = "failed" if outcome.reason else "kept" if outcome.is_kept else "done"
            progress.add(bool(outcome.reason))
        progress.show()


def run(
    places: Iterable[str | os.PathLike[str]],
    out: str | os.PathLike[str],
    settings: Mapping[str, Any] | None = None,
    *,
    workers: int | None = None,
    ray: str | None = None,
    keep_going: bool = False,
    tries: int = 3,
    limit_s: float = 3600.0,
    shows_progress: bool = False,
) -> Report:
    """Objects and a summary of every recording at and below `places` (folders, or patterns of such), and one map of all: docs/fleet.md.

    What an earlier run into `out` has done is kept, so that one that was stopped, or killed, goes on. Recordings that fail `tries` times are
    in the report with the reason, and keep nobody else from being done. settings: over each recording's own. workers: as many at a time;
    None: as there are processors. ray: a cluster's address, or "local"; None: processes of this computer. keep_going: bad lines of
    recordings are skipped. limit_s: the most seconds for a recording.

    Raises ValueError for places without recordings and for settings that cannot be, BlockingIOError where another run works on `out`, and
    OSError where that cannot be written. KeyboardInterrupt ends it; the report is written before.
    """
    out = pathlib.Path(out).absolute()
    results = out / "recordings"
    names = find_recordings([os.fspath(place) for place in places], out)
    task = Task(str(results), _settings(settings or {}), keep_going, _core.version(), limit_s)
    results.mkdir(parents=True, exist_ok=True)
    with lock(out):
        remove_partial(results)
        report = Report(task.version, json.loads(task.settings), recordings=[Entry(name) for name in names])
        began = time.monotonic()
        progress = Progress(len(names), shows_progress)
        count = workers or len(os.sched_getaffinity(0))
        pool: Workers = Processes(task, count) if ray is None else RayWorkers(task, ray, count)
        try:
            _work_off(report.recordings, pool, tries, progress)
        finally:
            pool.close()
            progress.show(is_last=True)
            remove_partial(results)
            report.seconds = round(time.monotonic() - began, 3)
            if report.count("not done") == 0:
                write_maps(out, results, report)
            _core.write_file(os.fspath(out / "report.json"), report.to_json())
            _core.write_file(os.fspath(out / "report.txt"), report.to_text())
    return report
