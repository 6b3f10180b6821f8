# SPDX-License-Identifier: Apache-2.0
"""A terminal that is stopped (Ctrl-S), or a pipe that nobody reads, stops neither the flight nor its end."""
import fcntl
import os
import termios
import unittest

from flight_under_fault import FaultTest, wait_until
from support import open_terminal

MOST_TO_END_S = 30  # a second of patience with the terminal; the rest is for a loaded machine


def full_pipe():
    """The reading and the writing end of a pipe of one page that takes nothing more."""
    reader, writer = os.pipe()
    fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, 4096)
    os.set_blocking(writer, False)
    try:
        while True:
            os.write(writer, b"." * 4096)
    except BlockingIOError:
        os.set_blocking(writer, True)
    return reader, writer


class StoppedTerminal(FaultTest):

    def fly_and_end(self, app, status=0):
        """Flies, then ends the app by Ctrl-C: everything must be there."""
        self.fly()
        wait_until(lambda: self.objects_file.exists() and self.features(), "objects in the file")
        ended, took_s = self.interrupt(app)
        self.assertEqual(ended, status)
        self.assertLess(took_s, MOST_TO_END_S)
        self.assertGreater(self.frames_recorded(), 5)
        self.assertTrue((self.recording / "frames.jsonl").exists(), "the recording is complete")
        self.assertTrue(self.features())

    def test_a_terminal_stopped_in_flight(self):
        controller, terminal = open_terminal()
        self.addCleanup(os.close, controller)
        app = self.start(stderr=terminal)
        self.assertIn(b"listening", os.read(controller, 4096))
        termios.tcflow(terminal, termios.TCOOFF)
        os.close(terminal)
        self.fly_and_end(app)

    def test_an_unread_pipe(self):
        reader, writer = full_pipe()
        self.addCleanup(os.close, reader)
        app = self.start(stderr=writer)
        os.close(writer)
        self.fly_and_end(app)

    def test_an_unread_pipe_as_stdout(self):
        reader, writer = full_pipe()
        self.addCleanup(os.close, reader)
        csv = self.folder / "objects.csv"
        app = self.start(outputs=("--csv", csv), stdout=writer)  # with --out there would be no table
        os.close(writer)
        self.fly()
        wait_until(lambda: csv.exists() and csv.read_text().count("\n") > 1, "objects in the file")
        status, took_s = self.interrupt(app)
        self.assertEqual(status, 1, "the table of objects is an output that was not written")
        self.assertLess(took_s, MOST_TO_END_S)


if __name__ == "__main__":
    unittest.main()
