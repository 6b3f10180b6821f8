# SPDX-License-Identifier: Apache-2.0
"""A short simulated flight and geoloc_app, to which a test does harm."""
import json
import os
import resource
import signal
import subprocess
import time

from support import BIN, PATIENCE_S, AppTest, World

def wait_until(holds, what):
    """Returns the first true value of holds()."""
    deadline = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline:
        value = holds()
        if value:
            return value
        time.sleep(0.05)
    raise AssertionError(f"never: {what}")


def shim(**settings):
    """The environment of a program whose disk is ours (disk_shim.cpp)."""
    return {**os.environ, "LD_PRELOAD": os.environ["GEOLOC_DISK_SHIM"],
            "ASAN_OPTIONS": "verify_asan_link_order=0", **{name: str(value) for name, value in settings.items()}}


def limit(kind, most, hard=None):
    """For a program that is started: it may use `most` of something."""
    return lambda: resource.setrlimit(kind, (most, most if hard is None else hard))


def line_count(file):
    return file.read_bytes().count(b"\n") if file.exists() else 0


class FaultTest(AppTest):
    """Flies for an app that records into self.recording and writes its objects to self.objects_file."""

    def setUp(self):
        super().setUp()
        self.world = World()
        self.recording = self.folder / "recording"
        self.objects_file = self.folder / "objects.geojson"

    def start(self, *arguments, world=None, outputs=None, **options):
        """geoloc_app as a bare process, for faults of its surroundings (see World.watch() for others)."""
        world = world or self.world
        outputs = ("--record", self.recording, "--out", self.objects_file) if outputs is None else outputs
        app = subprocess.Popen([BIN / "geoloc_app", *world.inputs(), *map(str, outputs + arguments)],
                               **{"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **options})
        self.addCleanup(app.wait)
        self.addCleanup(app.kill)
        return app

    def fly(self, end_s=95, speed=3):
        """Flies a part of the flight with targets in view, 80 s to `end_s`, to its end."""
        with self.world.fly("--start-s", 80, "--end-s", end_s, "--speed", speed) as sim:
            self.assertEqual(sim.wait(), 0, sim.lines)

    def interrupt(self, app):
        """Sends Ctrl-C; returns the exit status and how many seconds it took."""
        app.send_signal(signal.SIGINT)
        begin = time.monotonic()
        status = app.wait(PATIENCE_S)
        return status, time.monotonic() - begin

    def frames_recorded(self, folder=None):
        """Frames in a recording, also in one that is being written."""
        folder = folder or self.recording
        return max(line_count(place / "frames.jsonl") for place in (folder, folder.with_name(folder.name + ".partial")))

    def features(self, file=None):
        """The objects that the run has found."""
        return json.loads((file or self.objects_file).read_text())["features"]
