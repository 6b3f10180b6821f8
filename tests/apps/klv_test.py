# SPDX-License-Identifier: Apache-2.0
"""MISB ST 0601 in MPEG transport streams (--klv): the streams read by FFmpeg's libraries (PyAV), the metadata by klvdata."""
import itertools
import json
import math
import re
import socket
import tempfile
import threading
import unittest

import av
import klvdata

from support import AppTest, Live, World, free_port, run
from video_import_test import VideoTest

# A part of the flight with targets in view.
PIECE = ("--start-s", 80, "--end-s", 90)
TELEMETRY = bytes.fromhex("8d646b4e556f4a908b7c35e629510321")  # of video with telemetry in its frames
EARTH_M = 6371e3
DATAGRAM = 1316  # seven packets
IDR, PARAMETER_SETS = 5, {7, 8}  # units of H.264


class Stream:
    """A transport stream's packets: (presentation time [s], bytes) of the video, and (time, items by tag) of the metadata."""

    def __init__(self, source):
        self.pictures, self.sets, self.order = [], [], []
        with av.open(str(source), format="mpegts") as container:
            self.kinds = sorted(stream.type for stream in container.streams)
            for packet in container.demux():
                if packet.size == 0:
                    continue
                time_s = float(packet.pts * packet.time_base)
                if packet.stream.type == "video":
                    self.pictures.append((time_s, bytes(packet)))
                else:
                    self.sets.append((time_s, items_of(bytes(packet))))
                self.order.append((packet.stream.type, time_s))

    def set_of(self, time_s):
        """The metadata of the picture that is shown then; None without."""
        found = [items for at_s, items in self.sets if abs(at_s - time_s) < 1e-4]
        assert len(found) <= 1, time_s
        return found[0] if found else None


def items_of(packet):
    """Values by tags; klvdata refuses a set that is damaged."""
    sets = list(klvdata.StreamParser(packet))
    assert len(sets) == 1 and isinstance(sets[0], klvdata.misb0601.UASLocalMetadataSet), sets
    values = {element.TAG: element.value.value for element in sets[0].items.values()}
    assert values[1] == klvdata.common.packet_checksum(packet), "the checksum"
    return values


def time_us(items):
    return round(items[2].timestamp() * 1e6)


def of_h264(unit):
    return unit & 31 in (1, IDR, 6)


def of_h265(unit):
    return unit >> 1 < 32


def units_of(picture, is_content=of_h264):
    """The NAL units of a picture that are its own: slices and messages (SEI); by start codes or by lengths of four bytes."""
    units, at = [], 0
    if picture[:4] == b"\0\0\0\1" or picture[:3] == b"\0\0\1":
        units = [unit.rstrip(b"\0") for unit in picture.split(b"\0\0\1")[1:]]
    else:
        while at < len(picture):
            size = int.from_bytes(picture[at:at + 4], "big")
            units.append(picture[at + 4:at + 4 + size].rstrip(b"\0"))
            at += 4 + size
    return [unit for unit in units if is_content(unit[0])]


def pictures_of(video):
    with av.open(str(video)) as container:
        return [bytes(packet) for packet in container.demux(video=0) if packet.size > 0]


def told_us(picture):
    """The time that a picture's own telemetry tells."""
    record = picture[picture.index(TELEMETRY) + len(TELEMETRY):]
    return json.JSONDecoder().raw_decode(record[:record.rindex(b"}") + 1].decode("latin-1"))[0]["utc_us"]


def aim(items):
    """North and east [m] from the sensor to where its angles and range point, and how far it is below."""
    azimuth, elevation = math.radians(items[18]), math.radians(items[19])
    forward, right, down = math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), -math.sin(elevation)
    heading, pitch, roll = (math.radians(items[tag]) for tag in (5, 6, 7))
    right, down = right * math.cos(roll) - down * math.sin(roll), right * math.sin(roll) + down * math.cos(roll)
    forward, down = forward * math.cos(pitch) + down * math.sin(pitch), -forward * math.sin(pitch) + down * math.cos(pitch)
    north, east = (forward * math.cos(heading) - right * math.sin(heading), forward * math.sin(heading) + right * math.cos(heading))
    return tuple(items[21] * part for part in (north, east, down))


