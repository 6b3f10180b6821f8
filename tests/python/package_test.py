# SPDX-License-Identifier: Apache-2.0
import inspect
import os
import pathlib
import re
import subprocess
import sys
import unittest

import geoloc
from support import AppTest, run

SOURCE = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"])


class Examples(AppTest):
    """Every program in the pages runs as it stands, and prints what its comments say."""

    def run_program(self, program):
        done = subprocess.run([sys.executable, "-c", program], cwd=self.folder, capture_output=True, text=True, timeout=100, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def run_page(self, page):
        """What each program of the page prints; as it says, where it says so."""
        self.assertEqual(run("geoloc_sim", "--record", self.folder / "flight").status, 0)
        programs = re.findall(r"^```python\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)
        for program in programs:
            printed = self.run_program(program)
            for promised in re.findall(r"print\(.*\)  # ([\d.]+, .+|found .+)$", program, re.MULTILINE):
                self.assertIn(promised.removesuffix("…"), printed, program)
        return programs

    def test_of_the_page_on_python(self):
        self.assertGreaterEqual(len(self.run_page(SOURCE / "docs/python.md")), 4)

    def test_of_readme(self):
        (program,) = self.run_page(SOURCE / "README.md")
        self.assertLessEqual(len(program.splitlines()), 12)


class Types(AppTest):
    """The package tells its types and what it does."""

    USER = """
import numpy as np
import geoloc

geolocator = geoloc.Geolocator(method="paper", camera={"width": 640})
geolocator.add_attitude(0.0, [0.0, 0.0, 0.0])
outcomes: list[geoloc.Outcome] = geolocator.process(0.0, np.zeros((0, 4)))
score: geoloc.Score = geoloc.evaluate(geoloc.replay("flight", joint={"gate": 3.0}))
rmse_m: float | None = score.rmse_m
"""

    def check(self, *arguments):
        return subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", self.folder / "cache", *arguments],
                              capture_output=True, text=True, timeout=200, check=False, cwd=self.folder)

    def test_types_hold_within_and_for_users(self):
        checked = self.check("-p", "geoloc")
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        checked = self.check(self.write("user.py", self.USER))
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        checked = self.check(self.write("wrong.py", self.USER + "score.rmse\ngeolocator.process()\n"))
        self.assertEqual(len(re.findall(r"wrong\.py:\d+: error", checked.stdout)), 2, checked.stdout)

    def test_everything_public_is_documented(self):
        for name in geoloc.__all__:
            thing = getattr(geoloc, name)
            if not inspect.isclass(thing) and not inspect.isfunction(thing):
                continue
            self.assertGreater(len(thing.__doc__ or ""), 20, name)
            for member, value in vars(thing).items():
                if inspect.isfunction(value) and not member.startswith("_"):
                    self.assertGreater(len(value.__doc__ or ""), 20, f"{name}.{member}")

    def test_the_version_is_the_programs(self):
        self.assertRegex((SOURCE / "CMakeLists.txt").read_text(), rf"project\(geoloc VERSION {re.escape(geoloc.__version__)} ")

    def test_fates_are_those_of_the_library(self):
        self.assertEqual(len({fate.explain() for fate in geoloc.Fate}), len(geoloc.Fate))
        with self.assertRaises(ValueError):
            geoloc._core.explain(len(geoloc.Fate))


if __name__ == "__main__":
    unittest.main()
