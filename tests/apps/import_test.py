# SPDX-License-Identifier: Apache-2.0
import csv
import datetime
import json
import math
import os
import pathlib
import re
import struct
import unittest

from still_pictures import EXIFTOOL, dji_tags, grey_jpeg, read_tags, write_tags
from support import SOURCE, AppTest, Live, rmse_m, run

# Real flights that may not be copied; where they are not, their tests are skipped.
REAL = pathlib.Path(os.environ.get("GEOLOC_REAL_DATA", SOURCE.parent / "shared/data/real"))
WIDTH, HEIGHT = 4000, 3000
POSITION, ATTITUDE, GPS = 33, 30, 24


# Of a picture that tells nothing of how it looked.
UNTOLD = {f"{vehicle}{angle}Degree": None for vehicle in ("Gimbal", "Flight") for angle in ("Roll", "Pitch", "Yaw")}


def messages(recording, wanted, form):
    """(time in us, fields) of each message of that number in the telemetry, the same one but once."""
    log, found = (recording / "telemetry.tlog").read_bytes(), []
    while log:
        stamp_us, size, number = struct.unpack(">Q", log[:8])[0], log[9], int.from_bytes(log[15:18], "little")
        payload = log[18:18 + size].ljust(255, b"\0")
        message = stamp_us, struct.unpack_from("<" + form, payload)
        if number == wanted and message not in found:
            found.append(message)
        log = log[8 + 12 + size:]
    return found


def as_numbers(tags):
    """DJI's numbers are texts with a sign."""
    return {name: float(value) if re.fullmatch(r"[+-]\d+\.\d+", str(value)) else value for name, value in tags.items()}


def frames(recording):
    return [json.loads(line) for line in (recording / "frames.jsonl").read_text().splitlines()]


def micros(date, zone="+00:00"):
    return round(datetime.datetime.strptime(date + zone.replace(":", ""), "%Y:%m:%d %H:%M:%S.%f%z").timestamp() * 1e6)


@unittest.skipUnless(EXIFTOOL, "exiftool writes the pictures' tags (libimage-exiftool-perl)")
class ImportTest(AppTest):
    def setUp(self):
        super().setUp()
        self.pictures = self.folder / "pictures"
        self.pictures.mkdir()
        self.recording = self.folder / "recording"

    def put(self, tags_by_name, size=(WIDTH, HEIGHT)):
        jpeg = grey_jpeg(*size)
        for name in tags_by_name:
            (self.pictures / name).write_bytes(jpeg)
        write_tags(self.pictures, tags_by_name)

    def label(self, *lines, header="picture,u,v"):
        return self.write("labels.csv", "\n".join((header, *lines)) + "\n")

    def import_stills(self, *arguments, labels=None, inputs=None):
        if labels is None:
            labels = self.label(*(f"{file.name},2000,1500" for file in sorted(self.pictures.iterdir())))
        return run("geoloc_import", "stills", *(inputs or [self.pictures]), "--out", self.recording, "--labels", labels,
                   *arguments)

    def assert_imported(self, result, *assumptions):
        self.assertEqual(result.status, 0, result.err)
        for assumption in assumptions:
            self.assertIn(assumption, result.err)
        self.assertFalse(self.recording.with_name("recording.partial").exists())

    def assert_nothing_written(self):
        self.assertEqual([path.name for path in self.folder.glob("recording*")], [])


