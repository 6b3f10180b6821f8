# SPDX-License-Identifier: Apache-2.0
"""The JSON Lines of a running program, as they come."""
import json
import os
import queue
import threading
import time


class JsonLines:
    """Reads a named pipe, to be given to --jsonl. The program that opens it for writing ends the reader by its own end."""

    def __init__(self, folder):
        self.pipe = folder / "lines.fifo"
        os.mkfifo(self.pipe)
        self._lines = queue.SimpleQueue()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        with self.pipe.open() as lines:
            for line in lines:
                self._lines.put((time.monotonic(), json.loads(line)))

    def next(self, deadline, kind, holds=lambda _: True):
        """(arrival by the monotonic clock, line) of the next one of a type for which something holds; None after the deadline."""
        while True:
            try:
                arrival_s, line = self._lines.get(timeout=max(0.0, deadline - time.monotonic()))
            except queue.Empty:
                return None
            if line["type"] == kind and holds(line):
                return arrival_s, line

    def skip(self):
        """Forgets what has come up to now."""
        while not self._lines.empty():
            self._lines.get()
