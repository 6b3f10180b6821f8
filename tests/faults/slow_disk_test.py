# SPDX-License-Identifier: Apache-2.0
"""A disk that does not answer for a while costs no frame; one that stays away costs the recording, not the flight."""
import json
import socket
import time
import unittest

from flight_under_fault import FaultTest, line_count, shim, wait_until

STALL_S = 8
MOST_TO_END_S = 60  # ten seconds of patience with the disk; the rest is for a loaded machine


def heartbeat(sequence):
    """A HEARTBEAT of an autopilot (MAVLink 1)."""
    frame = bytes((0xFE, 9, sequence % 256, 1, 1, 0)) + bytes((0, 0, 0, 0, 2, 3, 0, 4, 3))
    crc = 0xFFFF  # CRC-16/MCRF4XX over all but the start, and the message's own byte
    for byte in frame[1:] + b"\x32":
        byte ^= crc & 0xFF
        byte ^= byte << 4 & 0xFF
        crc = crc >> 8 ^ byte << 8 ^ byte << 3 ^ byte >> 4
    return frame + (crc & 0xFFFF).to_bytes(2, "little")


class SlowDisk(FaultTest):

    def setUp(self):
        super().setUp()
        self.gate = self.folder / "the-disk-stands-still"
        self.words_file = self.folder / "stderr"

    def start_on_slow_disk(self, *arguments):
        with open(self.words_file, "w", encoding="utf-8") as words:
            return self.start(*arguments, env=shim(GEOLOC_STALL=self.gate), stderr=words)

    def words(self):
        return self.words_file.read_text()

    def test_a_stall_costs_no_frame(self):
        lines_file = self.folder / "run.jsonl"
        located = []  # how many frames had been located when the disk stopped and when it went on

        def processed(file):
            lines = [json.loads(line) for line in file.read_bytes().rpartition(b"\n")[0].splitlines()]
            return [line["time_us"] for line in lines if line["type"] == "frame"]

        app = self.start_on_slow_disk("--jsonl", lines_file)
        partial = lines_file.with_name("run.jsonl.partial")
        with self.world.fly("--start-s", 80, "--end-s", 110, "--speed", 2) as sim:
            wait_until(lambda: self.frames_recorded() > 5, "frames")
            self.gate.touch()
            located.append(len(processed(partial)))
            time.sleep(STALL_S)
            located.append(len(processed(partial)))
            self.gate.unlink()
            self.assertEqual(sim.wait(), 0, sim.lines)
        self.assertEqual(self.interrupt(app)[0], 0, self.words())
        during_stall = located[1] - located[0]
        self.assertGreater(during_stall, STALL_S / 2)  # a busy machine processes few
        recorded = [json.loads(line)["time_us"] for line in (self.recording / "frames.jsonl").read_text().splitlines()]
        self.assertEqual(recorded, processed(lines_file))
        print(f"a stall of {STALL_S} s: {during_stall} frames processed meanwhile, {len(recorded)} of "
              f"{len(recorded)} recorded", flush=True)

    def test_what_does_not_fit_is_counted_and_said(self):
        app = self.start_on_slow_disk()
        log = self.recording.with_name("recording.partial") / "telemetry.tlog"
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
            flood = b"".join(map(heartbeat, range(3500)))

            def is_flooded(seen):
                link.sendto(flood, ("127.0.0.1", self.world.udp_port))
                return seen()

            wait_until(lambda: is_flooded(lambda: log.exists() and log.stat().st_size > 0), "telemetry recorded")
            self.gate.touch()
            wait_until(lambda: is_flooded(lambda: "the disk does not keep up" in self.words()), "a full queue")
        self.gate.unlink()
        status, _ = self.interrupt(app)
        self.assertEqual(status, 1)
        self.assertRegex(self.words(), r"recording: [1-9]\d* records of telemetry and 0 frames were left out")
        self.assertGreater((self.recording / "telemetry.tlog").stat().st_size, 1_000_000)

    def test_a_disk_that_stays_away_does_not_hold_up_the_end(self):
        app = self.start_on_slow_disk()
        with self.world.fly("--start-s", 80, "--end-s", 110, "--speed", 2):
            wait_until(lambda: self.frames_recorded() > 5, "frames")
            self.gate.touch()
            wait_until(lambda: self.objects_file.exists() and self.features(), "objects in the file")
            status, took_s = self.interrupt(app)
        self.assertEqual(status, 1)
        self.assertLess(took_s, MOST_TO_END_S)
        self.assertIn("the disk does not answer", self.words())
        self.assertTrue(self.features())
        self.assertGreater(line_count(self.recording.with_name("recording.partial") / "frames.jsonl"), 5)


if __name__ == "__main__":
    unittest.main()
