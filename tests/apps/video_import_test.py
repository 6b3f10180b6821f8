# SPDX-License-Identifier: Apache-2.0
import json
import math
import pathlib
import re
import struct
import tempfile
import unittest

from flight_logs import (GIMBAL, LATENCY_US, MOUNT, Flight, at, camera_below, euler_angles, labels_of, read_tlog, to_dataflash,
                         to_srt, to_table, to_ulog)
from support import AppTest, Live, rmse_m, run

SIM = ("--scenario", 1, "--seed", 3)


def frames_of(recording):
    return [json.loads(line) for line in (recording / "frames.jsonl").read_text().splitlines()]


class VideoTest(AppTest):
    """A simulated flight with its video, made once for all tests of a class."""
    SPAN = ()

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="geoloc-test-")
        cls.addClassCleanup(holder.cleanup)
        cls.sim = pathlib.Path(holder.name) / "sim"
        made = run("geoloc_sim", "--record", cls.sim, "--video", *SIM, *cls.SPAN)
        if made.status != 0:
            raise AssertionError(made.err)
        cls.flight = Flight(cls.sim / "telemetry.tlog")
        cls.video, cls.camera = cls.sim / "video.mkv", cls.sim / "camera.json"
        cls.stamps_us = [frame["time_us"] - cls.flight.utc_us for frame in frames_of(cls.sim)]

    def setUp(self):
        super().setUp()
        self.recording = self.folder / "recording"

    def log(self, name, content):
        file = self.folder / name
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        return file

    def labels(self):
        return self.log("labels.csv", labels_of(frames_of(self.sim)))

    def import_video(self, log, *arguments, camera=None):
        return run("geoloc_import", "video", self.video, "--log", log, "--out", self.recording, "--camera",
                   camera or self.camera, *arguments)

    def imported(self, log, *arguments, camera=None):
        result = self.import_video(log, *arguments, camera=camera)
        self.assertEqual(result.status, 0, result.err)
        return result.err

    def score(self, recording):
        result = run("geoloc_replay", recording, "--truth", self.sim / "truth.geojson", "--out",
                     self.folder / "objects.geojson")
        self.assertEqual(result.status, 0, result.err)
        return re.search(r"found \d+ / \d+", result.err)[0], rmse_m(result.err), result.err


