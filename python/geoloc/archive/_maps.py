# SPDX-License-Identifier: Apache-2.0
"""The maps of all summaries."""

from __future__ import annotations

import pathlib
from typing import Any

from .._fleet import FlightSummary, FusedMap, fuse
from ._job import SUMMARY
from ._report import Entry, Map, Report
from ._store import read_result


def _take(summary: FlightSummary, entry: Entry, taken: dict[str, tuple[FlightSummary, Entry]]) -> None:
    """Of several recordings of a flight the one with most frames; entries come in order of their keys, so that names decide nothing."""
    other = taken.get(summary.flight)
    if other is not None and other[0].sequence >= summary.sequence:
        entry.same_as = other[1].recording
        return
    if other is not None:
        other[1].same_as = entry.recording
    taken[summary.flight] = summary, entry


def _class_names(records: list[dict[str, Any]], report: Report) -> list[str]:
    lists = {tuple(record["class_names"]) for record in records if record["class_names"]}
    if len(lists) > 1:
        report.notes.append("the maps name no classes, since the recordings have different lists of names")
    return list(lists.pop()) if len(lists) == 1 else []


def _maps_of(summaries: list[FlightSummary], class_names: list[str]) -> list[FusedMap]:
    """One for all that began within reach of each other: flights that are too far for one map make the next."""
    maps: list[FusedMap] = []
    while summaries or not maps:
        made = fuse(summaries, class_names)
        far = {flight.flight for flight in made.flights if flight.verdict == "too far"}
        maps.append(fuse([one for one in summaries if one.flight not in far], class_names) if far else made)
        summaries = [one for one in summaries if one.flight in far]
    return maps


def write_maps(out: pathlib.Path, results: pathlib.Path, report: Report) -> None:
    """Fuses what the report says is done, writes map.geojson (and map-2.geojson, …), and completes the report."""
    taken: dict[str, tuple[FlightSummary, Entry]] = {}
    records = []
    for entry in sorted(report.recordings, key=lambda entry: (entry.key, entry.recording)):
        record = read_result(results / entry.key) if entry.key else None
        if record is None:
            continue
        records.append(record)
        entry.flight = record["flight"]
        if entry.flight is None:
            entry.reason = "no frame was located: " + record["said"]
        else:
            _take(FlightSummary.read(results / entry.key / SUMMARY), entry, taken)
    summaries = [taken[flight][0] for flight in sorted(taken)]
    names = []
    for number, fused in enumerate(_maps_of(summaries, _class_names(records, report)), start=1):
        names.append("map.geojson" if number == 1 else f"map-{number}.geojson")
        fused.to_geojson(out / names[-1])
        report.maps.append(Map(names[-1], len(fused.objects), fused.flights, fused.table))
    for old in out.glob("map-*.geojson"):
        if old.name not in names:
            old.unlink()