class KlvTest(AppTest):
    def assert_plausible(self, items):
        """That the items of a set tell one story: from the sensor along its angles to the centre of the frame."""
        north_m, east_m, down_m = aim(items)
        latitude = math.radians(items[13])
        self.assertAlmostEqual(math.radians(items[23] - items[13]) * EARTH_M, north_m, delta=0.3)
        self.assertAlmostEqual(math.radians(items[24] - items[14]) * EARTH_M * math.cos(latitude), east_m, delta=0.3)
        self.assertAlmostEqual(items[15] - items[25], down_m, delta=0.5)  # steps of 0.3 m
        corners = [(items[tag], items[tag + 1]) for tag in (82, 84, 86, 88)]
        for value, (low, high) in zip((items[23], items[24]), map(lambda axis: (min(axis), max(axis)), zip(*corners, strict=True)), strict=True):
            self.assertLess(low, value)
            self.assertLess(value, high)

    def assert_in_order(self, stream):
        """Metadata is not later than a picture's time in the stream: beside the picture that it is of."""
        latest = 0.0
        for kind, time_s in stream.order:
            if kind == "video":
                latest = max(latest, time_s)
            else:
                self.assertGreaterEqual(time_s, latest - 0.2)


class KlvOfRecordings(KlvTest):
    def setUp(self):
        super().setUp()
        self.recording = self.make_recording()
        self.stream, self.lines = self.folder / "run.ts", self.folder / "run.jsonl"
        replayed = run("geoloc_replay", self.recording, "--klv", self.stream, "--jsonl", self.lines)
        self.assertEqual(replayed.status, 0, replayed.err)

    def test_each_frame_has_its_set(self):
        stream = Stream(self.stream)
        self.assertEqual(stream.kinds, ["data"])
        frames = [line for line in map(json.loads, self.lines.read_text().splitlines()) if line["type"] == "frame"]
        self.assertEqual([time_us(items) for _, items in stream.sets], [frame["time_us"] for frame in frames])
        first_s, begin_us = stream.sets[0][0], frames[0]["time_us"]
        located = 0
        for (time_s, items), frame in zip(stream.sets, frames, strict=True):
            self.assertAlmostEqual(time_s - first_s, 1e-6 * (frame["time_us"] - begin_us), delta=2e-5)  # of 90 kHz
            self.assertEqual(13 in items, frame["vehicle"] is not None)
            if not frame["vehicle"]:
                continue
            located += 1
            longitude, latitude = frame["vehicle"]["coordinates"]
            self.assertAlmostEqual(items[13], latitude, delta=1e-5)  # the camera is calibrated, the vehicle is not
            self.assertAlmostEqual(items[14], longitude, delta=1e-5)
            self.assertAlmostEqual((items[5] - frame["vehicle"]["yaw_deg"] + 180) % 360 - 180, 0, delta=0.005)
            self.assertAlmostEqual(items[6], frame["vehicle"]["pitch_deg"], delta=0.002)
            self.assertAlmostEqual(items[7], frame["vehicle"]["roll_deg"], delta=0.002)
            for tag, corner in zip((82, 84, 86, 88), frame["footprint"], strict=True):
                self.assertAlmostEqual(items[tag], corner[1], delta=1e-7)
                self.assertAlmostEqual(items[tag + 1], corner[0], delta=1e-7)
            self.assert_plausible(items)
        self.assertGreater(located, 50)

    def test_the_same_recording_gives_the_same_bytes(self):
        again = self.folder / "again.ts"
        self.assertEqual(run("geoloc_replay", self.recording, "--klv", again).status, 0)
        self.assertEqual(self.stream.read_bytes(), again.read_bytes())

    def test_what_is_no_target_is_refused(self):
        for bad in ("tcp://127.0.0.1:5004", "udp://127.0.0.1", "udp://127.0.0.1:0"):
            self.assert_refused(run("geoloc_replay", self.recording, "--klv", bad), bad, "udp://HOST:PORT")
        self.assert_refused(run("geoloc_replay", self.recording, "--klv", self.folder / "no" / "run.ts"), "there is no folder")
        self.assert_refused(run("geoloc_replay", self.recording, "--klv", self.recording / "frames.jsonl"), "is an input of this run")


