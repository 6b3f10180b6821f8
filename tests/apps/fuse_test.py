# SPDX-License-Identifier: Apache-2.0
import json
import unittest

from split_recording import split_recording
from support import AppTest, rmse_m, run

FLIGHTS = ("gnss_path1", "gnss_path2", "gnss_path3")


class Fleets(AppTest):
    """Several flights over the same targets, from recordings to one map."""

    def summary(self, flight, name, *options):
        """The file of a flight's summary."""
        recording, file = self.folder / flight, self.folder / name
        flown = run("geoloc_sim", "--record", recording, "--flight", flight, "--scenario", "2")
        self.assertEqual(flown.status, 0, flown.err)
        replayed = run("geoloc_replay", recording, "--summary", file, "--out", self.folder / "objects.geojson", *options)
        self.assertEqual(replayed.status, 0, replayed.err)
        return file

    def fuse(self, *arguments):
        fused = run("geoloc_fuse", *arguments)
        self.assertEqual(fused.status, 0, fused.err)
        return fused

    def test_flights_become_one_map(self):
        files = [self.summary(flight, f"{flight}.json", "--flight-id", flight) for flight in FLIGHTS]
        out, again = self.folder / "map.geojson", self.folder / "again.geojson"
        told = self.fuse(*files, "--out", out, "--truth", self.folder / FLIGHTS[0] / "truth.geojson").err
        self.assertIn("found 30 / 30", told)
        self.assertIn("extra 0, merged pairs 0", told)
        document = json.loads(out.read_text())
        self.assertEqual([flight["flight"] for flight in document["flights"]], list(FLIGHTS))
        self.assertEqual({flight["verdict"] for flight in document["flights"]}, {"fused"})
        self.assertEqual(len(document["features"]), 30)
        self.fuse(*reversed(files), *files, "--out", again)
        self.assertEqual(again.read_bytes(), out.read_bytes())

        moved = json.loads(files[1].read_text())
        for thing in moved["objects"]:
            thing["position_in_enu_m"][1] += 6.0
        files[1].write_text(json.dumps(moved))
        told = self.fuse(*files, "--out", out).err
        self.assertRegex(told, r"gnss_path2 +quarantined")
        self.assertRegex(told, r"its objects lie -?\d\.\d m east and [3-8]\.\d m north of where the rest of the fleet")

    def test_two_surveyed_objects_take_out_what_all_receivers_are_off_by(self):
        files = [self.summary(flight, f"{flight}.fs", "--flight-id", flight) for flight in FLIGHTS]
        truth = self.folder / FLIGHTS[0] / "truth.geojson"
        without = rmse_m(self.fuse(*files, "--truth", truth, "--out", self.folder / "map.geojson").err)
        targets = json.loads(truth.read_text())
        targets["features"] = targets["features"][:20:10]
        survey = self.write("survey.geojson", targets)
        out = self.folder / "surveyed.geojson"
        told = self.fuse(*files, "--truth", truth, "--known-points", survey, "--out", out).err
        self.assertIn("found 28 / 28", told)  # the two are not scored
        self.assertLess(rmse_m(told), 0.5 * without)
        document = json.loads(out.read_text())
        self.assertEqual(len(document["features"]), 30)
        for feature in document["features"]:
            self.assertGreater(feature["properties"]["first_seen"], "2000")
            self.assertNotEqual(feature["properties"]["flights"], ["known-points"])

    def test_points_that_no_flight_has_seen_are_not_on_the_map(self):
        file = self.summary(FLIGHTS[0], "one.fs")
        truth = json.loads((self.folder / FLIGHTS[0] / "truth.geojson").read_text())
        for feature in truth["features"]:
            feature["geometry"]["coordinates"][1] += 0.01  # a kilometre
        told = self.fuse(file, "--known-points", self.write("survey.geojson", truth), "--out", self.folder / "map.geojson").err
        self.assertRegex(told, "known-points +alone +30 +0 ")
        self.assertEqual(len(json.loads((self.folder / "map.geojson").read_text())["features"]), 30)

    def replayed_parts(self, *options):
        """The summaries of a flight whose app was started again in the air, as files; that of the whole flight is the last."""
        whole = self.summary(FLIGHTS[0], "whole.json")
        parts = [self.folder / "first", self.folder / "second"]
        split_recording(self.folder / FLIGHTS[0], parts, [0.5])
        files = [part.with_suffix(".fs") for part in parts]
        for part, file in zip(parts, files):
            replayed = run("geoloc_replay", part, "--summary", file, "--out", self.folder / "objects.geojson", *options)
            self.assertEqual(replayed.status, 0, replayed.err)
        return [*files, whole]

    def sigma_m(self, file):
        """Stated 1-sigma of the objects, in the mean."""
        objects = json.loads(file.read_text())["features"]
        return sum(feature["properties"]["sigma_major_m"] for feature in objects) / len(objects)

    def test_halves_of_a_flight_are_the_flight_and_not_two(self):
        first, second, whole = self.replayed_parts()
        truth = self.folder / FLIGHTS[0] / "truth.geojson"
        halves, of_whole = self.folder / "halves.geojson", self.folder / "whole.geojson"
        told = self.fuse(first, second, "--truth", truth, "--out", halves).err
        self.assertIn("found 30 / 30", told)
        self.assertIn("one flight with its other parts", told)
        self.assertLess(abs(rmse_m(told) - rmse_m(self.fuse(whole, "--truth", truth, "--out", of_whole).err)), 0.15)
        document = json.loads(halves.read_text())
        names = [flight["flight"] for flight in document["flights"]]
        for flight in document["flights"]:
            self.assertEqual((flight["verdict"], flight["parts"]), ("alone", names))
        self.assertGreater(self.sigma_m(halves), 0.8 * self.sigma_m(of_whole))  # two flights would state 0.7 of it

    def test_a_user_may_say_what_is_part_of_which_flight(self):
        first, second, _ = self.replayed_parts("--part-of", "tuesday")
        out = self.folder / "map.geojson"
        self.assertIn("one flight with its other parts", self.fuse(first, second, "--out", out).err)
        replayed = run("geoloc_replay", self.folder / "second", "--part-of", "monday", "--summary", second, "--out", self.folder / "objects.geojson")
        self.assertEqual(replayed.status, 0, replayed.err)
        self.assertNotIn("one flight with its other parts", self.fuse(first, second, "--out", out).err)
        refused = run("geoloc_replay", self.folder / "second", "--part-of", "my flight", "--summary", second)
        self.assert_refused(refused, "--part-of my flight", "letters, digits")
        self.assert_refused(run("geoloc_replay", self.folder / "second", "--part-of", "monday"), "--part-of", "--summary")

    def test_both_forms_of_a_summary_say_the_same(self):
        outs = []
        for name in ("one.fs", "one.json"):
            file = self.summary(FLIGHTS[0], name)
            self.fuse(file, "--out", self.folder / f"{name}.geojson")
            outs.append((self.folder / f"{name}.geojson").read_bytes())
            (self.folder / FLIGHTS[0]).rename(self.folder / f"{name}.recording")
        self.assertEqual(*outs)

    def test_what_cannot_be_fused_is_refused_with_the_reason(self):
        text = self.write("notes.txt", "no summary")
        missing = self.folder / "missing.fs"
        refused = run("geoloc_fuse", text, missing, "--out", self.folder / "map.geojson")
        self.assert_refused(refused, f"{text}: is not a flight summary", f"{missing}: cannot be opened")
        self.assertFalse((self.folder / "map.geojson").exists())

    def test_an_input_is_not_written_over(self):
        text = self.write("one.fs", "no summary")
        self.assert_refused(run("geoloc_fuse", text, "--out", text), "is an input of this run")

    def test_the_paper_method_has_no_summary(self):
        recording = self.make_recording("short")
        refused = run("geoloc_replay", recording, "--method", "paper", "--summary", self.folder / "a.fs")
        self.assert_refused(refused, "--summary", "use --method joint")

    def test_a_flight_id_is_a_plain_name(self):
        recording = self.make_recording("short")
        refused = run("geoloc_replay", recording, "--summary", self.folder / "a.fs", "--flight-id", "my flight")
        self.assert_refused(refused, "--flight-id my flight", "letters, digits")


if __name__ == "__main__":
    unittest.main()
