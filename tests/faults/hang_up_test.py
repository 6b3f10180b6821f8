# SPDX-License-Identifier: Apache-2.0
"""A terminal that goes away (a dropped ssh) ends a run as Ctrl-C does, unless nohup says otherwise."""
import signal
import unittest

from flight_under_fault import FaultTest, wait_until
from support import PATIENCE_S


class HangUp(FaultTest):

    def test_a_hang_up_ends_the_run_with_its_results(self):
        app = self.start()
        self.fly()
        wait_until(lambda: self.objects_file.exists() and self.features(), "objects in the file")
        for _ in range(2):  # the kernel's and the shell's
            app.send_signal(signal.SIGHUP)
        self.assertEqual(app.wait(PATIENCE_S), 0)
        self.assertGreater(self.frames_recorded(), 5)
        self.assertTrue((self.recording / "frames.jsonl").exists(), "the recording is complete")

    def test_nohup_is_respected(self):
        app = self.start(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        wait_until(self.objects_file.exists, "the first results")
        app.send_signal(signal.SIGHUP)
        self.objects_file.unlink()
        wait_until(self.objects_file.exists, "the next results")
        self.assertEqual(self.interrupt(app)[0], 0)


if __name__ == "__main__":
    unittest.main()
