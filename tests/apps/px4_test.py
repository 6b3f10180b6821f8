# SPDX-License-Identifier: Apache-2.0
"""PX4 on the link: its messages by pymavlink, a real log of it played as telemetry, and a simulated flight."""
import os
import pathlib
import re
import threading
import time
import unittest

from link_test import COMPANION, Link, Speaker
from pymavlink.dialects.v10 import common as mavlink_v1
from pymavlink.dialects.v20 import common as mavlink
from pyulog import ULog
from support import SOURCE, rmse_m, run

REAL_LOG = pathlib.Path(os.environ.get("GEOLOC_REAL_DATA", SOURCE.parent / "shared/data/real")) / "px4/sample_log_small.ulg"
# The flags of ESTIMATOR_STATUS in flight, with a receiver that is not believed, and on the ground without a fix.
FINE, GLITCH, CONSTANT_POSITION = 831, 831 | mavlink.ESTIMATOR_GPS_GLITCH, 229
SET_MESSAGE_INTERVAL = mavlink.MAV_CMD_SET_MESSAGE_INTERVAL


class Px4(Speaker):
    """A PX4 that sends its state, as its link to an onboard computer does."""

    def __init__(self, port, flags=FINE):
        super().__init__(port)
        self.flags = flags

    def heartbeat(self):
        self.mav.heartbeat_send(mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4, 157, 4 << 24 | 4 << 16, 4)

    def boot_us(self):
        return int(1e6 * (time.monotonic() - self.began)) + 100_000_000

    def state(self):
        super().state()
        self.status(self.flags)
        self.mav.timesync_send(0, 1000 * self.boot_us())

    def status(self, flags, accuracy_m=0.5):
        self.mav.estimator_status_send(self.boot_us(), flags, 0.01, 0.02, 0.03, 0.04, 0.05, 0, accuracy_m, 0.6)

    def commands(self, patience_s):
        """(command, message id) of each COMMAND_LONG, and whether a TIMESYNC answered."""
        commands, has_answered = set(), False
        deadline = time.monotonic() + patience_s
        while time.monotonic() < deadline:
            try:
                messages = self.mav.parse_buffer(self.socket.recv(2048)) or []
            except (TimeoutError, ConnectionRefusedError):
                continue
            for message in messages:
                if message.get_type() == "COMMAND_LONG":
                    commands.add((message.command, int(message.param1)))
                has_answered |= message.get_type() == "TIMESYNC" and message.tc1 != 0
        return commands, has_answered


class Px4Link(Link):
    """What geoloc makes of PX4's messages, and sends to it."""

    def px4(self, **settings):
        speaker = Px4(self.world.udp_port, **settings)
        self.addCleanup(speaker.close)
        return speaker

    def speak(self, speaker, rate_hz=10):
        """Sends heartbeats and state until the test ends."""
        is_over = threading.Event()

        def go_on():
            while not is_over.wait(1 / rate_hz):
                speaker.heartbeat()
                speaker.state()

        thread = threading.Thread(target=go_on)
        thread.start()
        self.addCleanup(thread.join)
        self.addCleanup(is_over.set)

    def test_its_estimator_vetoes_positions_and_names_glitches(self):
        vehicle = self.px4(flags=CONSTANT_POSITION)
        with self.world.watch() as app:
            self.speak(vehicle)
            app.wait_for("its estimator says that it does not know where it is")
            vehicle.flags = FINE
            app.wait_for("vehicle 1: telemetry comes")
            vehicle.flags = GLITCH
            app.wait_for("its estimator reports a GNSS glitch")
            self.assertEqual(app.interrupt(), 0)

    def test_it_is_asked_for_its_own_messages_and_its_requests_are_left_alone(self):
        vehicle = self.px4()
        with self.world.watch() as app:
            self.speak(vehicle, rate_hz=2)
            app.wait_for("vehicle 1: telemetry comes")
            commands, has_answered = vehicle.commands(patience_s=6)
            self.assertEqual(app.interrupt(), 0)
        asked = {message for command, message in commands if command == SET_MESSAGE_INTERVAL}
        self.assertEqual({command for command, _ in commands}, {SET_MESSAGE_INTERVAL})
        self.assertLessEqual({mavlink.MAVLINK_MSG_ID_ATTITUDE, mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT}, asked)
        self.assertNotIn(193, asked, "EKF_STATUS_REPORT is ArduPilot's")
        self.assertFalse(has_answered, "another companion's clock may be the one that PX4 follows")

    def test_one_that_speaks_mavlink_1_hears_mavlink_2(self):
        old = self.speaker()
        old.mav = mavlink_v1.MAVLink(old, srcSystem=1, srcComponent=1)
        with self.world.watch() as app:
            app.wait_for("^00:")
            old.mav.heartbeat_send(mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4, 0, 0, 0)
            old.mav = mavlink.MAVLink(old, srcSystem=1, srcComponent=1)
            self.assertIn(("HEARTBEAT", COMPANION), old.hear(10, until=("HEARTBEAT", COMPANION)))
            self.assertEqual(app.interrupt(), 0)


