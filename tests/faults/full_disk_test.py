# SPDX-License-Identifier: Apache-2.0
"""A disk that takes nothing more ends the recording, not the flight."""
import resource
import unittest

from flight_under_fault import FaultTest, limit, shim


class FullDisk(FaultTest):

    def test_a_disk_that_is_full_from_the_start_is_no_reason_not_to_fly(self):
        with self.world.watch("--record", self.recording, env=shim(GEOLOC_FULL=1)) as app, self.world.fly():
            app.wait_for("recording stopped, the run goes on: .*No space left on device")
            app.wait_for("objects [1-9]")
            self.assertEqual(app.interrupt(), 1, app.lines)

    def test_a_file_that_may_not_grow_ends_the_recording_alone(self):
        for most_bytes in (100, 10_000):  # of the settings, of the log
            with self.subTest(most_bytes=most_bytes):
                recording = self.folder / f"recording-of-{most_bytes}"
                with self.world.watch("--record", recording, preexec_fn=limit(resource.RLIMIT_FSIZE, most_bytes)) as app:
                    self.fly()
                    app.wait_for("objects [1-9]", after=app.line_count() - 1)
                    self.assertEqual(app.interrupt(), 1, app.lines)
                told = [line for line in app.lines if "recording stopped, the run goes on" in line]
                self.assertEqual(len(told), 1, app.lines)
                self.assertIn("File too large", told[0])


if __name__ == "__main__":
    unittest.main()
