# SPDX-License-Identifier: Apache-2.0
"""Outputs, read by third-party programs."""
import asyncio
import configparser
import contextlib
import json
import math
import os
import pathlib
import resource
import signal
import socket
import subprocess
import threading
import unittest

import fastkml
import lxml.etree
import pandas
import pykml
import pytak
import takproto

from support import BIN, AppTest, free_port, run

HOSTILE_NAME = "</name><b>&\"';]]>=x,\u0007\u009b" + "\u2603" * 300
EARTH_RADIUS_M = 6.37e6


def distance_m(a, b):
    """Distance between (longitude, latitude) pairs that are near each other."""
    east = math.radians(a[0] - b[0]) * math.cos(math.radians(a[1]))
    return EARTH_RADIUS_M * math.hypot(east, math.radians(a[1] - b[1]))


class Replayed(AppTest):
    """A recording whose class has a hostile name, and its objects from GeoJSON."""

    def setUp(self):
        super().setUp()
        self.recording = self.make_recording()
        (self.recording / "class_names.json").write_text(json.dumps([HOSTILE_NAME]))
        self.objects_file = self.folder / "objects.geojson"

    def replay(self, *arguments, **options):
        result = run("geoloc_replay", self.recording, "--out", self.objects_file, *arguments, **options)
        self.assertEqual(result.status, 0, result.err)
        self.objects = {feature["properties"]["id"]: feature
                        for feature in json.loads(self.objects_file.read_text())["features"]}
        self.assertGreater(len(self.objects), 3)
        return result

    def place(self, object_id):
        return self.objects[object_id]["geometry"]["coordinates"]


class Files(Replayed):
    """Files can be opened in the programs that people use."""

    def test_geojson_by_gdal(self):
        self.replay()
        told = subprocess.run(["ogrinfo", "-al", "-so", self.objects_file], capture_output=True, text=True, check=True).stdout
        self.assertIn(f"Feature Count: {len(self.objects)}", told)
        has_heights = all(len(feature["geometry"]["coordinates"]) == 3 for feature in self.objects.values())
        self.assertIn("Geometry: 3D Point" if has_heights else "Geometry: Point", told)
        self.assertIn('ID["EPSG",4979]' if has_heights else 'ID["EPSG",4326]', told)
        self.assertRegex(told, r"sigma_major_m: Real")

    @unittest.skipUnless((BIN.parent / "share/geoloc/geoids").is_dir(), "was built without a geoid")
    def test_heights_above_the_ellipsoid_by_proj(self):
        self.replay()
        above_sea = "\n".join("{} {} {}".format(*feature["geometry"]["coordinates"][:2], feature["properties"]["height_msl_m"])
                              for feature in self.objects.values())
        told = subprocess.run(["gdaltransform", "-s_srs", "+proj=longlat +datum=WGS84 +geoidgrids=egm96_15.gtx +vunits=m",
                               "-t_srs", "EPSG:4979"], input=above_sea, capture_output=True, text=True, check=True).stdout
        for feature, line in zip(self.objects.values(), told.splitlines(), strict=True):
            height_m = float(line.split()[2])
            self.assertGreater(abs(height_m - feature["properties"]["height_msl_m"]), 1, line)
            self.assertAlmostEqual(height_m, feature["properties"]["height_ellipsoid_m"], delta=0.1)
            self.assertEqual(feature["geometry"]["coordinates"][2], feature["properties"]["height_ellipsoid_m"])

    def test_csv_by_pandas(self):
        self.replay("--csv", self.folder / "objects.csv", "--raw", self.folder / "raw.csv")
        table = pandas.read_csv(self.folder / "objects.csv", parse_dates=["first_seen", "last_seen"])
        self.assertEqual(list(table["id"]), list(self.objects))
        for row in table.itertuples():
            self.assertLess(distance_m((row.longitude_deg, row.latitude_deg), self.place(row.id)), 1e-3)
            self.assertTrue(row.class_name.startswith("</name><b>&\"';]]>=x,\u2603"))
            self.assertGreater(row.last_seen, row.first_seen)
            self.assertAlmostEqual(row.variance_east_m2 + row.variance_north_m2, row.sigma_major_m**2 + row.sigma_minor_m**2,
                                   delta=1e-3)
        raw = pandas.read_csv(self.folder / "raw.csv", parse_dates=["time"])
        self.assertTrue(raw["time"].is_monotonic_increasing)
        self.assertGreater(len(raw), 10 * len(table))

    def test_json_lines_by_pandas(self):
        result = self.replay("--jsonl", "-", "--jsonl", self.folder / "run.jsonl")
        self.assertEqual(result.out, (self.folder / "run.jsonl").read_text())
        lines = pandas.read_json(self.folder / "run.jsonl", lines=True)
        self.assertEqual(len(lines), result.out.count("\n"), "nothing else is on stdout")
        counts = lines["type"].value_counts()
        self.assertEqual(counts["frame"], len((self.recording / "frames.jsonl").read_text().splitlines()))
        self.assertEqual(counts["run"], 1)
        last = lines[lines["type"] == "object"].drop_duplicates("id", keep="last")
        for row in last[last["id"].isin(list(self.objects))].itertuples():
            self.assertLess(distance_m(row.coordinates, self.place(row.id)), 1e-3)

    def test_kml_by_schema_and_libraries(self):
        file = self.folder / "run.kml"
        self.replay("--kml", file)
        with_googles_extension = pathlib.Path(pykml.__file__).parent / "schemas" / "kml22gx.xsd"
        lxml.etree.XMLSchema(file=with_googles_extension).assertValid(lxml.etree.parse(file))

        points, polygons = {}, 0
        (top,) = fastkml.KML.parse(file).features
        folder, trajectory = top.features
        for place in folder.features:
            if place.geometry.geom_type == "Point":
                data = {entry.name: entry.value for entry in place.extended_data.elements}
                points[int(data["id"])] = place
                self.assertLess(distance_m((place.geometry.x, place.geometry.y), self.place(int(data["id"]))), 1e-3)
            else:
                polygons += 1
                self.assert_is_ellipse(place, next(reversed(points)))
        self.assertEqual(set(points), set(self.objects))
        self.assertEqual(polygons, len(points))
        self.assertGreater(len(trajectory.kml_geometry.track_items), 100)

    def assert_is_ellipse(self, place, object_id):
        properties = self.objects[object_id]["properties"]
        centre = self.place(object_id)
        distances = [distance_m(corner, centre) for corner in place.geometry.exterior.coords]
        self.assertAlmostEqual(max(distances), 2 * properties["sigma_major_m"], delta=0.01 + 0.01 * max(distances))
        self.assertAlmostEqual(min(distances), 2 * properties["sigma_minor_m"], delta=0.01 + 0.01 * max(distances))


