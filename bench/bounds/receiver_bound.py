#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How well a map can be placed that hangs on the receiver alone.

    python3 bench/bounds/receiver_bound.py [FLIGHT ...]      # needs numpy; default: gnss_path1 ... gnss_path6

The observer knows the vehicle's true path but for a shift, a turn and a scale of the whole, which no look at
unknown objects tells (docs/results.md). He places it by the reported positions, by generalised least squares
with a covariance close to that which the flights were simulated with (its fast part is fitted to them). What that
leaves is the bound for any method that is told no surveyed point: it is the receiver's own error, drawn once a
flight, whatever targets and seed.
"""
import csv
import gzip
import pathlib
import struct
import sys

import numpy

FLIGHTS = pathlib.Path(__file__).resolve().parents[2] / "data" / "flights"
METRES_PER_DEGREE = 111318.845  # of the simulator's sphere
GLOBAL_POSITION_INT = 33
SURVEY_HEIGHT_M = 19.0
TARGET_RADIUS_M = 26.0  # RMS distance of targets from their middle, scenarios 1 to 3
POSITION_LAG_S = 0.035  # of the reported position behind the true one: the latency's business, not the receiver's


def reported_positions(path):
    """Rows (time_s, lat_deg, lon_deg) of GLOBAL_POSITION_INT in a log of MAVLink 2."""
    data, rows, at = path.read_bytes(), [], 0
    while at < len(data):
        packet = at + 8  # after the time stamp
        length, flags = data[packet + 1], data[packet + 2]
        if int.from_bytes(data[packet + 7:packet + 10], "little") == GLOBAL_POSITION_INT:
            payload = data[packet + 10:packet + 10 + length].ljust(28, b"\0")
            time_ms, lat, lon = struct.unpack_from("<Iii", payload)
            rows.append((time_ms / 1e3, lat / 1e7, lon / 1e7))
        at = packet + 12 + length + (13 if flags & 1 else 0)
    return numpy.array(rows)


def true_path(path):
    """Columns of the truth by name."""
    with gzip.open(path, "rt") as file:
        rows = list(csv.DictReader(file))
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def errors_of(flight):
    """Times [s], true places and errors of the reported positions (n x 2, east and north, m), once a second."""
    truth = true_path(FLIGHTS / f"{flight}_truth.csv.gz")
    reported = reported_positions(FLIGHTS / f"{flight}.tlog")
    seconds = truth["time_boot_s"]
    height = truth["alt_amsl"] - truth["alt_amsl"].min()
    survey = seconds[height > SURVEY_HEIGHT_M]
    times = numpy.arange(survey[0], survey[-1], 1.0)
    scale = METRES_PER_DEGREE * numpy.array([numpy.cos(numpy.radians(truth["lat"].mean())), 1.0])

    def at(name):
        return numpy.interp(times, seconds, truth[name])

    place = numpy.stack([at("lon"), at("lat")], axis=1)
    seen = numpy.stack([numpy.interp(times, reported[:, 0], reported[:, i]) for i in (2, 1)], axis=1)
    error = (seen - place) * scale + POSITION_LAG_S * numpy.stack([at("ve"), at("vn")], axis=1)
    return times, (place - place.mean(axis=0)) * scale, error


def covariance(times):
    """Of one axis [m^2]: 0.5 m over 60 s, and what the filter leaves of the receiver's seconds, 0.26 m over 4 s."""
    apart = numpy.abs(times[:, None] - times[None])
    return 0.25 * numpy.exp(-apart / 60.0) + 0.066 * numpy.exp(-apart / 4.0) + 1e-4 * numpy.eye(len(times))


def placement(times, place, error):
    """Shift east and north [m], scale and turn that the error looks like, and their covariance."""
    weight = numpy.kron(numpy.eye(2), numpy.linalg.inv(covariance(times)))
    one, zero = numpy.ones(len(times)), numpy.zeros(len(times))
    east, north = place.T
    design = numpy.stack([numpy.r_[one, zero], numpy.r_[zero, one], numpy.r_[east, north], numpy.r_[-north, east]],
                         axis=1)
    spread = numpy.linalg.inv(design.T @ weight @ design)
    return spread @ design.T @ weight @ numpy.r_[error[:, 0], error[:, 1]], spread


def main():
    flights = sys.argv[1:] or [f"gnss_path{i}" for i in range(1, 7)]
    print("| flight | offset left m | expected | relative RMSE left m | expected | mean of the reported error m |")
    print("|---|---|---|---|---|---|")
    rows = []
    for flight in flights:
        times, place, error = errors_of(flight)
        found, spread = placement(times, place, error)
        row = (numpy.hypot(*found[:2]), numpy.sqrt(spread[0, 0] + spread[1, 1]),
               TARGET_RADIUS_M * numpy.hypot(*found[2:]), TARGET_RADIUS_M * numpy.sqrt(spread[2, 2] + spread[3, 3]),
               numpy.hypot(*error.mean(axis=0)))
        rows.append(row)
        print(f"| {flight} | " + " | ".join(f"{value:.3f}" for value in row) + " |")
    print("| mean | " + " | ".join(f"{value:.3f}" for value in numpy.mean(rows, axis=0)) + " |")


if __name__ == "__main__":
    main()
