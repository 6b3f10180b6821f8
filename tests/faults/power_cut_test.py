# SPDX-License-Identifier: Apache-2.0
"""A power cut, or kill -9, costs two seconds of a flight at most, and what is left can be replayed."""
import bisect
import json
import os
import pathlib
import random
import struct
import tempfile
import time
import unittest

from flight_under_fault import FaultTest, shim, wait_until
from support import run
from synced_disk import SyncedDisk

MOST_LOST_S = 2.0
KILLS = int(os.environ.get("GEOLOC_KILLS", 5))  # scripts/soak.sh makes 100
KILLS_PER_FLIGHT = 5
METADATA = "camera.json", "config.json", "class_names.json"


def telemetry_stamps_s(folder):
    """When each record of the log was received, up to its (possibly torn) end."""
    log, stamps, offset = (folder / "telemetry.tlog").read_bytes(), [], 0
    while offset + 11 <= len(log) and log[offset + 8] in (0xFD, 0xFE):
        is_v2 = log[offset + 8] == 0xFD
        size = (12 if is_v2 else 8) + log[offset + 9] + (13 if is_v2 and log[offset + 10] & 1 else 0)
        if offset + 8 + size > len(log):
            break
        stamps.append(struct.unpack_from(">Q", log, offset)[0] * 1e-6)
        offset += 8 + size
    return stamps


def frame_lines(folder):
    """The whole lines."""
    return (folder / "frames.jsonl").read_bytes().rpartition(b"\n")[0].split(b"\n")


def frames_processed_s(folder, stamps_s):
    """When each frame had been processed: before the first telemetry that it could not use."""
    used = [json.loads(line)["telemetry_records"] for line in frame_lines(folder)]
    return [stamps_s[min(count, len(stamps_s) - 1)] for count in used]


class PowerCut(FaultTest):

    def setUp(self):
        super().setUp()
        memory = "/dev/shm" if os.path.isdir("/dev/shm") else None  # a busy disk of the test machine does not count
        holder = tempfile.TemporaryDirectory(prefix="geoloc-test-", dir=memory)
        self.addCleanup(holder.cleanup)
        self.disk = pathlib.Path(holder.name)
        self.recording = self.disk / "flights/of today/recording"  # folders whose names have to be synced, too
        self.objects_file = self.disk / "objects.geojson"

    def test_twenty_cuts(self):
        store = self.folder / "synced"
        store.mkdir()
        app = self.start(env=shim(GEOLOC_SYNCED=store))
        self.fly(end_s=120)
        self.assertEqual(self.interrupt(app)[0], 0)
        stamps_s = telemetry_stamps_s(self.recording)
        frames_s = frames_processed_s(self.recording, stamps_s)
        disk = SyncedDisk(self.disk, store)

        chance, worst_s = random.Random(1), 0.0
        for number in range(20):
            cut_s = chance.uniform(frames_s[0] + MOST_LOST_S, stamps_s[-1])
            with self.subTest(cut_s=cut_s - frames_s[0]):
                left = self.folder / f"left-{number}"
                disk.lay_out(int(cut_s * 1e9), left, zeros=chance.choice((0, 1, 5000)))
                partial = left / "flights/of today/recording.partial"
                worst_s = max(worst_s, self.check_what_is_left(partial, stamps_s, frames_s, cut_s))
        # From the first frame on, nothing that a replay needs is missing.
        disk.lay_out(int(frames_s[0] * 1e9), self.folder / "left-at-first")
        for name in METADATA:
            self.assertEqual((self.folder / "left-at-first/flights/of today/recording.partial" / name).read_bytes(),
                             (self.recording / name).read_bytes())
        # The last word of the run: the recording has its name.
        disk.lay_out(time.time_ns(), self.folder / "left-at-last")
        self.assertEqual(frame_lines(self.folder / "left-at-last/flights/of today/recording"), frame_lines(self.recording))
        json.loads((self.folder / "left-at-last/objects.geojson").read_text())
        print(f"20 power cuts: at most {worst_s:.2f} s lost", flush=True)

    def check_what_is_left(self, partial, stamps_s, frames_s, cut_s):
        """That it is enough and can be replayed; returns how much is lost, in s."""
        left_s, left_frames = telemetry_stamps_s(partial), frame_lines(partial)
        self.assertEqual(left_s, stamps_s[:len(left_s)])
        self.assertEqual(left_frames, frame_lines(self.recording)[:len(left_frames)])
        self.assertGreaterEqual(len(left_s), bisect.bisect(stamps_s, cut_s - MOST_LOST_S))
        self.assertGreaterEqual(len(left_frames), bisect.bisect(frames_s, cut_s - MOST_LOST_S))
        replayed = run("geoloc_replay", partial, "--csv", self.folder / "replayed.csv")
        self.assertEqual(replayed.status, 0, replayed.err)
        self.assertIn(f"in {len(left_frames)} frames", replayed.err)
        return cut_s - left_s[-1]

    def test_kills(self):
        chance, lost_s = random.Random(2), []
        while len(lost_s) < KILLS:
            with self.world.fly("--start-s", 80, "--end-s", 140, "--speed", 2) as sim:
                for _ in range(KILLS_PER_FLIGHT):
                    lost_s.append(self.lost_by_a_kill(len(lost_s) + 1, chance.uniform(0.2, 1.5)))
                    self.assertLess(lost_s[-1], MOST_LOST_S)
                sim.interrupt()
        print(f"{len(lost_s)} kills: at most {max(lost_s):.2f} s lost", flush=True)

    def lost_by_a_kill(self, number, after_s):
        """How much of a run is lost that is killed some time after its first frame, in s; what is left can be replayed."""
        recording = self.recording.with_name("recording" + (f"-{number}" if number > 1 else ""))
        partial = recording.with_name(recording.name + ".partial")
        app = self.start()
        wait_until(lambda: self.frames_recorded(recording), "frames")
        time.sleep(after_s)
        killed_s = time.time()
        app.kill()
        app.wait()
        replayed = run("geoloc_replay", partial)
        self.assertEqual(replayed.status, 0, replayed.err)
        return killed_s - telemetry_stamps_s(partial)[-1]


if __name__ == "__main__":
    unittest.main()
