# SPDX-License-Identifier: Apache-2.0
"""Many flights, one map (docs/fleet.md)."""

from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._rows import FUSED_OBJECT, SUMMARY_OBJECT, rows


class FlightSummary:
    """All that one flight knows of its objects at rest, as geoloc_app and geoloc_replay write it with --summary.

    Object i is truly at ``objects[i]["position_in_enu_m"] + shared_error_m[i] @ s`` and its own noise, with s ~ N(0, I) the same for all
    objects of the flight.
    """

    def __init__(self, core: _core.Summary) -> None:
        self._core = core
        self.flight: str = core.flight
        """The same for all summaries of one flight, and of no other."""
        self.vehicle: str = core.vehicle
        """For people."""
        self.sequence: int = core.sequence
        """Of several summaries of one flight the one with the highest counts."""
        self.origin_deg: tuple[float, float] = core.origin
        """Latitude and longitude of the local frame's origin."""
        self.home_height_msl_m: float | None = core.home_height_msl_m
        """Of the home that heights count from, where it is known."""
        self.objects: npt.NDArray[np.void] = rows(core.objects(), SUMMARY_OBJECT)
        """In order of their ids: dtype `geoloc.SUMMARY_OBJECT`, shape (N,)."""
        self.shared_error_m: npt.NDArray[np.float64] = np.frombuffer(core.shared_error()).reshape(
            len(self.objects), 3, core.shared_count()
        )
        """What objects are off by in common, per shared error: shape (N, 3, K), east, north, up."""
        self.apart: npt.NDArray[np.int64] = np.frombuffer(core.apart(), dtype=np.int64).reshape(-1, 2)
        """Pairs of places among the objects that a frame showed side by side: never one. Shape (M, 2)."""

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> FlightSummary:
        """Reads a file of either form, binary or JSON. Raises ValueError with the reason where it is none, and OSError."""
        return cls.from_bytes(pathlib.Path(path).read_bytes(), os.fspath(path))

    @classmethod
    def from_bytes(cls, content: bytes, name: str = "summary") -> FlightSummary:
        """The same from a file's or a message's content. name stands for the source in the reason."""
        return cls(_core.parse_summary(content, name))

    def to_bytes(self) -> bytes:
        """The binary form, which from_bytes() reads back to the bit."""
        return self._core.to_bytes()

    def to_json(self) -> dict[str, Any]:
        """The form for people and other programs."""
        document: dict[str, Any] = json.loads(self._core.to_json())
        return document


@dataclass(frozen=True)
class FusedFlight:
    """What became of a flight."""

    flight: str
    vehicle: str
    sequence: int
    verdict: str
    """"fused", "alone", "disputed", "quarantined" or "too far" (docs/fleet.md)."""
    reason: str
    """For people; empty where it is fused, unless it contradicts other parts of its flight."""
    objects: int
    shared_objects: int
    """That other flights have, too."""
    common_error_m: tuple[float, float, float]
    """By how much its objects are off in common, reported minus estimated: east, north, up."""
    sigma_m: tuple[float, float, float]
    """1-sigma of that."""
    chi2: float
    """Of its common shift against all others, 2 degrees of freedom."""
    parts: tuple[str, ...] = ()
    """Names of the flights that are parts of one with it, itself included; empty: it is one by itself."""


class FusedMap:
    """One map of many flights. `fuse` makes it."""

    def __init__(self, core: _core.Fused) -> None:
        self._core = core
        self.objects: npt.NDArray[np.void] = rows(core.objects(), FUSED_OBJECT)
        """In order of their ids: dtype `geoloc.FUSED_OBJECT`, shape (N,)."""
        self.flights: list[FusedFlight] = [FusedFlight(**flight) for flight in core.flights()]
        """In order of their names."""
        self.contributions: npt.NDArray[np.int64] = np.frombuffer(core.contributions(), dtype=np.int64).reshape(-1, 3)
        """Which objects of which flights an object is made of: places in `objects`, in `flights`, and in that summary's objects. Shape (M, 3)."""
        self.origin_deg: tuple[float, float] | None = core.origin()
        """Latitude and longitude of the local frame's origin; None of no flights."""
        self.table: str = core.table()
        """A line for each flight, as geoloc_fuse says it."""

    def to_geojson(self, path: str | os.PathLike[str]) -> None:
        """Writes the file that geoloc_fuse's --out writes; it appears whole or not at all. Raises RuntimeError where it cannot be written."""
        _core.write_file(os.fspath(path), self._core.geojson())

    def geojson(self) -> dict[str, Any]:
        """The same FeatureCollection as an object."""
        collection: dict[str, Any] = json.loads(self._core.geojson())
        return collection


def fuse(
    summaries: Iterable[FlightSummary],
    class_names: Sequence[str] = (),
    *,
    quarantine_gate: float | None = None,
    most_shift_m: float | None = None,
    sigma_home_m: float | None = None,
) -> FusedMap:
    """Fuses flights into one map: objects that several of them saw, and what each flight was off by. The order makes no difference.

    class_names: by class id. quarantine_gate: chi-square, 2 degrees of freedom, of a flight's common shift against all others, from which
    on it is left out. most_shift_m: how far flights may be off against each other, whatever they say. sigma_home_m: 1-sigma of the height
    that a home is said to have. None: as geoloc_fuse has it.

    Raises ValueError that names every fault of the settings.
    """
    cores = [summary._core for summary in summaries]
    return FusedMap(_core.fuse(cores, list(class_names), quarantine_gate, most_shift_m, sigma_home_m))
