# SPDX-License-Identifier: Apache-2.0
"""geoloc as a camera on a MAVLink network, seen by pymavlink and by MAVSDK."""
import json
import math
import os
import selectors
import socket
import threading
import time
import unittest

os.environ["MAVLINK20"] = "1"  # pymavlink reads it when it is imported
import mavsdk
from mavsdk.plugins.camera import Camera as MavsdkCamera
from mavsdk.plugins.mavlink_direct import MavlinkDirect
from pymavlink import mavutil

from support import PATIENCE_S, AppTest, World, free_port

CAMERA = 105
EARTH_RADIUS_M = 6.37e6
mavlink = mavutil.mavlink


class Router:
    """What mavlink-router does: each datagram goes to all the others. All on the loopback."""

    def __init__(self, vehicle_port, app_port, station_ports):
        self._selector = selectors.DefaultSelector()
        self._peers = {self._bind(vehicle_port): None}  # a vehicle's address is the one it sends from
        for port in (app_port, *station_ports):
            self._peers[self._bind(0)] = ("127.0.0.1", port)
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _bind(self, port):
        end = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        end.bind(("127.0.0.1", port))
        end.setblocking(False)
        self._selector.register(end, selectors.EVENT_READ)
        return end

    def _run(self):
        while not self._ends.is_set():
            for key, _ in self._selector.select(0.1):
                try:
                    data, self._peers[key.fileobj] = key.fileobj.recvfrom(65536)
                except ConnectionRefusedError:  # nobody is listening yet
                    continue
                for end, peer in self._peers.items():
                    if end is not key.fileobj and peer is not None:
                        end.sendto(data, peer)

    def stop(self):
        self._ends.set()
        self._thread.join()
        for end in self._peers:
            end.close()


