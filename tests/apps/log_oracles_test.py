# SPDX-License-Identifier: Apache-2.0
"""What geoloc_import takes from logs is, number by number, what the projects' own readers take: pymavlink's DFReader,
pyulog and, of subtitles, expressions written for this test."""
import json
import math
import os
import pathlib
import re
import shutil
import struct
import tempfile
import unittest

import numpy
from flight_logs import ATTITUDE, GPS, MOUNT, POSITION, Flight, Ulog, read_tlog, to_dataflash, to_ulog
from pymavlink.dialects.v20 import ardupilotmega as mavlink
from pymavlink.DFReader import DFReader_binary
from pyulog import ULog
from support import SOURCE, AppTest, run

DATA = pathlib.Path(os.environ.get("GEOLOC_REAL_DATA", SOURCE.parent / "shared/data/real")).parent


def half_step_of_rounding_mm(heights_m):
    """Heights above home that are whole metres, or tenths, are rounded, and the import takes that out; finer ones stay."""
    for step_mm in 1000, 100:
        if all(round(height * 1e3) % step_mm == 0 for height in heights_m):
            return step_mm / 2
    return 0.0


def float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def ulog_attitudes(topic):
    """us, roll, pitch, yaw in radians."""
    attitudes = []
    for time, *q in zip(topic.get("timestamp_sample", topic["timestamp"]), *(topic[f"q[{i}]"] for i in range(4))):
        w, x, y, z = numpy.array(q, dtype=float) / numpy.linalg.norm(q)
        attitudes.append((int(time), math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
                          math.asin(max(-1, min(1, 2 * (w * y - z * x)))),
                          math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))))
    return sorted(attitudes, key=lambda sample: sample[0])


def ulog_positions(topics):
    """us, degrees, degrees, m above the sea, m above home; the receiver's where there are no others."""
    if "vehicle_global_position" in topics:
        place = topics["vehicle_global_position"]
        rows = list(zip(place["timestamp"], place["lat"], place["lon"], place["alt"]))
    elif "vehicle_gps_position" in topics:
        place = topics["vehicle_gps_position"]
        rows = [(time, lat / 1e7, lon / 1e7, alt / 1e3) for time, lat, lon, alt, fix_type in
                zip(*(place[name] for name in ("timestamp", "lat", "lon", "alt", "fix_type"))) if fix_type >= 3]
    else:
        return []
    home_m = topics["home_position"]["alt"][0] if "home_position" in topics else rows[0][3]
    return [(int(time), lat, lon, alt, alt - home_m) for time, lat, lon, alt in rows]


