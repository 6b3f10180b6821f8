# SPDX-License-Identifier: Apache-2.0
"""How far it is."""

from __future__ import annotations

import collections
import sys
import time

_WIDTH = 30
_RECENT = 50  # recordings that the speed is taken from
_EVERY_S = {True: 0.2, False: 10.0}  # on a terminal, and in a log


class Progress:
    """A line on stderr: a bar, counts, and the time left at the speed of the last recordings."""

    def __init__(self, total: int, is_shown: bool = True) -> None:
        self._total = total
        self._done = self._failed = 0
        self._is_shown = is_shown
        self._is_terminal = sys.stderr.isatty()
        self._shown_at = time.monotonic()
        self._ends = collections.deque([time.monotonic()], maxlen=_RECENT)

    def add(self, has_failed: bool) -> None:
        """A recording has ended for good."""
        self._done += 1
        self._failed += has_failed
        self._ends.append(time.monotonic())

    def show(self, is_last: bool = False) -> None:
        """Writes the line where it is time to."""
        now = time.monotonic()
        if not self._is_shown or not is_last and now - self._shown_at < _EVERY_S[self._is_terminal]:
            return
        self._shown_at = now
        full = _WIDTH * self._done // max(1, self._total)
        failed = f", {self._failed} failed" if self._failed else ""
        line = f"[{'#' * full}{'.' * (_WIDTH - full)}] {self._done} of {self._total} recordings{failed}{self._left(now)}"
        end = "\n" if is_last or not self._is_terminal else ""
        sys.stderr.write(("\r\033[K" if self._is_terminal else "") + line + end)
        sys.stderr.flush()

    def _left(self, now: float) -> str:
        if len(self._ends) < 2 or self._done == self._total:
            return ""
        left_s = round((self._total - self._done) * (now - self._ends[0]) / (len(self._ends) - 1))
        hours, seconds = divmod(left_s, 3600)
        return f", {hours}:{seconds // 60:02}:{seconds % 60:02} left"
