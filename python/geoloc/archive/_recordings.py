# SPDX-License-Identifier: Apache-2.0
"""Which recordings an archive has."""

from __future__ import annotations

import glob
import os
import pathlib
from collections.abc import Iterable


def _is_recording(folder: pathlib.Path) -> bool:
    """Or what should be one: where a file is missing, the reason is to be told."""
    return (folder / "frames.jsonl").exists() or (folder / "telemetry.tlog").exists()


def _below(folder: pathlib.Path, without: pathlib.Path) -> Iterable[pathlib.Path]:
    for name, folders, _ in os.walk(folder):
        here = pathlib.Path(name)
        if here.resolve() == without:
            folders.clear()
        elif _is_recording(here):
            folders.clear()
            yield here
        else:  # os.walk() does not descend into links, which may lead in circles; a recording may be one
            yield from (here / one for one in folders if (here / one).is_symlink() and _is_recording(here / one))


def find_recordings(places: Iterable[str], out: pathlib.Path) -> list[str]:
    """All recordings at and below these folders or patterns, by their absolute names, in order; those below `out` are not looked for.

    Raises ValueError that names every place without any.
    """
    found: set[str] = set()
    faults = []
    for place in places:
        folders = [pathlib.Path(name) for name in ([place] if os.path.exists(place) else glob.glob(place, recursive=True))]
        here = {os.path.abspath(one) for folder in folders if folder.is_dir() for one in _below(folder, out.resolve())}
        if not here:
            faults.append(f"{place}: " + ("no recording is there" if folders else "is not there"))
        found |= here
    if faults:
        raise ValueError("\n".join(faults))
    return sorted(found)
