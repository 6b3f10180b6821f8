# SPDX-License-Identifier: Apache-2.0
"""What estimate.cpp and estimate.c do with a feed, in Python."""

import pathlib
import sys

import numpy as np
from feed import doubles, hex_of

import geoloc


def telemetry(lines, kind):
    """Times [s] and the columns of a kind's lines."""
    words = [line.split() for line in lines if line[0] == kind]
    return np.array([int(word[1]) for word in words]) / 1e9, np.array([doubles(word[2:]) for word in words])


def camera_of(line):
    _, width, height, *words = line.split()
    numbers = doubles(words)
    lens = dict(zip(("fx", "fy", "cx", "cy"), numbers))
    mount = dict(zip(("roll_deg", "pitch_deg", "yaw_deg", "x_m", "y_m", "z_m"), numbers[9:]))
    return {"width": int(width), "height": int(height), **lens, "distortion": numbers[4:9], "mount": mount}


def objects_of(geolocator):
    for found in geolocator.objects(confirmed_only=False):
        covariance = found["covariance_m2"]
        times = [found[name].astype(np.int64) for name in ("first_seen", "last_seen")]
        yield (f"O {found['id']} {found['class_id']} {found['hits']} {times[0]} {times[1]} "
               + hex_of(found["latitude_deg"], found["longitude_deg"], *found["position_in_enu_m"], covariance[0, 0], covariance[0, 1],
                        covariance[1, 1], found["height_above_home_m"], found["sigma_height_m"], found["confidence"]))


def estimate(feed):
    lines = feed.splitlines()
    geolocator = geoloc.Geolocator(camera=camera_of(lines[0]))
    time_s, attitudes = telemetry(lines, "A")
    geolocator.add_attitude(time_s, attitudes[:, :3], attitudes[:, 3:])
    time_s, positions = telemetry(lines, "P")
    geolocator.add_position(time_s, *positions[:, :3].T, height_msl_m=positions[:, 3])
    outcomes = []
    for at, line in enumerate(lines):
        if line[0] != "F":
            continue
        time_ns, utc_ns, count = map(int, line.split()[1:])
        seen = [one.split() for one in lines[at + 1:at + 1 + count]]
        numbers = np.array([doubles(one[2:]) for one in seen]).reshape(count, 5)
        outcomes += geolocator.process(time_ns / 1e9, numbers[:, :4], numbers[:, 4], [int(one[1]) for one in seen], utc_ns=utc_ns)
    outcomes += geolocator.finish()
    told = [f"F {round(outcome.time_s * 1e9)} {int(outcome.fate)}" for outcome in outcomes]
    return "\n".join([*told, *objects_of(geolocator)]) + "\n"


if __name__ == "__main__":
    print(estimate(pathlib.Path(sys.argv[1]).read_text()), end="")
