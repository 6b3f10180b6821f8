# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import re
import tempfile
import unittest
import xml.etree.ElementTree

from support import PATIENCE_S, AppTest, run


TOLERANCE = 1.15  # of what was measured


class Baseline(AppTest):
    """The paper's method with default settings is a fair baseline: what the project promises of it holds."""

    def test_the_stock_flights(self):
        result = run("geoloc_eval", "--flights", "stock", "--method", "paper", "--seeds", 1, "--report", self.folder)
        self.assertEqual(result.status, 0, result.err)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(len(report["runs"]), 6 * 3)
        (summary,) = report["summaries"]
        self.assertEqual(summary["targets"], 540)
        self.assertLessEqual(summary["mean_rmse_m"], TOLERANCE * 0.348)
        self.assertGreaterEqual(summary["found"], 537)  # 538 were measured
        self.assertLessEqual(summary["extra"], 3)  # 1 was measured

    def test_the_number_of_threads_changes_nothing(self):
        one, three = self.folder / "one", self.folder / "three"
        for threads, folder in (1, one), (3, three):
            run("geoloc_eval", "--flights", "stock", "--method", "paper", "--seeds", 5, "--threads", threads, "--report", folder)
        self.assertEqual((one / "report.json").read_bytes(), (three / "report.json").read_bytes())


# RMSE and relative RMSE of the table in docs/results.md.
MEASURED_M = {
    ("stock", "paper"): (0.353, 0.331),
    ("stock", "joint"): (0.027, 0.025),
    ("stock", "joint, 2 known points"): (0.031, 0.025),
    ("gnss", "paper"): (0.771, 0.548),
    ("gnss", "joint"): (0.491, 0.125),
    ("gnss", "joint, 2 known points"): (0.144, 0.109),
}


class JointMethod(AppTest):
    """What docs/results.md promises of the joint method, over every run of the seeds 0, 1 and 2."""

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory(prefix="geoloc-test-") as folder:
            result = run("geoloc_eval", "--known-points", 2, "--report", folder, timeout=2.5 * PATIENCE_S)
            assert result.status == 0, result.err
            cls.report = json.loads((pathlib.Path(folder) / "report.json").read_text())

    def summary(self, flights, method):
        (found,) = [s for s in self.report["summaries"] if s["set"] == flights and s["method"] == method]
        return found

    def assert_found_all(self, summary):
        self.assertEqual((summary["found"], summary["extra"], summary["merged_pairs"]), (summary["targets"], 0, 0))

    def test_accuracy_is_what_was_measured(self):
        for (flights, method), (rmse_m, relative_rmse_m) in MEASURED_M.items():
            with self.subTest(flights=flights, method=method):
                summary = self.summary(flights, method)
                self.assertLessEqual(summary["mean_rmse_m"], TOLERANCE * rmse_m)
                self.assertLessEqual(summary["mean_relative_rmse_m"], TOLERANCE * relative_rmse_m)

    def test_the_joint_method_finds_every_target_and_nothing_else(self):
        for flights, method in MEASURED_M:
            if method != "paper":
                with self.subTest(flights=flights, method=method):
                    self.assert_found_all(self.summary(flights, method))

    def test_stated_sigmas_are_right_within_a_factor_of_two(self):
        """2 is right; what is stated is rather too large than too small."""
        for flights in "stock", "gnss":
            self.assertGreaterEqual(self.summary(flights, "joint")["mean_nees"], 0.5)
            self.assertLessEqual(self.summary(flights, "joint")["mean_nees"], 3)

    def test_latency_and_boresight_of_every_stock_run(self):
        stock = self.summary("stock", "joint")
        self.assertLessEqual(stock["worst_latency_error_s"], 0.020)
        self.assertLessEqual(stock["worst_boresight_error_deg"], 0.25)
        self.assertLessEqual(stock["worst_error_in_sigmas"], 3)

    def test_no_run_is_much_worse_than_with_the_papers_method(self):
        rmse_m = {(r["flight"], r["scenario"], r["seed"], r["method"]): r["rmse_m"] for r in self.report["runs"]}
        for (*key, method), value in rmse_m.items():
            if method == "joint":
                self.assertLessEqual(value, rmse_m[(*key, "paper")] + 0.05, key)


