# SPDX-License-Identifier: Apache-2.0
import json
import unittest

from support import AppTest, rmse_m, run


class ZoomFlights(AppTest):
    """A camera that zooms between its calibration and four times that."""

    def fly(self, name, *options):
        recording = self.folder / name
        result = run("geoloc_sim", "--record", recording, "--zoom", "1..4", *options)
        self.assertEqual(result.status, 0, result.err)
        return recording

    def replay(self, recording, *options):
        result = run("geoloc_replay", recording, "--out", self.folder / "objects.geojson", *options)
        self.assertEqual(result.status, 0, result.err)
        return result.err

    def test_a_camera_that_tells_its_field_of_view_is_as_good_as_one_that_does_not_zoom(self):
        said = self.replay(self.fly("zooms"))
        self.assertIn("found 30 / 30", said)
        self.assertIn("extra 0", said)
        self.assertLess(rmse_m(said), 0.05)

    def test_frames_may_tell_their_focal_length_themselves(self):
        """The calibration is wrong by half, and each frame is right: as if the calibration were."""
        recording = self.folder / "halved"
        self.assertEqual(run("geoloc_sim", "--record", recording).status, 0)
        expected = self.replay(recording)
        objects = (self.folder / "objects.geojson").read_bytes()
        camera = json.loads((recording / "camera.json").read_text())
        focal_px = [camera["fx"], camera["fy"]]
        camera["fx"], camera["fy"] = (0.5 * length for length in focal_px)
        (recording / "camera.json").write_text(json.dumps(camera))
        lines = [json.loads(line) for line in (recording / "frames.jsonl").read_text().splitlines()]
        told = "".join(json.dumps({**line, "focal_px": focal_px}) + "\n" for line in lines)
        (recording / "frames.jsonl").write_text(told)
        self.assertEqual(self.replay(recording), expected)
        self.assertEqual((self.folder / "objects.geojson").read_bytes(), objects)

    def test_focal_lengths_that_no_camera_has_are_named(self):
        recording = self.fly("senseless", "--end-s", "110")
        lines = (recording / "frames.jsonl").read_text().splitlines()
        broken = json.loads(lines[7])
        for focal_px, words in ((0, "above 0"), ([914, 914, 914], "two numbers"), ([9.14, 9.14], "0.01 to 10000 times")):
            lines[7] = json.dumps({**broken, "focal_px": focal_px if isinstance(focal_px, list) else [focal_px, 914]})
            (recording / "frames.jsonl").write_text("\n".join(lines) + "\n")
            result = run("geoloc_replay", recording, "--out", self.folder / "objects.geojson")
            self.assertEqual(result.status, 2, result.err)
            self.assertIn("frames.jsonl", result.err)
            self.assertIn(words, result.err)
            self.replay(recording, "--keep-going")

    def configured_as(self, recording, factor):
        """What the replay says where camera.json has a focal length that is so much longer than the camera's."""
        camera = json.loads((recording / "camera.json").read_text())
        wrong = self.folder / f"{factor}.json"
        wrong.write_text(json.dumps({"camera": {**camera, "fx": factor * camera["fx"], "fy": factor * camera["fy"]}}))
        return self.replay(recording, "--config", wrong)

    def test_a_camera_that_contradicts_the_configuration_is_named(self):
        """The camera begins at 70 degrees and zooms in."""
        recording = self.fly("contradicted", "--end-s", "110")
        told = "the camera tells a horizontal field of view of 7"  # nominal, to a percent
        self.assertNotIn("the camera tells", self.configured_as(recording, 1.0))
        said = self.configured_as(recording, 1.3)
        self.assertIn(told, said)
        self.assertIn("by its configuration it is 56.6 deg: the configuration is of another camera or mode", said)
        self.assertIn("calibrate it at its widest", said)
        self.assertNotIn("the camera tells", self.configured_as(recording, 0.7))  # it may have begun zoomed in

    def test_a_camera_that_never_sees_what_the_configuration_says_is_named(self):
        recording = self.folder / "still"
        self.assertEqual(run("geoloc_sim", "--record", recording, "--zoom", "1..1.001", "--end-s", "90").status, 0)
        said = self.configured_as(recording, 0.7)
        self.assertIn("by its configuration it is 90.0 deg: it has been zoomed in from the beginning, or the configuration", said)
        self.assertIn("horizontal_fov_deg", said)

    def test_zooms_that_no_camera_has_are_refused(self):
        for zoom in "4", "4..1", "0..4", "one..4", "1..4x", "1..nan":
            result = run("geoloc_sim", "--record", self.folder / "refused", "--zoom", zoom)
            self.assertEqual(result.status, 2, zoom)
            self.assertIn("zoom", result.err)
        self.assertFalse((self.folder / "refused").exists())


if __name__ == "__main__":
    unittest.main()
