#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures python -m geoloc.archive: recordings an hour, and what kills of workers and of the driver do to its results.

    PYTHON bench/fleet/archive.py BIN FOLDER [--recordings N] [--frame-rate HZ] [--only RUN[,RUN…]]

PYTHON has the package geoloc, and Ray (pip install . -r python/ray_requirements.txt). BIN holds geoloc_sim; FOLDER is for recordings, which are
made once, and for results, which are made anew."""
import argparse
import hashlib
import itertools
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

KILL_EVERY_S = 10.0
LENGTH_S = 130  # of a recording
STARTS_S = [60.0 + 0.5 * i for i in range(34)]  # on the vehicle's clock


def make_recordings(bin_dir, folder, count, frame_rate_hz):
    """Simulated flights of six paths over the same targets, begun at different times."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, (start_s, path) in zip(range(count), itertools.product(STARTS_S, range(1, 7))):
        place = folder / f"flight-{number:03}"
        if place.exists():
            continue
        subprocess.run([bin_dir / "geoloc_sim", "--flight", f"gnss_path{path}", "--scenario", "2", "--frame-rate", str(frame_rate_hz), "--start-s", str(start_s),
                        "--end-s", str(start_s + LENGTH_S), "--record", place], check=True, capture_output=True)


def start(recordings, out, *options):
    with open(f"{out}.log", "a", encoding="utf-8") as log:
        return subprocess.Popen([sys.executable, "-m", "geoloc.archive", recordings, "--out", out, *map(str, options)], stdout=log, stderr=log)


def children_of(process_id):
    """All processes below one, by their ids, with their titles."""
    parents, titles = {}, {}
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            parents[int(entry.name)] = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
            titles[int(entry.name)] = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace").strip()
        except OSError:
            continue  # it has ended
    below = {process_id}
    while grown := {one for one, parent in parents.items() if parent in below} - below:
        below |= grown
    return {one: titles[one] for one in below - {process_id}}


def kill_a_worker(driver):
    """One that works, with SIGKILL. Whether there was one. Forked ones have the driver's title."""
    below = children_of(driver.pid)
    workers = [one for one, title in below.items() if title.startswith("ray::work") or title == " ".join(map(str, driver.args))]
    if not workers:
        return False
    os.kill(random.choice(workers), signal.SIGKILL)
    return True


def finish(driver, kills_every_s=None):
    """Waits for its end; how often a worker was killed."""
    kills, due = 0, time.monotonic() + (kills_every_s or 0.0)
    try:
        while driver.poll() is None:
            time.sleep(0.02)
            if kills_every_s and time.monotonic() >= due and kill_a_worker(driver):
                kills, due = kills + 1, due + kills_every_s
    finally:
        driver.terminate()
        driver.wait()
    return kills


def sum_of(out):
    """Of all results and maps, by their names; not of the report, which tells times and tries."""
    digest = hashlib.sha256()
    for file in sorted([*out.glob("recordings/**/*"), *out.glob("map*.geojson")]):
        if file.is_file():
            digest.update(f"{file.relative_to(out)} {hashlib.sha256(file.read_bytes()).hexdigest()}\n".encode())
    return digest.hexdigest()[:16]


def stop(*_):
    raise SystemExit("stopped")


def measure(name, recordings, out, *options, kills_every_s=None, driver_dies_at=()):
    """A run from nothing; prints what came of it."""
    shutil.rmtree(out, ignore_errors=True)
    pathlib.Path(f"{out}.log").unlink(missing_ok=True)
    began, restarts, kills = time.monotonic(), 0, 0
    for results in driver_dies_at:
        driver = start(recordings, out, *options)
        while driver.poll() is None and len(list(out.glob("recordings/*/job.json"))) < results:
            time.sleep(0.02)
        driver.kill()
        driver.wait()
        restarts += 1
    driver = start(recordings, out, *options)
    kills = finish(driver, kills_every_s)
    wall_s = time.monotonic() - began
    report = json.loads((out / "report.json").read_text())
    entries = report["recordings"]
    states = {state: sum(entry["state"] == state for entry in entries) for state in ("done", "kept", "failed", "not done")}
    tries = sum(entry["tries"] for entry in entries)
    print(f"{name}: status {driver.returncode}, {states}, {tries} tries, {kills} workers killed, {restarts} drivers killed; {wall_s:.1f} s in all,"
          f" {report['seconds']:.1f} s of work, {3600 * len(entries) / report['seconds']:.0f} an hour; sum {sum_of(out)}", flush=True)
    return report["seconds"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--recordings", type=int, default=200)
    parser.add_argument("--frame-rate", type=float, default=30.0, help="of the recordings, per s: what each costs [%(default)g]")
    parser.add_argument("--only", default="", help="of: processes-1, processes-2, processes-2-killed, ray-1, ray-2, ray-2-killed, ray-2-driver")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, stop)
    recordings = options.folder / "recordings"
    make_recordings(options.bin, recordings, options.recordings, options.frame_rate)
    ray = "--ray", "local", "--workers"
    runs = {
        "processes-1": (("--workers", 1), {}),
        "processes-2": (("--workers", 2), {}),
        "processes-2-killed": (("--workers", 2), {"kills_every_s": KILL_EVERY_S}),
        "ray-1": ((*ray, 1), {}),
        "ray-2": ((*ray, 2), {}),
        "ray-2-killed": ((*ray, 2), {"kills_every_s": KILL_EVERY_S}),
        "ray-2-driver": ((*ray, 2), {"driver_dies_at": (50, 100)}),
    }
    took_s = {}
    for name in options.only.split(",") if options.only else runs:
        arguments, faults = runs[name]
        took_s[name] = measure(name, recordings, options.folder / name, *arguments, **faults)
    for kind in "processes", "ray":
        if f"{kind}-1" in took_s and f"{kind}-2" in took_s:
            print(f"{kind}: speed-up of 2 workers against 1: {took_s[f'{kind}-1'] / took_s[f'{kind}-2']:.2f}")


if __name__ == "__main__":
    main()
