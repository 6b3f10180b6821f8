# SPDX-License-Identifier: Apache-2.0
"""Who else speaks on the vehicle's link, by pymavlink: forgers, and a vehicle that signs its messages."""
import contextlib
import json
import socket
import threading
import time
import unittest

from pymavlink.dialects.v20 import common as mavlink

from support import PATIENCE_S, AppTest, World, run

KEY = bytes(range(32))
SECOND = 100_000  # of signing's time stamps
LATITUDE, LONGITUDE = -22.906, -43.133
COMPANION = (1, 191)  # what geoloc is on the link


class Speaker:
    """A system that sends messages from a port of its own."""

    def __init__(self, port, system=1, key=None, stamp=None):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(("127.0.0.1", port))
        self.socket.settimeout(0.2)
        self.sent = []
        self.mav = mavlink.MAVLink(self, srcSystem=system, srcComponent=1)
        self.mav.robust_parsing = True  # what is not valid is BAD_DATA
        self.began = time.monotonic()
        if key:
            signing = self.mav.signing
            signing.secret_key, signing.sign_outgoing, signing.timestamp = key, True, stamp

    def check_by(self, key):
        """What comes is valid to it if it is signed by that key."""
        self.mav.signing.secret_key = key

    def write(self, frame):
        """What pymavlink calls with each frame."""
        self.sent.append(bytes(frame))
        self.send(frame)

    def send(self, datagram):
        try:
            self.socket.send(datagram)
        except ConnectionRefusedError:  # the program is not up yet, or down
            pass

    def heartbeat(self):
        self.mav.heartbeat_send(mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, 0, 0, 0)

    def state(self, latitude=LATITUDE, longitude=LONGITUDE):
        boot_ms = int(1e3 * (time.monotonic() - self.began)) + 100_000
        self.mav.attitude_send(boot_ms, 0, 0, 0, 0, 0, 0)
        self.mav.global_position_int_send(boot_ms, int(1e7 * latitude), int(1e7 * longitude), 30_000, 20_000, 0, 0, 0, 0)

    def timesync_answer(self):
        now_us = time.time_ns() // 1000
        self.mav.timesync_send(10**15, 1000 * now_us + 191)

    def hear(self, patience_s=2, until=None):
        """(type, sender) of the messages that came, each of which pymavlink took for valid."""
        heard = set()
        deadline = time.monotonic() + patience_s
        while time.monotonic() < deadline and until not in heard:
            try:
                datagram = self.socket.recv(2048)
            except (TimeoutError, ConnectionRefusedError):
                continue
            for message in self.mav.parse_buffer(datagram) or []:
                if message.get_type() != "BAD_DATA":
                    heard.add((message.get_type(), (message.get_srcSystem(), message.get_srcComponent())))
        return heard

    def close(self):
        self.socket.close()


class Link(AppTest):
    def setUp(self):
        super().setUp()
        self.world = World()
        self.objects_file = self.folder / "objects.geojson"

    def speaker(self, **settings):
        speaker = Speaker(self.world.udp_port, **settings)
        self.addCleanup(speaker.close)
        return speaker


class ForgedLink(Link):
    """Whoever reaches the port cannot take the vehicle's place."""

    def test_a_flight_among_forgers_is_mapped_and_is_its_replay(self):
        stranger, twin = self.speaker(system=7), self.speaker()
        is_over = threading.Event()

        def forge():
            while not is_over.wait(0.05):
                stranger.heartbeat()
                twin.heartbeat()
                twin.state(LATITUDE + 3)
                twin.timesync_answer()

        recording = self.folder / "recording"
        with self.world.watch("--out", self.objects_file, "--record", recording) as app:
            app.wait_for("listening for MAVLink")
            stranger.heartbeat()
            app.wait_for("vehicle 7: no attitude comes")
            with self.world.fly("--start-s", 80, "--end-s", 95, "--speed", 3) as sim:
                app.wait_for("vehicle 1: telemetry comes")
                forger = threading.Thread(target=forge)
                forger.start()
                try:
                    self.assertEqual(sim.wait(), 0, sim.lines)
                finally:
                    is_over.set()
                    forger.join()
            app.wait_for("objects [1-9]", after=app.line_count() - 1)
            self.assertEqual(app.interrupt(), 0)
        self.assertTrue(any("what 127.0.0.1:" in line and "under its name is refused" in line for line in app.lines), app.lines)
        self.assertTrue(any(line.startswith("MAVLink messages refused: ") for line in app.lines), app.lines)
        objects = json.loads(self.objects_file.read_text())
        self.assertGreater(len(objects["features"]), 0)
        # Some are of the seconds before the vehicle was known, which are many on a busy machine.
        self.assertLess(objects["counters"]["frames_unusable"], 0.5 * objects["counters"]["frames"])
        for feature in objects["features"]:
            self.assertAlmostEqual(feature["geometry"]["coordinates"][1], LATITUDE, delta=0.01)
        replayed = self.folder / "replayed.geojson"
        self.assertEqual(run("geoloc_replay", recording, "--out", replayed).status, 0)
        self.assertEqual(self.objects_file.read_bytes(), replayed.read_bytes())