class KlvOfVideos(VideoTest, KlvTest):
    """A file with telemetry in its frames, played by geoloc_app: each picture tells when it was taken, and so does its metadata."""
    SPAN = (*PIECE, "--sei")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.stream_file = cls.sim / "run.ts"
        with Live("geoloc_app", "--video", cls.video, "--klv", cls.stream_file) as app:
            status = app.wait()
            if status != 0:
                raise AssertionError(app.lines)
        cls.stream = Stream(cls.stream_file)

    def test_the_video_is_passed_on_bit_by_bit(self):
        self.assertEqual(self.stream.kinds, ["data", "video"])
        passed = [units_of(picture) for _, picture in self.stream.pictures]
        self.assertEqual(passed, [units_of(picture) for picture in pictures_of(self.video)])
        self.assertGreater(len(passed), 90)

    def test_whoever_joins_later_finds_what_a_decoder_needs(self):
        """Each picture that stands for itself comes with the parameter sets."""
        kinds = [{unit[0] & 31 for unit in re.split(b"\0\0\1", picture)[1:]} for _, picture in self.stream.pictures]
        whole = [kind for kind in kinds if IDR in kind]
        self.assertGreater(len(whole), 0)
        for kind in whole:
            self.assertLessEqual(PARAMETER_SETS, kind)

    def test_metadata_is_of_the_picture_that_is_shown_with_it(self):
        self.assert_in_order(self.stream)
        differences, located = set(), 0
        for time_s, picture in self.stream.pictures:
            items = self.stream.set_of(time_s)
            if items is None:
                continue  # a frame for which the detector had no time
            differences.add(time_us(items) - told_us(picture))
            if 13 in items:
                self.assert_plausible(items)
                located += 1
        self.assertEqual(len(differences), 1)  # the clock of a file's first picture is that of its playing
        self.assertGreater(located, 20)
        self.assertGreaterEqual(len(self.stream.sets), located)

    def played(self, name, codec, pixels="yuv420p", **options):
        """The beginning of the video in another file, what comes of it, and what geoloc_app says; without telemetry."""
        other = self.folder / name
        with av.open(str(self.video)) as source, av.open(str(other), "w") as target:
            stream = target.add_stream(codec, rate=10)
            stream.width, stream.height, stream.pix_fmt, stream.options = 1280, 720, pixels, options
            for frame in itertools.islice(source.decode(video=0), 15):
                target.mux(stream.encode(frame.reformat(format=pixels)))
            target.mux(stream.encode(None))
        with Live("geoloc_app", "--udp", f"127.0.0.1:{free_port()}", "--video", other, "--klv", self.folder / "other.ts") as app:
            self.assertEqual(app.wait(), 0, app.lines)
        return other, Stream(self.folder / "other.ts"), "\n".join(app.lines)

    def test_pictures_out_of_order_and_h265_are_passed_on_too(self):
        for name, codec, is_content, options in (("other.mp4", "libx264", of_h264, {"bf": "2", "preset": "veryfast"}),
                                                 ("other.mkv", "libx265", of_h265, {"preset": "ultrafast", "x265-params": "log-level=error"})):
            other, stream, _ = self.played(name, codec, **options)
            self.assertEqual([units_of(picture, is_content) for _, picture in stream.pictures],
                             [units_of(picture, is_content) for picture in pictures_of(other)], codec)
            self.assertEqual(len(stream.pictures), 15)

    def test_a_video_that_cannot_be_passed_on_leaves_the_metadata(self):
        """Motion JPEG is none that a transport stream has."""
        _, stream, said = self.played("other.mkv", "mjpeg", "yuvj420p")
        self.assertIn("neither H.264 nor H.265", said)
        self.assertEqual(stream.kinds, ["data"])


class Receiver:
    """Keeps the datagrams that come to a port of the loopback."""

    def __init__(self):
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self._socket.settimeout(0.2)
        self.url = f"udp://127.0.0.1:{self._socket.getsockname()[1]}"
        self.datagrams, self._is_over = [], False
        self._thread = threading.Thread(target=self._receive)
        self._thread.start()

    def _receive(self):
        while not self._is_over:
            try:
                self.datagrams.append(self._socket.recv(65536))
            except TimeoutError:
                continue

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._is_over = True
        self._thread.join()
        self._socket.close()


class KlvOfStreams(KlvTest):
    def test_a_cameras_stream_goes_on_by_udp_with_what_it_shows(self):
        world = World()
        with Receiver() as receiver:
            with Live("geoloc_app", *world.inputs()[2:], "--klv", receiver.url) as app, world.fly("--sei", *PIECE) as sim:
                app.wait_for("^telemetry comes in the video$")
                self.assertEqual(sim.wait(), 0, sim.lines)
                self.assertEqual(app.interrupt(), 0, app.lines)
            datagrams = receiver.datagrams
        self.assertTrue(datagrams)
        self.assertEqual({len(datagram) for datagram in datagrams}, {DATAGRAM})
        with tempfile.NamedTemporaryFile(suffix=".ts", dir=self.folder) as file:
            file.write(b"".join(datagrams))
            file.flush()
            stream = Stream(file.name)
        self.assertEqual(stream.kinds, ["data", "video"])
        self.assert_in_order(stream)
        checked = 0
        for time_s, picture in stream.pictures:
            items = stream.set_of(time_s)
            if items is not None and 13 in items and TELEMETRY in picture:
                self.assertEqual(time_us(items), told_us(picture))
                self.assert_plausible(items)
                checked += 1
        self.assertGreater(checked, 10, app.lines)

    def test_nobody_has_to_listen(self):
        with Receiver() as receiver:
            url = receiver.url
        recording = self.make_recording()
        self.assertEqual(run("geoloc_replay", recording, "--klv", url).status, 0)


if __name__ == "__main__":
    unittest.main()