class ImportedVideos(VideoTest):
    """A video with a log beside it is as good as the flight's own recording."""
    SPAN = ("--frame-rate", 2)

    def assert_as_good(self, log, *arguments, ratio=1.1):
        said = self.imported(log, "--labels", self.labels(), *arguments)
        (found, error_m, replayed), (live_found, live_error_m, _) = self.score(self.recording), self.score(self.sim)
        self.assertEqual(found, live_found, replayed)
        self.assertLessEqual(error_m, ratio * live_error_m + 0.0005, replayed)  # figures are told to 1 mm
        return said

    def test_mavlink_log_and_the_creation_time(self):
        self.assertIn("by the video's creation time, to 1 s", self.assert_as_good(self.sim / "telemetry.tlog"))

    def test_ardupilot_log_and_its_command(self):
        log = self.log("flight.BIN", to_dataflash(self.flight, [self.stamps_us[0]]))
        self.assertIn("by the command to begin a video in the log", self.assert_as_good(log))

    def test_px4_log_and_its_command(self):
        log = self.log("flight.ulg", to_ulog(self.flight, [self.stamps_us[0]]))
        self.assertIn("by the command to begin a video in the log", self.assert_as_good(log))

    def test_table_and_a_told_offset(self):
        offset_s = (self.stamps_us[0] - self.flight.begin_us()) / 1e6 + 0.2  # wrong by a fifth of a second
        self.assertIn("by --log-offset-s",
                      self.assert_as_good(self.log("flight.csv", to_table(self.flight)), "--log-offset-s", offset_s))

    def test_table_without_accuracies(self):
        """The flight shows how good the receiver is."""
        column = "sigma_horizontal_m"
        rows = [line.split(",") for line in to_table(self.flight).splitlines()]
        left_out = rows[0].index(column)
        table = "\n".join(",".join(row[:left_out] + row[left_out + 1:]) for row in rows) + "\n"
        offset_s = (self.stamps_us[0] - self.flight.begin_us()) / 1e6
        self.assert_as_good(self.log("flight.csv", table), "--log-offset-s", offset_s, ratio=1.2)

    def test_subtitles_with_angles(self):
        """Coordinates end at 1e-6 degrees, 0.11 m, and two subtitles a second leave more of that than the 30 of a DJI."""
        exposed_us = [stamp_us - LATENCY_US for stamp_us in self.stamps_us]
        log = self.log("flight.SRT", to_srt(self.flight, exposed_us, lambda time: camera_below(self.flight, time)))
        said = self.assert_as_good(log, ratio=1.3)
        self.assertIn("by the subtitles, frame by frame", said)
        self.assertIn("does not tell its time zone: UTC is assumed", said)

    def test_subtitles_with_a_zoom(self):
        exposed_us = [stamp_us - LATENCY_US for stamp_us in self.stamps_us]
        blocks = to_srt(self.flight, exposed_us).split("\n\n")
        half = len(blocks) // 2
        zoomed = [block.replace("focal_len: 24.00", "focal_len: 48.00") for block in blocks[half:]]
        said = self.imported(self.log("flight.SRT", "\n\n".join(blocks[:half] + zoomed)), "--labels", self.labels())
        self.assertIn("the camera zooms during the video", said)
        camera = json.loads(self.camera.read_text())
        told = [frame.get("focal_px") for frame in frames_of(self.recording)]
        self.assertEqual(len(told), len(blocks))
        self.assertEqual(told[:half], [None] * half)
        self.assertEqual(told[half:], [[2 * camera["fx"], 2 * camera["fy"]]] * (len(blocks) - half))

    def test_detectors_look_at_videos_and_go_on_where_they_were_stopped(self):
        log = self.log("flight.BIN", to_dataflash(self.flight, [self.stamps_us[0]]))
        command = ("geoloc_import", "video", self.video, "--log", log, "--camera", self.camera)
        with Live(*command, "--out", self.recording) as running:
            running.wait_for("looking for objects")
            self.assertEqual(running.interrupt(), 1)
            running.wait_for("the same command goes on from there")
        self.assertEqual([path.name for path in self.folder.glob("recording*")], ["recording.found.jsonl"])
        self.assertIn("goes on with frame", self.imported(log))
        self.assertEqual([path.name for path in self.folder.glob("recording*")], ["recording"])
        at_once = self.folder / "at_once"
        self.assertEqual(run(*command, "--out", at_once).status, 0)
        for file in "frames.jsonl", "telemetry.tlog":
            self.assertEqual((self.recording / file).read_bytes(), (at_once / file).read_bytes())
        self.assert_as_live_with_these_detections()

    def assert_as_live_with_these_detections(self):
        """The same detections with the flight's own stamps and telemetry, as a live run would have recorded them."""
        live = self.folder / "live"
        live.mkdir()
        for file in "telemetry.tlog", "camera.json":
            (live / file).write_bytes((self.sim / file).read_bytes())
        seen = [{**frame, "detections": imported["detections"]}
                for frame, imported in zip(frames_of(self.sim), frames_of(self.recording))]
        (live / "frames.jsonl").write_text("".join(json.dumps(frame) + "\n" for frame in seen))
        (found, error_m, replayed), (live_found, live_error_m, _) = self.score(self.recording), self.score(live)
        self.assertEqual(found, live_found, replayed)
        self.assertLessEqual(error_m, 1.1 * live_error_m + 0.0005, replayed)


