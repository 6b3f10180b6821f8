# SPDX-License-Identifier: Apache-2.0
"""What estimators and scores answer besides arrays."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import NamedTuple

from . import _core


class Fate(enum.IntEnum):
    """What became of a frame; ``fate.explain()`` says it in a sentence."""

    LOCATED = 0
    NO_TELEMETRY = 1
    BEFORE_TELEMETRY = 2
    IN_A_GAP = 3
    AFTER_TELEMETRY = 4
    OUT_OF_ORDER = 5
    CLOCK_BEGUN_ANEW = 6
    NO_ROOM = 7
    UNUSABLE_MOUNT = 8
    NO_GIMBAL = 9
    UNUSABLE_FOCAL_LENGTH = 10

    def explain(self) -> str:
        """What became of the frame and, where it was not located, what would change that."""
        return _core.explain(int(self))


class Outcome(NamedTuple):
    """A frame that waits no longer."""

    time_s: float
    """Of its capture, on the vehicle's clock."""
    fate: Fate

    @property
    def is_located(self) -> bool:
        """Whether its detections refined the objects."""
        return self.fate is Fate.LOCATED


@dataclass(frozen=True)
class Calibration:
    """What was learnt of the errors that are constant over a flight, each with its 1-sigma: true = reported, corrected by this."""

    boresight_deg: tuple[float, float, float]
    """The camera is turned by this against its nominal mount, about its own x (right), y (down), z (forward)."""
    sigma_boresight_deg: tuple[float, float, float]
    latency_s: float
    """A frame shows the world this much before its stamp."""
    sigma_latency_s: float
    height_m: float
    """The camera is this much higher above the ground than reported."""
    sigma_height_m: float
    focal_percent: float
    """The focal length is this much longer than the nominal one."""
    sigma_focal_percent: float
    position_lag_s: float
    """The reported position is that of the vehicle this much earlier, as seen against its attitude."""
    sigma_position_lag_s: float
    offset_m: tuple[float, float]
    """The vehicle is this much east and north of where it reports to be."""
    sigma_offset_m: tuple[float, float]


@dataclass(frozen=True)
class Score:
    """How well objects match true targets, one to one at least total distance; pairs over 3 m do not count (docs/formats.md)."""

    targets: int
    objects: int
    found: int
    """Targets with an object of their own."""
    extra: int
    """Objects without a target."""
    merged_pairs: int
    """A target without an object beside one whose object stands for both."""
    rmse_m: float | None
    """Over the targets found; None where there is none."""
    relative_rmse_m: float | None
    """The same with the mean offset of all objects removed."""
    target_of_object: list[int | None]
    """The index of each object's target."""
    mean_nees: float | None = None
    """Mean squared error of the objects in units of their stated covariance: 2 where that is right. Of a Result alone."""
    height_rmse_m: float | None = None
    """Of the objects' heights, where they and the targets have some. Of a Result alone."""