class Hills(AppTest):
    """Neither hills nor a take-off elsewhere are told to the estimator, and neither costs it anything to speak of."""

    def test_the_stock_flights_over_hills(self):
        result = run("geoloc_eval", "--flights", "stock", "--method", "joint", "--hills-m", 1.5, "--report", self.folder)
        self.assertEqual(result.status, 0, result.err)
        (summary,) = json.loads((self.folder / "report.json").read_text())["summaries"]
        self.assertEqual((summary["found"], summary["extra"], summary["merged_pairs"]), (summary["targets"], 0, 0))
        self.assertLessEqual(summary["mean_rmse_m"], TOLERANCE * 0.048)
        self.assertLessEqual(summary["mean_relative_rmse_m"], TOLERANCE * 0.042)
        self.assertLessEqual(summary["mean_relative_height_rmse_m"], TOLERANCE * 0.050)
        self.assertGreaterEqual(summary["mean_nees"], 0.5)
        self.assertLessEqual(summary["mean_nees"], 3)

    def test_a_take_off_elsewhere(self):
        result = run("geoloc_eval", "--flights", "none", "--method", "joint", "--seeds", 0, "--sweep", "take-off",
                     "--report", self.folder)
        self.assertEqual(result.status, 0, result.err)
        (sweep,) = json.loads((self.folder / "report.json").read_text())["sweeps"]
        self.assertEqual([point["value"] for point in sweep["points"]], [-20, -10, -5, 0, 5, 10, 20])
        for point in sweep["points"]:
            self.assertEqual((point["found"], point["extra"]), (point["targets"], 0), point["value"])
            self.assertLessEqual(point["mean_rmse_m"], TOLERANCE * 0.046, point["value"])

    def test_a_camera_whose_clock_is_off_by_seconds(self):
        result = run("geoloc_eval", "--flights", "none", "--method", "joint", "--seeds", 0, "--sweep", "clock-camera",
                     "--report", self.folder)
        self.assertEqual(result.status, 0, result.err)
        (sweep,) = json.loads((self.folder / "report.json").read_text())["sweeps"]
        self.assertEqual([point["value"] for point in sweep["points"]], [-2.9, -1, -0.3, 0, 0.3, 1, 2.9])
        for point in sweep["points"]:
            self.assertEqual((point["found"], point["extra"]), (point["targets"], 0), point["value"])
            self.assertLessEqual(point["mean_rmse_m"], TOLERANCE * 0.048, point["value"])

    def test_attitudes_that_are_off_for_seconds_are_not_taken_for_another_latency(self):
        result = run("geoloc_eval", "--flights", "none", "--method", "joint", "--seeds", 2, "--sweep", "attitude-slow",
                     "--report", self.folder)
        self.assertEqual(result.status, 0, result.err)
        (sweep,) = json.loads((self.folder / "report.json").read_text())["sweeps"]
        for point in sweep["points"]:
            with self.subTest(sigma_deg=point["value"]):
                self.assertGreaterEqual(point["found"], 179)
                self.assertEqual(point["extra"], 0)

    def test_jumps_of_the_vehicles_state(self):
        result = run("geoloc_eval", "--flights", "none", "--seeds", 0, "--sweep", "jumps", "--report", self.folder)
        self.assertEqual(result.status, 0, result.err)
        (sweep,) = json.loads((self.folder / "report.json").read_text())["sweeps"]
        for point in sweep["points"]:
            if point["method"] == "paper":
                self.assertLessEqual(point["mean_rmse_m"], TOLERANCE * 0.42, point["value"])
                continue
            self.assertEqual((point["found"], point["extra"]), (point["targets"], 0), point["value"])
            self.assertLessEqual(point["mean_rmse_m"], TOLERANCE * 0.049, point["value"])
            self.assertGreaterEqual(point["mean_nees"], 0.5, point["value"])
            self.assertLessEqual(point["mean_nees"], 3, point["value"])

    def test_slow_telemetry(self):
        result = run("geoloc_eval", "--flights", "none", "--seeds", 0, "--sweep", "telemetry", "--report", self.folder)
        self.assertEqual(result.status, 0, result.err)
        (sweep,) = json.loads((self.folder / "report.json").read_text())["sweeps"]
        rmse_m = {(point["method"], point["value"]): point["mean_rmse_m"] for point in sweep["points"]}
        for rate_hz, limit_m in ((1, 0.065), (2, 0.05), (10, 0.048)):
            self.assertLessEqual(rmse_m["joint", rate_hz], TOLERANCE * limit_m, rate_hz)
            self.assertLess(rmse_m["joint", rate_hz], rmse_m["paper", rate_hz], rate_hz)


