# SPDX-License-Identifier: Apache-2.0
"""Limits of the system end a run with a reason and an exit status, never by a signal."""
import os
import resource
import signal
import unittest

from flight_under_fault import FaultTest, limit, wait_until
from support import PATIENCE_S, run

MIB = 1 << 20
SANITIZED = bool(os.environ["GEOLOC_SANITIZE"])


class Limits(FaultTest):

    def run_under(self, imposed):
        return run("geoloc_app", *self.world.inputs(), "--record", self.recording, "--http", 0, preexec_fn=imposed)

    def test_few_descriptors_are_a_reason(self):
        for most in (6, 10, 16, 20, 64):
            with self.subTest(most=most):
                result = self.run_under(limit(resource.RLIMIT_NOFILE, most))
                self.assert_refused(result, f"{most} files may be open at once", "ulimit -n")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_low_limit_of_descriptors_is_raised_where_it_can_be(self):
        with self.world.watch(preexec_fn=limit(resource.RLIMIT_NOFILE, 20, hard=1024)) as app, self.world.fly():
            app.wait_for("video: frames come")
            self.assertEqual(app.interrupt(), 0, app.lines)

    @unittest.skipIf(SANITIZED, "sanitizers need addresses without limit")
    def test_little_memory_is_a_reason(self):
        for most_mib in (500, 1000, 1500):
            with self.subTest(most_mib=most_mib):
                result = self.run_under(limit(resource.RLIMIT_AS, most_mib * MIB))
                self.assert_refused(result, "not enough memory", f"{most_mib} MiB", "ulimit -v")

    @unittest.skipIf(SANITIZED, "sanitizers need addresses without limit")
    def test_memory_that_runs_out_in_flight_is_a_reason(self):
        with open(self.folder / "stderr", "w+", encoding="utf-8") as stderr:
            with self.world.fly():
                app = self.start(stderr=stderr)
                wait_until(lambda: self.frames_recorded() > 5, "frames")
                resource.prlimit(app.pid, resource.RLIMIT_AS, (100 * MIB, 100 * MIB))  # it gets nothing more
            with self.world.fly("--image-size", "3840x2160"):  # a picture of 24 MB; no stream before it had such a block
                status = app.wait(PATIENCE_S)
            stderr.seek(0)
            words = stderr.read()
        self.assertEqual(status, 1, words)
        self.assertRegex(words.splitlines()[-1], "^geoloc_app: .*(memory|allocate|Resource temporarily unavailable)")

    @unittest.skipIf(SANITIZED, "sanitizers need addresses without limit")
    def test_a_library_that_uses_what_it_was_not_given_is_a_reason(self):
        for most, status, reason in ((100 * MIB, 1, "not enough memory"), (resource.RLIM_INFINITY, -signal.SIGSEGV, "")):
            with self.subTest(most=most), open(self.folder / "stderr", "w+", encoding="utf-8") as stderr:
                app = self.start(stderr=stderr)
                wait_until(self.objects_file.exists, "the first results")
                resource.prlimit(app.pid, resource.RLIMIT_AS, (most, most))
                app.send_signal(signal.SIGSEGV)  # as gst-libav does where it gets no context of a decoder
                self.assertEqual(app.wait(PATIENCE_S), status)
                stderr.seek(0)
                self.assertIn(reason, stderr.read())

    def test_an_abort_of_glib_is_a_reason(self):
        with open(self.folder / "stderr", "w+", encoding="utf-8") as stderr:
            app = self.start(stderr=stderr)
            wait_until(self.objects_file.exists, "the first results")
            app.send_signal(signal.SIGTRAP)  # as GLib does where it cannot go on
            self.assertEqual(app.wait(PATIENCE_S), 1)
            stderr.seek(0)
            self.assertIn("geoloc_app: a library could not go on", stderr.read())


if __name__ == "__main__":
    unittest.main()
