# SPDX-License-Identifier: Apache-2.0
"""What docs/import.md tells pilots to type, typed as it stands, on files that geoloc_sim's flights make."""
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from flight_logs import LATENCY_US, Flight, to_dataflash, to_srt, to_ulog
from support import BIN, SOURCE, AppTest, run

PIECE = ("--seed", 3, "--frame-rate", 4, "--start-s", 75, "--end-s", 105)
FOCAL_35MM_MM = 25.2  # of 70 degrees, as an equivalent that takes the picture for one between 3:2 and 4:3


def commands(section):
    """The shell's lines below a heading of the page."""
    page = (SOURCE / "docs/import.md").read_text()
    text = re.split(r"^## ", page[page.index(f"\n## {section}\n") + 4:], maxsplit=1, flags=re.MULTILINE)[0]
    return "\n".join(re.findall(r"^```sh\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))


def way_m(a, b):
    """Between two positions in degrees, longitude first, near to each other."""
    return math.hypot((a[0] - b[0]) * math.cos(math.radians(a[1])), a[1] - b[1]) * 111_320


class Guide(AppTest):
    """Each pilot gets a map."""

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="geoloc-test-")
        cls.addClassCleanup(holder.cleanup)
        cls.sims = pathlib.Path(holder.name)
        for name, camera in ("fixed", ()), ("gimbal", ("--gimbal", "nadir", "--gimbal-told-yaw", "north")):
            made = run("geoloc_sim", "--record", cls.sims / name, "--video", *PIECE, *camera)
            if made.status != 0:
                raise AssertionError(made.err)

    def setUp(self):
        super().setUp()
        for model, name in ("fiducial.onnx", "best.onnx"), ("fiducial_second_look.onnx", "fiducial_second_look.onnx"):
            shutil.copy(SOURCE / "data/models" / model, self.folder / name)

    def fly(self, name, video):
        """A flight with its video in the folder: the flight, and when its frames were stamped."""
        sim = self.sims / name
        shutil.copy(sim / "video.mkv", self.folder / video)
        flight = Flight(sim / "telemetry.tlog")
        frames = [json.loads(line) for line in (sim / "frames.jsonl").read_text().splitlines()]
        stamps_us = [frame["time_us"] - flight.utc_us for frame in frames]
        targets = json.loads((sim / "truth.geojson").read_text())["features"]
        self.truth = [target["geometry"]["coordinates"] for target in targets]
        return flight, stamps_us

    def type_in(self, section, map_name, most_error_m):
        script = commands(section)
        self.assertIn("geoloc_import", script)
        done = subprocess.run(["bash", "-euc", script], cwd=self.folder, capture_output=True, text=True, timeout=250, check=False,
                              env={**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"})
        self.assertEqual(done.returncode, 0, done.stderr)
        objects = json.loads((self.folder / f"{map_name}.geojson").read_text())["features"]
        self.assertTrue((self.folder / f"{map_name}.kml").exists())
        self.assertGreaterEqual(len(objects), 3, done.stderr)
        for found in objects:
            self.assertLess(min(way_m(found["geometry"]["coordinates"], true) for true in self.truth), most_error_m, done.stderr)
        return done.stderr

    def test_a_dji_pilot(self):
        flight, stamps_us = self.fly("gimbal", "DJI_0001.MP4")
        exposed_us = [stamp_us - LATENCY_US for stamp_us in stamps_us]
        (self.folder / "DJI_0001.SRT").write_text(to_srt(flight, exposed_us, focal_35mm_mm=FOCAL_35MM_MM))
        said = self.type_in("You fly a DJI", "objects", 1.5)  # its subtitles tell neither angles nor accuracy
        self.assertIn("with a pitch of -90 degrees", said)

    def test_an_ardupilot_pilot(self):
        flight, stamps_us = self.fly("fixed", "flight.mp4")
        (self.folder / "00000042.BIN").write_bytes(to_dataflash(flight, [stamps_us[0]]))
        said = self.type_in("You fly ArduPilot", "copter", 0.5)
        self.assertIn("by the command to begin a video in the log", said)

    def test_a_px4_pilot(self):
        flight, stamps_us = self.fly("gimbal", "flight.mp4")
        (self.folder / "12_30_05.ulg").write_bytes(to_ulog(flight, [stamps_us[0]], flight.gimbal))
        said = self.type_in("You fly PX4", "mission", 0.5)
        self.assertIn("by the command to begin a video in the log", said)


if __name__ == "__main__":
    unittest.main()