class Tak(Replayed):
    """Cursor on Target as TAK's own libraries read it."""

    def check_events(self, events):
        latest = {}
        for event in events:
            message = takproto.parse_proto(bytearray(event)).cotEvent
            self.assertEqual(message.type, "a-n-G")
            self.assertEqual(message.how, "m-f")
            self.assertGreater(message.staleTime, message.sendTime)
            latest[message.uid] = message
        self.assertEqual(len({uid.rsplit(".", 1)[0] for uid in latest}), 1, "one run")
        for uid, message in latest.items():
            object_id = int(uid.rsplit(".", 1)[1])
            if object_id not in self.objects:  # merged or deleted after it was sent
                continue
            self.assertLess(distance_m((message.lon, message.lat), self.place(object_id)), 5e-3)
            sigma_m = self.objects[object_id]["properties"]["sigma_major_m"]
            self.assertTrue(1.64 * sigma_m - 0.01 <= message.ce <= 2.15 * sigma_m + 0.01, (message.ce, sigma_m))
            self.assertTrue(message.detail.contact.callsign.startswith("</name><b>&\"';]]>=x,\u2603"))
        self.assertLessEqual(set(self.objects), {int(uid.rsplit(".", 1)[1]) for uid in latest})

    def config(self):
        name = HOSTILE_NAME
        return self.write("config.json", {"cot": {"types": {name: "a-n-G"}}})

    def received_by_pytak(self, config):
        """The events of a replay with that configuration."""
        port = free_port()

        async def listen():
            parser = configparser.ConfigParser()
            parser["pytak"] = {"COT_URL": f"udp+ro://127.0.0.1:{port}"}
            reader, _ = await pytak.protocol_factory(parser["pytak"])
            replay = asyncio.get_running_loop().run_in_executor(
                None, lambda: self.replay("--config", config, "--cot", f"udp://127.0.0.1:{port}"))
            events = []
            while True:
                with contextlib.suppress(asyncio.TimeoutError):
                    data, _ = await asyncio.wait_for(reader.recv(), 0.3)
                    events.append(data)
                    continue
                if replay.done():
                    await replay
                    return events

        return asyncio.run(listen())

    def test_udp_by_pytak(self):
        self.check_events(self.received_by_pytak(self.config()))

    def test_a_camera_looks_at_its_point_of_interest(self):
        """From the vehicle along azimuth, elevation and range; the ground is level."""
        events = [lxml.etree.fromstring(event) for event in
                  self.received_by_pytak(self.write("config.json", {"cot": {"sensor_period_s": 0.001}}))]
        vehicles = [event for event in events if event.get("type") == "a-f-A-M-H-Q"]
        points = [event for event in events if event.get("type") == "b-m-p-s-p-i"]
        self.assertGreater(len(points), 3)
        self.assertEqual(len(vehicles), len(points))
        for vehicle, point in zip(vehicles, points, strict=True):
            self.assertEqual(vehicle.get("start"), point.get("start"))
            self.assertEqual(point.find("detail/link").get("uid"), vehicle.get("uid"))
            sensor = {name: float(vehicle.find("detail/sensor").get(name)) for name in ("azimuth", "elevation", "range", "fov", "vfov")}
            there, here = ([float(event.find("point").get(name)) for name in ("lon", "lat")] for event in (point, vehicle))
            along_m = sensor["range"] * math.cos(math.radians(sensor["elevation"]))
            self.assertAlmostEqual(distance_m(here, there), along_m, delta=0.1)
            north_m, east_m = (along_m * f(math.radians(sensor["azimuth"])) for f in (math.cos, math.sin))
            moved = (here[0] + math.degrees(east_m / EARTH_RADIUS_M / math.cos(math.radians(here[1]))), here[1] + math.degrees(north_m / EARTH_RADIUS_M))
            self.assertLess(distance_m(moved, there), 0.15)
            self.assertAlmostEqual(sensor["range"] * math.sin(math.radians(-sensor["elevation"])), 20, delta=3)
            self.assertAlmostEqual(math.tan(math.radians(sensor["fov"] / 2)) / math.tan(math.radians(sensor["vfov"] / 2)), 1280 / 720, delta=0.01)

    def test_tcp_is_a_stream_of_events(self):
        received = bytearray()
        with socket.create_server(("127.0.0.1", 0)) as server:
            def serve():
                connection, _ = server.accept()
                with connection:
                    while chunk := connection.recv(4096):
                        received.extend(chunk)

            thread = threading.Thread(target=serve)
            thread.start()
            self.replay("--config", self.config(), "--cot", f"tcp://127.0.0.1:{server.getsockname()[1]}")
            thread.join()
        events = [event + b"</event>" for event in bytes(received).split(b"</event>")[:-1]]
        self.check_events(event.strip() for event in events)


