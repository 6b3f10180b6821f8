# SPDX-License-Identifier: Apache-2.0
"""Telemetry in the video's own frames, as the only one: of streams, of files that are played, and of imports."""
import json
import unittest

from support import AppTest, Live, World, rmse_m, run
from video_import_test import VideoTest, frames_of

# A part of the flight with targets in view.
PIECE = ("--start-s", 80, "--end-s", 95)


def messages_of(recording):
    """Ids of the MAVLink 2 messages in a recording's log."""
    log, at, ids = (recording / "telemetry.tlog").read_bytes(), 0, []
    while at < len(log):
        size = log[at + 9] + 12
        ids.append(int.from_bytes(log[at + 15:at + 18], "little"))
        at += 8 + size
    return ids


class Played(AppTest):
    """geoloc_app without --udp."""

    def setUp(self):
        super().setUp()
        self.recording, self.objects_file = self.folder / "recording", self.folder / "objects.geojson"

    def watch(self, *arguments):
        return Live("geoloc_app", *arguments, "--record", self.recording, "--out", self.objects_file)

    def assert_found_and_replayed(self):
        objects = json.loads(self.objects_file.read_text())
        self.assertGreater(len(objects["features"]), 0)
        self.assertLess(objects["counters"]["frames_unusable"], 0.25 * objects["counters"]["frames"])
        self.assertEqual({frame["time_quality"] for frame in frames_of(self.recording)}, {"telemetry"})
        replayed = self.folder / "replayed.geojson"
        self.assertEqual(run("geoloc_replay", self.recording, "--out", replayed).status, 0)
        self.assertEqual(self.objects_file.read_bytes(), replayed.read_bytes())


class TelemetryInStreams(Played):
    """A camera's stream is all that geoloc_app needs."""

    def test_a_stream_alone_finds_objects_and_its_recording_replays(self):
        world = World()
        with self.watch(*world.inputs()[2:]) as app, world.fly("--sei", *PIECE, "--speed", 3) as sim:
            app.wait_for("the video carries telemetry, which is used")
            app.wait_for("^telemetry comes in the video$")
            self.assertEqual(sim.wait(), 0, sim.lines)
            app.wait_for("objects [1-9]", after=app.line_count() - 1)
            self.assertEqual(app.interrupt(), 0, app.lines)
        self.assert_found_and_replayed()
        heartbeat, attitude, position, field_of_view = 0, 30, 33, 271
        self.assertEqual(set(messages_of(self.recording)), {heartbeat, attitude, position, field_of_view})

    def test_mavlink_that_is_asked_for_goes_before(self):
        world = World()
        with world.watch("--record", self.recording) as app, world.fly("--sei", *PIECE, "--speed", 3) as sim:
            app.wait_for("the video carries telemetry, too, which is not used")
            app.wait_for("^vehicle 1: telemetry comes$")
            self.assertEqual(sim.wait(), 0, sim.lines)
            self.assertEqual(app.interrupt(), 0, app.lines)
        self.assertNotIn("telemetry", {frame["time_quality"] for frame in frames_of(self.recording)})

    def test_without_it_mavlink_is_listened_to(self):
        world = World()
        with self.watch(*world.inputs()[2:]) as app, world.fly(*PIECE, "--wait-s", 8):
            app.wait_for("no telemetry in the video")
            self.assertEqual(app.interrupt(), 0, app.lines)


class TelemetryInVideos(VideoTest, Played):
    """A file with telemetry in its frames is a flight: played by geoloc_app, or imported without a log."""
    SPAN = ("--start-s", 80, "--end-s", 110, "--sei")

    def test_a_file_is_played(self):
        with self.watch("--video", self.video) as app:
            app.wait_for("^telemetry comes in the video$")
            self.assertEqual(app.wait(), 0, app.lines)
        self.assert_found_and_replayed()

    def test_a_file_is_imported_without_a_log(self):
        result = run("geoloc_import", "video", self.video, "--out", self.recording, "--camera", self.camera, "--labels",
                     self.labels())
        self.assertEqual(result.status, 0, result.err)
        count = len(self.stamps_us)
        self.assertIn(f"telemetry in {count} of {count} frames is the flight's log", result.err)
        self.assertEqual([frame["time_us"] for frame in frames_of(self.recording)],
                         [frame["time_us"] for frame in frames_of(self.sim)])
        (found, error_m, replayed), (live_found, live_error_m, _) = self.score(self.recording), self.score(self.sim)
        self.assertEqual(found, live_found, replayed)
        self.assertLessEqual(error_m, 1.1 * live_error_m + 0.005, replayed)

    def test_the_camera_that_it_tells_does_without_a_file(self):
        result = run("geoloc_import", "video", self.video, "--out", self.recording, "--labels", self.labels())
        self.assertEqual(result.status, 0, result.err)
        self.assertIn("a nominal field of view of 70.0 deg, looking straight down", result.err)
        camera = json.loads((self.recording / "camera.json").read_text())
        self.assertAlmostEqual(camera["fx"], json.loads(self.camera.read_text())["fx"], delta=0.1)

    def assert_imported_as_flown(self, *flight):
        """Of another flight; what the import said."""
        sim = self.folder / "sim"
        made = run("geoloc_sim", "--record", sim, "--video", "--sei", *flight)
        self.assertEqual(made.status, 0, made.err)
        self.video, self.camera, self.sim = sim / "video.mkv", sim / "camera.json", sim
        result = run("geoloc_import", "video", self.video, "--out", self.recording, "--camera", self.camera, "--labels",
                     self.labels())
        self.assertEqual(result.status, 0, result.err)
        (found, error_m, replayed), (live_found, live_error_m, _) = self.score(self.recording), self.score(sim)
        self.assertEqual(found, live_found, replayed)
        self.assertLessEqual(error_m, 1.2 * live_error_m + 0.02, replayed)
        return result.err

    def test_a_gimbals_angles_are_in_it(self):
        self.assert_imported_as_flown("--gimbal", "45", "--start-s", 80, "--end-s", 90)
        self.assertIn(265, messages_of(self.recording))

    def test_a_camera_that_zooms_tells_it(self):
        self.assertIn("the camera zooms", self.assert_imported_as_flown("--zoom", "1..4", "--start-s", 60, "--end-s", 130, "--frame-rate", 5))

    def test_a_file_without_it_needs_a_log(self):
        plain = self.folder / "plain"
        made = run("geoloc_sim", "--record", plain, "--video", "--start-s", 80, "--end-s", 81)
        self.assertEqual(made.status, 0, made.err)
        self.assert_refused(run("geoloc_import", "video", plain / "video.mkv", "--out", self.recording, "--camera",
                                self.camera), "carries no telemetry", "--log")
        self.assertFalse(self.recording.exists())

    def test_options_that_need_a_log_or_a_video_are_refused_without(self):
        self.assert_refused(run("geoloc_import", "video", self.video, "--out", self.recording, "--log-offset-s", 3), "--log")
        self.assert_refused(run("geoloc_sim", "--record", self.folder / "new", "--sei"), "--video")


if __name__ == "__main__":
    unittest.main()
