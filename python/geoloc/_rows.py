# SPDX-License-Identifier: Apache-2.0
"""The structured arrays that results come in, as python/bindings/rows.hpp lays them out."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _core

_TIME = "datetime64[ns]"
_PLACE = [("latitude_deg", "f8"), ("longitude_deg", "f8")]
_KNOWN = [("id", "u8"), ("class_id", "i8"), ("hits", "i8"), ("confidence", "f8")]
_WHERE = [
    *_PLACE,
    ("height_above_home_m", "f8"),
    ("sigma_major_m", "f8"),
    ("sigma_minor_m", "f8"),
    ("sigma_azimuth_deg", "f8"),
    ("sigma_height_m", "f8"),
]
_SEEN = [("first_seen", _TIME), ("last_seen", _TIME)]

#: Objects. Angles are in degrees from true north; NaN is what is not known.
OBJECT = np.dtype(
    [
        *_KNOWN,
        *_WHERE,
        ("position_in_enu_m", "f8", 2),
        ("covariance_m2", "f8", (2, 2)),
        ("velocity_in_enu_mps", "f8", 2),
        ("velocity_covariance_m2ps2", "f8", (2, 2)),
        *_SEEN,
        ("is_confirmed", "?"),
    ],
    align=True,
)

_BOX = [("box_px", "f8", 4), ("confidence", "f8"), ("class_id", "i8")]

#: Detections of the frame located last, where they meet the ground. ground_from_pixel_mppx is d(east, north) / d(u, v).
FIX = np.dtype(
    [*_BOX, *_PLACE, ("position_in_enu_m", "f8", 2), ("ground_from_pixel_mppx", "f8", (2, 2)), ("range_m", "f8")],
    align=True,
)

#: Detections of a whole run. object_id is -1 for a detection that is no object's.
RAW_FIX = np.dtype(
    [
        ("captured_at", _TIME),
        ("frame", "u8"),
        ("object_id", "i8"),
        *_BOX,
        *_PLACE,
        ("position_in_enu_m", "f8", 2),
        ("range_m", "f8"),
        ("expected_px", "f8", 2),
    ],
    align=True,
)

#: Where the vehicle was at the located frames of a run.
TRAJECTORY = np.dtype([("captured_at", _TIME), *_PLACE, ("position_in_enu_m", "f8", 3)], align=True)

#: Objects of one flight's summary; positions are east, north, up in the flight's local frame.
SUMMARY_OBJECT = np.dtype(
    [
        *_KNOWN,
        ("position_in_enu_m", "f8", 3),
        ("own_covariance_m2", "f8", (3, 3)),
        *_SEEN,
    ],
    align=True,
)

#: Objects of the map of many flights; covariance_m2 is that of the absolute position: east, north, up.
FUSED_OBJECT = np.dtype(
    [
        *_KNOWN,
        *_WHERE,
        ("position_in_enu_m", "f8", 3),
        ("covariance_m2", "f8", (3, 3)),
        *_SEEN,
    ],
    align=True,
)

_sizes = tuple(dtype.itemsize for dtype in (OBJECT, FIX, RAW_FIX, TRAJECTORY, SUMMARY_OBJECT, FUSED_OBJECT))
if _sizes != tuple(_core.row_sizes()):
    raise ImportError(f"geoloc's module lays out rows of {_core.row_sizes()} bytes, not of {_sizes}: install it anew")


def rows(content: bytes, dtype: np.dtype) -> npt.NDArray[np.void]:
    """An array of one's own."""
    return np.frombuffer(bytearray(content), dtype=dtype)
