# SPDX-License-Identifier: Apache-2.0
import re
import signal
import threading
import time
import unittest

import numpy as np

import geoloc
from support import AppTest, run, tree


class Replays(AppTest):
    """A recording gives in Python what geoloc_replay gives, to the byte."""

    def compare(self, recording, options=(), **settings):
        """Replays it both ways; the result in Python."""
        program = run("geoloc_replay", recording, "--out", self.folder / "program.geojson", "--raw", self.folder / "program.csv", *options)
        self.assertEqual(program.status, 0, program.err)
        result = geoloc.replay(recording, **settings)
        result.to_geojson(self.folder / "python.geojson")
        result.fixes_to_csv(self.folder / "python.csv")
        for kind in "geojson", "csv":
            self.assertEqual((self.folder / f"python.{kind}").read_bytes(), (self.folder / f"program.{kind}").read_bytes(), kind)
        self.assertIn(result.summary, program.err)
        self.assertGreater(len(result.objects), 3)
        return result

    def test_by_either_method(self):
        recording = self.make_recording()
        for method in "joint", "paper":
            with self.subTest(method):
                result = self.compare(recording, ("--method", method), method=method)
                self.assertEqual(result.calibration is None, method == "paper")

    def test_of_a_gimbal_and_of_a_camera_that_zooms(self):
        self.compare(self.make_recording("gimbal", "--gimbal", "sweep"))
        self.compare(self.make_recording("zoom", "--zoom", "1..3"))

    def test_with_settings(self):
        settings = {"joint": {"gate": 7.0, "prior": {"sigma_latency_s": 0.0}}, "max_detections": 3}
        config = self.write("config.json", settings)
        self.compare(self.make_recording(), ("--config", config), **settings)

    def test_rows_tell_what_the_files_tell(self):
        result = self.compare(self.make_recording())
        features = result.geojson()["features"]
        self.assertEqual(len(result.objects), len(features))
        for row, feature in zip(result.objects, features):
            properties, coordinates = feature["properties"], feature["geometry"]["coordinates"]
            self.assertEqual((row["id"], row["hits"], row["class_id"]), (properties["id"], properties["hits"], properties["class_id"]))
            np.testing.assert_allclose([row["longitude_deg"], row["latitude_deg"]], coordinates[:2], atol=6e-10)
            for name in "sigma_major_m", "sigma_minor_m", "height_above_home_m", "sigma_height_m":
                self.assertAlmostEqual(row[name], properties[name], delta=6e-4)
            self.assertEqual(str(row["first_seen"].astype("datetime64[ms]")) + "Z", properties["first_seen"])
        lines = (self.folder / "python.csv").read_text().splitlines()[1:]
        self.assertEqual(len(lines), len(result.fixes))
        taken = {int(line.split(",")[13] or -1) for line in lines}
        self.assertEqual(set(result.fixes["object_id"]), taken)
        self.assertEqual(len(result.trajectory), len(np.unique(result.trajectory["captured_at"])))

    def whole_flight(self):
        self.assertEqual(run("geoloc_sim", "--record", self.folder / "whole").status, 0)
        return geoloc.Recording.read(self.folder / "whole")._files()

    def test_ctrl_c_ends_it(self):
        files = self.whole_flight()
        before = signal.signal(signal.SIGALRM, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, 0.005)
        with self.assertRaises(KeyboardInterrupt):
            geoloc._core.Run(files, "{}")

    def test_other_threads_go_on_meanwhile(self):
        files = self.whole_flight()
        times, is_done = [], threading.Event()

        def count():
            while not is_done.is_set():
                times.append(time.monotonic())
                time.sleep(0.001)

        counter = threading.Thread(target=count)
        counter.start()
        begin = time.monotonic()
        geoloc._core.Run(files, "{}")
        end = time.monotonic()
        is_done.set()
        counter.join()
        self.assertGreater(len([at for at in times if begin < at < end]), 5)

    def test_settings_that_cannot_be_are_named(self):
        recording = self.make_recording()
        with self.assertRaisesRegex(ValueError, r"joint.gate must lie(.|\n)*mavlink.system_id must lie"):
            geoloc.replay(recording, joint={"gate": -1}, mavlink={"system_id": 300})
        with self.assertRaisesRegex(ValueError, "no such recording folder"):
            geoloc.replay(self.folder / "nowhere")


