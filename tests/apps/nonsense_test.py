# SPDX-License-Identifier: Apache-2.0
import json
import re
import unittest

from support import PROGRAMS, AppTest, rmse_m, run


class Recordings(AppTest):
    """Input that is readable and wrong gets the sentence that helps."""

    def setUp(self):
        super().setUp()
        self.recording = self.make_recording()

    def change_frames(self, change):
        """Applies `change` to each line of frames.jsonl, as recordings of other tools have them."""
        file = self.recording / "frames.jsonl"
        frames = [json.loads(line) for line in file.read_text().splitlines()]
        for frame in frames:
            frame.pop("telemetry_records", None)
            change(frame)
        file.write_text("".join(json.dumps(frame) + "\n" for frame in frames))

    def change_boxes(self, change):
        def change_frame(frame):
            for detection in frame["detections"]:
                detection["box"] = change(*detection["box"])
        self.change_frames(change_frame)

    def replay(self, *options, status=0):
        result = run("geoloc_replay", self.recording, "--out", self.folder / "objects.geojson", *options)
        self.assertEqual(result.status, status, result.err)
        return result.err

    def test_a_good_recording_gets_none(self):
        said = self.replay()
        self.assertEqual(len(said.splitlines()), 1, said)

    def test_boxes_in_normalised_coordinates(self):
        self.change_boxes(lambda x, y, width, height: [x / 1280, y / 720, width / 1280, height / 720])
        said = self.replay()
        self.assertIn("boxes are smaller than a pixel: are they normalised?", said)
        self.assertRegex(said, r"found 0 / 30, RMSE – \(relative –\)")

    def test_boxes_of_two_corners(self):
        self.change_boxes(lambda x, y, width, height: [x, y, x + width, y + height])
        self.assertRegex(self.replay(), r"\d+ of \d+ boxes end beyond the 1280 x 720 image, and .*left, top, right, bottom")

    def test_boxes_of_another_image(self):
        self.change_boxes(lambda *box: [3 * edge for edge in box])
        self.assertRegex(self.replay(), r"\d+ of \d+ boxes end beyond the 1280 x 720 image: are they of this camera")

    def test_times_in_milliseconds(self):
        def in_milliseconds(frame):
            frame["time_us"] //= 1000
        self.change_frames(in_milliseconds)
        said = self.replay()
        self.assertRegex(said, r"all \d+ frames lie outside the telemetry: they are of 1970-01-.* the telemetry is of 2026-")
        self.assertIn("Is time_us in milliseconds?", said)

    def test_a_mount_that_looks_up(self):
        camera = json.loads((self.recording / "camera.json").read_text())
        camera["mount"]["pitch_deg"] = 90
        (self.recording / "camera.json").write_text(json.dumps(camera))
        self.assertRegex(self.replay(), r"\d+ detections look above the horizon: is the mount's pitch right\? It is 90 deg")

    def test_a_ground_above_the_vehicle(self):
        config = self.write("config.json", {"projector": {"ground_height_above_home_m": 500}})
        said = self.replay("--method", "paper", "--config", config)  # the joint method estimates the height
        self.assertIn("projector.ground_height_above_home_m is 500 m", said)

    def test_a_threshold_that_nothing_reaches(self):
        said = self.replay("--method", "paper", "--config", self.write("config.json", {"paper": {"confirm_hits": 100000}}))
        self.assertRegex(said, r"found 0 / 30, RMSE – .*\n(.*\n)*no object is confirmed: .* paper.confirm_hits asks for 100000")

    def test_a_truth_of_another_place_names_the_distance(self):
        truth = json.loads((self.recording / "truth.geojson").read_text())
        for feature in truth["features"]:
            feature["geometry"]["coordinates"][1] += 0.01
        said = self.replay("--truth", self.write("truth.geojson", truth))
        self.assertRegex(said, r"no object is within 3 m of a target: the nearest is 10\d\d\.\d m away")

    def test_ids_of_the_truth_may_be_texts(self):
        truth = json.loads((self.recording / "truth.geojson").read_text())
        for feature in truth["features"]:
            feature["properties"]["id"] = f"mark {feature['properties']['id']}"
        self.assertEqual(self.replay("--truth", self.write("truth.geojson", truth)), self.replay())

    def test_objects_whose_places_were_told_are_not_scored(self):
        truth = json.loads((self.recording / "truth.geojson").read_text())
        found = int(re.search(r"found (\d+) / 30", self.replay())[1])
        self.assertGreater(found, 3)
        objects = json.loads((self.folder / "objects.geojson").read_text())["features"]
        near = min(truth["features"], key=lambda target: min(
            sum((a - b) ** 2 for a, b in zip(target["geometry"]["coordinates"], seen["geometry"]["coordinates"]))
            for seen in objects))
        said = self.replay("--reference", self.write("survey.geojson", dict(truth, features=[near])))
        self.assertIn(f"found {found - 1} / 29", said)
        self.assertIn("left out of the score, since known points tell their places: 1 objects", said)
        self.assertGreater(rmse_m(said), 0)

    def test_bad_lines_are_named(self):
        file = self.recording / "frames.jsonl"
        file.write_text("".join(f"nonsense {i}\n" for i in range(12)) + file.read_text())
        said = self.replay("--keep-going")
        self.assertIn(f"skipped {file}:10: not a JSON object", said)
        self.assertNotIn(f"{file}:11:", said)
        self.assertIn("skipped 12 bad lines", said)
        self.assertIn("and 2 more bad lines (--keep-going skips bad lines)", self.replay(status=2))

    def test_settings_without_effect_are_named(self):
        config = self.write("config.json", {"detection": {"confidence": 0.9}, "paper": {"gate": 2}, "mavlink": {"camera": True}})
        said = self.replay("--config", config)
        self.assertIn("since a replay takes frames and detections as they were recorded: detection.confidence", said)
        self.assertIn("since the method is joint: paper.gate", said)
        self.assertIn("since a replay sends nothing to a vehicle: mavlink.camera", said)
        self.assertNotIn("without effect", self.replay("--config", self.write("config.json", {"joint": {"gate": 11}})))

    def test_what_the_papers_method_has_no_use_for_is_refused(self):
        first = self.folder / "first.geojson"
        run("geoloc_replay", self.recording, "--out", first)
        for options in (("--calibration", first), ("--ground", "free"), ("--ground-sigma-m", 1)):
            self.assertIn(options[0], self.replay("--method", "paper", *options, status=2))


