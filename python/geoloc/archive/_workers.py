# SPDX-License-Identifier: Apache-2.0
"""Who does the recordings: processes of this computer, or Ray's workers. Both tell when a worker died, and with which recording."""

from __future__ import annotations

import importlib
import multiprocessing
import multiprocessing.connection
import os
import signal
import threading
from multiprocessing.connection import Connection
from multiprocessing.context import ForkProcess
from typing import Any, Protocol

from ._job import Outcome, Task, has_geoid, work


class Workers(Protocol):
    """Recordings in, outcomes out, in any order."""

    def room(self) -> int:
        """How many more recordings they would take now."""

    def start(self, recording: str) -> None:
        """Begins a recording."""

    def wait(self, seconds: float) -> list[tuple[str, Outcome]]:
        """Those that have ended, waiting for the first of them at most so long."""

    def close(self) -> None:
        """Ends them, whatever they do."""


def _answer(task: Task, recording: str, answer: Connection) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a terminal sends Ctrl-C to all; the driver ends its workers
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    outcome = work(task, recording)
    try:
        answer.send(outcome)
    except BrokenPipeError:
        pass  # the driver was killed; the result stands


class Processes:
    """A process a recording, forked from this one, which costs milliseconds. Not concurrent.futures: there, a worker that dies takes
    the other workers' recordings with it, and nobody knows whose fault it was. A process that lost its driver ends with its recording."""

    def __init__(self, task: Task, count: int) -> None:
        self._task = task
        self._count = count
        has_geoid()  # asked once, before the processes are forked that have to know
        self._running: dict[Connection, tuple[str, ForkProcess]] = {}

    def room(self) -> int:
        return self._count - len(self._running)

    def start(self, recording: str) -> None:
        context = multiprocessing.get_context("fork")
        answer, its_end = context.Pipe(duplex=False)
        process = context.Process(target=_answer, args=(self._task, recording, its_end), daemon=True)
        process.start()
        its_end.close()
        self._running[answer] = recording, process

    def wait(self, seconds: float) -> list[tuple[str, Outcome]]:
        ended = []
        for answer in multiprocessing.connection.wait(list(self._running), seconds):
            assert isinstance(answer, Connection)
            recording, process = self._running.pop(answer)
            try:
                outcome = answer.recv()
            except EOFError:
                outcome = None
            process.join()
            if outcome is None:
                outcome = Outcome(reason=_how_it_died(process.exitcode))
            answer.close()
            ended.append((recording, outcome))
        return ended

    def close(self) -> None:
        for _, process in self._running.values():
            process.kill()
            process.join()
        self._running.clear()


def _how_it_died(exit_code: int | None) -> str:
    if exit_code is not None and exit_code < 0:
        name = signal.Signals(-exit_code).name
        return f"its worker was killed by {name}" + (", as by the system when memory runs out" if name == "SIGKILL" else "")
    return f"its worker ended with status {exit_code}"


class RayWorkers:
    """Ray's tasks: the cluster at an address as ray.init() takes it, or "local", one that begins and ends with this run."""

    def __init__(self, task: Task, address: str, count: int) -> None:
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")  # Ray would tell its makers
        self._ray: Any = importlib.import_module("ray")
        on_sigterm = signal.getsignal(signal.SIGTERM)
        if address == "local":
            self._ray.init(address="local", num_cpus=count, include_dashboard=False, log_to_driver=False)
        else:
            self._ray.init(address=address, log_to_driver=False)
        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGTERM, on_sigterm)  # Ray's would end the driver without a report
        self._task = self._ray.put(task)
        # The driver counts the tries.
        self._work: Any = self._ray.remote(max_retries=0, num_cpus=1, scheduling_strategy="SPREAD")(work)
        self._running: dict[Any, str] = {}

    def room(self) -> int:
        """As many again as there are processors wait there, so that no worker waits for the driver. Clusters grow and shrink."""
        return 2 * max(1, int(self._ray.cluster_resources().get("CPU", 1))) - len(self._running)

    def start(self, recording: str) -> None:
        self._running[self._work.remote(self._task, recording)] = recording

    def wait(self, seconds: float) -> list[tuple[str, Outcome]]:
        references = list(self._running)
        ready, _ = self._ray.wait(references, num_returns=1, timeout=seconds)
        return [(self._running.pop(reference), self._outcome(reference)) for reference in ready]

    def _outcome(self, reference: Any) -> Outcome:
        try:
            outcome: Outcome = self._ray.get(reference)
            return outcome
        except self._ray.exceptions.RayError as error:
            return Outcome(reason="its worker died: " + str(error).strip().splitlines()[0])

    def close(self) -> None:
        self._ray.shutdown()
