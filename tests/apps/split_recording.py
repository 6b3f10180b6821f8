# SPDX-License-Identifier: Apache-2.0
"""A recording as others that follow each other: as if the app had been started again in the air."""
import json
import pathlib
import shutil
import struct

# A run that begins in the air hears of what was before for so long, and one that ends for so long after its last frame.
HEARS_S = 2.0
COPIED = ("camera.json", "config.json", "class_names.json", "truth.geojson")


def _records(log):
    """Times [us] and bytes of the records of a MAVLink log."""
    at = 0
    while at + 10 <= len(log):
        (time_us,) = struct.unpack_from(">Q", log, at)
        length = log[at + 9]
        size = 8 + (length + 12 + (13 if log[at + 10] & 1 else 0) if log[at + 8] == 0xFD else length + 8)
        yield time_us, log[at : at + size]
        at += size


def split_recording(recording, folders, shares):
    """Writes a part of the recording into each folder, divided at those shares of its frames."""
    frames = [json.loads(line) for line in (recording / "frames.jsonl").read_text().splitlines()]
    log = list(_records((recording / "telemetry.tlog").read_bytes()))
    bounds = [0, *(round(share * len(frames)) for share in shares), len(frames)]
    for folder, begin, end in zip(map(pathlib.Path, folders), bounds, bounds[1:]):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        part = frames[begin:end]
        for frame in part:
            frame.pop("telemetry_records", None)
        (folder / "frames.jsonl").write_text("".join(json.dumps(frame) + "\n" for frame in part))
        first_us, last_us = part[0]["time_us"] - HEARS_S * 1e6, part[-1]["time_us"] + HEARS_S * 1e6
        is_first, is_last = begin == 0, end == len(frames)
        (folder / "telemetry.tlog").write_bytes(
            b"".join(record for time_us, record in log if (is_first or time_us >= first_us) and (is_last or time_us <= last_us)))
        for name in COPIED:
            if (recording / name).exists():
                shutil.copy(recording / name, folder / name)
