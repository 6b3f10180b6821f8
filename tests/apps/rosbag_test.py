# SPDX-License-Identifier: Apache-2.0
"""Bags of ROS 2 (--rosbag), read by MCAP's own reader and by rosbags, neither of which needs ROS."""
import collections
import csv
import json
import math
import unittest

import numpy
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from support import AppTest, run

HOSTILE_NAME = "</name><b>&\"';\u0007\u009b" + "\u2603" * 300
TYPES = {"/geoloc/origin": "sensor_msgs/msg/NavSatFix", "/geoloc/vehicle": "sensor_msgs/msg/NavSatFix", "/geoloc/fixes": "sensor_msgs/msg/NavSatFix",
         "/geoloc/objects": "sensor_msgs/msg/NavSatFix", "/geoloc/trajectory": "geometry_msgs/msg/PointStamped",
         "/geoloc/markers": "visualization_msgs/msg/MarkerArray"}


def utc_s(stamp):
    return stamp.sec + 1e-9 * stamp.nanosec


class Bags(AppTest):
    def setUp(self):
        super().setUp()
        self.recording = self.make_recording()
        (self.recording / "class_names.json").write_text(json.dumps([HOSTILE_NAME]))
        self.bag = self.folder / "run.mcap"
        objects, self.raw = self.folder / "objects.geojson", self.folder / "raw.csv"
        replayed = run("geoloc_replay", self.recording, "--out", objects, "--raw", self.raw, "--rosbag", self.bag)
        self.assertEqual(replayed.status, 0, replayed.err)
        self.objects = {feature["properties"]["id"]: feature for feature in json.loads(objects.read_text())["features"]}
        self.assertGreater(len(self.objects), 3)

    def decoded(self):
        """The messages of each topic, as the definitions in the file itself have them."""
        messages = collections.defaultdict(list)
        with self.bag.open("rb") as stream:
            reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
            for _, channel, message, content in reader.iter_decoded_messages(log_time_order=False):
                messages[channel.topic].append((message.log_time, content))
        return messages

    def test_topics_times_and_counts_are_what_the_index_says(self):
        with self.bag.open("rb") as stream:
            summary = make_reader(stream, validate_crcs=True).get_summary()
        self.assertEqual({channel.topic: summary.schemas[channel.schema_id].name for channel in summary.channels.values()}, TYPES)
        messages = self.decoded()
        self.assertEqual({channel.topic: summary.statistics.channel_message_counts[number] for number, channel in summary.channels.items()},
                         {topic: len(messages[topic]) for topic in TYPES})
        times = sorted(time for topic in messages.values() for time, _ in topic)
        self.assertEqual((summary.statistics.message_start_time, summary.statistics.message_end_time), (times[0], times[-1]))
        for topic in messages.values():
            self.assertEqual([time for time, _ in topic], sorted(time for time, _ in topic))

    def test_objects_are_those_of_the_geojson(self):
        messages = self.decoded()
        self.assertEqual({f"object {number}" for number in self.objects}, {fix.header.frame_id for _, fix in messages["/geoloc/objects"]})
        for _, fix in messages["/geoloc/objects"]:
            feature = self.objects[int(fix.header.frame_id.split()[1])]
            self.assertAlmostEqual(fix.longitude, feature["geometry"]["coordinates"][0], delta=1e-9)
            self.assertAlmostEqual(fix.latitude, feature["geometry"]["coordinates"][1], delta=1e-9)
            properties = feature["properties"]
            ellipsoid_m = properties.get("height_ellipsoid_m")
            self.assertTrue(math.isnan(fix.altitude) if ellipsoid_m is None else abs(fix.altitude - ellipsoid_m) < 1e-3)
            sigmas = numpy.sqrt(numpy.linalg.eigvalsh(numpy.reshape(fix.position_covariance, (3, 3))[:2, :2]))
            numpy.testing.assert_allclose(sigmas, [properties["sigma_minor_m"], properties["sigma_major_m"]], atol=1e-4)
            self.assertEqual(fix.position_covariance_type, 1)

    def test_raw_fixes_are_those_of_the_csv(self):
        fixes = self.decoded()["/geoloc/fixes"]
        with self.raw.open() as stream:
            told = list(csv.DictReader(stream))
        self.assertEqual(len(fixes), len(told))
        for (_, fix), row in zip(fixes, told, strict=True):
            self.assertAlmostEqual(fix.latitude, float(row["latitude_deg"]), delta=1e-9)
            self.assertAlmostEqual(fix.longitude, float(row["longitude_deg"]), delta=1e-9)
            self.assertEqual(fix.header.frame_id, f"object {row['object_id']}" if row["object_id"] else "no object")

    def test_markers_stand_where_the_objects_are(self):
        messages = self.decoded()
        ((_, origin),) = messages["/geoloc/origin"]
        shown = [marker for _, array in messages["/geoloc/markers"] for marker in array.markers]
        self.assertEqual({marker.header.frame_id for marker in shown}, {"map"})
        ellipses = {marker.id: marker for marker in shown if marker.ns == "ellipses"}
        names = {marker.id: marker.text for marker in shown if marker.ns == "names"}
        self.assertEqual(set(ellipses), set(self.objects))
        for number, marker in ellipses.items():
            properties = self.objects[number]["properties"]
            longitude, latitude = self.objects[number]["geometry"]["coordinates"][:2]
            north_m = math.radians(latitude - origin.latitude) * 6.37e6
            east_m = math.radians(longitude - origin.longitude) * 6.37e6 * math.cos(math.radians(latitude))
            self.assertAlmostEqual(marker.pose.position.x, east_m, delta=0.01 * abs(east_m) + 0.01)
            self.assertAlmostEqual(marker.pose.position.y, north_m, delta=0.01 * abs(north_m) + 0.01)
            self.assertAlmostEqual(marker.pose.position.z, properties["height_above_home_m"], delta=1e-3)
            self.assertAlmostEqual(marker.scale.x, 4 * properties["sigma_major_m"], delta=1e-3)
            turned_deg = math.degrees(2 * math.atan2(marker.pose.orientation.z, marker.pose.orientation.w))
            self.assertAlmostEqual((90 - turned_deg - properties["sigma_azimuth_deg"] + 90) % 180 - 90, 0, delta=0.1)
            self.assertEqual(names[number], HOSTILE_NAME.translate({7: None, 0x9b: None}) + f" {number}")
        (line,) = [marker for marker in shown if marker.ns == "trajectory"]
        self.assertEqual([(point.x, point.y, point.z) for point in line.points],
                         [(at.point.x, at.point.y, at.point.z) for _, at in messages["/geoloc/trajectory"]])
        self.assertEqual(len(line.points), len(messages["/geoloc/vehicle"]))

    def test_rosbags_reads_the_same_by_the_definitions_of_ros(self):
        of_ros = get_typestore(Stores.ROS2_HUMBLE)
        counts = collections.Counter()
        with AnyReader([self.bag], default_typestore=of_ros) as reader:
            for connection, time_ns, raw in reader.messages():
                self.assertEqual(TYPES[connection.topic], connection.msgtype)
                message = of_ros.deserialize_cdr(raw, connection.msgtype)
                self.assertEqual(bytes(of_ros.serialize_cdr(message, connection.msgtype)), bytes(raw), connection.topic)
                counts[connection.topic] += 1
                if connection.topic != "/geoloc/markers":
                    self.assertAlmostEqual(utc_s(message.header.stamp), 1e-9 * time_ns, delta=1e-6)
        self.assertEqual(counts, {topic: len(messages) for topic, messages in self.decoded().items()})

    def test_a_long_flight_has_an_index_by_which_a_part_is_found(self):
        """So many frames that there are several chunks."""
        self.assertEqual(run("geoloc_sim", "--record", self.folder / "long").status, 0)
        self.assertEqual(run("geoloc_replay", self.folder / "long", "--rosbag", self.bag).status, 0)
        with self.bag.open("rb") as stream:
            reader = make_reader(stream, validate_crcs=True)
            summary = reader.get_summary()
            self.assertGreater(len(summary.chunk_indexes), 1)
            begin, end = summary.statistics.message_start_time, summary.statistics.message_end_time
            middle = (begin + end) // 2
            before, after = (sum(1 for _ in reader.iter_messages(starting_at=a, ending_before=b)) for a, b in ((begin, middle), (middle, end + 1)))
        self.assertEqual(before + after, summary.statistics.message_count)
        self.assertGreater(min(before, after), summary.statistics.message_count // 10)


if __name__ == "__main__":
    unittest.main()