@unittest.skipUnless(REAL_LOG.exists(), f"{REAL_LOG} is not here")
class Px4Log(Link):
    """A real log of PX4 (CubeOrange, 1.11, on the ground), told as PX4 tells the same topics on a link."""
    TOPICS = ["vehicle_attitude", "vehicle_gps_position", "estimator_status", "vehicle_local_position"]

    def setUp(self):
        super().setUp()
        log = ULog(str(REAL_LOG), self.TOPICS)
        topics = {topic.name: topic.data for topic in log.data_list if topic.multi_id == 0}
        self.samples = sorted(((int(time_us), name, {field: values[i] for field, values in data.items()})
                               for name, data in topics.items() for i, time_us in enumerate(data["timestamp"])),
                              key=lambda sample: sample[0])
        self.place = next((int(sample["lat"]), int(sample["lon"]), int(sample["alt"]))
                          for _, name, sample in self.samples if name == "vehicle_gps_position")

    def play(self, app, flags=None):
        """Sends the log's samples as fast as they were; `flags` in place of the estimator's own."""
        vehicle = self.speaker()
        app.wait_for("^00:")
        began_s = time.monotonic()
        for time_us, name, sample in self.samples:
            time.sleep(max(0.0, began_s + (time_us - self.samples[0][0]) / 1e6 - time.monotonic()))
            self.tell(vehicle.mav, name, time_us, sample, flags)

    def tell(self, mav, name, time_us, sample, flags):
        if name == "vehicle_attitude":
            mav.attitude_quaternion_send(time_us // 1000, *(float(sample[f"q[{i}]"]) for i in range(4)), 0, 0, 0)
        elif name == "vehicle_gps_position":
            mav.heartbeat_send(mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4, 0, 0, 0)
            mav.gps_raw_int_send(time_us, int(sample["fix_type"]), *self.place, 0, 0, 0, 0, int(sample["satellites_used"]),
                                 int(sample["alt_ellipsoid"]), int(1e3 * sample["eph"]), int(1e3 * sample["epv"]))
        elif name == "estimator_status":
            mav.estimator_status_send(time_us, flags or int(sample["solution_status_flags"]), 0, 0, 0, 0, 0, 0,
                                      float(sample["pos_horiz_accuracy"]), float(sample["pos_vert_accuracy"]))
        else:
            mav.global_position_int_send(time_us // 1000, *self.place, int(-1e3 * sample["z"]), 0, 0, 0, 0)

    def test_its_estimator_did_not_know_where_it_was_although_the_receiver_did(self):
        with self.world.watch() as app:
            self.play(app)
            app.wait_for("vehicle 1: no position comes: its estimator says that it does not know where it is")
            self.assertEqual(app.interrupt(), 0)

    def test_with_an_estimator_that_knows_it_telemetry_comes(self):
        with self.world.watch() as app:
            self.play(app, FINE)
            app.wait_for("vehicle 1: telemetry comes")
            self.assertEqual(app.interrupt(), 0)


class Px4Flight(Link):
    """A simulated flight by PX4 is mapped as one by ArduPilot."""
    PIECE = ("--start-s", 80, "--end-s", 95, "--speed", 3)

    def score(self, recording, truth):
        result = run("geoloc_replay", recording, "--truth", truth)
        self.assertEqual(result.status, 0, result.err)
        return int(re.search(r"found (\d+)", result.err)[1]), rmse_m(result.err), result.err

    def test_its_messages_are_worth_what_ardupilots_are(self):
        scores = []
        for autopilot in "ardupilot", "px4":
            recording = self.make_recording(autopilot, "--autopilot", autopilot)
            scores.append(self.score(recording, recording / "truth.geojson")[:2])
        self.assertEqual(*scores)

    def test_a_home_that_is_set_anew_in_flight_is_noticed(self):
        """By the two heights of GLOBAL_POSITION_INT, as ArduPilot's is."""
        for link in "px4", "px4-ground":
            recording = self.folder / f"{link}-home"
            made = run("geoloc_sim", "--record", recording, "--autopilot", link, "--jump", "home")
            self.assertEqual(made.status, 0, made.err)
            found, error_m, said = self.score(recording, recording / "truth.geojson")
            self.assertIn("the vehicle's home was set 3.0 m lower: heights stay above the first one", said)
            self.assertEqual(found, 30, said)
            self.assertLess(error_m, 0.1)

    def test_live_on_each_of_its_links(self):
        for link in "px4", "px4-ground":
            with self.subTest(link):
                truth, recording = self.folder / f"{link}.geojson", self.folder / link
                with self.world.watch("--record", recording) as app:
                    with self.world.fly("--autopilot", link, "--truth", truth, *self.PIECE) as sim:
                        app.wait_for("vehicle 1: telemetry comes")
                        self.assertEqual(sim.wait(), 0, sim.lines)
                    self.assertEqual(app.interrupt(), 0)
                found, _, said = self.score(recording, truth)
                self.assertGreater(found, 0, said)
                self.assertIn("extra 0", said)


if __name__ == "__main__":
    unittest.main()
