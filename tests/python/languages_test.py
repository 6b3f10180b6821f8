# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import re
import subprocess
import sys
import unittest

import geoloc
from support import AppTest

sys.path.insert(0, str(pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"]) / "tests/languages"))
from estimate import estimate  # noqa: E402
from feed import feed_of  # noqa: E402

PROGRAMS = pathlib.Path(os.environ["GEOLOC_LANGUAGES_DIR"])


class OneRecordingInThreeLanguages(AppTest):
    """The same calls in C++, C and Python give the same bytes."""

    def estimate_in(self, language, feed):
        done = subprocess.run([PROGRAMS / f"estimate_in_{language}", feed], capture_output=True, text=True, timeout=100, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def compare(self, *options):
        recording = geoloc.Recording.read(self.make_recording(options[-1], *options))
        feed = self.write("feed.txt", feed_of(recording))
        expected = self.estimate_in("cpp", feed)
        self.assertGreaterEqual(len(re.findall(r"^F \d+ 0$", expected, re.MULTILINE)), len(recording.frames) // 2)
        self.assertGreaterEqual(expected.count("\nO "), 5)
        self.assertEqual(self.estimate_in("c", feed), expected)
        self.assertEqual(estimate(feed.read_text()), expected)

    def test_of_a_camera_that_looks_down(self):
        self.compare("--flight", "stock_path1")

    def test_of_a_consumer_receiver_and_a_lens_that_distorts(self):
        self.compare("--mount-pitch-deg", "-60", "--distortion", "-0.1", "0.02", "0.001", "-0.001", "0", "--flight", "gnss_path5")


if __name__ == "__main__":
    unittest.main()
