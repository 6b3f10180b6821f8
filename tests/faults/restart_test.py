# SPDX-License-Identifier: Apache-2.0
"""What a run has written is never removed by another: not by a restart after a crash, nor by a run beside it."""
import json
import shutil
import subprocess
import unittest

from flight_under_fault import FaultTest, wait_until
from support import BIN, SOURCE, World, run, tree


class Restart(FaultTest):

    def crash(self, app):
        app.kill()
        app.wait()

    def start_all(self, **options):
        """With every output that is a file."""
        return self.start("--csv", self.folder / "objects.csv", "--jsonl", self.folder / "run.jsonl", **options)

    def assert_replays(self, recording):
        replayed = run("geoloc_replay", recording, "--out", self.folder / "replayed.geojson")
        self.assertEqual(replayed.status, 0, replayed.err)
        self.assertTrue(self.features(self.folder / "replayed.geojson"))

    def test_a_restart_keeps_the_crashed_flight(self):
        app = self.start_all()
        self.fly()
        wait_until(lambda: self.objects_file.exists() and self.features(), "objects in the file")
        self.crash(app)
        partial = self.recording.with_name("recording.partial")
        flight = {"recording": tree(partial), "objects": self.objects_file.read_bytes(),
                  "csv": (self.folder / "objects.csv").read_bytes(), "jsonl": (self.folder / "run.jsonl.partial").read_bytes()}
        self.assertGreater(flight["jsonl"].count(b'"frame"'), 5)

        for restart in (1, 2):  # without a flight
            app = self.start_all(stderr=subprocess.PIPE, text=True)
            self.addCleanup(app.stderr.close)
            new = self.recording.with_name(f"recording-{restart + 1}")
            self.assertIn("listening", app.stderr.readline())
            self.assertEqual(self.interrupt(app)[0], 0)
            self.assertIn(f"recording into {new}", app.stderr.read())
            self.assertTrue((new / "camera.json").exists())
        self.assertEqual(tree(partial), flight["recording"])
        self.assert_replays(partial)
        self.assertEqual((self.folder / "objects.old-1.geojson").read_bytes(), flight["objects"])
        self.assertEqual((self.folder / "objects.old-1.csv").read_bytes(), flight["csv"])
        self.assertEqual((self.folder / "run.jsonl.partial").read_bytes(), flight["jsonl"])
        self.assertTrue((self.folder / "run.old-1.jsonl").exists(), "that of the first restart")
        self.assertEqual(self.features(), [], "the last run's own")

    def test_two_runs_with_one_name_both_keep_their_flight(self):
        worlds = [self.world, World()]
        apps = []
        for world, files in zip(worlds, ("objects.geojson", "others.geojson")):
            apps.append(self.start(world=world, outputs=("--record", self.recording, "--out", self.folder / files)))
            wait_until(lambda: len(list(self.folder.glob("recording*.partial"))) == len(apps), "a recording of each")
        for world in worlds:
            self.world = world
            self.fly()
        for app in apps:
            self.assertEqual(self.interrupt(app)[0], 0)
        for name in ("recording", "recording-2"):
            self.assertGreater(self.frames_recorded(self.folder / name), 5)
            self.assert_replays(self.folder / name)

    def test_a_run_that_cannot_begin_leaves_everything_as_it_was(self):
        run_lines = self.write("run.jsonl", "of yesterday\n")
        before = tree(self.folder)
        refused = run("geoloc_app", *self.world.inputs(), "--record", self.recording, "--out", self.objects_file,
                      "--jsonl", run_lines, "--http", "nowhere:0")
        self.assert_refused(refused, "--http")
        self.assertEqual(tree(self.folder), before)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["run.jsonl"])

    def test_two_runs_with_one_output_do_not_fight_over_it(self):
        first = self.start()
        wait_until(self.objects_file.exists, "the first run's file")
        second = self.start(world=World())
        kept = self.folder / "objects.old-1.geojson"
        wait_until(kept.exists, "the first run's file kept by the second")
        last = json.loads(kept.read_text())
        statuses = sorted(self.interrupt(app)[0] for app in (first, second))
        self.assertEqual(statuses, [0, 1], "one of them says that its last results are not under that name")
        self.assertEqual(last["features"], [])


@unittest.skipUnless(shutil.which("systemd-analyze"), "needs systemd-analyze")
class ServiceUnit(FaultTest):
    """packaging/geoloc.service restarts for ever, and confines what it starts."""

    def test_systemd_takes_it_and_finds_it_confined(self):
        text = (SOURCE / "packaging/geoloc.service").read_text()
        self.assertIn("\nRestart=always\n", text)
        unit = self.write("geoloc.service", text.replace("ExecStart=geoloc_app", f"ExecStart={BIN}/geoloc_app"))
        for check in (("verify", "--man=no"), ("security", "--offline=yes", "--threshold=20")):  # of 100; 20 is "OK"
            done = subprocess.run(["systemd-analyze", *check, unit], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(done.stderr, "")


if __name__ == "__main__":
    unittest.main()