class VideosAndLogsThatDoNotFit(VideoTest):
    SPAN = ("--start-s", 70, "--end-s", 70.4)

    def refuse(self, log, *reasons, arguments=(), camera=None):
        self.assert_refused(self.import_video(log, "--labels", self.labels(), *arguments, camera=camera), *reasons)
        self.assertEqual([path.name for path in self.folder.glob("recording*")], [])

    def test_logs_that_are_none(self):
        self.refuse(self.folder / "none.BIN", "none.BIN")
        self.refuse(self.log("a.txt", "x"), "a.txt: what kind of log it is", ".SRT, .BIN, .ulg")
        self.refuse(self.log("a.BIN", bytes(1000)), "a.BIN: holds no position")
        self.refuse(self.log("a.ulg", bytes(1000)), "a.ulg: is no ULog")
        self.refuse(self.log("a.srt", "1\n00:00:00,000 --> 00:00:01,000\nHello\n"), "a.srt: holds no position")
        self.refuse(self.log("a.csv", "time_s,lat,lon\n1,2,x\n"), "a.csv: line 2: column `lon`: is no number: `x`")
        self.refuse(self.log("a.csv", "time_s,lat,lon\n1,2,3\n"), "a.csv: tells some positions without a height")

    def test_times_that_nothing_tells(self):
        lines = to_table(self.flight).splitlines()
        lines = ["time_s" + lines[0][3:]] + [f"{i / 10}{line[line.index(','):]}" for i, line in enumerate(lines[1:])]
        table = self.log("a.csv", "\n".join(lines))
        self.refuse(table, "when the video began is not known (the log tells no UTC", "--log-offset-s")
        self.refuse(table, "video and log do not overlap", arguments=("--log-offset-s", 5000))
        self.refuse(table, "neither `auto` nor a number of seconds", arguments=("--log-offset-s", "soon"))
        self.assertIn("begins on 2 January 1970", self.imported(table, "--labels", self.labels(), "--log-offset-s", 3))

    def test_of_several_commands_the_creation_time_tells_which(self):
        starts_us = [self.stamps_us[0] - 30_000_000, self.stamps_us[0], self.stamps_us[0] + 30_000_000]
        said = self.imported(self.log("a.BIN", to_dataflash(self.flight, starts_us)), "--labels", self.labels())
        begin_s = (self.stamps_us[0] - self.flight.begin_us()) / 1e6
        self.assertIn(f"begins {begin_s:.2f} s after the log's beginning, by the command", said)
        self.recording.rename(self.folder / "done")
        far_us = [self.stamps_us[0] + offset for offset in (-30_000_000, 30_000_000)]
        self.refuse(self.log("a.BIN", to_dataflash(self.flight, far_us)), "has 2 commands to begin a video", "--log-offset-s")

    def test_cameras_that_nothing_tells_or_of_another_size(self):
        self.assert_refused(run("geoloc_import", "video", self.video, "--log", self.sim / "telemetry.tlog", "--out",
                                self.recording, "--labels", self.labels()), "the camera's focal length is not known", "--camera")
        camera = json.loads(self.camera.read_text())
        other = self.log("camera.json", json.dumps({**camera, "width": 1920, "height": 1080}))
        self.refuse(self.sim / "telemetry.tlog", "1920 x 1080, and the video's are 1280 x 720", camera=other)

    def test_a_gimbal_of_which_the_log_tells_nothing(self):
        log = self.log("flight.BIN", to_dataflash(self.flight, [self.stamps_us[0]]))
        camera = self.log("camera.json", json.dumps({**json.loads(self.camera.read_text()), "mount": {"kind": "gimbal"}}))
        self.refuse(log, "camera.json: the mount is of kind gimbal", "--gimbal-pitch-deg", camera=camera)
        result = self.import_video(log, "--labels", self.labels(), "--gimbal-pitch-deg", -60, camera=camera)
        self.assertEqual(result.status, 0, result.err)
        self.assertEqual(json.loads((self.recording / "camera.json").read_text())["mount"]["kind"], "fixed")
        self.assertEqual(len([frame for frame in frames_of(self.recording) if "mount" in frame]), len(self.stamps_us))

    def test_labels_that_name_no_frame(self):
        for lines, reason in (("a.jpg,1,2", "names no frame"), ("999,1,2", "none of its frames is in")):
            labels = self.log("wrong.csv", f"picture,u,v\n{lines}\n")
            self.assert_refused(self.import_video(self.sim / "telemetry.tlog", "--labels", labels), reason)

    def test_what_another_detector_found_is_not_mixed_in(self):
        self.log("recording.found.jsonl", "of something else\n")
        self.assert_refused(self.import_video(self.sim / "telemetry.tlog"), "recording.found.jsonl: holds what another")

    def test_a_camera_whose_angles_nothing_tells_looks_down_along_the_course(self):
        exposed_us = list(range(self.stamps_us[0], self.stamps_us[-1] + 1, 100_000))
        log = self.log("flight.SRT", to_srt(self.flight, exposed_us))
        said = self.imported(log, "--labels", self.labels())
        self.assertIn("it is taken to look straight down, to 5 degrees (--gimbal-pitch-deg", said)
        self.assertIn("the image's top is taken to be where the vehicle flew to", said)
        north, east = next(position[5][:2] for position in self.flight.positions if position[0] >= self.stamps_us[0])
        for frame in frames_of(self.recording):
            self.assertAlmostEqual(frame["mount"]["pitch_deg"], -90, places=3)
            heading = frame["mount"]["yaw_deg"] - frame["mount"]["roll_deg"]  # one at a pitch of -90
            self.assertLess(abs(math.remainder(heading - math.degrees(math.atan2(east, north)), 360)), 15)

    def test_a_told_pitch_is_held_level(self):
        log = self.log("flight.BIN", to_dataflash(self.flight, [self.stamps_us[0]]))
        self.assertIn("keep the pitch of --gimbal-pitch-deg",
                      self.imported(log, "--labels", self.labels(), "--gimbal-pitch-deg", -60))
        for frame in frames_of(self.recording):
            roll, pitch, _ = at(self.flight.attitudes, frame["time_us"] - self.flight.utc_us)
            self.assertAlmostEqual(frame["mount"]["pitch_deg"], -60 - math.degrees(pitch), delta=0.5 + abs(math.degrees(roll)))

    def test_angles_of_the_logs_gimbal_are_in_the_telemetry(self):
        gimbal = [(time, 0, -45, math.degrees(yaw)) for time, _, _, yaw in self.flight.attitudes]
        for name, write, number in (("a.BIN", to_dataflash, MOUNT), ("a.ulg", to_ulog, GIMBAL)):
            with self.subTest(log=name):
                log = self.log(name, write(self.flight, [self.stamps_us[0]], gimbal))
                self.imported(log, "--labels", self.labels())
                self.assertFalse(any("mount" in frame for frame in frames_of(self.recording)))
                mount = json.loads((self.recording / "camera.json").read_text())["mount"]
                self.assertEqual((mount["kind"], mount["pitch_deg"]), ("gimbal", 0))
                told = [payload for _, kind, payload in read_tlog(self.recording / "telemetry.tlog") if kind == number]
                self.assertEqual(len(told), len(gimbal))
                for payload, (_, _, pitch_deg, yaw_deg) in zip(told, gimbal):
                    found = self.angles_deg(number, payload)
                    self.assertAlmostEqual(found[0], pitch_deg, places=3)
                    self.assertLess(abs(math.remainder(found[1] - yaw_deg, 360)), 0.001)
                self.recording.rename(self.folder / f"done-{name}")

    @staticmethod
    def angles_deg(number, payload):
        """Pitch and yaw, from north."""
        if number == GIMBAL:
            return [math.degrees(angle) for angle in euler_angles(*struct.unpack_from("<4f", payload, 4))[1:]]
        _, _, pitch_deg, yaw_deg = struct.unpack_from("<I3f", payload)
        yaw_absolute_deg, = struct.unpack_from("<f", payload, 16)
        return pitch_deg, yaw_absolute_deg if math.isnan(yaw_deg) else math.nan


