# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import re
import threading
import unittest

import numpy as np
from c_library import CGeolocator

import geoloc
from support import AppTest, run

CAMERA = {"width": 1280, "height": 720, "horizontal_fov_deg": 70.0}
FOCAL_PX = 640.0 / np.tan(np.radians(35.0))


class Survey:
    """A noisy flight to and fro over a grid of objects, level, at 20 m."""

    def __init__(self, duration_s=40.0, seed=5):
        random = np.random.default_rng(seed)
        self.time_s = np.arange(0.0, duration_s, 0.1)
        self.angles_rad = random.normal(0.0, 0.004, (len(self.time_s), 3))
        place = self.place(self.time_s) + random.normal(0.0, 0.05, (len(self.time_s), 2))
        self.latitude_deg = 47.4 + place[:, 1] / 111175.0
        self.longitude_deg = 8.5 + place[:, 0] / 75400.0
        self.objects = np.array([[8.0 * i, 8.0 * k] for i in range(-2, 3) for k in range(-2, 3)])
        self.frames = [self.frame(at, random) for at in np.arange(0.35, duration_s - 0.5, 0.2)]

    @staticmethod
    def place(time_s):
        """East and north [m]."""
        return np.stack([15.0 * np.sin(0.3 * time_s), 14.0 * np.sin(0.17 * time_s)], axis=-1)

    def frame(self, time_s, random):
        """(time, boxes, confidences, classes) as the camera sees it."""
        away = self.objects - self.place(time_s)
        centres = np.stack([639.5 + FOCAL_PX * away[:, 0] / 20.0, 359.5 - FOCAL_PX * away[:, 1] / 20.0], axis=1)
        seen = (np.abs(away[:, 0]) < 12.0) & (np.abs(away[:, 1]) < 6.0) & (random.random(len(away)) < 0.9)
        centres = centres[seen] + random.normal(0.0, 0.6, (seen.sum(), 2))
        boxes = np.concatenate([centres - 15.0 + 0.5, np.full((len(centres), 2), 30.0)], axis=1)
        return time_s, boxes, random.uniform(0.6, 0.95, len(boxes)), np.arange(len(self.objects))[seen] % 3

    def fly(self, geolocator):
        geolocator.add_attitude(self.time_s, self.angles_rad)
        geolocator.add_position(self.time_s, self.latitude_deg, self.longitude_deg, 20.0, sigma_horizontal_m=0.4)
        outcomes = []
        for time_s, boxes, confidence, classes in self.frames:
            outcomes += geolocator.process(time_s, boxes, confidence, classes, utc_ns=self.utc_ns(time_s))
        return outcomes + geolocator.finish()

    @staticmethod
    def utc_ns(time_s):
        return 1_700_000_000_000_000_000 + ns(time_s)


def ns(time_s):
    return int(np.rint(time_s * 1e9))