class UnharmedBySinks(Replayed):
    """Whatever happens to its outputs, a replay finds byte for byte the same objects, and ends."""

    def setUp(self):
        super().setUp()
        self.replay()
        self.expected = self.objects_file.read_bytes()
        self.objects_file.unlink()

    def tearDown(self):
        self.assertEqual(self.objects_file.read_bytes(), self.expected)
        self.assertEqual(list(self.folder.glob("*.partial-*")), [])

    def test_by_all_of_them(self):
        for option, name in ("--csv", "o.csv"), ("--kml", "o.kml"), ("--jsonl", "o.jsonl"), ("--raw", "r.csv"), ("--picture", "p.svg"):
            self.replay(option, self.folder / name, "--cot", f"udp://127.0.0.1:{free_port()}")
            self.assertTrue((self.folder / name).exists())

    def test_by_readers_that_do_not_read(self):
        nobody_reads = self.folder / "pipe"
        os.mkfifo(nobody_reads)
        with subprocess.Popen([BIN / "geoloc_replay", self.recording, "--out", self.objects_file, "--jsonl", "-", "--jsonl", nobody_reads],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as replay:
            self.assertEqual(replay.wait(60), 1)
            told = replay.stderr.read()
        for target in "-", nobody_reads:
            self.assertIn(f"--jsonl {target}: does not answer, left unfinished", told)

    def test_by_a_dead_tak_server(self):
        self.assertIn("trying again", self.replay("--cot", f"tcp://127.0.0.1:{free_port(socket.SOCK_STREAM)}").err)

    def test_by_a_tak_server_that_never_reads(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            self.replay("--cot", f"tcp://127.0.0.1:{server.getsockname()[1]}")

    def test_by_a_full_disk(self):
        def limit_file_size():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # writes fail, as they do on a full disk
            resource.setrlimit(resource.RLIMIT_FSIZE, (len(self.expected), len(self.expected)))

        result = run("geoloc_replay", self.recording, "--out", self.objects_file, "--kml", self.folder / "run.kml",
                     "--jsonl", self.folder / "run.jsonl", "--csv", "/dev/full", preexec_fn=limit_file_size)
        self.assertEqual(result.status, 1)
        for name in "run.kml", "run.jsonl":
            self.assertRegex(result.err, rf"{name}: cannot be written")
            self.assertFalse((self.folder / name).exists())
        self.assertIn("/dev/full: cannot be written", result.err)


if __name__ == "__main__":
    unittest.main()