class Sweeps(AppTest):
    """One circumstance varied: the pictures, the page and the figures agree, whatever the number of threads."""

    def evaluate(self, folder, *arguments):
        result = run("geoloc_eval", "--seeds", 1, "--report", folder, *arguments)
        self.assertEqual(result.status, 0, result.err)
        return json.loads((folder / "report.json").read_text())

    def test_latency_harms_the_paper_and_not_full(self):
        report = self.evaluate(self.folder, "--flights", "none", "--sweep", "latency")
        self.assertEqual(report["runs"], [])
        (sweep,) = report["sweeps"]
        rmse_m = {(point["method"], point["value"]): point["mean_rmse_m"] for point in sweep["points"]}
        self.assertGreater(rmse_m["paper", 0.3], 2 * rmse_m["paper", 0.0])
        self.assertLess(rmse_m["joint", 0.3], 1.3 * rmse_m["joint", 0.0])

    def test_from_no_height_is_full_too_sure_of_itself(self):
        report = self.evaluate(self.folder, "--flights", "none", "--sweep", "height", "--method", "joint")
        (sweep,) = report["sweeps"]
        for point in sweep["points"]:
            self.assertLessEqual(point["mean_nees"], 2 * 2, point["value"])

    def test_the_usual_value_gives_the_tables_figures(self):
        report = self.evaluate(self.folder, "--flights", "stock", "--scenarios", 1, "--sweep", "height")
        (sweep,) = report["sweeps"]
        for summary in report["summaries"]:
            (usual,) = [point for point in sweep["points"]
                        if point["value"] == sweep["usual_value"] and point["method"] == summary["method"]]
            self.assertEqual(usual["mean_rmse_m"], summary["mean_rmse_m"])
            self.assertEqual(usual["found"], summary["found"])

    def test_the_page_stands_alone_and_its_pictures_are_whole(self):
        self.evaluate(self.folder, "--flights", "stock", "--scenarios", 1, "--sweep", "pairs")
        page = (self.folder / "report.html").read_text()
        for needed_elsewhere in (r"<script", r"<link", r"\bsrc=", r"\bhref=", r"url\(", r"@import"):
            self.assertNotRegex(page, needed_elsewhere)
        drawings = re.findall(r"<svg.*?</svg>", page, re.DOTALL)
        self.assertEqual(len(drawings), 4 + 4 + 1)  # every run, over time, the sweep
        for drawing in drawings + [(self.folder / "sweep_pairs.svg").read_text()]:
            xml.etree.ElementTree.fromstring(drawing)
        self.assertNotIn("nan", page)
        for name in "error_over_time_stock", "found_over_time_stock", "latency_convergence", "boresight_convergence":
            xml.etree.ElementTree.parse(self.folder / f"{name}.svg")

    def test_the_page_says_what_it_is_of(self):
        self.evaluate(self.folder, "--flights", "none", "--sweep", "pairs", "--method", "joint")
        page = (self.folder / "report.html").read_text()
        self.assertRegex(page, r"<code>\S*geoloc_eval --seeds 1 --report \S+ --flights none --sweep pairs --method joint</code>")
        self.assertRegex(page, r"20\d\d-\d\d-\d\dT\S+Z, geoloc \d+\.\d+\.\d+")
        self.assertIn("All settings of the estimator are the defaults", page)
        self.assertNotIn("Every run", page)  # there is no such picture

    def test_a_setting_is_varied(self):
        config = self.write("config.json", {"joint": {"ambiguity": 4}, "paper": {"gate": 2}})
        report = self.evaluate(self.folder / "report", "--flights", "none", "--sweep-setting", "joint.gate=20,1e-9,11.8",
                               "--method", "joint", "--config", config)
        (sweep,) = report["sweeps"]
        self.assertEqual((sweep["name"], sweep["usual_value"]), ("joint.gate", 11.8))
        nothing, usual, wide = sweep["points"]
        self.assertEqual([nothing["value"], usual["value"], wide["value"]], [1e-9, 11.8, 20])
        self.assertEqual(usual["found"], usual["targets"])
        self.assertNotEqual(nothing["mean_rmse_m"], usual["mean_rmse_m"])
        page = (self.folder / "report" / "report.html").read_text()
        self.assertIn("joint.ambiguity = 4.0", page)
        self.assertIn("settings as above", page)
        self.assertTrue((self.folder / "report" / "sweep_joint.gate.svg").exists())

    def test_the_number_of_threads_changes_nothing(self):
        for threads in (1, 3):
            self.evaluate(self.folder / str(threads), "--flights", "none", "--sweep", "clutter", "--method", "paper",
                          "--threads", threads)
        self.assertEqual((self.folder / "1/report.json").read_bytes(), (self.folder / "3/report.json").read_bytes())