class Camera(AppTest):
    """A ground station finds the camera, queries it, selects an object, and is told where it is."""

    def setUp(self):
        super().setUp()
        self.world = World()
        vehicle_port, station_port, mavsdk_port = free_port(), free_port(), free_port()
        router = Router(vehicle_port, self.world.udp_port, (station_port, mavsdk_port))
        self.addCleanup(router.stop)
        self.station = mavutil.mavlink_connection(f"udpin:127.0.0.1:{station_port}", source_system=255, dialect="common")
        self.addCleanup(self.station.close)
        self.mavsdk_port = mavsdk_port
        self.objects_file = self.folder / "objects.geojson"
        self.vehicle = World()
        self.vehicle.udp_port, self.vehicle.rtsp_port = vehicle_port, self.world.rtsp_port

    def watch(self, settings):
        return self.world.watch("--config", self.write("config.json", {"mavlink": settings}), "--out", self.objects_file)

    def fly(self):
        return self.vehicle.fly("--start-s", 80, "--end-s", 120, "--speed", 2)

    def hear(self, message, component=CAMERA, holds=lambda _: True):
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            heard = self.station.recv_match(type=message, blocking=True, timeout=1)
            if heard and heard.get_srcComponent() == component and holds(heard):
                return heard
        self.fail(f"never heard {message} of component {component}")

    def command(self, command, *parameters, component=CAMERA):
        """The result in the camera's answer."""
        filled = (*parameters, *[0] * (7 - len(parameters)))
        self.station.mav.command_long_send(1, component, command, 0, *filled)
        return self.hear("COMMAND_ACK", holds=lambda ack: ack.command == command).result

    def distance_to_nearest_object_m(self, latitude_deg, longitude_deg):
        objects = json.loads(self.objects_file.read_text())["features"]
        east, north = EARTH_RADIUS_M * math.cos(math.radians(latitude_deg)), EARTH_RADIUS_M
        return min(math.hypot(east * math.radians(lon - longitude_deg), north * math.radians(lat - latitude_deg))
                   for lon, lat in (feature["geometry"]["coordinates"][:2] for feature in objects))

    def test_by_pymavlink_and_mavsdk(self):
        with self.watch({"camera": True, "status_text": True}) as app, self.fly():
            heartbeat = self.hear("HEARTBEAT")
            self.assertEqual((heartbeat.type, heartbeat.autopilot), (mavlink.MAV_TYPE_CAMERA, mavlink.MAV_AUTOPILOT_INVALID))
            self.ask_for_what_it_is()
            place = self.hear("CAMERA_TRACKING_GEO_STATUS")
            self.ask_for_its_view()
            self.refuse_what_it_cannot()
            text = self.hear("STATUSTEXT", component=191)
            self.assertRegex(text.text, r"^\S.* \d+: -22\.9\d+, -43\.1\d+$")
            self.see_it_by_mavsdk()
            self.assertEqual(app.interrupt(), 0)
        self.assertEqual(place.tracking_status & mavlink.CAMERA_TRACKING_STATUS_FLAGS_ACTIVE, 1)
        self.assertLess(self.distance_to_nearest_object_m(place.lat / 1e7, place.lon / 1e7), 3.0)
        self.assertTrue(0.0 < place.h_acc < 5.0)
        self.assertTrue(math.isnan(place.vel_n) and 10.0 < place.dist < 100.0)

    def ask_for_what_it_is(self):
        self.assertEqual(self.command(mavlink.MAV_CMD_REQUEST_MESSAGE, mavlink.MAVLINK_MSG_ID_CAMERA_INFORMATION), 0)
        information = self.hear("CAMERA_INFORMATION")
        self.assertEqual((information.resolution_h, information.resolution_v), (1280, 720))
        self.assertEqual(information.flags, mavlink.CAMERA_CAP_FLAGS_HAS_TRACKING_POINT
                         | mavlink.CAMERA_CAP_FLAGS_HAS_TRACKING_GEO_STATUS)
        self.assertEqual(bytes(information.vendor_name).rstrip(b"\0"), b"geoloc")

    def ask_for_its_view(self):
        self.assertEqual(self.command(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, mavlink.MAVLINK_MSG_ID_CAMERA_FOV_STATUS, 2e5), 0)
        view = self.hear("CAMERA_FOV_STATUS")
        self.hear("CAMERA_FOV_STATUS")
        self.assertAlmostEqual(view.hfov, 70.0, delta=0.1)
        self.assertAlmostEqual((view.alt_camera - view.alt_image) / 1e3, 20.0, delta=2.0)
        self.assertAlmostEqual(sum(value**2 for value in view.q), 1.0, places=5)
        # Zero rotation looks north. This camera looks down: its forward axis points down.
        w, x, y, z = view.q
        self.assertGreater(2 * (x * z - w * y), 0.8)
        self.assertEqual(self.command(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, mavlink.MAVLINK_MSG_ID_CAMERA_FOV_STATUS, -1), 0)

    def refuse_what_it_cannot(self):
        self.assertEqual(self.command(mavlink.MAV_CMD_IMAGE_START_CAPTURE, 0, 0, 1), mavlink.MAV_RESULT_UNSUPPORTED)
        self.assertEqual(self.command(mavlink.MAV_CMD_REQUEST_MESSAGE, math.nan), mavlink.MAV_RESULT_UNSUPPORTED)
        self.assertEqual(self.command(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, 276, math.nan), mavlink.MAV_RESULT_DENIED)
        self.assertEqual(self.command(mavlink.MAV_CMD_CAMERA_TRACK_POINT, -5, 7), mavlink.MAV_RESULT_DENIED)
        self.assertEqual(self.command(mavlink.MAV_CMD_CAMERA_STOP_TRACKING), mavlink.MAV_RESULT_ACCEPTED)

    def see_it_by_mavsdk(self):
        told = threading.Event()
        places = []

        def on_place(message, _):
            places.append(message)
            told.set()

        station = mavsdk.Mavsdk(mavsdk.Configuration.create_with_component_type(mavsdk.ComponentType.GROUND_STATION))
        self.addCleanup(station.destroy)
        station.add_any_connection(f"udpin://127.0.0.1:{self.mavsdk_port}")
        system = station.first_autopilot(PATIENCE_S)
        self.assertIsNotNone(system)
        direct, camera = MavlinkDirect(system), MavsdkCamera(system)
        direct.subscribe_message("CAMERA_TRACKING_GEO_STATUS", on_place)
        deadline = time.monotonic() + PATIENCE_S
        while not (cameras := camera.camera_list().cameras) and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertEqual([(found.component_id, found.vendor_name) for found in cameras], [(CAMERA, "geoloc")])
        self.assertEqual(cameras[0].horizontal_resolution_px, 1280)
        self.assertTrue(told.wait(PATIENCE_S))
        place = json.loads(places[0].fields_json)
        self.assertAlmostEqual(place["lat"] / 1e7, -22.906, delta=0.002)
        self.assertAlmostEqual(place["lon"] / 1e7, -43.133, delta=0.002)

    def test_unless_asked_for_it_is_no_camera_and_says_nothing(self):
        with self.watch({}) as app, self.fly():
            app.wait_for("objects [1-9]")
            heard = set()
            while message := self.station.recv_match(type=["HEARTBEAT", "STATUSTEXT", "CAMERA_TRACKING_GEO_STATUS"]):
                heard.add((message.get_type(), message.get_srcComponent()))
            self.assertEqual(heard, {("HEARTBEAT", 1), ("HEARTBEAT", 191)})
            self.assertEqual(app.interrupt(), 0)


if __name__ == "__main__":
    unittest.main()