class LogOracles(AppTest):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="geoloc-test-")
        cls.addClassCleanup(holder.cleanup)
        cls.sim = pathlib.Path(holder.name) / "sim"
        made = run("geoloc_sim", "--record", cls.sim, "--video", "--start-s", 70, "--end-s", 70.4)
        if made.status != 0:
            raise AssertionError(made.err)

    def import_log(self, log, *arguments):
        """The messages of the recording, by their numbers: lists of (us since the first one, fields)."""
        recording, labels = self.folder / "recording", self.folder / "labels.csv"
        labels.write_text("picture,u,v\n0,1,1\n1,1,1\n2,1,1\n")
        result = run("geoloc_import", "video", self.sim / "video.mkv", "--camera", self.sim / "camera.json", "--log", log,
                     "--labels", labels, "--out", recording, *arguments)
        self.assertEqual(result.status, 0, result.err)
        forms = {ATTITUDE: "Ifff", POSITION: "Iiiii", GPS: "QiiiHHHHBBiII", MOUNT: "Iffff"}
        messages, first_us = {number: [] for number in forms}, None
        for stamp_us, number, payload in read_tlog(recording / "telemetry.tlog"):
            first_us = stamp_us if first_us is None else first_us
            if number in forms:
                messages[number].append((stamp_us - first_us, *struct.unpack_from("<" + forms[number], payload)[1:]))
        self.frames = [json.loads(line) for line in (recording / "frames.jsonl").read_text().splitlines()]
        return messages

    def assert_attitudes(self, messages, expected):
        """`expected`: us, roll, pitch, yaw in radians."""
        self.assertEqual(len(messages[ATTITUDE]), len(expected))
        for (time, *angles), (wanted_us, *wanted) in zip(messages[ATTITUDE], expected):
            self.assertEqual(time, wanted_us)
            for angle, value in zip(angles, wanted):
                self.assertLess(abs(math.remainder(angle - value, math.tau)), 3e-7)  # of a float

    def assert_positions(self, messages, expected):
        """`expected`: us, degrees, degrees, m above the sea, m above home. What repeats the one before is left out."""
        by_time = {}
        for row in expected:
            by_time.setdefault(row[0], row)
        self.assertGreater(len(messages[POSITION]), len(by_time) / 6)
        for time, lat, lon, alt_mm, above_home_mm in messages[POSITION]:
            _, latitude_deg, longitude_deg, alt_m, above_home_m = by_time[time]
            self.assertEqual((lat, lon), (round(latitude_deg * 1e7), round(longitude_deg * 1e7)))
            self.assertAlmostEqual(alt_mm, alt_m * 1e3, delta=0.6)
            self.assertAlmostEqual(above_home_mm, above_home_m * 1e3, delta=0.6)

    def assert_dataflash(self, file):
        reader, attitudes, positions, fixes = DFReader_binary(str(file)), [], [], []
        while (record := reader.recv_msg()) is not None:
            kind = record.get_type()
            if kind == "ATT":
                attitudes.append((record.TimeUS, *map(math.radians, (record.Roll, record.Pitch, record.Yaw))))
            elif kind == "POS":
                positions.append((record.TimeUS, record.Lat, record.Lng, record.Alt, record.RelHomeAlt))
            elif kind == "GPS":
                fixes.append([record.TimeUS, record.Lat, record.Lng, record.Alt, record.Status])
            elif kind == "GPA":
                fixes[-1] += [record.HAcc, record.VAcc]
        begin_us = min(attitudes[0][0], positions[0][0])
        messages = self.import_log(file, "--log-offset-s", 1)
        self.assert_attitudes(messages, [(time - begin_us, *rest) for time, *rest in attitudes])
        self.assert_positions(messages, [(time - begin_us, *rest) for time, *rest in positions])
        self.assertGreater(len(messages[GPS]), 0)
        wanted = {time - begin_us: rest for time, *rest in fixes}
        for time, lat, lon, alt_mm, *_, fix_type, _, _, h_acc_mm, v_acc_mm in messages[GPS]:
            latitude_deg, longitude_deg, alt_m, status, h_acc_m, v_acc_m = wanted[time]
            self.assertEqual((lat, lon, fix_type), (round(latitude_deg * 1e7), round(longitude_deg * 1e7), status))
            self.assertAlmostEqual(alt_mm, alt_m * 1e3, delta=0.6)
            self.assertEqual((h_acc_mm, v_acc_mm), (max(1, round(h_acc_m * 1e3)), max(1, round(v_acc_m * 1e3))))

    def assert_ulog(self, file):
        """Of a log without any place, its attitudes: with one place added, since nothing can be imported without."""
        log = ULog(str(file))
        topics = {data.name: data.data for data in log.data_list if data.multi_id == 0}
        attitudes, positions = ulog_attitudes(topics["vehicle_attitude"]), ulog_positions(topics)
        if not positions:
            place = Ulog(0)
            place.define("vehicle_global_position", "Qddf", "uint64_t timestamp;double lat;double lon;float alt")
            place.topics = {name: (60000, form) for name, (_, form) in place.topics.items()}
            place.subscribe()
            positions = [(attitudes[0][0], 1.0, 2.0, 3.0, 0.0)]
            place.sample("vehicle_global_position", *positions[0][:4])
            original, file = file, self.folder / f"placed-{file.name}"
            content, flags = original.read_bytes(), 3 + 40  # the message with flags comes first, if there is one
            begin = 16 + (flags if content[18:19] == b"B" else 0)
            file.write_bytes(content[:begin] + place.bytes[16 + flags:] + content[begin:])
        begin_us = min(attitudes[0][0], positions[0][0])
        messages = self.import_log(file, "--log-offset-s", 1)
        self.assert_attitudes(messages, [(time - begin_us, *rest) for time, *rest in attitudes])
        self.assert_positions(messages, [(time - begin_us, *rest) for time, *rest in positions])

    def test_dataflash_of_the_tests(self):
        file = self.folder / "a.BIN"
        file.write_bytes(to_dataflash(Flight(self.sim / "telemetry.tlog")))
        self.assert_dataflash(file)

    def test_ulog_of_the_tests(self):
        file = self.folder / "a.ulg"
        file.write_bytes(to_ulog(Flight(self.sim / "telemetry.tlog")))
        self.assert_ulog(file)

    @unittest.skipUnless((DATA / "arducopter_live").exists(), "the real logs are not here")
    def test_dataflash_of_arducopter(self):
        self.assert_dataflash(DATA / "arducopter_live/flight.BIN")

    @unittest.skipUnless((DATA / "real/px4").exists(), "the real logs are not here")
    def test_ulogs_of_px4(self):
        for name in "sample.ulg", "sample_log_small.ulg":
            with self.subTest(log=name):
                self.assert_ulog(DATA / "real/px4" / name)
                (self.folder / "recording").rename(self.folder / f"done-{name}")

    @unittest.skipUnless((DATA / "real/dji_srt").exists(), "the real subtitles are not here")
    def test_subtitles_of_dji(self):
        for file in sorted((DATA / "real/dji_srt").glob("*.SRT")):
            with self.subTest(log=file.name):
                self.assert_subtitles(file)
                (self.folder / "recording").rename(self.folder / f"done-{file.name}")

    def assert_subtitles(self, file):
        number = r"\s*:\s*([-+]?[\d.]+)"
        places, gimbal, half_digits = {}, {}, []
        for block in re.split(r"\n\s*\n", file.read_text()):
            begin = re.search(r"(\d+):(\d+):(\d+)[,.](\d+) -->", block)
            if not begin:
                continue
            hours, minutes, seconds, milliseconds = map(int, begin.groups())
            time_us = ((hours * 60 + minutes) * 60 + seconds) * 1_000_000 + milliseconds * 1000
            old = re.search(r"GPS\(([-\d.]+),([-\d.]+),.*BAROMETER\(([-\d.]+)\)", block)
            if old:
                places[time_us] = (*map(float, old.groups()), None)
            else:
                places[time_us] = tuple(float(re.search(key + number, block)[1]) for key in
                                        ("latitude", "longitude", "rel_alt", "abs_alt"))
            coordinates = old.groups()[:2] if old else (re.search(key + number, block)[1] for key in ("latitude", "longitude"))
            half_digits += [0.5 * 10.0 ** -len(coordinate.partition(".")[2]) for coordinate in coordinates]
            if "gb_pitch" in block:
                gimbal[time_us] = tuple(float(re.search(key + number, block)[1]) for key in ("gb_roll", "gb_pitch", "gb_yaw"))
        begin_us = min(places)
        half_step_mm = half_step_of_rounding_mm([above_home_m for _, _, above_home_m, _ in places.values()])
        messages = self.import_log(file)
        self.assertGreater(len(messages[POSITION]), 0)
        for time, lat, lon, alt_mm, above_home_mm in messages[POSITION]:
            latitude_deg, longitude_deg, above_home_m, alt_m = places[time + begin_us]
            for told, written_deg in ((lat, latitude_deg), (lon, longitude_deg)):  # the import takes the rounding out
                self.assertAlmostEqual(told, written_deg * 1e7, delta=min(half_digits) * 1e7 + 0.6)
            self.assertAlmostEqual(above_home_mm, above_home_m * 1e3, delta=half_step_mm + 0.6)
            if alt_m is not None:
                self.assertAlmostEqual(alt_mm, alt_m * 1e3, delta=0.6)
        self.assertEqual(len(messages[MOUNT]), len(gimbal))
        for time, roll_deg, pitch_deg, yaw_deg, from_north_deg in messages[MOUNT]:
            self.assertTrue(math.isnan(yaw_deg))
            for found, wanted in zip((roll_deg, pitch_deg, from_north_deg), gimbal[time + begin_us]):
                self.assertAlmostEqual(found, wanted, places=4)
        for frame in self.frames:
            if gimbal:
                self.assertNotIn("mount", frame)
            else:
                self.assertAlmostEqual(frame["mount"]["pitch_deg"], -90, places=4)


