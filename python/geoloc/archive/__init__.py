# SPDX-License-Identifier: Apache-2.0
"""Archives of recordings: objects and a summary of every flight, and one map of all. ``python -m geoloc.archive`` is the program."""

from ._report import Entry, Map, Report
from ._run import run

__all__ = ["Entry", "Map", "Report", "run"]