class ImportedStills(ImportTest):
    """What pictures tell of themselves is what the recording holds, as exiftool reads it."""

    def assert_is_what_exiftool_reads(self, files):
        tags = sorted(map(as_numbers, read_tags(*files)), key=lambda picture: picture["DateTimeOriginal"])
        positions, attitudes = messages(self.recording, POSITION, "Iiiiihhh"), messages(self.recording, ATTITUDE, "Ifff")
        self.assertEqual((len(positions), len(attitudes)), (len(tags), len(tags)))
        take_off_m = sorted(tag["AbsoluteAltitude"] - tag["RelativeAltitude"] for tag in tags)[len(tags) // 2]
        for picture, (stamp_us, position), (_, attitude), frame in zip(tags, positions, attitudes, frames(self.recording)):
            date = f"{picture['DateTimeOriginal']}.{picture.get('SubSecTimeOriginal', 0)}"
            self.assertEqual(stamp_us, micros(date, picture.get("OffsetTimeOriginal", "+00:00")))
            self.assertEqual(frame["time_us"], stamp_us)
            self.assertAlmostEqual(position[1], picture["GPSLatitude"] * 1e7, delta=0.6)
            self.assertAlmostEqual(position[2], picture["GPSLongitude"] * 1e7, delta=0.6)
            self.assertAlmostEqual(position[3], 1e3 * (picture["RelativeAltitude"] + take_off_m), delta=1)
            self.assertAlmostEqual(position[4], 1e3 * picture["RelativeAltitude"], delta=1)
            for radians, name in zip(attitude[1:], ("Roll", "Pitch", "Yaw")):
                self.assertAlmostEqual(math.degrees(radians), picture[f"Flight{name}Degree"], places=4)

    def test_tags_of_a_drone_are_its_state(self):
        self.put({f"DJI_{i}.JPG": dji_tags(DateTimeOriginal=f"2016:06:23 16:32:4{i}", GPSLatitude=46.8428 + i * 1e-4,
                                           RelativeAltitude=39.9 + i, AbsoluteAltitude=198.4 + i, FlightRollDegree=i)
                  for i in range(3)})
        self.assert_imported(self.import_stills(), "equivalent for film of 35 mm")
        self.assert_is_what_exiftool_reads(sorted(self.pictures.iterdir()))
        camera = json.loads((self.recording / "camera.json").read_text())
        self.assertEqual((camera["width"], camera["height"]), (WIDTH, HEIGHT))
        self.assertAlmostEqual(camera["fx"], 20 / 34.61 * WIDTH)
        prior = json.loads((self.recording / "config.json").read_text())["joint"]["prior"]
        self.assertEqual(prior["sigma_focal_percent"], 3)

    @unittest.skipUnless((REAL / "dji_stills").exists(), "the real pictures are not here")
    def test_real_pictures_are_what_exiftool_reads(self):
        files = sorted((REAL / "dji_stills").glob("*.JPG"))
        labels = self.label(*(f"{file.name},1999.5,1124.5" for file in files))
        self.assert_imported(self.import_stills(labels=labels, inputs=files), "do not tell their time zone")
        self.assert_is_what_exiftool_reads(files)
        result = run("geoloc_replay", self.recording, "--raw", self.folder / "raw.csv", "--out", self.folder / "out.geojson")
        self.assertEqual(result.status, 0, result.err)
        with open(self.folder / "raw.csv", newline="") as lines:  # cameras that look straight down, to 0.1 degrees
            for fix, tags in zip(csv.DictReader(lines), read_tags(*files)):
                self.assertAlmostEqual(float(fix["latitude_deg"]), tags["GPSLatitude"], delta=1e-6)
                self.assertAlmostEqual(float(fix["longitude_deg"]), tags["GPSLongitude"], delta=1.5e-6)

    def test_accuracies_of_rtk_are_the_receivers_claims(self):
        rtk = {"RtkFlag": 50, "RtkStdLon": 0.03, "RtkStdLat": 0.04, "RtkStdHgt": 0.02}
        self.put({"a.jpg": {**dji_tags(), **{f"XMP-drone-dji:{name}": value for name, value in rtk.items()}}})
        self.assert_imported(self.import_stills(), "RTK: of 1 pictures, 1 have a fixed solution",
                             "heights: above the take-off, and above the ellipsoid")
        (_, gps), = messages(self.recording, GPS, "QiiiHHHHBBiII")
        self.assertEqual((gps[8], gps[-2], gps[-1]), (6, 50, 20))

    def test_objects_are_where_gimbals_look(self):
        """From above a mark, from four sides at 45 degrees: each camera's middle shows it."""
        north_deg, height_m = 1 / 111164.0, 40.0  # of a metre at that latitude
        east_deg = north_deg / math.cos(math.radians(46.8428)) * 0.9978
        self.put({f"{i}.jpg": dji_tags(
            DateTimeOriginal=f"2016:06:23 16:3{i}:00", GimbalYawDegree=yaw_deg, GimbalPitchDegree=pitch_deg,
            RelativeAltitude=height_m, AbsoluteAltitude=198.4,
            GPSLatitude=46.8428 - math.cos(math.radians(yaw_deg)) * away_m * north_deg,
            GPSLongitude=91.9936 + math.sin(math.radians(yaw_deg)) * away_m * east_deg)
            for i, (yaw_deg, pitch_deg, away_m) in enumerate([(0, -90, 0), (0, -45, 40), (90, -45, 40), (180, -45, 40),
                                                              (-90, -45, 40)])})
        self.assert_imported(self.import_stills(labels=self.label(*(f"{i}.jpg,1999.5,1499.5" for i in range(5)))))
        result = run("geoloc_replay", self.recording, "--raw", self.folder / "raw.csv", "--method", "paper",
                     "--out", self.folder / "out.geojson")
        self.assertEqual(result.status, 0, result.err)
        with open(self.folder / "raw.csv", newline="") as lines:
            fixes = list(csv.DictReader(lines))
        self.assertEqual(len(fixes), 5)
        for fix in fixes:
            self.assertAlmostEqual(float(fix["latitude_deg"]), 46.8428, delta=0.2 * north_deg)
            self.assertAlmostEqual(float(fix["longitude_deg"]), -91.9936, delta=0.2 * east_deg)

    def test_a_picture_that_is_named_twice_counts_once(self):
        self.put({"a.jpg": dji_tags()})
        self.assert_imported(self.import_stills(inputs=[self.pictures, self.pictures / "a.jpg"]), "1 pictures with")

    def test_detectors_look_at_the_pictures(self):
        (self.pictures / "a.jpg").write_bytes((SOURCE / "tests/data/detection/targets.jpg").read_bytes())
        write_tags(self.pictures, {"a.jpg": dji_tags()})
        found = run("geoloc_detect", self.pictures, "--json", "-")
        result = run("geoloc_import", "stills", self.pictures, "--out", self.recording)
        self.assert_imported(result)
        detections = json.loads(found.out)["detections"]
        self.assertGreater(len(detections), 3)
        self.assertEqual([detection["class_id"] for detection in frames(self.recording)[0]["detections"]],
                         [detection["class_id"] for detection in detections])
        again = self.folder / "again"  # from what geoloc_detect wrote
        result = run("geoloc_import", "stills", self.pictures, "--out", again, "--labels", self.write("a.jsonl", found.out))
        self.assert_imported(result)
        self.assertEqual([detection["class_id"] for detection in frames(again)[0]["detections"]],
                         [detection["class_id"] for detection in detections])
        for name in "telemetry.tlog", "class_names.json":
            self.assertEqual((again / name).read_bytes(), (self.recording / name).read_bytes())

    @unittest.skipUnless((REAL / "helenenschacht").exists(), "the real survey is not here")
    def test_a_survey_from_its_pictures_is_as_good_as_from_its_telemetry(self):
        source, names = REAL / "helenenschacht", self.survey_pictures()
        result = self.import_stills(labels=source / "gcp_list.txt")
        self.assert_imported(result, "left out", "max_0131.jpg")
        self.assertEqual(len(frames(self.recording)), len(names))
        known = run("geoloc_replay", source, "--out", self.folder / "known.geojson").err
        found = run("geoloc_replay", self.recording, "--out", self.folder / "found.geojson").err
        self.assertIn("found 5 / 5", found)
        self.assertLess(rmse_m(found), 1.1 * rmse_m(known))

    @unittest.skipUnless((REAL / "helenenschacht").exists(), "the real survey is not here")
    def test_a_survey_without_attitudes_needs_but_its_pitch(self):
        self.survey_pictures(**UNTOLD)
        self.assert_imported(self.import_stills("--gimbal-pitch-deg", -80, labels=REAL / "helenenschacht/gcp_list.txt"))
        found = run("geoloc_replay", self.recording, "--out", self.folder / "found.geojson").err
        self.assertIn("found 5 / 5", found)
        self.assertLess(rmse_m(found), 0.3)

    def test_pictures_of_a_flight_tell_as_much_as_its_telemetry(self):
        """A simulated camera, fixed in a vehicle that tilts: its angles come by way of a gimbal's."""
        flight = self.folder / "flight"
        self.assertEqual(run("geoloc_sim", "--record", flight, "--latency-s", 0, "--jitter-s", 0).status, 0)
        seen = frames(flight)[::10]
        (flight / "frames.jsonl").write_text("".join(json.dumps(frame) + "\n" for frame in seen))
        positions, attitudes = messages_of(flight, POSITION, "Iiiii"), unwrapped(messages_of(flight, ATTITUDE, "Ifff"))
        tags, labels = {}, []
        for number, frame in enumerate(seen):
            name = f"{number:03}.jpg"
            tags[name] = flight_tags(frame["time_us"], between(positions, frame["time_us"]),
                                     between(attitudes, frame["time_us"]))
            labels += [f"{name},{x + w / 2 - 0.5},{y + h / 2 - 0.5},{w},{h}" for x, y, w, h in
                       (detection["box"] for detection in frame["detections"])] or [f"{name},,,,"]
        self.put(tags, size=(1280, 720))
        self.assert_imported(self.import_stills("--camera", flight / "camera.json", labels=self.label(
            *labels, header="picture,u,v,width,height")))
        self.assertEqual(len(frames(self.recording)), len(seen))
        truth = ("--truth", flight / "truth.geojson", "--out", self.folder / "objects.geojson")
        known, found = (run("geoloc_replay", recording, *truth).err for recording in (flight, self.recording))
        self.assertEqual(re.search(r"found (\d+) /", found)[1], re.search(r"found (\d+) /", known)[1], known + found)
        self.assertLess(rmse_m(found), 1.5 * rmse_m(known), known + found)

    def survey_pictures(self, **changes):
        """Pictures with the tags that a survey's would have: its own are not to be had, but its telemetry is."""
        source = REAL / "helenenschacht"
        positions, attitudes = messages_of(source, POSITION, "Iiiii"), messages_of(source, ATTITUDE, "Ifff")
        centres = {}
        for frame in frames(source):
            for detection in frame["detections"]:
                x, y, width, height = detection["box"]
                centres[round(x + width / 2 - 0.5), round(y + height / 2 - 0.5)] = frame["time_us"]
        tags = {}
        for line in (source / "gcp_list.txt").read_text().splitlines()[1:]:
            words = line.split()
            stamp_us = next((centres[key] for key in centres if abs(key[0] - float(words[3])) < 1 and
                             abs(key[1] - float(words[4])) < 1), None)
            if stamp_us is not None:
                tags[words[5]] = survey_tags(stamp_us, between(positions, stamp_us),
                                             between(attitudes, stamp_us), **changes)
        self.put(tags, size=(5472, 3648))
        return tags


def messages_of(recording, wanted, form):
    """As messages(), of a log of thousands."""
    log, found, at = (recording / "telemetry.tlog").read_bytes(), [], 0
    while at < len(log):
        size, number = log[at + 9], int.from_bytes(log[at + 15:at + 18], "little")
        if number == wanted:
            payload = log[at + 18:at + 18 + size].ljust(255, b"\0")
            found.append((struct.unpack(">Q", log[at:at + 8])[0], *struct.unpack_from("<" + form, payload)))
        at += 8 + 12 + size
    return found


def unwrapped(attitudes):
    """Without jumps of a turn, so that between() may take the mean of two yaws."""
    turns, before, smooth = 0, 0, []
    for *others, yaw in attitudes:
        turns -= round((yaw - before) / math.tau)
        before = yaw
        smooth.append((*others, yaw + turns * math.tau))
    return smooth


def between(samples, stamp_us):
    after = next(i for i, sample in enumerate(samples) if sample[0] >= stamp_us)
    a, b = samples[after - 1], samples[after]
    share = (stamp_us - a[0]) / (b[0] - a[0])
    return [x + share * (y - x) for x, y in zip(a, b)]


def exposure_tags(stamp_us, position):
    taken = datetime.datetime.fromtimestamp(stamp_us / 1e6, datetime.timezone.utc)
    return {"DateTimeOriginal": taken.strftime("%Y:%m:%d %H:%M:%S"), "SubSecTimeOriginal": f"{taken.microsecond:06}",
            "OffsetTimeOriginal": "+00:00", "GPSLatitude": abs(position[2]) / 1e7,
            "GPSLatitudeRef": "N" if position[2] > 0 else "S", "GPSLongitude": abs(position[3]) / 1e7,
            "GPSLongitudeRef": "E" if position[3] > 0 else "W", "GPSAltitude": position[4] / 1e3,
            "AbsoluteAltitude": position[4] / 1e3, "RelativeAltitude": position[5] / 1e3}


def survey_tags(stamp_us, position, attitude, **changes):
    return dji_tags(**{**exposure_tags(stamp_us, position), "FocalLengthIn35mmFormat": 29, "GimbalPitchDegree": -80,
                       "GimbalYawDegree": math.degrees(attitude[4]), "FlightYawDegree": None, "FlightRollDegree": None,
                       **changes})


def flight_tags(stamp_us, position, attitude):
    """Of a camera that looks straight down from a level vehicle, and with it to the side from one that tilts."""
    _, _, roll, pitch, yaw = attitude
    sr, cr, sp, cp, sy, cy = (f(angle) for angle in (roll, pitch, yaw) for f in (math.sin, math.cos))
    ned_from_body = [[cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy],
                     [cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy], [-sp, sr * cp, cr * cp]]
    # The camera's forward, right and down are the body's down, right and backward.
    forward, right, down = ([scale * row[axis] for row in ned_from_body] for axis, scale in ((2, 1), (1, 1), (0, -1)))
    degrees = {"Roll": math.atan2(right[2], down[2]), "Pitch": -math.asin(forward[2]),
               "Yaw": math.atan2(forward[1], forward[0])}
    return dji_tags(**exposure_tags(stamp_us, position),
                    **{f"Gimbal{name}Degree": math.degrees(angle) for name, angle in degrees.items()},
                    **{f"Flight{name}Degree": math.degrees(angle) for name, angle in
                       {"Roll": roll, "Pitch": pitch, "Yaw": yaw}.items()})


class IncompleteStills(ImportTest):
    """What pictures do not tell is named, with what was taken in its place, or asked for."""

    def test_no_time_zone(self):
        self.put({"a.jpg": dji_tags(OffsetTimeOriginal=None)})
        self.assert_imported(self.import_stills(), "1 pictures do not tell their time zone: UTC is assumed",
                             "--utc-offset-h")
        self.assertEqual(frames(self.recording)[0]["time_us"], micros("2016:06:23 16:32:43.125"))

    def test_a_time_zone_that_the_user_tells(self):
        self.put({"a.jpg": dji_tags(OffsetTimeOriginal=None)})
        result = self.import_stills("--utc-offset-h", -5)
        self.assert_imported(result)
        self.assertNotIn("time zone", result.err)
        self.assertEqual(frames(self.recording)[0]["time_us"], micros("2016:06:23 16:32:43.125", "-05:00"))

    def test_several_pictures_of_one_second(self):
        self.put({f"{i}.jpg": dji_tags(SubSecTimeOriginal=None) for i in range(4)})
        self.assert_imported(self.import_stills(), "4 pictures tell the same second")
        times = [frame["time_us"] for frame in frames(self.recording)]
        self.assertEqual([time - times[0] for time in times], [0, 250_000, 500_000, 750_000])

    def test_no_attitude(self):
        self.put({f"{i}.jpg": dji_tags(DateTimeOriginal=f"2016:06:23 16:32:4{i}", GPSLongitude=91.9936 - i * 1e-4, **UNTOLD)
                  for i in range(3)})
        self.assert_imported(self.import_stills(), "3 of 3 pictures do not tell how the camera looked", "straight down",
                             "3 of 3 pictures tell no heading")
        for _, attitude in messages(self.recording, ATTITUDE, "Ifff"):
            self.assertAlmostEqual(math.degrees(attitude[3]), 90, delta=0.1)  # it flew east
        settings = json.loads((self.recording / "config.json").read_text())
        self.assertEqual(settings["joint"]["sigma_attitude_deg"], 5)

    def test_a_pitch_that_the_user_tells(self):
        self.put({"a.jpg": dji_tags(GPSImgDirection=33.5, **UNTOLD)})
        result = self.import_stills("--gimbal-pitch-deg", -80)
        self.assert_imported(result, "look with a pitch of -80 degrees, to 2 degrees")
        self.assertNotIn("heading", result.err)
        self.assertEqual(json.loads((self.recording / "camera.json").read_text())["mount"]["pitch_deg"], -80)
        (_, attitude), = messages(self.recording, ATTITUDE, "Ifff")
        self.assertAlmostEqual(math.degrees(attitude[3]), 33.5, places=3)

    def test_yaws_that_contradict_each_other(self):
        self.put({"a.jpg": dji_tags(GimbalYawDegree=41), "b.jpg": dji_tags(DateTimeOriginal="2016:06:23 16:32:45")})
        self.assert_imported(self.import_stills(), "1 of 2 pictures tell a camera that looks to the rear", "a.jpg")

    def test_no_height_above_the_take_off(self):
        self.put({"a.jpg": dji_tags(RelativeAltitude=None)})
        result = self.import_stills()
        self.assert_refused(result, "a.jpg", "no height above the take-off", "above sea level", "--take-off-height-m")
        self.assert_nothing_written()
        self.assert_imported(self.import_stills("--take-off-height-m", 158.41))
        (_, position), = messages(self.recording, POSITION, "Iiiii")
        self.assertEqual(position[4], 40_000)

    def test_a_take_off_as_high_as_the_marks(self):
        self.put({"a.jpg": dji_tags(RelativeAltitude=None)})
        marks = self.write("gcp_list.txt", "EPSG:4326\n-91.9936 46.8428 150.41 10 20 a.jpg 1\n"
                                           "-91.9937 46.8428 152.41 30 40 A.JPG 2\n")
        self.assert_imported(self.import_stills(labels=marks), "as high as the survey's marks, 151.4 m")
        (_, position), = messages(self.recording, POSITION, "Iiiii")
        self.assertEqual(position[4], 47_000)
        truth = json.loads((self.recording / "truth.geojson").read_text())
        self.assertEqual([feature["properties"]["id"] for feature in truth["features"]], ["1", "2"])

    def test_pictures_that_were_zoomed(self):
        self.put({f"{i}.jpg": dji_tags(DateTimeOriginal=f"2016:06:23 16:32:4{i}") for i in range(3)})
        self.put({"3.jpg": dji_tags(DateTimeOriginal="2016:06:23 16:32:43", FocalLengthIn35mmFormat=40)})
        self.assert_imported(self.import_stills(), "1 of 4 pictures have another focal length than most")
        camera = json.loads((self.recording / "camera.json").read_text())
        lines = frames(self.recording)
        self.assertEqual(len(lines), 4)
        self.assertFalse(any("focal_px" in line for line in lines[:3]))
        for told, calibrated in zip(lines[3]["focal_px"], (camera["fx"], camera["fy"])):
            self.assertAlmostEqual(told / calibrated, 40 / 20, places=3)

    def test_pictures_of_two_cameras(self):
        self.put({f"{i}.jpg": dji_tags(DateTimeOriginal=f"2016:06:23 16:32:4{i}") for i in range(3)})
        self.put({"other.jpg": dji_tags()}, size=(400, 300))
        self.assert_imported(self.import_stills(), "other.jpg: has another size or lens than most")
        self.assertEqual(len(frames(self.recording)), 3)

    def test_a_camera_that_the_user_calibrated(self):
        self.put({"a.jpg": dji_tags(FocalLengthIn35mmFormat=None)})
        self.assert_refused(self.import_stills(), "a.jpg", "tells no focal length", "--camera")
        camera = {"width": WIDTH, "height": HEIGHT, "fx": 2345.5, "fy": 2345.5, "cx": 1999.5, "cy": 1499.5}
        self.assert_imported(self.import_stills("--camera", self.write("camera.json", camera)))
        self.assertNotIn("sigma_focal_percent", json.loads((self.recording / "config.json").read_text())["joint"]["prior"])
        self.assertEqual(json.loads((self.recording / "camera.json").read_text())["fx"], 2345.5)


class UselessStills(ImportTest):
    """Pictures that are of no use are named with the reason, and never become half a recording."""

    def test_are_left_out_by_name(self):
        self.put({"good.jpg": dji_tags(), "void.jpg": dji_tags(GPSStatus="V"), "turned.jpg": dji_tags(Orientation=6),
                  "timeless.jpg": dji_tags(DateTimeOriginal=None),
                  "nowhere.jpg": dji_tags(GPSLatitude=None, GPSLatitudeRef=None)})
        (self.pictures / "short.jpg").write_bytes((self.pictures / "good.jpg").read_bytes()[:-9000])
        (self.pictures / "text.jpg").write_text("no picture")
        (self.pictures / "empty.jpg").write_bytes(b"")
        self.assert_imported(self.import_stills(), "void.jpg: says that its receiver had no fix",
                             "turned.jpg: is to be turned", "timeless.jpg: tells no time",
                             "nowhere.jpg: tells no position", "short.jpg: is cut short", "text.jpg: is no JPEG",
                             "empty.jpg: is no JPEG", "1 pictures with 1 detections")

    def test_xmp_of_a_megabyte_ends_nothing(self):
        self.put({"good.jpg": dji_tags()})
        jpeg, header = (self.pictures / "good.jpg").read_bytes(), b"http://ns.adobe.com/xap/1.0/\0"
        segment = b"\xff\xe1" + struct.pack(">H", 65002) + header + b"<x>" * ((65000 - len(header)) // 3)
        (self.pictures / "large.jpg").write_bytes(jpeg[:2] + 17 * segment.ljust(65004, b" ") + jpeg[2:])
        self.assert_imported(self.import_stills(), "large.jpg: holds XMP that is no XML")

    def test_alone_leave_nothing_behind(self):
        self.put({"a.jpg": dji_tags(GPSLatitude=None, GPSLongitude=None)})
        self.assert_refused(self.import_stills(), "a.jpg: tells no position", "nothing was written")
        self.assert_nothing_written()

    def test_whose_pixels_cannot_be_read_are_not_taken_for_empty_ground(self):
        self.put({"a.jpg": dji_tags()})
        jpeg = (self.pictures / "a.jpg").read_bytes()
        size = jpeg.rindex(struct.pack(">HH", HEIGHT, WIDTH))  # more pixels than any camera has
        (self.pictures / "a.jpg").write_bytes(jpeg[:size] + struct.pack(">HH", 16000, 21333) + jpeg[size + 4:])
        result = run("geoloc_import", "stills", self.pictures, "--out", self.recording)
        self.assert_refused(result, "a.jpg", "no picture could be looked at")
        self.assert_nothing_written()

    def test_of_a_month_are_no_flight(self):
        self.put({"a.jpg": dji_tags(), "b.jpg": dji_tags(DateTimeOriginal="2016:07:23 16:32:43")})
        self.assert_refused(self.import_stills(), "30.0 days", "import each flight by itself")
        self.assert_nothing_written()

    def test_labels_that_are_wrong_or_of_other_pictures(self):
        self.put({"a.jpg": dji_tags()})
        self.assert_refused(self.import_stills(labels=self.label("b.jpg,1,2")), "none of its pictures is there: b.jpg")
        self.assert_refused(self.import_stills(labels=self.label("a.jpg,1,x")), "labels.csv:2", "v is no number")
        self.assert_refused(self.import_stills("--model", "model.onnx"), "--labels", "--model")
        self.assert_nothing_written()

    def test_a_recording_that_exists_stays(self):
        self.put({"a.jpg": dji_tags()})
        self.assert_imported(self.import_stills())
        before = (self.recording / "frames.jsonl").read_bytes()
        self.assert_refused(self.import_stills(), "recording: exists already")
        self.assertEqual((self.recording / "frames.jsonl").read_bytes(), before)

    def test_an_import_that_is_stopped_leaves_nothing_behind(self):
        self.put({f"{i:03}.jpg": dji_tags() for i in range(60)})
        with Live("geoloc_import", "stills", self.pictures, "--out", self.recording) as running:
            running.wait_for("assumed: ")  # and now it looks into the pictures, which takes it seconds
            self.assertEqual(running.interrupt(), 1)
            running.wait_for("stopped: nothing was written")
        self.assert_nothing_written()

    def test_wrong_commands(self):
        self.assert_refused(run("geoloc_import"), "subcommand")
        self.assert_refused(run("geoloc_import", "stills", "none", "--out", self.recording, "--lables", 1),
                            "there is no option --lables; did you mean --labels?")
        self.assert_refused(run("geoloc_import", "stills", self.folder / "none", "--out", self.recording),
                            self.folder / "none")
        self.assert_nothing_written()


if __name__ == "__main__":
    unittest.main()
