# SPDX-License-Identifier: Apache-2.0
"""A fleet live: flights to a broker, and the service that fuses them, while broker, service and database come and go."""
import json
import os
import subprocess
import time
import unittest

from fleet_servers import Broker, Database, send_retained
from support import PATIENCE_S, AppTest, Live, World, run
from tls_test import Certificates

FLIGHTS = ("gnss_path1", "gnss_path2", "gnss_path3")
OPEN = ("allow_anonymous true",)


class FleetTest(AppTest):
    def recording(self, flight):
        folder = self.folder / flight
        if not folder.exists():
            flown = run("geoloc_sim", "--record", folder, "--flight", flight, "--scenario", 2)
            self.assertEqual(flown.status, 0, flown.err)
        return folder

    def fly(self, flight, url, *options, environment=None):
        """A flight that ends by telling its fleet; its summary is kept beside, as it was told."""
        return run("geoloc_replay", self.recording(flight), "--flight-id", flight, "--mqtt", url, "--summary",
                   self.folder / f"{flight}.fs", "--out", self.folder / f"{flight}.geojson", *options,
                   env={**os.environ, **(environment or {})})

    def map(self):
        return json.loads((self.folder / "map.geojson").read_text())

    def wait_until(self, holds):
        deadline = time.monotonic() + PATIENCE_S
        while not holds():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.1)

    def wait_for_map(self, of_flights):
        """The service's map, once it is of so many flights."""
        file = self.folder / "map.geojson"
        self.wait_until(lambda: file.exists() and len(self.map()["flights"]) == of_flights)
        return self.map()

    def serve(self, url, *options, **more):
        return Live("geoloc_fuse", "--mqtt", url, "--every", 0.2, "--out", self.folder / "map.geojson", *options, **more)

    def assert_undisturbed(self, told):
        """The map is that of the same summaries, fused at once from files."""
        files = [self.folder / f"{flight['flight']}.fs" for flight in told["flights"]]
        fused = run("geoloc_fuse", *files, "--out", self.folder / "files.geojson")
        self.assertEqual(fused.status, 0, fused.err)
        expected = json.loads((self.folder / "files.geojson").read_text())
        self.assertEqual(told["flights"], expected["flights"])
        places = [sorted(feature["geometry"]["coordinates"] for feature in map_["features"]) for map_ in (told, expected)]
        self.assertEqual(*places)