class PythonMemory(unittest.TestCase):
    """What is told of memory is the library's; tests/pipeline/memory_needed_test.cpp holds that against the heap."""

    def test_is_the_figure_of_the_page(self):
        page = (pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"]) / "docs/library.md").read_text()
        rows = re.findall(r"^\| (joint|paper)(?:, default)? \| (\d+) \| (\d+) \| ([\d.]+) MB \|$", page, re.MULTILINE)
        self.assertEqual(len(rows), 4)
        for method, tracks, detections, megabytes in rows:
            settings = {"method": method, method: {"max_tracks": int(tracks)}, "max_detections": int(detections)}
            told = geoloc.memory_needed(settings, camera=CAMERA)
            self.assertAlmostEqual(told / 1e6, float(megabytes), delta=0.05 * float(megabytes) + 0.05)

    def test_of_settings_that_cannot_be_is_refused_with_every_fault(self):
        with self.assertRaisesRegex(ValueError, "max_detections(.|\\n)*joint.gate"):
            geoloc.memory_needed(max_detections=0, joint={"gate": -1})


class Flights(AppTest):
    """One's own detections and poses."""

    def test_the_answers_are_those_of_the_library_for_c_to_the_bit(self):
        survey = Survey()
        ours, theirs = geoloc.Geolocator(camera=CAMERA, joint={"max_tracks": 200}), CGeolocator(1280, 720, 70.0, **{"joint.max_tracks": 200})
        self.addCleanup(theirs.close)
        outcomes = survey.fly(ours)

        expected, fed = [], 0
        for time_s, *seen in survey.frames + [(np.inf, [], [], [])]:
            while fed < len(survey.time_s) and survey.time_s[fed] <= time_s + 1.0:
                at = ns(survey.time_s[fed])
                theirs.add_attitude(at, survey.angles_rad[fed])
                theirs.add_position(at, survey.latitude_deg[fed], survey.longitude_deg[fed], 20.0, 0.4)
                expected += theirs.process()
                fed += 1
            if np.isfinite(time_s):
                theirs.add_frame(ns(time_s), survey.utc_ns(time_s), *seen)
                expected += theirs.process()
        theirs.finish()
        self.assertEqual([(ns(outcome.time_s), int(outcome.fate)) for outcome in outcomes], expected)
        self.assertEqual({outcome.fate for outcome in outcomes}, {geoloc.Fate.LOCATED})

        objects, same = ours.objects(confirmed_only=False), theirs.objects()
        self.assertEqual(len(objects), len(same))
        self.assertGreaterEqual(ours.objects().size, 20)
        for one, other in zip(objects, same):
            for field in "id", "class_id", "hits", "confidence", "latitude_deg", "longitude_deg", "height_above_home_m", "sigma_height_m":
                self.assertEqual(one[field], getattr(other, field), field)
            self.assertEqual(list(one["position_in_enu_m"]), list(other.position_in_enu_m))
            self.assertEqual([one["covariance_m2"][0, 0], one["covariance_m2"][0, 1], one["covariance_m2"][1, 1]], list(other.covariance_m2))
            self.assertEqual(one["first_seen"].astype(np.int64), other.first_seen_ns)
            self.assertEqual(one["last_seen"].astype(np.int64), other.last_seen_ns)
            self.assertEqual(one["is_confirmed"], bool(other.is_confirmed))
            self.assertTrue(np.isnan(one["velocity_in_enu_mps"]).all())

    def test_objects_lie_where_they_are(self):
        survey, geolocator = Survey(), geoloc.Geolocator(camera=CAMERA)
        survey.fly(geolocator)
        truth = np.stack([47.4 + survey.objects[:, 1] / 111175.0, 8.5 + survey.objects[:, 0] / 75400.0], axis=1)
        score = geoloc.evaluate(geolocator.objects(), truth)
        self.assertEqual((score.extra, score.merged_pairs), (0, 0))
        self.assertGreaterEqual(score.found, 20)
        self.assertLess(score.rmse_m, 0.25)

    def test_samples_one_by_one_as_they_come_are_the_same_flight(self):
        survey, at_once, live = Survey(), geoloc.Geolocator(camera=CAMERA), geoloc.Geolocator(camera=CAMERA)
        survey.fly(at_once)
        frames = iter(survey.frames)
        frame = next(frames)
        for i, time_s in enumerate(survey.time_s):
            live.add_attitude(time_s, survey.angles_rad[i])
            live.add_position(time_s, survey.latitude_deg[i], survey.longitude_deg[i], 20.0, sigma_horizontal_m=0.4)
            if frame is not None and frame[0] < time_s - 0.15:  # the detector takes a while
                live.process(*frame, utc_ns=survey.utc_ns(frame[0]))
                frame = next(frames, None)
        live.finish()
        self.assertEqual(live.counters()["frames_located"], len(survey.frames))
        ours, theirs = at_once.objects(), live.objects()
        self.assertEqual(len(ours), len(theirs))
        np.testing.assert_allclose(ours["position_in_enu_m"], theirs["position_in_enu_m"], atol=1e-3)

    def test_the_last_frame_is_shown_with_its_pose(self):
        survey, geolocator = Survey(), geoloc.Geolocator(camera=CAMERA)
        self.assertIsNone(geolocator.enu_from_camera())
        self.assertIsNone(geolocator.origin_deg())
        survey.fly(geolocator)
        pose, fixes = geolocator.enu_from_camera(), geolocator.fixes()
        np.testing.assert_allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3), atol=1e-12)
        self.assertAlmostEqual(pose[2, 3], 20.0, delta=0.01)
        np.testing.assert_allclose(np.hypot(*(fixes["position_in_enu_m"] - pose[:2, 3]).T) ** 2 + 400.0, fixes["range_m"] ** 2, rtol=0.05)
        east_m, north_m = geolocator.to_local(*geolocator.to_geodetic(3.0, -4.0))
        self.assertAlmostEqual(east_m, 3.0, places=6)
        self.assertAlmostEqual(north_m, -4.0, places=6)

    def test_the_papers_method_learns_no_calibration(self):
        geolocator = geoloc.Geolocator(method="paper", camera=CAMERA)
        Survey().fly(geolocator)
        self.assertIsNone(geolocator.calibration())
        self.assertGreaterEqual(len(geolocator.objects()), 20)

    def test_several_threads_may_compute_at_once(self):
        surveys = [Survey(20.0, seed) for seed in range(3)]
        alone, together = [], [geoloc.Geolocator(camera=CAMERA) for _ in surveys]
        for survey in surveys:
            geolocator = geoloc.Geolocator(camera=CAMERA)
            survey.fly(geolocator)
            alone.append(geolocator.objects())
        threads = [threading.Thread(target=survey.fly, args=[geolocator]) for survey, geolocator in zip(surveys, together)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for objects, geolocator in zip(alone, together):
            self.assertEqual(objects.tobytes(), geolocator.objects().tobytes())


class Samples(unittest.TestCase):
    """What cannot be used is refused by its shape, and counted by its values."""

    def setUp(self):
        self.geolocator = geoloc.Geolocator(camera=CAMERA)

    def test_shapes_and_times_that_cannot_be_are_named(self):
        cases = [
            ("roll_pitch_yaw_rad", lambda g: g.add_attitude(0.0, [1.0, 2.0])),
            ("different lengths", lambda g: g.add_attitude([0.0, 1.0], np.zeros((3, 3)))),
            ("latitude_deg", lambda g: g.add_position([0.0, 1.0], [47.0, 47.0, 47.0], 8.0, 20.0)),
            ("time_s", lambda g: g.add_range(float("nan"), 3.0)),
            ("time_s", lambda g: g.add_range(1e12, 3.0)),
            ("boxes_px", lambda g: g.process(0.0, [[1.0, 2.0, 3.0]])),
            ("confidence", lambda g: g.process(0.0, np.ones((2, 4)), [0.5, 0.5, 0.5])),
            ("class_id", lambda g: g.process(0.0, np.ones((1, 4)), class_id=2**40)),
            ("yaw", lambda g: g.add_gimbal(0.0, [1.0, 0.0, 0.0, 0.0], yaw="south")),
            ("mount.roll_deg", lambda g: g.process(0.0, mount={"roll_deg": "a"})),
            ("no position", lambda g: g.to_geodetic(0.0, 0.0)),
        ]
        for named, call in cases:
            with self.subTest(named), self.assertRaisesRegex(ValueError, named):
                call(self.geolocator)

    def test_values_that_cannot_be_are_counted(self):
        self.geolocator.add_attitude([0.0, 0.1, 0.2], [[0.0, 0.0, 0.0], [np.nan, 0.0, 0.0], [90.0, 0.0, 0.0]])
        self.geolocator.add_position([0.0, 0.1], [47.0, 147.0], 8.0, 20.0)
        self.geolocator.finish()
        counters = self.geolocator.counters()
        self.assertEqual((counters["attitudes"], counters["positions"]), (1, 1))
        self.assertEqual((counters["invalid"], counters["out_of_range"]), (2, 1))

    def test_a_frame_tells_why_it_was_not_located(self):
        self.geolocator.process(1.0)
        (outcome,) = self.geolocator.finish()
        self.assertEqual(outcome, geoloc.Outcome(1.0, geoloc.Fate.NO_TELEMETRY))
        self.assertFalse(outcome.is_located)
        self.assertIn("attitude", outcome.fate.explain())


class PythonSettings(AppTest):
    """Settings have the names of docs/settings.md, and their faults the programs' words."""

    BAD = {"method": "best", "max_detections": 0.5, "joint": {"gat": 1, "gate": -1, "prior": {"sigma_latency_s": None}},
           "camera": {"width": 1280, "horizontal_fov_deg": 190, "mount": {"pitch_deg": 1e4}}}

    def test_every_fault_is_listed_as_the_programs_list_it(self):
        printed = run("geoloc_replay", "--print-config", "--config", self.write("bad.json", self.BAD)).err.splitlines()
        with self.assertRaises(ValueError) as raised:
            geoloc.Geolocator(**self.BAD)
        ours = str(raised.exception).splitlines()
        self.assertEqual(ours[0], "unusable configuration:")
        self.assertGreaterEqual(len(ours), 8)
        self.assertEqual(ours[1:], [line for line in printed if line.startswith("  ")])

    def test_settings_come_as_a_mapping_as_keywords_or_both(self):
        geoloc.Geolocator({"joint": {"gate": 9.0}}, joint={"max_tracks": np.int64(10)}, known_points=())
        with self.assertRaisesRegex(ValueError, r"gate must lie.*\n.*max_tracks must lie"):
            geoloc.Geolocator({"joint": {"gate": -9.0}}, joint={"max_tracks": 0})
        with self.assertRaisesRegex(ValueError, 'joint.gate must be a finite number, but is "nan"'):
            geoloc.Geolocator(joint={"gate": float("nan")})

    def test_a_calibration_file_is_a_camera(self):
        file = self.write("camera.json", {"width": 640, "height": 480, "fx": 500, "fy": 500, "cx": 320, "cy": 240})
        geoloc.Geolocator(camera=file)
        with self.assertRaisesRegex(ValueError, "nowhere.json"):
            geoloc.Geolocator(camera=self.folder / "nowhere.json")


if __name__ == "__main__":
    unittest.main()
