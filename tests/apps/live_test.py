# SPDX-License-Identifier: Apache-2.0
import json
import resource
import signal
import unittest

from support import AppTest, World, run

# A part of the flight with targets in view; it is flown in a third of its time.
PIECE = ("--start-s", 80, "--end-s", 95, "--speed", 3)


class LiveRun(AppTest):
    """What a user of geoloc_app is promised, over real UDP and RTSP."""

    def setUp(self):
        super().setUp()
        self.world = World()
        self.objects_file = self.folder / "objects.geojson"

    def objects(self):
        return json.loads(self.objects_file.read_text())

    def fly_over(self, app, *options):
        """Flies the piece for a running app, to its end."""
        with self.world.fly(*PIECE, *options) as sim:
            self.assertEqual(sim.wait(), 0, sim.lines)
        app.wait_for("objects [1-9]", after=app.line_count() - 1)


class LiveIsItsReplay(LiveRun):
    """Replaying a live run's recording gives the objects of the live run, byte for byte."""

    def test_live_is_its_replay(self):
        recording, replayed = self.folder / "recording", self.folder / "replayed.geojson"
        live_summary, replayed_summary = self.folder / "live.fs", self.folder / "replayed.fs"
        with self.world.watch("--record", recording, "--out", self.objects_file, "--summary", live_summary) as app:
            self.fly_over(app)
            self.assertEqual(app.interrupt(), 0, app.lines)
        objects = self.objects()
        counters = objects["counters"]
        self.assertGreater(len(objects["features"]), 0)
        self.assertLess(counters["frames_unusable"], 0.25 * counters["frames"])

        again = run("geoloc_replay", recording, "--out", replayed, "--summary", replayed_summary)
        self.assertEqual(again.status, 0, again.err)
        self.assertEqual(self.objects_file.read_bytes(), replayed.read_bytes())
        self.assertEqual(live_summary.read_bytes(), replayed_summary.read_bytes())

    def test_a_camera_that_zooms_is_its_replay_too(self):
        recording, replayed = self.folder / "recording", self.folder / "replayed.geojson"
        with self.world.watch("--record", recording, "--out", self.objects_file) as app:
            self.fly_over(app, "--zoom", "1..2")
            self.assertEqual(app.interrupt(), 0, app.lines)
        self.assertTrue(any("its camera tells its zoom" in line for line in app.lines), app.lines)
        self.assertGreater(len(self.objects()["features"]), 0)
        self.assertEqual(run("geoloc_replay", recording, "--out", replayed).status, 0)
        self.assertEqual(self.objects_file.read_bytes(), replayed.read_bytes())


class Streams(LiveRun):
    """Bad or missing streams never end a run, and nothing is made up."""

    def test_an_unreachable_stream_is_tried_again_and_told_once(self):
        quick = self.write("config.json", {"video": {"retry_min_s": 0.1, "retry_max_s": 0.1}})
        with self.world.watch("--config", quick, "--out", self.objects_file) as app:
            app.wait_for("^video: trying again")
            for _ in range(4):  # seconds
                app.wait_for("^00:", after=app.line_count())
            told = [line for line in app.lines if line.startswith("video: ")]
            self.assertLessEqual(len(told), 2, told)  # one for connecting, and one for the fault
            quiet = app.lines[:app.lines.index(told[0])]  # what is missing in the first seconds is no fault
            self.assertTrue(any(line.startswith("00:0") for line in quiet), quiet)
            for line in app.lines:
                self.assertTrue(len(line) < 80 or not line.startswith("00:"), line)
            self.assertEqual(app.interrupt(), 0)
        self.assertEqual(self.objects()["features"], [])

    def test_without_telemetry_frames_are_unusable(self):
        elsewhere = World()
        elsewhere.rtsp_port = self.world.rtsp_port
        with elsewhere.fly(), self.world.watch("--out", self.objects_file) as app:
            app.wait_for("waiting for a vehicle")
            app.wait_for("located 0 %")
            self.assertEqual(app.interrupt(), 0)
        self.assertEqual(self.objects()["features"], [])
        said = "\n".join(app.lines)
        self.assertRegex(said, r"0 objects from 0 fixes in (\d+) frames \(\1 without vehicle state\)")
        self.assertIn("no frame was located: no telemetry came", said)

    def test_a_simulator_that_dies_and_comes_back_is_found_again(self):
        with self.world.watch("--out", self.objects_file) as app:
            with self.world.fly():
                app.wait_for("video: frames come")
                app.wait_for("telemetry comes")
            seen = app.line_count()
            app.wait_for("video: trying again", after=seen)
            app.wait_for("no attitude comes", after=seen)
            self.fly_over(app)
            self.assertEqual(app.interrupt(), 0)
        self.assertGreater(len(self.objects()["features"]), 0)

    def test_a_reboot_in_flight_is_counted_and_the_run_goes_on(self):
        with self.world.watch("--out", self.objects_file) as app:
            with self.world.fly("--start-s", 80, "--end-s", 110, "--speed", 3, "--reboot-at", 3) as sim:
                self.assertEqual(sim.wait(), 0)
            self.assertEqual(app.interrupt(), 0)
        counters = self.objects()["counters"]
        self.assertEqual(counters["reboots"], 1)
        self.assertGreater(counters["frames_located"], counters["frames_unusable"])
        self.assertGreater(len(self.objects()["features"]), 0)


class FullDisk(LiveRun):
    """A disk that fills up ends the recording, not the run."""

    @staticmethod
    def limit_file_size():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # writes fail, as they do on a full disk
        resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))

    def test_the_recording_stops_and_the_run_goes_on(self):
        recording = self.folder / "recording"
        with self.world.watch("--record", recording, "--out", self.objects_file,
                              preexec_fn=self.limit_file_size) as app:
            self.fly_over(app)
            self.assertEqual(app.interrupt(), 1)
        told = [line for line in app.lines if "recording stopped" in line]
        self.assertEqual(len(told), 1, app.lines)
        self.assertGreater(len(self.objects()["features"]), 0)
        self.assertFalse(recording.exists())
        kept = run("geoloc_replay", "--keep-going", f"{recording}.partial")
        self.assertEqual(kept.status, 0, kept.err)


if __name__ == "__main__":
    unittest.main()
