#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes a recording one of a drone whose receiver is off: all its positions, moved by so much.

    scripts/shift_receiver.py RECORDING EAST_M NORTH_M

Rewrites RECORDING/telemetry.tlog in place: latitude and longitude of each GLOBAL_POSITION_INT, and its checksum."""
import math
import pathlib
import struct
import sys

STAMP_SIZE = 8
GLOBAL_POSITION_INT, ITS_CRC_EXTRA = 33, 104
EARTH_RADIUS_M = 6378137.0


def checksum(data):
    """CRC-16/MCRF4XX, as MAVLink has it."""
    crc = 0xFFFF
    for byte in data:
        byte ^= crc & 0xFF
        byte = (byte ^ (byte << 4)) & 0xFF
        crc = (crc >> 8) ^ (byte << 8) ^ (byte << 3) ^ (byte >> 4)
    return crc & 0xFFFF


def moved(frame, east_m, north_m):
    """A MAVLink 2 frame with the position in it moved; any other frame as it is. Zeros at a payload's end are not sent."""
    length, message = frame[1], int.from_bytes(frame[7:10], "little")
    if message != GLOBAL_POSITION_INT or length < 12:
        return frame
    latitude, longitude = struct.unpack_from("<ii", frame, 14)
    latitude += round(1e7 * math.degrees(north_m / EARTH_RADIUS_M))
    longitude += round(1e7 * math.degrees(east_m / (EARTH_RADIUS_M * math.cos(math.radians(latitude / 1e7)))))
    frame = bytearray(frame)
    struct.pack_into("<ii", frame, 14, latitude, longitude)
    end = 10 + length
    struct.pack_into("<H", frame, end, checksum(bytes(frame[1:end]) + bytes([ITS_CRC_EXTRA])))
    return bytes(frame)


def frames_of(log):
    """Stamps and frames of a tlog of MAVLink 2 without signatures, as geoloc_sim writes."""
    at = 0
    while at < len(log):
        start = at + STAMP_SIZE
        if log[start] != 0xFD or log[start + 2] & 1:
            raise SystemExit("shift_receiver.py: not a recording of geoloc_sim: no MAVLink 2, or signed")
        end = start + 12 + log[start + 1]
        yield log[at:start], log[start:end]
        at = end


def main():
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    file = pathlib.Path(sys.argv[1]) / "telemetry.tlog"
    east_m, north_m = float(sys.argv[2]), float(sys.argv[3])
    file.write_bytes(b"".join(stamp + moved(frame, east_m, north_m) for stamp, frame in frames_of(file.read_bytes())))


if __name__ == "__main__":
    main()