class LiveFleet(FleetTest):
    def test_the_map_is_the_same_whoever_was_killed_in_between(self):
        state = self.folder / "state"
        with Broker(self.folder, *OPEN) as broker:
            url = f"mqtt://127.0.0.1:{broker.port}/club"
            with self.serve(url, "--state", state) as service:
                self.assertEqual(self.fly(FLIGHTS[0], url).status, 0)
                ids = {feature["properties"]["id"]: feature["geometry"]["coordinates"] for feature in
                       self.wait_for_map(1)["features"]}
                os.kill(service.process_id, 9)
            self.assertEqual(self.fly(FLIGHTS[1], url).status, 0)  # the broker keeps it
            with self.serve(url, "--state", state) as service:
                self.wait_for_map(2)
                broker.kill()  # with all that it has kept
                service.wait_for("trying again")
                broker.start()
                told = self.fly(FLIGHTS[2], url)
                self.assertIn("fleet: 1 summaries delivered", told.err)
                self.wait_for_map(3)
                self.wait_until(lambda: len(list(state.glob("*.fs"))) == 3)
                os.kill(service.process_id, 9)
            broker.kill()
            broker.start()
            (self.folder / "map.geojson").unlink()
            with self.serve(url, "--state", state) as service:
                self.assertEqual(self.wait_for_map(3)["method"], "fused")
                self.assertEqual(service.interrupt(), 0)
        self.assert_undisturbed(self.map())
        now = {feature["properties"]["id"]: feature["geometry"]["coordinates"] for feature in self.map()["features"]}
        self.assertTrue(set(ids) <= set(now), "ids are kept over restarts")
        for object_id, place in ids.items():  # and mean the same objects: 5e-5 degrees are 5 m, as far as a receiver may be off
            self.assertTrue(all(abs(a - b) < 3e-5 for a, b in zip(place[:2], now[object_id][:2])), object_id)

    def test_what_is_no_summary_is_refused_and_counted(self):
        with Broker(self.folder, *OPEN) as broker, self.serve(f"mqtt://127.0.0.1:{broker.port}/club") as service:
            url = f"mqtt://127.0.0.1:{broker.port}/club"
            self.assertEqual(self.fly(FLIGHTS[0], url).status, 0)
            self.wait_for_map(1)
            good = (self.folder / f"{FLIGHTS[0]}.fs").read_bytes()
            send_retained(broker.port, "geoloc/v1/club/intruder/summary", good)
            service.wait_for("a summary was refused: .*is of another flight")
            send_retained(broker.port, f"geoloc/v1/club/{FLIGHTS[0]}/summary", good[:-1] + b"?")
            service.wait_for("a summary was refused: .*checksum")
            send_retained(broker.port, "geoloc/v1/club/b/summary", os.urandom(300))
            service.wait_for("a summary was refused: .*is not a flight summary")
            service.wait_for("summaries: 1 taken, 0 repeated, 3 refused")
            self.assertEqual(service.interrupt(), 0)
        self.assert_undisturbed(self.map())

    def test_a_live_flight_tells_its_fleet(self):
        world = World()
        with Broker(self.folder, *OPEN) as broker:
            url = f"mqtt://127.0.0.1:{broker.port}/club"
            with world.watch("--mqtt", url, "--flight-id", "live", "--summary", self.folder / "live.fs", "--out",
                             self.folder / "live.geojson") as app:
                with world.fly("--start-s", 80, "--end-s", 95, "--speed", 3) as drone:
                    self.assertEqual(drone.wait(), 0, drone.lines)
                app.wait_for("objects [1-9].*fleet: [1-9]")  # in the status, while it flies
                self.assertEqual(app.interrupt(), 0, app.lines)
            with self.serve(url) as service:
                self.wait_for_map(1)
                self.assertEqual(service.interrupt(), 0)
        self.assert_undisturbed(self.map())
        self.assertGreater(len(self.map()["features"]), 0)

    def test_a_flight_without_its_broker_ends_and_says_what_was_lost(self):
        told = self.fly(FLIGHTS[0], "mqtt://127.0.0.1:1/club")
        self.assertEqual(told.status, 1, told.err)
        self.assertIn("the last summary was not delivered", told.err)
        self.assertTrue((self.folder / f"{FLIGHTS[0]}.geojson").exists())


class ProtectedFleet(FleetTest):
    def setUp(self):
        super().setUp()
        self.certificates = Certificates(self.folder)
        self.certificates.issue("server")
        self.password_file = self.write("password", "correct horse\n")
        self.password_file.chmod(0o600)
        subprocess.run(["mosquitto_passwd", "-b", "-c", self.folder / "users", "drone", "correct horse"], check=True,
                       capture_output=True)
        self.settings = (f"cafile {self.folder / 'ca.pem'}", f"certfile {self.folder / 'server.pem'}",
                         f"keyfile {self.folder / 'server.key'}", f"password_file {self.folder / 'users'}",
                         "allow_anonymous false")

    def test_a_broker_with_tls_and_passwords(self):
        other = Certificates(self.folder, "stranger")
        with Broker(self.folder, *self.settings) as broker:
            url = f"mqtts://drone@127.0.0.1:{broker.port}/club"
            trusted = ("--mqtt-ca", self.folder / "ca.pem")
            with self.serve(url, *trusted, "--mqtt-password-file", self.password_file) as service:
                told = self.fly(FLIGHTS[0], url, *trusted, environment={"GEOLOC_MQTT_PASSWORD": "correct horse"})
                self.assertEqual(told.status, 0, told.err)
                self.wait_for_map(1)
                self.assertEqual(service.interrupt(), 0)
            self.assert_undisturbed(self.map())
            told = self.fly(FLIGHTS[0], url, *trusted, environment={"GEOLOC_MQTT_PASSWORD": "wrong"})
            self.assertEqual(told.status, 1)
            self.assertRegex(told.err, "(?i)not authori[sz]ed|bad user")
            told = self.fly(FLIGHTS[0], url, "--mqtt-ca", self.folder / f"{other.authority}.pem",
                            environment={"GEOLOC_MQTT_PASSWORD": "correct horse"})
            self.assertEqual(told.status, 1)
            self.assertIn("certificate verify failed", told.err)

    def test_a_broker_that_wants_certificates(self):
        self.certificates.issue("drone")
        settings = [line for line in self.settings if "password_file" not in line and "anonymous" not in line]
        with Broker(self.folder, *settings, "require_certificate true", "use_identity_as_username true") as broker:
            url = f"mqtts://127.0.0.1:{broker.port}/club"
            trusted = ("--mqtt-ca", self.folder / "ca.pem")
            ours = ("--mqtt-cert", self.folder / "drone.pem", "--mqtt-key", self.folder / "drone.key")
            told = self.fly(FLIGHTS[0], url, *trusted, *ours)
            self.assertEqual(told.status, 0, told.err)
            self.assertEqual(self.fly(FLIGHTS[0], url, *trusted).status, 1)

    def test_passwords_that_others_can_read_are_refused(self):
        self.assert_refused(self.fly(FLIGHTS[0], "mqtts://drone:secret@127.0.0.1/club"), "--mqtt-password-file")
        self.password_file.chmod(0o644)
        self.assert_refused(self.fly(FLIGHTS[0], "mqtts://drone@127.0.0.1/club", "--mqtt-password-file", self.password_file),
                            "chmod 600")
        self.assert_refused(run("geoloc_fuse", "--postgis", "postgresql://me:secret@127.0.0.1/map"), "PGPASSWORD")


