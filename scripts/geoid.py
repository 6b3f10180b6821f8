#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""geoid.py EGM96_15.GTX EGM96-15.PGM: PROJ's grid of the geoid EGM96 (Debian: proj-data) in GeographicLib's format.

A .gtx is a header of 40 bytes (south-west corner and spacing in degrees as doubles, rows, columns; all big-endian), then float32 metres of
the geoid above the ellipsoid, from south to north. GeographicLib wants 16-bit grey values from north to south, from the meridian of
Greenwich eastwards: metres = offset + scale * value.
"""
import array
import os
import struct
import sys

OFFSET_M, SCALE_M = -108.0, 0.003  # those of GeographicLib's own files
HEADER = struct.Struct(">4d2i")


def read_gtx(path):
    """Rows from south to north, as arrays of float, and the first longitude in degrees."""
    with open(path, "rb") as file:
        south_deg, west_deg, row_deg, column_deg, rows, columns = HEADER.unpack(file.read(HEADER.size))
        if (south_deg, row_deg * (rows - 1), column_deg * columns) != (-90.0, 180.0, 360.0):
            raise ValueError(f"{path} does not cover the whole globe")
        heights_m = array.array("f", file.read(4 * rows * columns))
    if len(heights_m) != rows * columns:
        raise ValueError(f"{path} is cut off")
    if sys.byteorder == "little":
        heights_m.byteswap()
    return [heights_m[row * columns:(row + 1) * columns] for row in range(rows)], west_deg


def to_pgm(rows, west_deg):
    """The file's bytes."""
    columns = len(rows[0])
    greenwich = round(-west_deg / 360.0 * columns) % columns
    values = array.array("H")
    for row in reversed(rows):
        values.extend(round((height_m - OFFSET_M) / SCALE_M) for height_m in row[greenwich:] + row[:greenwich])
    if sys.byteorder == "little":
        values.byteswap()
    header = (f"P5\n# Geoid file in PGM format for the GeographicLib::Geoid class\n# Description WGS84 EGM96, 15-minute grid\n"
              f"# Origin 90N 0E\n# AREA_OR_POINT Point\n# Vertical_Datum WGS84\n# Offset {OFFSET_M:g}\n# Scale {SCALE_M:g}\n"
              f"{columns} {len(rows)}\n65535\n")
    return header.encode() + values.tobytes()


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    source, target = sys.argv[1:]
    content = to_pgm(*read_gtx(source))
    os.makedirs(os.path.dirname(target) or ".", exist_ok=True)
    with open(target + ".part", "wb") as file:
        file.write(content)
    os.replace(target + ".part", target)


if __name__ == "__main__":
    main()
