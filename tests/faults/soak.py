# SPDX-License-Identifier: Apache-2.0
"""soak.py MINUTES [SPEED]: one run of geoloc_app through flights at SPEED times real time (default 6), one after the other, with
visitors of its page.

Each flight's begin is a reboot of the vehicle and a restart of the stream. At the end, memory, file descriptors, threads and latency must
be those of the first flights, every target must have one object, and the recording's replay must be the run, byte for byte.
"""
import contextlib
import json
import pathlib
import re
import shutil
import sys
import tempfile
import threading
import time
import urllib.request

from json_lines import JsonLines
from support import Live, World, free_port, run

WARM_UP_SHARE = 0.2  # of the time, while caches and histories fill
MOST_MB_PER_HOUR = 1.0  # of flight


def vital_signs(process_id):
    """{name: value} of a process."""
    place = pathlib.Path(f"/proc/{process_id}")
    status = (place / "status").read_text()
    return {"rss_mb": int(re.search(r"VmRSS:\s+(\d+) kB", status)[1]) / 1024,
            "threads": int(re.search(r"Threads:\s+(\d+)", status)[1]),
            "files": len(list((place / "fd").iterdir()))}


def slope(points):
    """Least-squares slope of y over x, with its standard error if the residuals were independent."""
    count = len(points)
    mean_x, mean_y = (sum(values) / count for values in zip(*points))
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    gain = sum((x - mean_x) * (y - mean_y) for x, y in points) / spread
    residual = sum((y - mean_y - gain * (x - mean_x)) ** 2 for x, y in points)
    return gain, (residual / max(1, count - 2) / spread) ** 0.5


def visit(address, is_over):
    """Follows the page's events for a while, leaves, and comes again; one visitor never reads."""
    with contextlib.suppress(OSError):
        silent = urllib.request.urlopen(address + "events", timeout=30)
    while not is_over.is_set():
        with contextlib.suppress(OSError), urllib.request.urlopen(address + "events", timeout=30) as events:
            leave = time.monotonic() + 10
            while time.monotonic() < leave and not is_over.is_set():
                events.readline()
                urllib.request.urlopen(address + "frame", timeout=30).read()
    silent.close()


class Soak:
    def __init__(self, folder, minutes, speed):
        self._speed = speed
        self._end = time.monotonic() + 60 * minutes
        self._begin = time.monotonic()
        self._world = World()
        self._lines = JsonLines(folder)
        self._port = free_port()
        self._recording, self._objects, self._truth = (folder / name for name in ("recording", "objects.geojson", "truth.geojson"))
        self._folder = folder
        self._signs, self._latencies_ms, self.flights = [], [], 0

    def fly(self):
        """Exit status of the run."""
        is_over = threading.Event()
        with self._world.watch("--http", self._port, "--record", self._recording, "--out", self._objects,
                               "--jsonl", self._lines.pipe) as app:
            app.wait_for("listening for MAVLink")
            visitor = threading.Thread(target=visit, args=(f"http://127.0.0.1:{self._port}/", is_over))
            visitor.start()
            try:
                while time.monotonic() < self._end:
                    # No two flights show the same pictures: what the detector takes for an object in one is not there in all.
                    speed = self._speed * (1 + 0.003 * (self.flights % 20))
                    with self._world.fly("--speed", f"{speed:.3f}", "--truth", self._truth) as sim:
                        self._watch(app, sim)
                    self.flights += 1
            finally:
                is_over.set()
                visitor.join()
            return app.interrupt()

    def _watch(self, app, sim):
        while sim.is_running and time.monotonic() < self._end:
            status = self._lines.next(time.monotonic() + 5, "status")
            assert status, "no status for 5 s"
            self._latencies_ms.append((time.monotonic() - self._begin, status[1]["latency_ms"]))
            self._signs.append((time.monotonic() - self._begin, {**vital_signs(app.process_id), "flight": self.flights}))
            if len(self._signs) % 60 == 0:
                print(f"{self._signs[-1][0] / 60:5.1f} min, flight {self.flights + 1}: {self._signs[-1][1]}, "
                      f"latency {self._latencies_ms[-1][1]:.0f} ms, objects {status[1].get('confirmed', '?')}", flush=True)

    def check(self):
        """The faults found."""
        faults = []
        warm = [(time_s, signs) for time_s, signs in self._signs if time_s > WARM_UP_SHARE * self._signs[-1][0]]
        floors = self._floors(warm)
        gain, sigma = slope(floors)
        print(f"memory: at least {floors[0][1]:.1f} MB in the first flight of these, {floors[-1][1]:.1f} MB in the last, "
              f"{gain:+.2f} MB an hour of flight (sigma {sigma:.2f}, {len(floors)} flights)")
        if gain > MOST_MB_PER_HOUR:
            faults.append(f"the memory grows by {gain:.2f} MB an hour of flight")
        half = len(warm) // 2
        for what in "threads", "files":
            before, after = (max(signs[what] for _, signs in part) for part in (warm[:half], warm[half:]))
            print(f"{what}: at most {before} in the first half, {after} in the second")
            if after > before + 2:
                faults.append(f"{what} grow from {before} to {after}")
        latencies_ms = sorted(latency_ms for _, latency_ms in self._latencies_ms if latency_ms is not None)
        print(f"latency: {latencies_ms[len(latencies_ms) // 2]:.0f} ms in the median, "
              f"{latencies_ms[int(0.99 * len(latencies_ms))]:.0f} ms p99")
        return faults + self._check_objects()

    def _floors(self, signs):
        """[(hours of flight, MB)]: what each whole flight held at least. Queues and encoders come and go within a flight by ten
        times of what is to be seen, and are not independent from second to second."""
        floors = {}
        for time_s, sign in signs:
            hours = time_s * self._speed / 3600
            _, least = floors.get(sign["flight"], (0.0, float("inf")))
            floors[sign["flight"]] = (hours, min(least, sign["rss_mb"]))
        return list(floors.values())[:-1]  # the last one was cut off

    def _check_objects(self):
        again = self._folder / "again.geojson"
        replayed = run("geoloc_replay", self._recording, "--truth", self._truth, "--out", again, timeout=3600)
        score = re.search("found .*RMSE.*", replayed.err)[0]
        print(f"{self.flights} flights: {score}")
        faults = []
        if again.read_bytes() != self._objects.read_bytes():
            faults.append("the replay is not the run")
        if not re.match(r"found (\d+) / \1, .*extra 0", score):
            faults.append(score)
        return faults


def main():
    minutes = float(sys.argv[1])
    folder = pathlib.Path(tempfile.mkdtemp(prefix="geoloc-soak-"))
    soak = Soak(folder, minutes, float(sys.argv[2]) if len(sys.argv) > 2 else 6.0)
    status = soak.fly()
    faults = soak.check() + ([f"exit status {status}"] if status else [])
    for fault in faults:
        print(f"FAULT: {fault}", file=sys.stderr)
    if not faults:
        shutil.rmtree(folder)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
