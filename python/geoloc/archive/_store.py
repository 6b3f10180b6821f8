# SPDX-License-Identifier: Apache-2.0
"""Results that are there whole or not at all, whoever is killed in between, and one run at a time."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import json
import os
import pathlib
import secrets
import shutil
from collections.abc import Iterator, Mapping
from typing import Any

RECORD = "job.json"
_PARTIAL = ".partial-"


def _sync(folder: pathlib.Path) -> None:
    """Makes the names in it survive a power cut."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _set_aside(place: pathlib.Path) -> pathlib.Path:
    """Under another name at once: whoever still writes to it fails, rather than completing what is half removed."""
    aside = place.with_name(f"{_PARTIAL}{secrets.token_hex(8)}")
    os.rename(place, aside)
    return aside


def write_result(place: pathlib.Path, files: Mapping[str, bytes], record: Mapping[str, Any]) -> None:
    """A folder with these files, and the record with their checksums. Raises OSError."""
    sums = {name: hashlib.sha256(content).hexdigest() for name, content in sorted(files.items())}
    text = json.dumps({**record, "sha256": sums}, indent=1, ensure_ascii=False) + "\n"
    partial = place.with_name(f"{_PARTIAL}{secrets.token_hex(8)}")
    partial.mkdir()
    try:
        for name, content in {**files, RECORD: text.encode()}.items():
            with open(partial / name, "xb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
        _sync(partial)
        if place.exists() and read_result(place) is None:
            shutil.rmtree(_set_aside(place))
        try:
            os.rename(partial, place)
        except OSError:
            if read_result(place) is None:
                raise  # and not: another worker had the same recording
        _sync(place.parent)
    finally:
        shutil.rmtree(partial, ignore_errors=True)


def read_result(place: pathlib.Path) -> dict[str, Any] | None:
    """The record of a folder whose files are as they were written; None otherwise."""
    try:
        record: dict[str, Any] = json.loads((place / RECORD).read_bytes())
        for name, wanted in record["sha256"].items():
            if hashlib.sha256((place / name).read_bytes()).hexdigest() != wanted:
                return None
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None
    return record


def remove_partial(folder: pathlib.Path) -> None:
    """What killed workers have left."""
    for partial in folder.glob(f"{_PARTIAL}*"):
        with contextlib.suppress(OSError):
            shutil.rmtree(_set_aside(partial))


@contextlib.contextmanager
def lock(folder: pathlib.Path) -> Iterator[None]:
    """Raises BlockingIOError where another run has it. The system lets go of it when the process ends, however it does, and a forked worker
    does not inherit it."""
    with open(folder / ".lock", "w") as file:
        fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