class ImportedGimbals(VideoTest):
    """A gimbal's angles in a log are worth what they were live."""
    SPAN = ("--frame-rate", 2, "--start-s", 70, "--end-s", 130, "--gimbal", "sweep", "--gimbal-told-yaw", "north")

    def test_each_log_is_as_good_as_the_flights_own(self):
        live_found, live_error_m, _ = self.score(self.sim)
        logs = {"a.BIN": to_dataflash(self.flight, [self.stamps_us[0]], self.flight.gimbal),
                "a.ulg": to_ulog(self.flight, [self.stamps_us[0]], self.flight.gimbal),
                "a.tlog": (self.sim / "telemetry.tlog").read_bytes()}
        camera = self.log("camera.json", json.dumps({**json.loads(self.camera.read_text()), "mount": {"pitch_deg": -90}}))
        for name, content in logs.items():
            with self.subTest(log=name):
                said = self.imported(self.log(name, content), "--labels", self.labels(), camera=camera)
                self.assertIn("the log has the angles of a gimbal: the camera is taken to be on it", said)
                found, error_m, said = self.score(self.recording)
                self.assertEqual(found, live_found, said)
                self.assertLessEqual(error_m, 1.1 * live_error_m + 0.0005, said)
                self.recording.rename(self.folder / f"done-{name}")


if __name__ == "__main__":
    unittest.main()
