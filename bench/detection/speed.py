# SPDX-License-Identifier: Apache-2.0
"""The time to search an image of 1280 x 720, from letterbox to boxes, taking turns between all contenders so that
other load on the machine affects all of them. Prints a table in Markdown. Started by run.sh."""

import argparse
import random
import statistics
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PICTURE = ROOT / "tests/data/detection/targets.jpg"
PAUSE_S = 0.05  # threads of the previous one still spin


class Contender:
    """A program that answers each line with the time it took."""

    def __init__(self, name: str, command: list):
        self.name = name
        self.process = subprocess.Popen([*map(str, command)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.times_ms: list[float] = []
        self.found = 0

    def look(self, looks: int) -> float:
        self.process.stdin.write(f"{looks}\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline().split()
        if len(answer) != 2:
            sys.exit(f"{self.name} ended early")
        self.found = int(answer[1])
        return float(answer[0])


def contenders(worker: Path, networks: list[str], threads: int) -> dict[str, list[Contender]]:
    """NAME=FILE, or NAME=FILE,FILE_FOR_OPENCV."""
    made = {}
    for network in networks:
        name, _, files = network.partition("=")
        plain, _, converted = files.partition(",")
        made[name] = [
            Contender("ONNX Runtime", [sys.executable, HERE / "onnxruntime_worker.py", plain, threads, PICTURE]),
            Contender("geoloc, OpenCV", [worker, converted or plain, "opencv", threads, PICTURE]),
            Contender("geoloc, OpenVINO", [worker, plain, "openvino", threads, PICTURE]),
        ]
    return made


def measure(groups: dict[str, list[Contender]], rounds: int, looks: int) -> None:
    order = [contender for group in groups.values() for contender in group]
    for contender in order:
        contender.look(3)  # warm-up
    generator = random.Random(0)
    for number in range(rounds):
        generator.shuffle(order)
        for contender in order:
            time.sleep(PAUSE_S)
            contender.times_ms.append(contender.look(looks))
        print(f"\rround {number + 1} of {rounds}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)


def table(groups: dict[str, list[Contender]]) -> str:
    """Medians, and the median over the rounds of a contender's time relative to the peer's in the same round."""
    lines = [
        "| network | run by | minimum ms per image | median | images per second | time relative to ONNX Runtime | found |",
        "|---" * 7 + "|",
    ]
    for name, group in groups.items():
        for contender in group:
            shares = [own / peer for own, peer in zip(contender.times_ms, group[0].times_ms)]
            median = statistics.median(contender.times_ms)
            lines.append(
                f"| {name} | {contender.name} | {min(contender.times_ms):.1f} | {median:.1f} | {1e3 / median:.0f} "
                f"| {statistics.median(shares):.2f} | {contender.found} |"
            )
    return "\n".join(lines)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("networks", nargs="+", metavar="NAME=FILE[,FILE_FOR_OPENCV]")
    arguments.add_argument("--worker", type=Path, required=True)
    arguments.add_argument("--threads", type=int, default=2)
    arguments.add_argument("--rounds", type=int, default=40)
    arguments.add_argument("--looks", type=int, default=5, help="in a row, in each round")
    options = arguments.parse_args()
    groups = contenders(options.worker, options.networks, options.threads)
    measure(groups, options.rounds, options.looks)
    print(table(groups))


if __name__ == "__main__":
    main()
