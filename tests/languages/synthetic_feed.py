# SPDX-License-Identifier: Apache-2.0
"""synthetic_feed.py [SECONDS]: a feed (feed.py) of a noisy flight to and fro over a grid of objects, at 20 m; needs Python alone."""

import math
import random
import sys

from feed import hex_of

WIDTH, HEIGHT, FOCAL_PX = 1280, 720, 914.01
PERIOD_NS = 100_000_000
OBJECTS_M = [(8.0 * i, 8.0 * k) for i in range(-2, 3) for k in range(-2, 3)]


def place_m(time_s):
    """East and north."""
    return 15.0 * math.sin(0.3 * time_s), 14.0 * math.sin(0.17 * time_s)


def telemetry(time_ns, draw):
    east, north = (axis + draw.gauss(0.0, 0.05) for axis in place_m(time_ns / 1e9))
    angles = [draw.gauss(0.0, 0.004) for _ in range(3)]
    yield f"A {time_ns} {hex_of(*angles, 0.0, 0.0, 0.0)}"
    yield f"P {time_ns} {hex_of(47.4 + north / 111175.0, 8.5 + east / 75400.0, 20.0, 420.0)}"


def frame(time_ns, draw):
    east, north = place_m(time_ns / 1e9)
    seen = []
    for class_id, (object_east, object_north) in enumerate(OBJECTS_M):
        x = WIDTH / 2 + FOCAL_PX * (object_east - east) / 20.0 + draw.gauss(0.0, 0.6)
        y = HEIGHT / 2 - FOCAL_PX * (object_north - north) / 20.0 + draw.gauss(0.0, 0.6)
        if 20.0 < x < WIDTH - 20.0 and 20.0 < y < HEIGHT - 20.0 and draw.random() < 0.9:
            seen.append(f"D {class_id % 3} {hex_of(x - 15.0, y - 15.0, 30.0, 30.0, draw.uniform(0.6, 0.95))}")
    return [f"F {time_ns} {1_700_000_000_000_000_000 + time_ns} {len(seen)}", *seen]


def main(seconds="60"):
    draw = random.Random(7)
    print(f"C {WIDTH} {HEIGHT} "
          + hex_of(FOCAL_PX, FOCAL_PX, (WIDTH - 1) / 2, (HEIGHT - 1) / 2, *[0.0] * 5, 0.0, -90.0, 0.0, 0.0, 0.0, 0.0))
    for step in range(int(10 * float(seconds))):
        print("\n".join(telemetry(step * PERIOD_NS, draw)))
        if step % 2 == 1:
            print("\n".join(frame(step * PERIOD_NS - PERIOD_NS // 3, draw)))


if __name__ == "__main__":
    main(*sys.argv[1:])
