# SPDX-License-Identifier: Apache-2.0
import csv
import json
import re
import shutil
import subprocess
import unittest

from support import AppTest, rmse_m, run, tree


class Determinism(AppTest):
    """The same input gives the same bytes."""

    def outputs_of_replay(self, recording, method, name):
        folder = self.folder / method / name
        folder.mkdir(parents=True)
        result = run("geoloc_replay", recording, "--method", method, "--out", folder / "objects.geojson", "--raw", folder / "raw.csv",
                     "--picture", folder / "picture.svg")
        self.assertEqual(result.status, 0, result.err)
        return tree(folder)

    def test_a_recording_replayed_twice_gives_the_same_bytes(self):
        recording = self.make_recording()
        for method in "paper", "joint":
            with self.subTest(method):
                first = self.outputs_of_replay(recording, method, "first")
                self.assertEqual(first, self.outputs_of_replay(recording, method, "second"))
                self.assertGreater(len(json.loads(first["objects.geojson"])["features"]), 0)

    def test_the_simulator_writes_the_same_recording_for_the_same_seed(self):
        first = tree(self.make_recording("first"))
        self.assertEqual(first, tree(self.make_recording("second")))
        self.assertNotEqual(first["frames.jsonl"], tree(self.make_recording("other", "--seed", 2))["frames.jsonl"])


class Associations(AppTest):
    """What the tracker made of each fix can be judged from the files."""

    def test_fixes_name_frame_object_and_innovation(self):
        recording, raw, lines = self.make_recording(), self.folder / "raw.csv", self.folder / "lines.jsonl"
        times = [json.loads(line)["time_us"] for line in (recording / "frames.jsonl").read_text().splitlines()]
        for method in "paper", "joint":
            result = run("geoloc_replay", recording, "--method", method, "--raw", raw, "--jsonl", lines, "--out", self.folder / "out.geojson")
            self.assertEqual(result.status, 0, result.err)
            rows = list(csv.DictReader(raw.read_text().splitlines()))
            ids = {feature["properties"]["id"] for feature in json.loads((self.folder / "out.geojson").read_text())["features"]}
            self.assertLessEqual(ids, {int(row["object_id"]) for row in rows if row["object_id"]})
            followed = [row for row in rows if row["innovation_x_px"]]
            self.assertGreater(len(followed), 0.8 * len(rows))
            for row in followed:
                centre = float(row["box_x"]) + float(row["box_width"]) / 2 - 0.5
                self.assertAlmostEqual(float(row["expected_x_px"]) + float(row["innovation_x_px"]), centre, delta=0.02)
                self.assertLess(abs(float(row["innovation_x_px"])), 100)
                self.assertTrue(row["object_id"])
            frames = [line for line in map(json.loads, lines.read_text().splitlines()) if line["type"] == "frame"]
            self.assertEqual([frame["time_us"] for frame in frames], [times[frame["frame"]] for frame in frames])
            fixes = [(str(frame["frame"]), str(fix["object_id"] or "")) for frame in frames for fix in frame.get("fixes", [])]
            self.assertEqual(fixes, [(row["frame"], row["object_id"]) for row in rows])


