# SPDX-License-Identifier: Apache-2.0
"""A recording as a list of calls, which programs in three languages make of their estimators.

A feed is text, a call a line: a letter, whole numbers, then doubles by the sixteen hexadecimal digits of their bits.

    C width_px height_px | fx fy cx cy, distortion[5], mount: roll pitch yaw [deg] x y z [m]
    A time_ns | roll pitch yaw [rad], rates in the body [rad/s]
    P time_ns | latitude longitude [deg], height above home, height above mean sea level [m]
    F time_ns utc_ns detections, and so many lines of D class_id | x y width height [px], confidence

After each line, frames are processed that wait no longer. What a program answers, in the same digits: F time_ns fate of each frame, and of each object
O id class_id hits first_seen_ns last_seen_ns | latitude longitude, east north, covariance east-east east-north north-north, height, its sigma, confidence.
"""

import struct

ATTITUDE, GLOBAL_POSITION_INT = 30, 33
AHEAD_NS = 1_000_000_000  # so much telemetry goes before a frame


def hex_of(*values):
    return " ".join(struct.pack(">d", value).hex() for value in values)


def doubles(words):
    return [struct.unpack(">d", bytes.fromhex(word))[0] for word in words]


def messages(tlog):
    """(stamp [us], message id, payload) of MAVLink 2 in a tlog, cut zeros restored."""
    at = 0
    while at < len(tlog):
        stamp, = struct.unpack_from(">Q", tlog, at)
        magic, size, incompatible = tlog[at + 8:at + 11]
        assert magic == 0xFD, "MAVLink 2 alone"
        yield stamp, int.from_bytes(tlog[at + 15:at + 18], "little"), tlog[at + 18:at + 18 + size].ljust(64, b"\0")
        at += 8 + 12 + size + (13 if incompatible & 1 else 0)


def samples(tlog):
    """(time [ns], line) of attitudes, then positions; and the clock's zero [us]."""
    attitudes, positions, zero_us = [], [], None
    for stamp, kind, payload in messages(tlog):
        if kind == ATTITUDE:
            boot_ms, *angles = struct.unpack_from("<I6f", payload)
            attitudes.append((boot_ms * 1_000_000, f"A {boot_ms * 1_000_000} {hex_of(*angles)}"))
            zero_us = min(stamp - boot_ms * 1000, stamp if zero_us is None else zero_us)
        elif kind == GLOBAL_POSITION_INT:
            boot_ms, latitude, longitude, msl, relative = struct.unpack_from("<I4i", payload)
            place = hex_of(latitude / 1e7, longitude / 1e7, relative / 1e3, msl / 1e3)
            positions.append((boot_ms * 1_000_000, f"P {boot_ms * 1_000_000} {place}"))
    return sorted(attitudes + positions, key=lambda sample: sample[0]), zero_us


def feed_of(recording):
    """The text for a geoloc.Recording of a camera fixed to the body."""
    camera, mount = recording.camera, recording.camera["mount"]
    lens = [camera[name] for name in ("fx", "fy", "cx", "cy")] + (list(camera.get("distortion") or []) + [0.0] * 5)[:5]
    lines = [f"C {camera['width']} {camera['height']} "
             + hex_of(*lens, *(mount.get(name, 0.0) for name in ("roll_deg", "pitch_deg", "yaw_deg", "x_m", "y_m", "z_m")))]
    waiting, zero_us = samples(recording.telemetry)
    for frame in recording.frames:
        time_ns = (frame.time_us - zero_us) * 1000
        while waiting and waiting[0][0] <= time_ns + AHEAD_NS:
            lines.append(waiting.pop(0)[1])
        lines.append(f"F {time_ns} {frame.time_us * 1000} {len(frame.boxes_px)}")
        lines += [f"D {class_id} {hex_of(*box, confidence)}"
                  for box, confidence, class_id in zip(frame.boxes_px, frame.confidence, frame.class_id)]
    return "\n".join(lines + [line for _, line in waiting]) + "\n"
