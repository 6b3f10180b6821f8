# SPDX-License-Identifier: Apache-2.0
import json
import unittest

import numpy as np

import geoloc
from split_recording import split_recording
from support import AppTest, run


class PythonFleets(AppTest):
    """Summaries and their map are in Python what the programs make, to the byte."""

    def flights(self):
        """Three short flights over the same targets: their results, and the files of their summaries."""
        results, files = [], []
        for path in (1, 2, 5):
            recording = self.make_recording(f"path{path}", "--flight", f"gnss_path{path}", "--scenario", "2")
            file = self.folder / f"path{path}.fs"
            replayed = run("geoloc_replay", recording, "--summary", file, "--out", self.folder / "objects.geojson")
            self.assertEqual(replayed.status, 0, replayed.err)
            results.append(geoloc.replay(recording))
            files.append(file)
        return results, files

    def test_summaries_and_the_map_are_those_of_the_programs(self):
        results, files = self.flights()
        summaries = [result.flight_summary() for result in results]
        for summary, file in zip(summaries, files):
            self.assertEqual(summary.to_bytes(), file.read_bytes())
            self.assertEqual(geoloc.FlightSummary.read(file).to_bytes(), file.read_bytes())
        told = run("geoloc_fuse", *files, "--class-names", "mark", "--out", self.folder / "program.geojson")
        self.assertEqual(told.status, 0, told.err)
        fused = geoloc.fuse(reversed(summaries), ["mark"])
        fused.to_geojson(self.folder / "python.geojson")
        self.assertEqual((self.folder / "python.geojson").read_bytes(), (self.folder / "program.geojson").read_bytes())
        self.assertIn(fused.table, told.err)
        self.assertGreater(len(fused.objects), 5)
        self.assertGreaterEqual([flight.verdict for flight in fused.flights].count("fused"), 2)

    def test_arrays_hold_what_the_flight_knows(self):
        results, _ = self.flights()
        fused = geoloc.fuse(result.flight_summary() for result in results)
        result, summary = results[0], results[0].flight_summary("mine")
        self.assertEqual((summary.flight, summary.sequence), ("mine", len(result.trajectory) + 1))
        self.assertEqual(list(summary.objects["id"]), list(result.objects["id"]))
        positions, wanted = summary.objects["position_in_enu_m"], result.objects["position_in_enu_m"]
        np.testing.assert_allclose(positions[:, :2], wanted, atol=1e-3)
        shared = summary.shared_error_m
        covariances = summary.objects["own_covariance_m2"] + shared @ shared.transpose(0, 2, 1)
        np.testing.assert_allclose(covariances[:, :2, :2], result.objects["covariance_m2"], rtol=0.03, atol=0.01)
        self.assertTrue((summary.apart[:, 0] < summary.apart[:, 1]).all() and len(summary.apart) > 0)

        made_of = np.bincount(fused.contributions[:, 0], minlength=len(fused.objects))
        self.assertTrue((made_of >= 1).all())
        seen_by = {feature["properties"]["id"]: feature["properties"]["flights"] for feature in fused.geojson()["features"]}
        for place, flights in enumerate(seen_by[number] for number in fused.objects["id"]):
            of_it = fused.contributions[fused.contributions[:, 0] == place]
            self.assertEqual([fused.flights[flight].flight for flight in of_it[:, 1]], flights)

    def test_what_is_no_summary_is_refused_with_the_reason(self):
        result = geoloc.replay(self.make_recording())
        content = result.flight_summary().to_bytes()
        for spoilt, reason in ((b"", "is empty"), (b"nonsense", "is not a flight summary"), (content[:-1], "cut off"), (content[:-9] + b"x" + content[-8:], "checksum"),
                               (b'{"format": 3}', "format")):
            with self.assertRaisesRegex(ValueError, f"message.*{reason}"):
                geoloc.FlightSummary.from_bytes(spoilt, "message")
        document = result.flight_summary().to_json()
        document["objects"][0]["own_covariance_m2"][0][0] = -1.0
        with self.assertRaisesRegex(ValueError, "positive definite"):
            geoloc.FlightSummary.from_bytes(json.dumps(document).encode())
        with self.assertRaisesRegex(ValueError, "letters, digits"):
            result.flight_summary("my flight")
        with self.assertRaisesRegex(ValueError, "quarantine_gate"):
            geoloc.fuse([], quarantine_gate=-1.0)

    def test_the_parts_of_a_flight_name_each_other(self):
        parts = [self.folder / "first", self.folder / "second"]
        split_recording(self.make_recording("whole", "--flight", "gnss_path1", "--scenario", "2"), parts, [0.5])
        summaries = [geoloc.replay(part).flight_summary() for part in parts]
        names = tuple(summary.flight for summary in summaries)
        self.assertEqual([flight.parts for flight in geoloc.fuse(summaries).flights], [names, names])
        document = summaries[0].to_json()
        self.assertEqual(geoloc.FlightSummary.from_bytes(json.dumps(document).encode()).to_bytes(), summaries[0].to_bytes())
        other = geoloc.replay(parts[1]).flight_summary(part_of="tuesday")
        self.assertEqual(other.to_json()["part"]["whole"], "tuesday")
        self.assertEqual([flight.parts for flight in geoloc.fuse([summaries[0], other]).flights], [(), ()])

    def test_where_nothing_is_known_nothing_is_made_up(self):
        self.assertIsNone(geoloc.replay(self.make_recording(), method="paper").flight_summary())
        fused = geoloc.fuse([])
        self.assertEqual((len(fused.objects), fused.flights, fused.origin_deg, fused.geojson()["features"]), (0, [], None, []))


if __name__ == "__main__":
    unittest.main()
