#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench/latency/live.py BIN [--seconds S] [--fast]: how long after a frame's capture its objects are there, live.

Flies geoloc_sim and geoloc_app over the loopback at 10 and 30 frames per second, with telemetry at 10 Hz and on a link that
bears 50 Hz, and prints a table (docs/performance.md). Simulator, encoder and app share the computer. Takes two minutes."""
import argparse
import re
import signal
import socket
import subprocess
import tempfile
from pathlib import Path

WORDS = re.compile(
    r"from capture to objects (\d+) ms \(99 % within (\d+) ms\): (\d+) ms until the frame was here, (\d+) ms for the detector, "
    r"(\d+) ms for telemetry and estimate")


def free_port(kind):
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def fly(binaries, folder, frame_rate, telemetry_hz, seconds, options):
    """The delays of a flight, in ms: total, its 99th percentile, until the frame was here, detector, telemetry and estimate."""
    udp, rtsp = free_port(socket.SOCK_DGRAM), free_port(socket.SOCK_STREAM)
    sim = subprocess.Popen(
        [binaries / "geoloc_sim", "--udp", f"127.0.0.1:{udp}", "--rtsp-port", str(rtsp), "--frame-rate", str(frame_rate),
         "--telemetry-rate", str(telemetry_hz), "--start-s", "60", "--end-s", str(60 + seconds)],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    app = subprocess.Popen(
        [binaries / "geoloc_app", "--udp", f"127.0.0.1:{udp}", "--rtsp", f"rtsp://127.0.0.1:{rtsp}/cam",
         "--out", folder / "objects.geojson", *options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    try:
        sim.wait(timeout=seconds + 120)
        app.send_signal(signal.SIGINT)
        said = app.communicate(timeout=60)[1]
    finally:
        for program in (sim, app):
            program.kill()
            program.wait()
    found = WORDS.search(said)
    if not found:
        raise SystemExit(f"geoloc_app told no delays:\n{said}")
    return [int(number) for number in found.groups()]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bin", type=Path)
    parser.add_argument("--seconds", type=float, default=25.0, help="of each flight")
    parser.add_argument("--fast", action="store_true", help="geoloc_app --fast")
    arguments = parser.parse_args()
    options = ["--fast"] if arguments.fast else []
    print("| frames/s | telemetry | capture to objects, median | 99 % within | frame here | detector | telemetry and estimate |")
    print("|---|---|---|---|---|---|---|")
    for frame_rate in (10, 30):
        for telemetry_hz in (10, 50):
            with tempfile.TemporaryDirectory() as folder:
                total, most, here, detector, wait = fly(arguments.bin, Path(folder), frame_rate, telemetry_hz,
                                                        arguments.seconds, options)
            print(f"| {frame_rate} | {telemetry_hz} Hz | {total} ms | {most} ms | {here} ms | {detector} ms | {wait} ms |",
                  flush=True)


if __name__ == "__main__":
    main()
