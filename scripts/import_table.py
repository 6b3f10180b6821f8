#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/import_table.py [BIN [SEED,…]]: the table of docs/import.md, videos imported with each kind of log beside them.

geoloc_sim renders the video of a flight; its own detections are the labels, and the logs are written from its telemetry as autopilots and
cameras write them (tests/apps/flight_logs.py). Each row is the mean over three of the flights in data/flights with each seed, beside the flights'
own recordings. Rendering takes a minute a flight.
"""
import json
import pathlib
import sys
import tempfile

from recorded_flights import BUILT, ROOT, mean_rmse_m, replay, run, simulate

sys.path.insert(0, str(ROOT / "tests" / "apps"))
from flight_logs import LATENCY_US, Flight, camera_below, labels_of, to_dataflash, to_srt, to_table, to_ulog  # noqa: E402

BIN = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else BUILT
SEEDS = sys.argv[2].split(",") if len(sys.argv) > 2 else ["1", "2", "3"]
FLIGHTS = "stock_path1", "stock_path3", "stock_path5"
OWN = "its own recording"


def logs_of(sim, stamps_us, flight):
    """File name: content, and the options that it needs."""
    offset_s = (stamps_us[0] - flight.begin_us()) / 1e6
    exposed_us = [stamp_us - LATENCY_US for stamp_us in stamps_us]
    subtitles = to_srt(flight, exposed_us, lambda time_us: camera_below(flight, time_us))
    return {"a.tlog": ((sim / "telemetry.tlog").read_bytes(), ()), "a.BIN": (to_dataflash(flight, stamps_us[:1]), ()),
            "a.ulg": (to_ulog(flight, stamps_us[:1]), ()), "a.csv": (to_table(flight).encode(), ("--log-offset-s", offset_s)),
            "a.SRT": (subtitles.encode(), ())}


def scores_of(folder, flight_name, seed):
    """Kind of log: score."""
    sim, labels, imported = folder / "sim", folder / "labels.csv", folder / "imported"
    simulate(BIN, sim, "--video", "--flight", flight_name, "--seed", seed)
    flight = Flight(sim / "telemetry.tlog")
    frames = [json.loads(line) for line in (sim / "frames.jsonl").read_text().splitlines()]
    labels.write_text(labels_of(frames))
    truth = "--truth", sim / "truth.geojson"
    scores = {OWN: replay(BIN, sim, *truth)}
    for name, (content, options) in logs_of(sim, [frame["time_us"] - flight.utc_us for frame in frames], flight).items():
        (folder / name).write_bytes(content)
        recording = imported / name
        imported.mkdir(exist_ok=True)
        run(BIN / "geoloc_import", "video", sim / "video.mkv", "--log", folder / name, "--out", recording, "--camera",
            sim / "camera.json", "--labels", labels, *options)
        scores[name[1:]] = replay(BIN, recording, *truth)
    return scores


def main():
    rows = {}
    for flight in FLIGHTS:
        for seed in SEEDS:
            with tempfile.TemporaryDirectory(prefix="geoloc-import-") as folder:
                for kind, score in scores_of(pathlib.Path(folder), flight, seed).items():
                    rows.setdefault(kind, []).append(score)
    print("| log | found | extra | RMSE m | against its own recording |\n|---|---|---|---|---|")
    for kind, scores in rows.items():
        found = f"{sum(s.found for s in scores)} of {sum(s.targets for s in scores)}"
        ratio = mean_rmse_m(scores) / mean_rmse_m(rows[OWN])
        print(f"| `{kind}` | {found} | {sum(s.extra for s in scores)} | {mean_rmse_m(scores):.4f} | {ratio:.2f} |")


if __name__ == "__main__":
    main()
