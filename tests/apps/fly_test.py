# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import subprocess
import time
import unittest

from support import AppTest

FLY = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"]) / "scripts/fly.sh"

# A stand-in for either program: what matters here is how and when they end.
PROGRAM = """#!/usr/bin/env python3
import atexit, signal, sys, time
atexit.register(lambda: open(sys.argv[0] + ".ended", "w").write(str(time.time())))
def end(words, status):
    print(words, file=sys.stderr)
    sys.exit(status)
signal.signal(signal.SIGINT, lambda *_: sys.exit(0))
if {writes_truth}:
    open(sys.argv[sys.argv.index("--truth") + 1], "w").write("{{}}")
{then}
"""
FLIES_ON = "time.sleep(60)"
IGNORES_ALL = "signal.signal(signal.SIGINT, signal.SIG_IGN)\n" + FLIES_ON


class EarlyEnds(AppTest):
    """A program that dies ends the demo and the other program at once, and its messages are the last ones."""

    def fly(self, simulator=FLIES_ON, app=FLIES_ON):
        binaries = self.folder / "bin"
        binaries.mkdir()
        for name, then in {"geoloc_sim": simulator, "geoloc_app": app}.items():
            (binaries / name).write_text(PROGRAM.format(writes_truth=name == "geoloc_sim", then=then))
            (binaries / name).chmod(0o755)
        done = subprocess.run(["bash", FLY, binaries, self.folder / "out", "--seed", "1"], capture_output=True, text=True,
                              timeout=60, check=False)
        return done, time.time()

    def assert_ended_by(self, program, words, done, ended_at_s):
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertLess(ended_at_s - float((self.folder / f"bin/{program}.ended").read_text()), 2.0, done.stderr)
        tail = [line for line in done.stderr.splitlines() if f"{program} ended early" in line or line == words]
        self.assertEqual(len(tail), 2 if words else 1, done.stderr)
        self.assertEqual(done.stderr.splitlines()[-len(tail):], tail)
        left = subprocess.run(["pgrep", "-f", str(self.folder / "bin")], capture_output=True, text=True, check=False)
        self.assertEqual(left.stdout, "")

    def test_the_app_dies(self):
        self.assert_ended_by("geoloc_app", "--http: no such thing",
                             *self.fly(app="time.sleep(0.5); end('--http: no such thing', 2)"))

    def test_the_app_ends_as_if_all_were_well(self):
        self.assert_ended_by("geoloc_app", None, *self.fly(app="time.sleep(0.5)"))

    def test_the_app_dies_and_the_simulator_cannot_be_interrupted(self):
        self.assert_ended_by("geoloc_app", "gone", *self.fly(simulator=IGNORES_ALL, app="time.sleep(0.5); end('gone', 2)"))

    def test_the_simulator_dies(self):
        self.assert_ended_by("geoloc_sim", "no encoder", *self.fly("time.sleep(0.5); end('no encoder', 1)"))

    def test_the_simulator_dies_before_it_flies(self):
        self.assert_ended_by("geoloc_sim", "no flight", *self.fly("end('no flight', 2)"))

    def test_the_app_fails_when_the_flight_is_over(self):
        self.assert_ended_by("geoloc_app", "disk full", *self.fly(
            "time.sleep(0.5)", "signal.signal(signal.SIGINT, lambda *_: end('disk full', 1))\n" + FLIES_ON))


if __name__ == "__main__":
    unittest.main()
