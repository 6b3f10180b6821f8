# SPDX-License-Identifier: Apache-2.0
"""The notebooks of examples/notebooks, executed as a reader would by an environment of their own (scripts/test.sh makes it)."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import geoloc
from support import run

SOURCE = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"])
NOTEBOOKS = SOURCE / "examples/notebooks"
PYTHON = pathlib.Path(os.environ["GEOLOC_NOTEBOOKS_PYTHON"])


class Notebooks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """The recordings that their README tells to make, and a path to the package under test."""
        holder = tempfile.TemporaryDirectory(prefix="geoloc-test-")
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        commands = re.findall(r"`geoloc_sim ([^`]+)`", " ".join((NOTEBOOKS / "README.md").read_text().split()))
        assert len(commands) == 2, commands
        for command in commands:
            made = run("geoloc_sim", *command.split(), cwd=cls.folder)
            assert made.status == 0, made.err
        cls.packages = cls.folder / "packages"
        cls.packages.mkdir()
        (cls.packages / "geoloc").symlink_to(pathlib.Path(geoloc.__file__).parent)

    def executed(self, name):
        """What the notebook prints."""
        done = subprocess.run([PYTHON, SOURCE / "scripts/notebooks.py", self.folder, NOTEBOOKS / f"{name}.ipynb"], capture_output=True,
                              text=True, timeout=200, check=False, env={**os.environ, "PYTHONPATH": str(self.packages)})
        self.assertEqual(done.returncode, 0, done.stderr)
        for picture in self.folder.glob(f"{name}_*.png"):
            self.assertGreater(picture.stat().st_size, 10_000, picture)
        return done.stdout

    def test_a_flight(self):
        printed = self.executed("01_flight")
        self.assertIn("found 30 / 30", printed)
        self.assertRegex(printed, r"latency 0\.1[12]\d ± 0\.0")
        within = int(re.search(r"(\d+)% lie within 2 sigma", printed)[1])
        self.assertGreater(within, 70)

    def test_a_detector_of_ones_own(self):
        printed = self.executed("02_own_detector")
        self.assertLess(float(re.search(r"RMSE ([\d.]+) m", printed)[1]), 0.3)

    def test_an_experiment(self):
        rows = re.findall(r"paper ([\d.]+) m, joint ([\d.]+) m", self.executed("03_experiment"))
        self.assertEqual(len(rows), 4)
        for paper_m, joint_m in rows:
            self.assertLess(float(joint_m), float(paper_m))

    def test_geopandas(self):
        printed = self.executed("04_geopandas")
        self.assertIn("30 objects in objects.gpkg", printed)

    def test_there_is_no_other(self):
        self.assertEqual(sorted(file.stem for file in NOTEBOOKS.glob("*.ipynb")),
                         ["01_flight", "02_own_detector", "03_experiment", "04_geopandas"])


if __name__ == "__main__":
    unittest.main()
