# SPDX-License-Identifier: Apache-2.0
"""Geographic coordinates of ground objects from a drone's camera and telemetry.

`Geolocator` takes one's own detections and poses; `replay` replays a `Recording`; `evaluate` scores objects against the truth; `fuse` makes one map of the
`FlightSummary` of many flights, and ``python -m geoloc.archive`` of an archive of recordings. Results are NumPy's structured arrays.
docs/python.md has examples.
"""

from . import _core
from ._fleet import FlightSummary, FusedFlight, FusedMap, fuse
from ._geolocator import Geolocator, memory_needed
from ._recording import Frame, Recording, Result, evaluate, replay
from ._results import Calibration, Fate, Outcome, Score
from ._rows import FIX, FUSED_OBJECT, OBJECT, RAW_FIX, SUMMARY_OBJECT, TRAJECTORY

__version__ = _core.version()

__all__ = [
    "FIX",
    "FUSED_OBJECT",
    "OBJECT",
    "RAW_FIX",
    "SUMMARY_OBJECT",
    "TRAJECTORY",
    "Calibration",
    "Fate",
    "FlightSummary",
    "Frame",
    "FusedFlight",
    "FusedMap",
    "Geolocator",
    "Outcome",
    "Recording",
    "Result",
    "Score",
    "__version__",
    "evaluate",
    "fuse",
    "memory_needed",
    "replay",
]