class Priors(AppTest):
    """Prior knowledge improves the results of a flight, and is not used where it contradicts them."""

    def setUp(self):
        super().setUp()
        self.recording = self.folder / "gnss"
        self.assertEqual(run("geoloc_sim", "--record", self.recording, "--flight", "gnss_path1", "--seed", 3).status, 0)
        self.targets = json.loads((self.recording / "truth.geojson").read_text())["features"]

    def replay(self, *options):
        out = self.folder / "objects.geojson"
        result = run("geoloc_replay", self.recording, "--out", out, *options)
        self.assertEqual(result.status, 0, result.err)
        return json.loads(out.read_text()), rmse_m(result.err), result.err

    def survey(self, targets, north_deg=0.0):
        file = self.folder / "survey.geojson"
        features = [dict(target, properties={"id": f"mark {i}"}) for i, target in enumerate(targets)]
        for feature in features:
            lon, lat = feature["geometry"]["coordinates"][:2]
            feature["geometry"] = {"type": "Point", "coordinates": [lon, lat + north_deg]}
        file.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        return file

    def test_two_known_points_take_the_receivers_offset_out(self):
        _, without, _ = self.replay()
        objects, told, _ = self.replay("--known-points", self.survey([self.targets[0], self.targets[29]]))
        self.assertEqual([point["status"] for point in objects["known_points"]], ["matched", "matched"])
        self.assertLess(told, 0.6 * without)

    def test_known_points_were_once_called_references(self):
        survey = self.survey(self.targets[:1])
        self.assertEqual(self.replay("--reference", survey)[0], self.replay("--known-points", survey)[0])
        self.assertNotIn("--reference", run("geoloc_replay", "--help").out)

    def test_a_known_point_where_nothing_is_changes_nothing_and_is_reported(self):
        expected, _, _ = self.replay()
        objects, _, messages = self.replay("--known-points", self.survey(self.targets[:1], north_deg=1e-4))
        self.assertEqual(objects["features"], expected["features"])
        self.assertNotEqual(objects["known_points"][0]["status"], "matched")
        self.assertIn("known point mark 0 not used", messages)

    def test_a_vehicle_flown_twice_starts_calibrated(self):
        first, _, _ = self.replay()
        (self.folder / "first.geojson").write_text(json.dumps(first))
        second, _, _ = self.replay("--calibration", self.folder / "first.geojson")
        for key in "boresight_x_deg", "latency_s":
            self.assertAlmostEqual(second["calibration"][key]["value"], first["calibration"][key]["value"],
                                   delta=3 * first["calibration"][key]["sigma"])

    def test_unusable_files_are_refused_before_anything_starts(self):
        for options in (["--known-points", "missing.geojson"], ["--calibration", "missing.geojson"],
                        ["--method", "paper", "--known-points", self.survey(self.targets[:1])]):
            result = run("geoloc_replay", self.recording, *options)
            self.assertEqual(result.status, 2)
            self.assertIn("--known-points" if "paper" in options else "missing.geojson", result.err)


class FocalLength(AppTest):
    """A camera that looks ahead shows what its focal length is off by, where that is told to be uncertain."""

    ERROR_PERCENT = 3

    def replay(self, name, *options, sigma_percent=0):
        recording, out = self.folder / name, self.folder / f"{name}.geojson"
        if not recording.exists():
            done = run("geoloc_sim", "--record", recording, "--mount-pitch-deg", -50, "--seed", 1, *options)
            self.assertEqual(done.status, 0, done.err)
        config = self.write("config.json", {"joint": {"prior": {"sigma_focal_percent": sigma_percent}}})
        result = run("geoloc_replay", recording, "--config", config, "--out", out)
        self.assertEqual(result.status, 0, result.err)
        found = int(re.search(r"found (\d+) /", result.err)[1])
        return json.loads(out.read_text())["calibration"], found, rmse_m(result.err)

    def test_is_found_and_costs_nothing(self):
        _, found, right_m = self.replay("right")
        wrong = ("--focal-error-percent", self.ERROR_PERCENT)
        calibration, found_unknown, unknown_m = self.replay("wrong", *wrong, sigma_percent=3)
        focal = calibration["focal_percent"]
        self.assertLess(focal["sigma"], 0.8)
        self.assertLess(abs(focal["value"] - self.ERROR_PERCENT), 2 * focal["sigma"])
        self.assertGreaterEqual(found_unknown, found)
        self.assertLess(unknown_m, 1.5 * right_m)
        _, _, frozen_m = self.replay("wrong")
        self.assertGreater(frozen_m, 4 * right_m)

    def test_is_no_unknown_where_it_is_certain(self):
        calibration, _, _ = self.replay("right")
        self.assertNotIn("focal_percent", calibration)

    def test_is_learnt_for_the_next_flight(self):
        first, _, first_m = self.replay("wrong", "--focal-error-percent", self.ERROR_PERCENT, sigma_percent=3)
        self.write("first.json", first)
        out = self.folder / "second.geojson"
        again = run("geoloc_replay", self.folder / "wrong", "--calibration", self.folder / "first.json", "--out", out)
        self.assertEqual(again.status, 0, again.err)
        second = json.loads(out.read_text())["calibration"]
        self.assertAlmostEqual(second["focal_percent"]["value"], first["focal_percent"]["value"], delta=first["focal_percent"]["sigma"])
        self.assertLess(rmse_m(again.err), 1.1 * first_m)