class CameraMessages(AppTest):
    """What a ground station's log tells of the camera is when the video began; messages by pymavlink."""

    @classmethod
    def setUpClass(cls):
        LogOracles.setUpClass.__func__(cls)

    def told(self, *messages):
        """What an import says of when the video began; (s after the log's beginning, message) of each message."""
        records = [(stamp_us, record) for stamp_us, record in self.records()]
        begin_us, mav = records[0][0], mavlink.MAVLink(None, srcSystem=1, srcComponent=100)
        records += [(begin_us + round(1e6 * at_s), message.pack(mav)) for at_s, message in messages]
        log, recording = self.folder / "flight.tlog", self.folder / "recording"
        log.write_bytes(b"".join(struct.pack(">Q", stamp_us) + frame for stamp_us, frame in sorted(records)))
        labels = self.write("labels.csv", "picture,u,v\n0,1,1\n")
        result = run("geoloc_import", "video", self.sim / "video.mkv", "--camera", self.sim / "camera.json", "--log", log,
                     "--labels", labels, "--out", recording)
        self.assertEqual(result.status, 0, result.err)
        shutil.rmtree(recording)
        return re.search(r"begins ([\d.-]+) s after the log's beginning, (.*), to", result.err).groups()

    def records(self):
        log, at = (self.sim / "telemetry.tlog").read_bytes(), 0
        while at < len(log):
            size = 12 + log[at + 9]
            yield struct.unpack_from(">Q", log, at)[0], log[at + 8:at + 8 + size]
            at += 8 + size

    def test_messages_of_cameras_tell_when_the_video_began(self):
        start = mavlink.MAVLink_command_long_message(1, 100, mavlink.MAV_CMD_VIDEO_START_CAPTURE, 0, 0, 0, 0, 0, 0, 0, 0)
        stop = mavlink.MAVLink_command_long_message(1, 100, mavlink.MAV_CMD_VIDEO_STOP_CAPTURE, 0, 0, 0, 0, 0, 0, 0, 0)
        self.assertEqual(self.told((2, start), (2.5, start), (9, stop)), ("2.00", "by the command to begin a video in the log"))

        def status(runs, recorded_ms):
            return mavlink.MAVLink_camera_capture_status_message(0, 0, runs, 0, recorded_ms, 1000)

        by_status = ("1.50", "by the camera's own status in the log")
        self.assertEqual(self.told((1, start), (1, status(0, 0)), (3, status(1, 1500)), (8, status(1, 6490))), by_status)

        def picture(number):
            return mavlink.MAVLink_camera_image_captured_message(0, 0, 1, 0, 0, 0, 0, [1, 0, 0, 0], number, 1, b"")

        feedback = mavlink.MAVLink_camera_feedback_message(0, 1, 1, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0)
        trigger = mavlink.MAVLink_camera_trigger_message(0, 7)
        by_picture = "by the only camera message in the log"
        self.assertEqual(self.told((2, trigger)), ("2.00", by_picture))
        self.assertEqual(self.told((2, trigger), (2.2, picture(1)), (3, picture(1))), ("2.20", by_picture))
        self.assertEqual(self.told((2, trigger), (2.2, picture(1)), (2.3, feedback)), ("2.30", by_picture))
        self.assertEqual(self.told((2, picture(1)), (4, picture(2)))[1], "by the video's creation time")


if __name__ == "__main__":
    unittest.main()