class Rendered(AppTest):
    """With rendered images and the real detector, the objects are those of the same run with drawn detections."""

    def test_ten_seconds_of_a_flight(self):
        result = run("geoloc_eval", "--flights", "none", "--scenarios", 3, "--seeds", 1, "--rendered", "--rendered-s", 10,
                     "--report", self.folder)
        self.assertEqual(result.status, 0, result.err)
        rendered = json.loads((self.folder / "report.json").read_text())["rendered"]
        for pictures, model in zip(rendered["from_pictures"], rendered["from_model"], strict=True):
            self.assertEqual(pictures["method"], model["method"])
            self.assertGreaterEqual(pictures["found"], 6)
            self.assertLessEqual(abs(pictures["found"] - model["found"]), 2)
            self.assertLess(pictures["rmse_m"], 2 * model["rmse_m"] + 0.1)


class UnusableArguments(AppTest):
    """Status 2, a message that helps, and nothing written."""

    def test_they_are_refused(self):
        folder = self.folder / "report"
        for arguments, hint in ((("--sweep", "depth"), "height"), (("--scenarios", 4), "scenarios"),
                                (("--rendered", "--rendered-flight", "path9"), "stock_path1"),
                                (("--rendered", "--rendered-s", 0), "rendered-s"),
                                (("--sweep-setting", "joint.gates=1,2"), "no setting 'joint.gates'"),
                                (("--sweep-setting", "joint.gate"), "PATH=VALUE"),
                                (("--sweep-setting", "joint.gate="), "PATH=VALUE"),
                                (("--sweep-setting", "joint.gate=1,x"), "'x' is no number"),
                                (("--sweep-setting", "joint.gate=1,-1"), "joint.gate must lie in"),
                                (("--sweep-setting", "method=1"), "numbers"),
                                (("--sweep-setting", "a/b~0=1"), "no setting")):
            result = run("geoloc_eval", "--flights", "none", "--report", folder, *arguments)
            self.assertEqual(result.status, 2, result.err)
            self.assertIn(hint, result.err)
            self.assertFalse(folder.exists())


if __name__ == "__main__":
    unittest.main()
