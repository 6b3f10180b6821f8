# SPDX-License-Identifier: Apache-2.0
"""What became of every recording, as values, JSON and text."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field

from .._fleet import FusedFlight


@dataclass
class Entry:
    """A recording."""

    recording: str
    state: str = "not done"
    """"done", "kept" (an earlier run had done it), "failed" or "not done" (the run was stopped)."""
    tries: int = 0
    key: str = ""
    """The folder of its results, below recordings/."""
    flight: str | None = None
    """None: no frame was located, or it is not done."""
    same_as: str | None = None
    """Another recording of the same flight, which is in the map in its place."""
    reason: str = ""
    """Why it failed, or has no flight."""


@dataclass
class Map:
    """A map of flights that began within 50 km of each other."""

    file: str
    objects: int
    flights: list[FusedFlight]
    table: str


@dataclass
class Report:
    """What became of an archive."""

    version: str
    settings: dict[str, object]
    seconds: float = 0.0
    recordings: list[Entry] = field(default_factory=list)
    maps: list[Map] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def count(self, *states: str) -> int:
        """Recordings in these states."""
        return sum(entry.state in states for entry in self.recordings)

    @property
    def is_complete(self) -> bool:
        """Whether every recording is done."""
        return self.count("done", "kept") == len(self.recordings)

    def to_json(self) -> str:
        """report.json, in ASCII: names of folders may be anything."""
        document = asdict(self)
        for one in document["maps"]:
            del one["table"]
        return json.dumps(document, indent=1) + "\n"

    def to_text(self) -> str:
        """For people: first what was done, then what was not, and why."""
        done, kept, failed, left = (self.count(state) for state in ("done", "kept", "failed", "not done"))
        lines = [f"{len(self.recordings)} recordings: {done} done in {self.seconds:.1f} s"
                 + (f", {kept} done before" if kept else "") + (f", {failed} failed" if failed else "")
                 + (f", {left} not done: the run was stopped" if left else "")]
        lines += [f"{one.file}: {one.objects} objects of {len(one.flights)} flights" for one in self.maps]
        lines += self.notes
        for entry in self.recordings:
            if entry.state == "failed":
                tries = "once" if entry.tries == 1 else f"{entry.tries} times"
                lines.append(f"failed {tries}: {entry.recording}: {entry.reason}")
        lines += [f"no flight: {entry.recording}: {entry.reason}" for entry in self.recordings if entry.state != "failed" and entry.reason]
        lines += [f"the same flight: {entry.recording} is that of {entry.same_as}" for entry in self.recordings if entry.same_as]
        tables = [one.table for one in self.maps]
        text = "\n".join(lines) + "\n" + "".join("\n" + table for table in tables)
        return text.encode(errors="backslashreplace").decode()
