# SPDX-License-Identifier: Apache-2.0
"""Geographic coordinates of ground objects from a drone's camera and telemetry.

`Geolocator` takes one's own detections and poses; `replay` replays a `Recording`; `evaluate` scores objects against the truth. Results are
NumPy's structured arrays. docs/python.md has examples.
"""

from . import _core
from ._geolocator import Geolocator
from ._recording import Frame, Recording, Result, evaluate, replay
from ._results import Calibration, Fate, Outcome, Score
from ._rows import FIX, OBJECT, RAW_FIX, TRAJECTORY

__version__ = _core.version()

__all__ = [
    "FIX",
    "OBJECT",
    "RAW_FIX",
    "TRAJECTORY",
    "Calibration",
    "Fate",
    "Frame",
    "Geolocator",
    "Outcome",
    "Recording",
    "Result",
    "Score",
    "__version__",
    "evaluate",
    "replay",
]
