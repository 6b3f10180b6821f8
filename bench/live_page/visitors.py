#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench/live_page/visitors.py [PAGES…]: the cost of open pages to a live run. Flies a simulated drone once for each
number of pages (default: 0 1 50), a fifth of which also fetch the video, and prints latency from capture to result and
processor time. Needs geoloc_app and geoloc_sim in build/release/bin."""
import os
import pathlib
import re
import resource
import socket
import statistics
import sys
import threading
import time
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
os.environ.setdefault("GEOLOC_BIN_DIR", str(ROOT / "build/release/bin"))
sys.path.insert(0, str(ROOT / "tests/apps"))
from support import World  # noqa: E402: the path is known only here

FLIGHT = ("--start-s", 80, "--end-s", 120)


def read_events(host, port, received):
    with socket.create_connection((host, port)) as client:
        client.sendall(f"GET /events HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
        while piece := client.recv(65536):
            received.append(len(piece))


def fetch_pictures(url, received, is_over):
    while not is_over.is_set():
        try:
            with urllib.request.urlopen(f"{url}frame", timeout=5) as answer:
                received.append(len(answer.read()))
        except OSError:
            return
        time.sleep(0.2)


def spent_s():
    """CPU time of the programs that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def fly(pages):
    """[latency ms each second], processor seconds of geoloc_app, bytes sent."""
    world, received, is_over = World(), [], threading.Event()
    with world.watch("--http", "0") as app:
        url = app.wait_for(r"^page: (\S+)")[1]
        host, port = url.split("/")[2].split(":")
        threads = [threading.Thread(target=read_events, args=(host, int(port), received)) for _ in range(pages)]
        threads += [threading.Thread(target=fetch_pictures, args=(url, received, is_over)) for _ in range(pages // 5)]
        for thread in threads:
            thread.start()
        with world.fly(*FLIGHT) as sim:
            sim.wait()
        is_over.set()
        before_s = spent_s()
        app.interrupt()
        found = [re.search(r"objects [1-9].*latency (\d+) ms", line) for line in app.lines]
    for thread in threads:
        thread.join()
    return [int(match[1]) for match in found if match], spent_s() - before_s, sum(received)


def main(numbers):
    print("pages  latency ms: median  middle half  geoloc_app's processor s  MB sent")
    for pages in numbers:
        latencies, app_s, sent = fly(pages)
        quarters = statistics.quantiles(latencies, n=4)
        print(f"{pages:5d}  {quarters[1]:18.0f}  {quarters[0]:4.0f} … {quarters[2]:4.0f}  {app_s:24.1f}  {sent / 1e6:7.1f}", flush=True)


if __name__ == "__main__":
    main([int(argument) for argument in sys.argv[1:]] or [0, 1, 50])