@unittest.skipUnless(shutil.which("gdal_translate"), "needs gdal-bin")
class Ground(AppTest):
    """An elevation model of the simulated hills, as users have them, helps where hills are steep."""

    def setUp(self):
        super().setUp()
        self.recording = self.folder / "hills"
        done = run("geoloc_sim", "--record", self.recording, "--hills-m", 5, "--seed", 1)
        self.assertEqual(done.status, 0, done.err)
        self.model = self.folder / "utm.tif"
        subprocess.run(["gdalwarp", "-q", "-t_srs", "EPSG:32723", "-r", "bilinear", "-dstnodata", "-9999",
                        self.recording / "terrain.asc", self.model], check=True)

    def replay(self, *options):
        result = run("geoloc_replay", self.recording, "--out", self.folder / "objects.geojson", *options)
        self.assertEqual(result.status, 0, result.err)
        return int(re.search(r"found (\d+) / 30", result.err)[1]), rmse_m(result.err), result.err

    def test_a_geotiff_in_a_projection_is_at_least_as_good_as_none(self):
        found_without, without, _ = self.replay()
        found, with_model, messages = self.replay("--ground", self.model)
        self.assertIn(f"ground: {self.model}: ", messages)
        self.assertIn("mean sea level is assumed", messages)
        self.assertLessEqual(found_without, found)
        self.assertEqual(found, 30)
        self.assertLess(with_model, without + 0.005)
        self.assertIn("extra 0", messages)

    def test_a_model_that_is_believed_is_no_worse(self):
        _, doubted, _ = self.replay("--ground", self.model)
        found, believed, _ = self.replay("--ground", self.model, "--ground-sigma-m", 0.3)
        self.assertEqual(found, 30)
        self.assertLess(believed, doubted + 0.005)

    def test_a_model_of_another_place_is_named_and_does_no_harm(self):
        elsewhere = self.folder / "elsewhere.tif"
        subprocess.run(["gdal_translate", "-q", "-a_srs", "EPSG:4326", "-a_ullr", "7", "47", "7.01", "46.99",
                        self.recording / "terrain.asc", elsewhere], check=True)
        found, _, messages = self.replay("--ground", elsewhere)
        self.assertIn("of another place", messages)
        self.assertGreaterEqual(found, 28)
        self.assertNotIn("of another place", self.replay("--ground", self.model)[2])

    def test_ground_that_is_free_needs_no_model(self):
        self.assertEqual(self.replay("--ground", "free")[0], 30)

    def test_a_rangefinders_readings_are_counted(self):
        done = run("geoloc_sim", "--record", self.folder / "ranges", "--rangefinder", "--ground-above-home-m", 20, "--seed", 1,
                   "--start-s", 80, "--end-s", 100)
        self.assertEqual(done.status, 0, done.err)
        self.recording = self.folder / "ranges"
        self.replay()
        counters = json.loads((self.folder / "objects.geojson").read_text())["counters"]
        self.assertGreater(counters["ranges_used"], 100)
        self.assertLess(counters["ranges_refused"], 20)

    def test_unusable_models_are_refused_before_anything_starts(self):
        text = self.write("text.tif", "no picture")
        for options in (["--ground", "missing.tif"], ["--ground", text], ["--ground", self.folder],
                        ["--ground", "free", "--ground-sigma-m", 1], ["--ground-sigma-m", "nan"], ["--ground-sigma-m", -1]):
            with self.subTest(options):
                result = run("geoloc_replay", self.recording, "--out", self.folder / "none.geojson", *options)
                self.assert_refused(result, options[1] if options[1] != "free" else "--ground-sigma-m")
                self.assertFalse((self.folder / "none.geojson").exists())