class PythonRecordings(AppTest):
    """Recordings are read, changed and written; the programs read what Python writes."""

    def test_what_is_read_is_written_to_the_byte(self):
        for name, options in {"plain": (), "gimbal": ("--gimbal", "45"), "zoom": ("--zoom", "1..3")}.items():
            with self.subTest(name):
                folder = self.make_recording(name, *options)
                recording = geoloc.Recording.read(folder)
                recording.write(self.folder / f"{name}-again")
                before, after = tree(folder), tree(self.folder / f"{name}-again")
                del before["sim.json"]  # what the simulator injected
                self.assertEqual(before, after)

    def test_ones_own_detector_takes_the_place_of_the_recorded_one(self):
        recording = geoloc.Recording.read(self.make_recording())
        for frame in recording.frames:
            keep = np.arange(len(frame.boxes_px)) % 2 == 0
            frame.boxes_px, frame.confidence, frame.class_id, frame.sigma_px = frame.boxes_px[keep] + 0.25, 0.7, 4, 0.9
        recording.class_names = ["a", "b", "c", "d", "mine"]
        recording.write(self.folder / "mine")
        program = run("geoloc_replay", self.folder / "mine", "--out", self.folder / "program.geojson")
        self.assertEqual(program.status, 0, program.err)
        result = geoloc.replay(recording)
        result.to_geojson(self.folder / "python.geojson")
        self.assertEqual((self.folder / "python.geojson").read_bytes(), (self.folder / "program.geojson").read_bytes())
        self.assertEqual({feature["properties"]["class_name"] for feature in result.geojson()["features"]}, {"mine"})

    def test_a_recording_is_made_of_ones_own_parts(self):
        source = geoloc.Recording.read(self.make_recording())
        frames = [geoloc.Frame(frame.time_us, frame.boxes_px.tolist(), frame.confidence.tolist()) for frame in source.frames]
        made = geoloc.Recording(camera={"width": 1280, "height": 720, "horizontal_fov_deg": 70, "mount": {"pitch_deg": -90}},
                                telemetry=source.telemetry, frames=frames)
        self.assertEqual(len(geoloc.replay(made).objects), len(geoloc.replay(source).objects))

    def test_faults_are_named_by_their_places(self):
        recording = geoloc.Recording.read(self.make_recording())
        first, second = recording.frames[:2]
        cases = {
            "box": lambda: setattr(second, "boxes_px", [[1.0, 2.0, -3.0, 4.0]]),
            "boxes_px": lambda: setattr(second, "boxes_px", [[1.0, 2.0, 3.0]]),
            "time_us runs backwards": lambda: setattr(second, "time_us", first.time_us - 1),
            "fx must lie in (0, inf), but is -1": lambda: recording.camera.update(fx=-1.0),
            "camera.f_x": lambda: recording.camera.update(f_x=1.0),
            "truth": lambda: setattr(recording, "truth", {"type": "nothing"}),
        }
        for named, spoil in cases.items():
            with self.subTest(named):
                recording = geoloc.Recording.read(self.folder / "recording")
                first, second = recording.frames[:2]
                spoil()
                with self.assertRaisesRegex(ValueError, re.escape(named)):
                    geoloc.replay(recording)
                with self.assertRaisesRegex(ValueError, re.escape(named)):
                    recording.write(self.folder / "spoilt")
                self.assertEqual(list(self.folder.glob("spoilt*")), [])

    def test_bad_lines_are_refused_or_counted(self):
        folder = self.make_recording()
        lines = (folder / "frames.jsonl").read_text().splitlines()
        lines[3] = "nonsense"
        (folder / "frames.jsonl").write_text("\n".join(lines) + "\n")
        with self.assertRaisesRegex(ValueError, r"frames.jsonl:4"):
            geoloc.Recording.read(folder)
        recording = geoloc.Recording.read(folder, keep_going=True)
        self.assertEqual((len(recording.frames), recording.lines_skipped), (len(lines) - 1, 1))

    def test_a_folder_that_is_there_is_left_alone(self):
        folder = self.make_recording()
        before = tree(folder)
        with self.assertRaisesRegex(RuntimeError, "exists already"):
            geoloc.Recording.read(folder).write(folder)
        self.assertEqual(tree(folder), before)


class Scores(AppTest):
    """Scores are the programs'."""

    def test_a_result_has_the_score_that_the_program_tells(self):
        recording = self.make_recording()
        said = run("geoloc_replay", recording, "--out", self.folder / "objects.geojson").err
        score = geoloc.evaluate(geoloc.replay(recording))
        self.assertIn(f"found {score.found} / {score.targets}, RMSE {score.rmse_m:.3f} m (relative {score.relative_rmse_m:.3f} m), "
                      f"extra {score.extra}, merged pairs {score.merged_pairs}", said)

    def test_anybodys_objects_are_scored_alike(self):
        recording = geoloc.Recording.read(self.make_recording())
        result = geoloc.replay(recording)
        expected = geoloc.evaluate(result)
        places = np.stack([result.objects["latitude_deg"], result.objects["longitude_deg"]], axis=1)
        for objects, truth in ((result.objects, recording.truth), (places, recording.truth), (result, recording.truth),
                               (result, geoloc._recording._places(recording.truth))):
            score = geoloc.evaluate(objects, truth)
            self.assertEqual((score.found, score.extra, score.target_of_object), (expected.found, expected.extra, expected.target_of_object))
            self.assertAlmostEqual(score.rmse_m, expected.rmse_m, delta=1e-4)

    def test_known_cases(self):
        metre_deg = 1.0 / 111195.0
        truth = np.array([[0.0, 0.0], [100.0 * metre_deg, 0.0]])
        score = geoloc.evaluate(truth + [[metre_deg, 0.0], [0.0, 0.0]], truth)
        self.assertEqual((score.found, score.extra, score.merged_pairs), (2, 0, 0))
        self.assertAlmostEqual(score.rmse_m, np.sqrt(0.5), delta=0.01)
        self.assertEqual(geoloc.evaluate([], truth).found, 0)
        self.assertIsNone(geoloc.evaluate([], truth).rmse_m)
        self.assertEqual(geoloc.evaluate([[5.0, 5.0]], truth).extra, 1)
        for wrong in ([[200.0, 0.0]], [1.0, 2.0, 3.0]):
            with self.assertRaises(ValueError):
                geoloc.evaluate(wrong, truth)
        with self.assertRaisesRegex(ValueError, "truth"):
            geoloc.evaluate(truth)

    def test_a_recording_without_truth_cannot_be_scored(self):
        folder = self.make_recording()
        (folder / "truth.geojson").unlink()
        self.assertIsNone(geoloc.Recording.read(folder).truth)
        with self.assertRaisesRegex(ValueError, "true targets"):
            geoloc.evaluate(geoloc.replay(folder))


if __name__ == "__main__":
    unittest.main()