class SignedLink(Link):
    """With a key, what is not signed by it has no effect, and what geoloc sends is valid to pymavlink."""

    def setUp(self):
        super().setUp()
        self.key_file = self.folder / "key"
        self.key_file.write_text(KEY.hex() + "\n")
        self.config = self.write("config.json", {"mavlink": {"signing_key_file": str(self.key_file)}})
        self.now = (time.time_ns() // 10_000) - 1_420_070_400 * SECOND

    def watch(self):
        return self.world.watch("--config", self.config, "--out", self.objects_file)

    @contextlib.contextmanager
    def speaking(self, speaker):
        """Heartbeats and state are sent meanwhile, and once before."""
        is_over = threading.Event()

        def speak():
            speaker.heartbeat()
            speaker.state()

        def go_on():
            while not is_over.wait(0.1):
                speak()

        speak()
        thread = threading.Thread(target=go_on)
        thread.start()
        try:
            yield
        finally:
            is_over.set()
            thread.join()

    def tell(self, speaker, app, message):
        """Sends state until the program has said something."""
        seen = app.line_count()
        with self.speaking(speaker):
            app.wait_for(message, after=seen)

    def test_both_directions_and_over_a_restart(self):
        unsigned, stranger = self.speaker(), self.speaker(key=bytes(32), stamp=self.now)
        vehicle = self.speaker(key=KEY, stamp=self.now)
        with self.watch() as app:
            self.tell(unsigned, app, "waiting for a vehicle: .* not signed by mavlink.signing_key_file are refused")
            self.tell(stranger, app, "^00:")
            self.assertEqual(unsigned.hear() | stranger.hear(), set())
            self.tell(vehicle, app, "vehicle 1: telemetry comes")
            self.assertLessEqual({("HEARTBEAT", COMPANION), ("TIMESYNC", COMPANION)}, vehicle.hear())
            later = self.speaker(key=KEY, stamp=self.now + 120 * SECOND)
            time.sleep(4)  # the vehicle is silent, so that it may speak from another port
            with self.speaking(later):
                self.assertIn(("HEARTBEAT", COMPANION), later.hear(PATIENCE_S, until=("HEARTBEAT", COMPANION)))
            self.assertEqual(app.interrupt(), 0)
        self.assertTrue(any("not signed, " in line and "signed by another key" in line for line in app.lines), app.lines)
        stamps = (self.folder / "key.stamps").read_text()
        heard = int(stamps.split()[3])
        self.assertGreaterEqual(heard, self.now + 120 * SECOND)

        with self.watch() as app:
            app.wait_for("^00:")
            for _ in range(10):
                for frame in vehicle.sent:
                    vehicle.send(frame)
            app.wait_for("waiting for a vehicle: .* are refused")
            self.tell(self.speaker(key=KEY, stamp=heard + 1), app, "vehicle 1: telemetry comes")
            self.assertEqual(app.interrupt(), 0)
        self.assertTrue(any(line.startswith("MAVLink messages refused: ") and line.endswith(" repeated") for line in app.lines),
                        app.lines)

    def test_a_listener_with_another_key_finds_nothing_valid(self):
        vehicle = self.speaker(key=KEY, stamp=self.now)
        with self.watch() as app:
            app.wait_for("^00:")
            self.tell(vehicle, app, "vehicle 1: telemetry comes")
            vehicle.check_by(bytes(32))
            self.assertEqual(vehicle.hear(), set())
            self.assertEqual(app.interrupt(), 0)

    def test_files_that_are_no_key_are_refused(self):
        for content in ("", "key", KEY.hex() + "0", "g" * 64):
            self.key_file.write_text(content)
            result = run("geoloc_app", *self.world.inputs(), "--config", self.config)
            self.assert_refused(result, self.key_file, "no signing key", "openssl rand")
        self.key_file.unlink()
        self.assert_refused(run("geoloc_app", *self.world.inputs(), "--config", self.config), self.key_file)

    def test_a_place_for_the_stamps_that_cannot_be_written_is_refused(self):
        config = self.write("config.json", {"mavlink": {"signing_key_file": str(self.key_file),
                                                        "signing_state_file": "/proc/nowhere/stamps"}})
        self.assert_refused(run("geoloc_app", *self.world.inputs(), "--config", config), "mavlink.signing_state_file")

    def test_damaged_stamps_are_said_and_begun_anew(self):
        (self.folder / "key.stamps").write_bytes(b"\0" * 40)
        with self.watch() as app:
            app.wait_for("holds no stamps of signed messages and is begun anew")
            self.tell(self.speaker(key=KEY, stamp=self.now), app, "vehicle 1: telemetry comes")
            self.assertEqual(app.interrupt(), 0)
        self.assertRegex((self.folder / "key.stamps").read_text(), r"^sent \d+\nheard \d+\n$")


if __name__ == "__main__":
    unittest.main()
