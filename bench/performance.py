#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench/performance.py BIN [frame|projection|field|hours|live ...]: measures how long things take, and writes the tables of docs/performance.md anew.

BIN: the folder of programs of a build with benchmarks (cmake --preset release). Without names it measures all, which takes ten
minutes of a quiet computer. Frames are timed by the processor's clock, so that other work does not count, but for what it
takes of the caches."""
import datetime
import json
import platform
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "performance.md"
FIELDS = (900, 4900, 20000, 100000)
FIELD_LINE = re.compile(
    r"(\d+) objects, +(\d+) frames of ([\d.]+): (\d+) confirmed, \d+ tracks; first median (\d+) p99 (\d+) us; last median (\d+) "
    r"p99 (\d+) worst (\d+) us; all median (\d+) p99 (\d+) worst (\d+) us; (\d+) MB")

OUTPUTS_LINE = re.compile(r"report (\d+) us, JSON Lines (\d+) us, page (\d+) us")


def output_of(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


def computer():
    for line in Path("/proc/cpuinfo").read_text(encoding="ascii").splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def tracking_times_us(binaries, which):
    """{benchmark: the median of the processor's time of nine interleaved runs}."""
    report = json.loads(output_of(
        binaries / "tracking_bench", "--benchmark_format=json", "--benchmark_repetitions=9",
        "--benchmark_enable_random_interleaving=true", "--benchmark_report_aggregates_only=true", f"--benchmark_filter={which}"))
    scale = {"ns": 1e-3, "us": 1.0, "ms": 1e3}
    return {one["run_name"].split("/repeats")[0]: one["cpu_time"] * scale[one["time_unit"]]
            for one in report["benchmarks"] if one["aggregate_name"] == "median"}


def frame(binaries):
    times_us = tracking_times_us(binaries, "process_frame/.*detections:(30/tracks:30|100/tracks:100)$")
    yield "| detections x tracks in view | `paper` | `joint` | ratio |"
    yield "|---|---|---|---|"
    for size in (30, 100):
        paper, joint = (times_us[f"process_frame/{method}/detections:{size}/tracks:{size}"] for method in ("paper", "joint"))
        yield f"| {size} x {size} | {paper:.1f} µs | {joint:.0f} µs | {joint / paper:.1f} |"


def projection(binaries):
    times_us = tracking_times_us(binaries, "projection")
    yield "| 1000 pixels of a lens with distortion, with covariance | a pixel |"
    yield "|---|---|"
    for at_once, how in enumerate(("one by one", "a frame's at once")):
        yield f"| {how} | {times_us[f'projection/at_once:{at_once}']:.0f} ns |"


def numbers_of(pattern, text):
    return [float(number) for number in pattern.search(text).groups()]


def field(binaries):
    yield "| objects | frames | last 1000 frames: median / p99 / worst | worst of all | memory | a frame's report, JSON Lines, page |"
    yield "|---|---|---|---|---|---|"
    for objects in FIELDS:
        said = output_of(binaries / "field_bench", objects)
        count, frames, _, found, _, _, median, p99, worst, _, _, worst_of_all, memory_mb = numbers_of(FIELD_LINE, said)
        report, lines, page = numbers_of(OUTPUTS_LINE, said)
        note = "" if found == count else f" ({found:,.0f} confirmed)"
        yield (f"| {count:,.0f}{note} | {frames:,.0f} | {median:.0f} / {p99:.0f} / {worst:.0f} µs | {1e-3 * worst_of_all:.1f} ms | "
               f"{memory_mb:.0f} MB | {1e-3 * report:.2f}, {1e-3 * lines:.2f}, {1e-3 * page:.2f} ms |")


def hours(binaries):
    yield "| 900 objects, over and over | median | p99 | worst of all | memory |"
    yield "|---|---|---|---|---|"
    _, _, _, _, median, p99, last, last_p99, _, _, _, worst, memory_mb = numbers_of(
        FIELD_LINE, output_of(binaries / "field_bench", 900, 600))
    yield f"| from the tenth minute on | {median:.0f} µs | {p99:.0f} µs | | |"
    yield f"| at the end of ten hours | {last:.0f} µs | {last_p99:.0f} µs | {1e-3 * worst:.1f} ms | {memory_mb:.0f} MB |"


def live(binaries):
    yield output_of(sys.executable, ROOT / "bench" / "latency" / "live.py", binaries).rstrip()


PARTS = {"frame": frame, "projection": projection, "field": field, "hours": hours, "live": live}


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        raise SystemExit(__doc__)
    binaries = Path(sys.argv[1]).resolve()
    for name in sys.argv[2:] or PARTS:
        lines = []
        for line in PARTS[name](binaries):
            lines.append(line)
            print(line, flush=True)
        when = f"{datetime.date.today()}, {computer()}, {platform.system()} {platform.machine()}"
        text = f"<!-- begin {name} -->\n" + "\n".join(lines) + f"\n\n({when})\n<!-- end {name} -->"
        page, count = re.subn(f"<!-- begin {name} -->.*?<!-- end {name} -->", lambda _: text, PAGE.read_text(encoding="utf-8"),
                              flags=re.DOTALL)
        if count != 1:
            raise SystemExit(f"{PAGE}: no place for {name}")
        PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