class Options(AppTest):
    """Options that would do nothing, or something else than they say, are refused by name."""

    def test_no_program_takes_a_negative_number_for_a_large_one(self):
        taken = []
        for program in PROGRAMS:
            for option in re.findall(r"(--[a-z-]+)[^\n]*\bUINT\b", run(program, "--help").out):
                taken.append(option)
                self.assert_refused(run(program, option, -1), option)
        self.assertIn("--seed", taken)
        self.assertIn("--seeds", taken)

    def test_options_of_another_mode_of_the_simulator(self):
        record, images = ("--record", self.folder / "new"), ("--images", 1, "--out", self.folder / "new")
        for arguments in (record + ("--speed", 2), record + ("--udp", "127.0.0.1:1"), record + ("--loss", 0.1),
                          images + ("--flight", "stock_path2"), images + ("--pixel-noise", 1),
                          ("--hills-m", 5), ("--clock-step-s", 1), ("--uncalibrated-lens",), ("--out", "x")):
            self.assert_refused(run("geoloc_sim", *arguments), [a for a in arguments if str(a).startswith("--")][-1],
                                "without effect")
        self.assertFalse((self.folder / "new").exists())

    def test_options_of_an_evaluation_that_is_not_made(self):
        for arguments in (("--rendered-s", 5), ("--model", "x.onnx"), ("--dem-spacing-m", 2), ("--flights", "none"),
                          ("--scenarios", 1, "--flights", "none", "--sweep", "latency"),
                          ("--known-points", 1, "--flights", "none", "--sweep", "latency"),
                          ("--ground-sigma-m", 1, "--method", "paper")):
            self.assert_refused(run("geoloc_eval", *arguments), arguments[0])

    def test_an_unknown_option_is_answered_with_the_one_that_is_meant(self):
        for program, option, meant in (("geoloc_app", "--ouy", "--out"), ("geoloc_replay", "--methd", "--method"),
                                       ("geoloc_sim", "--sed", "--seed"), ("geoloc_eval", "--reprot", "--report")):
            self.assert_refused(run(program, option, 1), f"{program}: there is no option {option}; did you mean {meant}?")

    def test_every_program_tells_its_version(self):
        for program in PROGRAMS:
            result = run(program, "--version")
            self.assertEqual((result.status, result.err), (0, ""))
            self.assertRegex(result.out, rf"^{program} \d+\.\d+\.\d+\n$")


if __name__ == "__main__":
    unittest.main()
