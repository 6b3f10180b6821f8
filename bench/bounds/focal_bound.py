#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How well a vehicle that leans to and fro can tell its camera's focal length, and how well it believes it does.

    python3 bench/bounds/focal_bound.py [ACCURACY_M]      # needs numpy; default: 0.85, of the receiver (radial, 1-sigma)

The flight is that of tests/pipeline/focal_length_test.cpp, to first order: a camera that looks straight down leans by 0.05 rad
over a field of objects whose places and heights are unknown. The vehicle's position wanders and ripples as the drift's
prior says. All looks are solved at once by least squares (docs/method.md, "Focal length"), with that process's own covariance and
with those of straight lines between nodes and of a sway beside them. "stated" is the sigma of the focal length by the covariance that
is assumed, "true" what the same estimate is off by under the process's own.
"""
import sys

import numpy

FOCAL_PX, WIDTH_PX, HEIGHT_PX, SIGMA_PX = 914.01, 1280, 720, 0.5
ALTITUDE_M, SPEED_MPS, LEG_S, LEAN_RAD = 20.0, 2.5, 12.0, 0.05
CONSTANT_SHARE, RIPPLE_SHARE, WANDERING_S, RIPPLE_S = 0.15, 0.2, 100.0, 3.0
SWAY_S, SPELL_S = 2.0, 1.0
SWAY_M, WITHIN_SPELL_M = 0.09, 0.1  # as the flight of that test learns them: 1-sigma of the sway, and of each frame besides
SIGMA_FOCAL, SIGMA_HEIGHT_M, SIGMA_GROUND_M, SIGMA_BORESIGHT_RAD, SIGMA_LATENCY_S = 0.03, 2.0, 3.0, 0.026, 0.3
UNKNOWN = 1e4

TIMES = numpy.arange(0.5, 90.0, 0.2)
PLACES = numpy.array([(east, north) for north in numpy.arange(-3.0, 60.1, 4.5) for east in (-7.0, -1.0, 6.0)])
# The unknowns: east, north and up of each object, then these, then the vehicle's errors, east and north, at each frame.
FOCAL, HEIGHT, BORESIGHT, LATENCY, ERRORS = (3 * len(PLACES) + i for i in (0, 1, 2, 4, 5))


def whole(apart_s, sigma_m):
    """Covariance of the position's errors at times that lie so far apart."""
    return sigma_m**2 * ((1 - RIPPLE_SHARE) * numpy.exp(-apart_s / WANDERING_S) + RIPPLE_SHARE * numpy.exp(-apart_s / RIPPLE_S))


def apart(times_s):
    return numpy.abs(times_s[:, None] - times_s[None, :])


def by_nodes(spacing_s, sigma_m):
    """The same as straight lines between nodes see it, with a sway that is constant over each spell."""
    nodes_s = numpy.arange(TIMES[0], TIMES[-1] + 2 * spacing_s, spacing_s)
    lines = numpy.maximum(0.0, 1.0 - numpy.abs(TIMES[:, None] - nodes_s[None, :]) / spacing_s)
    spells_s = SPELL_S * numpy.floor((TIMES - TIMES[0]) / SPELL_S + 1e-9)
    sway = SWAY_M**2 * numpy.exp(-apart(spells_s) / SWAY_S)
    return lines @ whole(apart(nodes_s), sigma_m) @ lines.T + sway + WITHIN_SPELL_M**2 * numpy.eye(len(TIMES))


def information_of_looks():
    """Sum of J' J / sigma^2 over all looks."""
    information = numpy.zeros((ERRORS + 2 * len(TIMES),) * 2)
    variance_m2 = (SIGMA_PX * ALTITUDE_M / FOCAL_PX)**2
    for frame, time_s in enumerate(TIMES):
        along_s = time_s % (2 * LEG_S)
        vehicle = numpy.array([0.0, SPEED_MPS * min(along_s, 2 * LEG_S - along_s)])
        velocity = numpy.array([0.0, SPEED_MPS if along_s < LEG_S else -SPEED_MPS])
        tilt = LEAN_RAD * numpy.array([numpy.sin(time_s), numpy.cos(0.7 * time_s)])
        for number, place in enumerate(PLACES):
            beside = (place - vehicle) / ALTITUDE_M
            if numpy.any(numpy.abs(beside - tilt) * FOCAL_PX > (WIDTH_PX / 2, HEIGHT_PX / 2)):
                continue
            for axis in 0, 1:
                columns = [3 * number + axis, 3 * number + 2, FOCAL, HEIGHT, BORESIGHT + axis, LATENCY,
                           ERRORS + axis * len(TIMES) + frame]
                row = numpy.array([1.0, -beside[axis], ALTITUDE_M * (beside[axis] - tilt[axis]), beside[axis], ALTITUDE_M,
                                   velocity[axis], -1.0])
                information[numpy.ix_(columns, columns)] += numpy.outer(row, row) / variance_m2
    return information


def sigmas_percent(information, assumed, process):
    """Of the focal length: stated, and true."""
    sigmas = numpy.concatenate([numpy.tile([UNKNOWN, UNKNOWN, SIGMA_GROUND_M], len(PLACES)),
                                [SIGMA_FOCAL, SIGMA_HEIGHT_M, SIGMA_BORESIGHT_RAD, SIGMA_BORESIGHT_RAD, SIGMA_LATENCY_S]])
    posterior, inverse, count = information.copy(), numpy.linalg.inv(assumed), len(TIMES)
    posterior[range(ERRORS), range(ERRORS)] += sigmas**-2
    for axis in 0, 1:
        here = slice(ERRORS + axis * count, ERRORS + (axis + 1) * count)
        posterior[here, here] += inverse
    covariance = numpy.linalg.inv(posterior)[FOCAL]
    stated = true = covariance[FOCAL]
    for axis in 0, 1:
        gain = covariance[ERRORS + axis * count:ERRORS + (axis + 1) * count] @ inverse
        true += gain @ (process - assumed) @ gain
    return 100 * numpy.sqrt(stated), 100 * numpy.sqrt(true)


def main():
    accuracy_m = float(sys.argv[1]) if len(sys.argv) > 1 else 0.85
    sigma_m = numpy.sqrt(0.5 * (1 - CONSTANT_SHARE)) * accuracy_m
    process, information = whole(apart(TIMES), sigma_m), information_of_looks()
    print("| position | stated % | true % |\n|---|---|---|")
    for name, assumed in (("its own process", process), ("nodes 3 s apart, sway", by_nodes(3.0, sigma_m)),
                          ("nodes 1 s apart, sway", by_nodes(1.0, sigma_m))):
        stated, true = sigmas_percent(information, assumed, process)
        print(f"| {name} | {stated:.2f} | {true:.2f} |")


if __name__ == "__main__":
    main()