class FleetInADatabase(FleetTest):
    def test_objects_keep_their_rows_whatever_is_restarted(self):
        with Database(self.folder) as database, Broker(self.folder, *OPEN) as broker:
            url = f"mqtt://127.0.0.1:{broker.port}/club"
            with self.serve(url, "--postgis", database.url) as service:
                self.assertEqual(self.fly(FLIGHTS[0], url).status, 0)
                self.wait_for_rows(database, 1)
                first = self.rows(database)
                database.stop()
                self.assertEqual(self.fly(FLIGHTS[1], url).status, 0)
                service.wait_for("--postgis 127.0.0.1/postgres: ")
                os.kill(service.process_id, 9)
            broker.kill()  # and what it kept is lost: the second flight is nowhere but with itself
            broker.start()
            with self.serve(url, "--postgis", database.url) as service:
                service.wait_for("trying again")
                database.start()
                for flight in FLIGHTS[1:]:
                    self.assertEqual(self.fly(flight, url).status, 0)
                self.wait_for_rows(database, 3)
                self.assertEqual(service.interrupt(), 0)
            self.assert_undisturbed(self.map())
            rows = self.rows(database)
            present = {key for key, row in rows.items() if row[0] == "present"}
            self.assertEqual(present, {feature["properties"]["id"] for feature in self.map()["features"]})
            for feature in self.map()["features"]:
                _, longitude, latitude, *_ = rows[feature["properties"]["id"]]
                self.assertEqual([float(longitude), float(latitude)], feature["geometry"]["coordinates"][:2])
            self.assertTrue(set(first) <= set(rows))
            moved = database.ask("SELECT max(ST_Distance(h.position, o.position)) FROM geoloc.history h JOIN geoloc.objects o "
                                 "USING (fleet, id)")
            self.assertLess(float(moved[0][0]), 3.0)  # a row is one object's for ever
            self.assertGreater(len(database.ask("SELECT 1 FROM geoloc.history")), len(rows))
            seen = subprocess.run(["ogrinfo", "-so", f"PG:host=127.0.0.1 port={database.port} user=postgres dbname=postgres",
                                   "geoloc.objects"], check=True, capture_output=True, text=True).stdout
            self.assertIn("Geometry: Point", seen)  # GDAL, and so QGIS, opens the table
            self.assertIn(f"Feature Count: {len(rows)}", seen)
            verdicts = database.ask("SELECT flight, verdict, error_east_m FROM geoloc.flights ORDER BY flight")
            self.assertEqual([row[:2] for row in verdicts], [[flight, "fused"] for flight in FLIGHTS])
            self.assertEqual(run("geoloc_fuse", "--postgis", database.url, "--fleet", "club", "--out",
                                 self.folder / "map.geojson").status, 0)
            self.assert_undisturbed(self.map())  # of what the database has kept alone

    def rows(self, database):
        return {int(row[0]): row[1:] for row in database.ask(
            "SELECT id, status, round(ST_X(position::geometry)::numeric, 9), round(ST_Y(position::geometry)::numeric, 9) "
            "FROM geoloc.objects WHERE fleet = 'club' ORDER BY id")}

    def wait_for_rows(self, database, of_flights):
        self.wait_until(lambda: database.ask("SELECT to_regclass('geoloc.flights')") != [[""]] and
                        len(database.ask("SELECT 1 FROM geoloc.flights")) == of_flights)


if __name__ == "__main__":
    unittest.main()
