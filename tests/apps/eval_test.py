# SPDX-License-Identifier: Apache-2.0
import json
import unittest

from support import AppTest, run


class Baseline(AppTest):
    """The paper's method with default settings is a fair baseline: what the project promises of it holds."""

    def test_the_stock_flights(self):
        result = run("geoloc_eval", "--flights", "stock", "--method", "paper", "--seeds", 1, "--report", self.folder)
        self.assertEqual(result.status, 0, result.err)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(len(report["runs"]), 6 * 3)
        (summary,) = report["summaries"]
        self.assertEqual(summary["targets"], 540)
        self.assertLessEqual(summary["mean_rmse_m"], 0.42)
        self.assertGreaterEqual(summary["found"], 537)
        self.assertLessEqual(summary["extra"], 5)

    def test_the_number_of_threads_changes_nothing(self):
        one, three = self.folder / "one", self.folder / "three"
        for threads, folder in (1, one), (3, three):
            run("geoloc_eval", "--flights", "stock", "--method", "paper", "--seeds", 5, "--threads", threads, "--report", folder)
        self.assertEqual((one / "report.json").read_bytes(), (three / "report.json").read_bytes())


if __name__ == "__main__":
    unittest.main()