class BadRecordings(AppTest):
    """A faulty recording is rejected with file, line and reason, and nothing is written."""

    def setUp(self):
        super().setUp()
        self.recording = self.make_recording()
        self.out = self.folder / "objects.geojson"

    def spoil_line(self, number, line):
        """Replaces a line (from 1) of frames.jsonl."""
        file = self.recording / "frames.jsonl"
        lines = file.read_text().splitlines()
        lines[number - 1] = line
        file.write_text("\n".join(lines) + "\n")

    def replay(self, *arguments):
        return run("geoloc_replay", self.recording, "--out", self.out, *arguments)

    def assert_replay_refused(self, *reasons):
        self.assert_refused(self.replay(), *reasons)
        self.assertFalse(self.out.exists())

    def test_no_such_folder(self):
        shutil.rmtree(self.recording)
        self.assert_replay_refused(self.recording)

    def test_a_missing_file(self):
        for name in "telemetry.tlog", "frames.jsonl", "camera.json":
            with self.subTest(name):
                hidden = (self.recording / name).rename(self.folder / "hidden")
                self.assert_replay_refused(self.recording / name)
                hidden.rename(self.recording / name)

    def test_a_bad_line(self):
        detection = '{"box": %s, "confidence": 0.9, "class_id": 0}'
        bad_lines = {
            "no JSON": "{",
            "no time": '{"detections": []}',
            "not a number": '{"time_us": 1795313538548800, "detections": [%s]}' % (detection % "[NaN, 1, 2, 3]"),
            "infinite": '{"time_us": 1795313538548800, "detections": [%s]}' % (detection % "[1e999, 1, 2, 3]"),
            "a sigma of nothing": '{"time_us": 1795313538548800, "detections": [{"box": [1, 1, 2, 3], "sigma_px": 0}]}',
            "a sigma without bounds": '{"time_us": 1795313538548800, "detections": [{"box": [1, 1, 2, 3], "sigma_px": 1e9}]}',
            "a box of no size": '{"time_us": 1795313538548800, "detections": [%s]}' % (detection % "[1, 1, 0, 3]"),
        }
        good = (self.recording / "frames.jsonl").read_text().splitlines()[2]
        for name, line in bad_lines.items():
            with self.subTest(name):
                self.spoil_line(3, line)
                self.assert_replay_refused(f"{self.recording / 'frames.jsonl'}:3: ")
                self.spoil_line(3, good)
        self.assertEqual(self.replay().status, 0)

    def test_times_that_run_backwards(self):
        self.spoil_line(7, '{"time_us": 1000000, "detections": []}')
        self.assert_replay_refused(f"{self.recording / 'frames.jsonl'}:7: ", "backwards")

    def test_keep_going_skips_bad_lines_and_counts_them(self):
        self.spoil_line(3, "{")
        self.spoil_line(5, '{"time_us": 1000000, "detections": []}')
        result = self.replay("--keep-going")
        self.assertEqual(result.status, 0, result.err)
        self.assertIn("skipped 2 bad lines", result.err)
        self.assertTrue(self.out.exists())

    def test_an_output_that_cannot_be_written_ends_the_run_before_it_begins(self):
        result = run("geoloc_replay", self.recording, "--out", self.folder / "no such folder" / "objects.geojson")
        self.assert_refused(result, "no such folder")  # before the run


class Settings(AppTest):
    """--print-config prints what --config accepts."""

    def test_what_is_printed_is_accepted_back_and_printed_again(self):
        for program in "geoloc_app", "geoloc_replay":
            with self.subTest(program):
                first = run(program, "--print-config")
                self.assertEqual(first.status, 0, first.err)
                second = run(program, "--config", self.write("config.json", first.out), "--print-config")
                self.assertEqual((second.status, second.out), (0, first.out), second.err)

    def test_a_replay_accepts_the_settings_of_a_live_run(self):
        config = self.write("config.json", run("geoloc_app", "--print-config").out)
        result = run("geoloc_replay", self.make_recording(), "--config", config, "--out", self.folder / "objects.geojson")
        self.assertEqual(result.status, 0, result.err)

    def test_a_recording_of_the_time_when_the_joint_method_was_called_full_is_replayed_with_its_settings(self):
        recording = self.make_recording()
        for name in "full", "joint":
            (recording / "config.json").write_text(json.dumps({"method": name, name: {"max_tracks": 0}}))
            self.assertIn("joint.max_tracks must lie in", run("geoloc_replay", recording).err)

    def test_a_setting_changes_the_run(self):
        config = self.write("config.json", {"method": "paper", "paper": {"confirm_hits": 100000}})
        result = run("geoloc_replay", self.make_recording(), "--config", config)
        self.assertIn("found 0 / 30", result.err)


if __name__ == "__main__":
    unittest.main()
