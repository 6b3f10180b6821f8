# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import re
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "apps"))

from hostile_rtsp import Dripping, DrippingFrames, EndlessBody, HostileServer, Honest, Redirecting
from lossy_proxy import LossyProxy
from support import AppTest, Live, World, free_port, run

# Promised is a second; a loaded machine may take longer, but not as long as a server that waits.
END_S = 5


def memory_mb(process, which):
    """VmRSS or VmHWM (the most it ever was) of a running process."""
    text = pathlib.Path(f"/proc/{process}/status").read_text()
    return int(re.search(rf"{which}:\s+(\d+) kB", text)[1]) / 1024


class HostileStreams(AppTest):
    """Whatever a camera sends, the app ends when it is told to, within its memory, and does not storm the camera."""

    def watch(self, server, connect_timeout_s=60):
        config = self.write("config.json", {"video": {"connect_timeout_s": connect_timeout_s}})
        return Live("geoloc_app", "--udp", f"127.0.0.1:{free_port()}", "--rtsp", server.url, "--config", config,
                    "--out", self.folder / "objects.geojson")

    def assert_ends_at_once(self, app, name):
        begun = time.monotonic()
        self.assertEqual(app.interrupt(), 0, app.lines)
        took_s = time.monotonic() - begun
        print(f"{name}: ended within {took_s:.2f} s")
        self.assertLess(took_s, END_S)

    def wait_for_request(self, server, method):
        for _ in range(600):
            if method in server.requests:
                return time.sleep(1.0)  # into its answer
            time.sleep(0.1)
        self.fail(f"{method} was never asked for: {server.requests}")

    def test_a_camera_that_drips_its_answers_holds_up_nothing(self):
        for method in "OPTIONS", "DESCRIBE", "SETUP", "PLAY":
            with self.subTest(method), HostileServer(Dripping, method=method) as server, self.watch(server) as app:
                self.wait_for_request(server, method)
                self.assert_ends_at_once(app, f"dripping {method}")

    def test_a_camera_that_drips_frames_or_its_farewell_holds_up_nothing(self):
        for name, answers, options in (("frames", DrippingFrames, {}), ("farewell", Dripping, {"method": "TEARDOWN"}),
                                       ("nothing", Honest, {})):
            with self.subTest(name), HostileServer(answers, **options) as server, self.watch(server) as app:
                self.wait_for_request(server, "PLAY")
                self.assert_ends_at_once(app, f"dripping {name}")

    def test_a_dripping_camera_is_left_and_tried_again(self):
        with HostileServer(Dripping, method="DESCRIBE") as server, self.watch(server, connect_timeout_s=1) as app:
            app.wait_for("video: trying again: .*no frame for 1 s")
            for _ in range(4):  # seconds
                app.wait_for("^00:", after=app.line_count())
            self.assertGreaterEqual(server.connections, 2)
            self.assert_ends_at_once(app, "at a later attempt")

    def test_a_body_of_4_gb_does_not_fill_the_memory(self):
        for method in "DESCRIBE", "PLAY":
            with self.subTest(method), HostileServer(EndlessBody, method=method) as server, self.watch(server) as app:
                app.wait_for("^00:")
                before_mb = memory_mb(app.process_id, "VmRSS")
                app.wait_for("video: trying again: .*sends and sends, but no frame")
                for _ in range(4):  # seconds: more attempts
                    app.wait_for("^00:", after=app.line_count())
                grown_mb = memory_mb(app.process_id, "VmHWM") - before_mb
                print(f"endless body of {method}: the memory grew by {grown_mb:.0f} MB")
                self.assertLess(grown_mb, 250)
                self.assert_ends_at_once(app, f"endless body of {method}")

    def test_a_camera_that_redirects_to_itself_is_not_stormed(self):
        with HostileServer(Redirecting) as server, self.watch(server) as app:
            app.wait_for("video: trying again: .*redirects without end")
            begun, before = time.monotonic(), server.connections
            time.sleep(5)
            rate = (server.connections - before) / (time.monotonic() - begun)
            print(f"redirected to itself: {server.connections - before} connections, {rate:.1f} a second")
            self.assertLess(rate, 10)
            self.assert_ends_at_once(app, "redirected")

    def test_a_redirection_to_another_camera_is_followed(self):
        with HostileServer(Honest) as other, HostileServer(Redirecting, target=other.url) as server, \
                self.watch(server) as app:
            self.wait_for_request(other, "PLAY")
            self.assert_ends_at_once(app, "redirected to another")


class LossyStreams(AppTest):
    """Frames that are damaged on their way are left out, and that is said and counted."""

    def test_lost_packets_are_said_and_counted(self):
        world = World()
        objects, replayed, lines = (self.folder / name for name in ("objects.geojson", "replayed.geojson", "lines.jsonl"))
        config = self.write("config.json", {"video": {"transport": "udp"}})
        with LossyProxy(world.rtsp_port, loss=0.03) as network, \
                world.fly("--start-s", 80, "--end-s", 95, "--speed", 1) as sim, \
                Live("geoloc_app", "--udp", f"127.0.0.1:{world.udp_port}", "--config", config, "--out", objects, "--jsonl", lines,
                     "--rtsp", f"rtsp://127.0.0.1:{network.port}/cam", "--record", self.folder / "recording") as app:
            app.wait_for("video: frames come, but [1-9]\\d* % of them are damaged and left out, "
                         'for [1-9].* % of the packets are lost: set "video": {"transport": "tcp"}')
            app.wait_for(r", [1-9]\d* damaged")
            self.assertEqual(sim.wait(), 0, sim.lines)
            network.loss = 0.0
            self.assertEqual(app.interrupt(), 0)
        damaged = json.loads(objects.read_text())["counters"]["frames_damaged"]
        self.assertGreater(damaged, 10)
        self.assertIn(f"{damaged} more frames were damaged", "\n".join(app.lines))
        states = [line for line in map(json.loads, lines.read_text().splitlines()) if line["type"] == "status"]
        self.assertGreaterEqual(states[-1]["frames_damaged"], damaged - 10)
        self.assertGreater(states[-1]["packets_lost"], 10)
        # The last states may be of the seconds after the camera's end.
        last_of_stream = next(state for state in reversed(states) if "damaged" in state["video"])
        self.assertFalse(last_of_stream["video_is_good"])
        self.assertEqual(run("geoloc_replay", self.folder / "recording", "--out", replayed).status, 0)
        self.assertEqual(objects.read_bytes(), replayed.read_bytes())
        print(f"3 % of packets lost: {damaged} frames damaged, {len(states)} states, {app.lines[-2:]}")


if __name__ == "__main__":
    unittest.main()
