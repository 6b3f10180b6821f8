#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The table at the end of scripts/fleet_demo.sh, from the folder of its results and that of its flights. Exit status 1 where the map is not
what it would have been undisturbed."""
import json
import pathlib
import re
import statistics
import sys

SCORE = re.compile(r"found (\d+) / (\d+), RMSE ([\d.]+) m \(relative ([\d.]+) m\), extra (\d+), merged pairs (\d+)")
SAME_DEG = 1e-9  # what the files tell


def score(file):
    found, targets, rmse, relative, extra, merged = SCORE.findall(file.read_text())[-1]
    return [f"{found} / {targets}", f"{float(rmse):.2f}", f"{float(relative):.2f}", extra, merged]


def places(file):
    return sorted(tuple(feature["geometry"]["coordinates"][:2]) for feature in json.loads(file.read_text())["features"])


def differ(one, other):
    """Why two lists of longitudes and latitudes are not the same; empty where they are."""
    if len(one) != len(other):
        return f"{len(one)} objects, not {len(other)}"
    most = max((abs(a - b) for pair in zip(one, other) for a, b in zip(*pair)), default=0.0)
    return "" if most <= SAME_DEG else f"positions differ by {most:.1e} degrees"


def total(pattern, text):
    return sum(int(number) for number in re.findall(pattern, text))


def main():
    out, work = map(pathlib.Path, sys.argv[1:])
    singles = [score(out / f"drone-{drone}.log") for drone in range(1, 9)]
    rows = [["one flight (mean of eight)", *singles[0]], ["eight fused", *score(work / "eight.log")],
            ["with a ninth, 5 m off", *score(out / "service.log")]]
    rows[0][1] = f"{statistics.mean(int(row[0].split()[0]) for row in singles):.1f} / 30"
    for column in (2, 3):
        rows[0][column] = f"{statistics.mean(float(row[column - 1]) for row in singles):.2f}"
    for column in (4, 5):
        rows[0][column] = f"{statistics.mean(int(row[column - 1]) for row in singles):.1f}"
    print("\n| | found | RMSE m | relative m | extra | merged |\n|---|---|---|---|---|---|")
    for row in rows:
        print("| " + " | ".join(row) + " |")

    service = (out / "service.log").read_text()
    flown = "".join((out / f"drone-{drone}.log").read_text() for drone in range(1, 10))
    undelivered = flown.count("was not delivered")
    flights = {flight["flight"]: flight for flight in json.loads((out / "map.geojson").read_text())["flights"]}
    bad = [name for name, flight in flights.items() if flight["verdict"] == "quarantined"]
    retracted, history = (work / "changes").read_text().strip().split("|")
    rows_of_database = [line.split("|") for line in (work / "rows").read_text().split()]
    delivered, replaced = total(r"fleet: (\d+) summaries delivered", flown), total(r"delivered, (\d+) replaced", flown)
    print(f"\nmessages    {delivered} summaries delivered, {replaced} replaced before they could be sent, {undelivered} last ones lost; "
          f"{service.count('a summary was refused')} refused")
    print(f"quarantined {', '.join(bad) or 'none'}")
    print(f"database    {len(rows_of_database)} objects, {retracted} retracted on the way, {history} lines of history")
    faults = [fault for fault in (
        differ(places(out / "map.geojson"), places(out / "undisturbed.geojson")),
        differ(sorted((float(row[2]), float(row[1])) for row in rows_of_database), places(out / "undisturbed.geojson")),
        "" if bad == ["drone-9"] else "not the ninth drone alone was quarantined",
        f"{undelivered} drones' last summaries were not delivered" if undelivered else "") if fault]
    print("check       " + ("the map, and the database, are as undisturbed, to the last digit" if not faults else "; ".join(faults)))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
