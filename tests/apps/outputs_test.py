# SPDX-License-Identifier: Apache-2.0
import os
import socket
import stat
import threading
import unittest

from detect_test import DetectTest, lines, pixels, png
from support import AppTest, World, run, tree


def read_fifo(name, into):
    with open(name, "rb") as fifo:
        into.append(fifo.read())


class OutputPlaces(DetectTest):
    """One rule for all programs: a device, FIFO or socket is written to, a link is followed, an input is refused."""

    def setUp(self):
        super().setUp()
        self.picture = self.put("one.png", png(pixels(3, 2)))

    def assert_found(self, text):
        [line] = lines(text)
        self.assert_boxes(line, (3, 2))

    def test_a_device_stays_a_device(self):
        """The null device, as a node of the test's own: made by root, and never /dev/null itself."""
        device = self.folder / "null"
        try:
            os.mknod(device, 0o666 | stat.S_IFCHR, os.makedev(1, 3))
            device.write_bytes(b"")
        except PermissionError:
            self.skipTest("device nodes cannot be made or used here")
        self.assertEqual(self.detect(self.picture, "--json", device).status, 0)
        self.assertTrue(stat.S_ISCHR(device.stat().st_mode))

    def test_a_fifo_is_written_to_and_stays_one(self):
        fifo = self.folder / "fifo"
        os.mkfifo(fifo)
        read = []
        reader = threading.Thread(target=read_fifo, args=(fifo, read), daemon=True)
        reader.start()
        self.assertEqual(self.detect(self.picture, "--json", fifo).status, 0)
        reader.join(60)
        self.assert_found(read[0].decode())
        self.assertTrue(stat.S_ISFIFO(fifo.stat().st_mode))

    def test_a_socket_is_written_to(self):
        name = self.folder / "socket"
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(str(name))
            server.listen()
            server.settimeout(60)
            result = self.detect(self.picture, "--json", name)
            self.assertEqual(result.status, 0, result.err)
            connection, _ = server.accept()
            with connection, connection.makefile() as text:
                self.assert_found(text.read())
        self.assertTrue(stat.S_ISSOCK(name.stat().st_mode))

    def test_standard_output_by_its_name_is_written_to(self):
        link = self.folder / "stdout"  # as /dev/stdout is one, which a faulty program would replace
        link.symlink_to("/proc/self/fd/1")
        result = self.detect(self.picture, "--json", link)
        self.assertEqual(result.status, 0, result.err)
        self.assert_found(result.out)

    def test_a_link_is_followed_to_a_file_or_to_none_yet(self):
        target, link, far_link = self.folder / "target.jsonl", self.folder / "link", self.folder / "far"
        link.symlink_to("target.jsonl")
        far_link.symlink_to(link)
        for old in (None, "old"):
            with self.subTest(old=old):
                if old:
                    target.write_text(old)
                self.assertEqual(self.detect(self.picture, "--json", far_link).status, 0)
                self.assertTrue(link.is_symlink() and far_link.is_symlink())
                self.assert_found(target.read_text())
        self.assertEqual({file.name for file in self.folder.iterdir()}, {"one.png", "target.jsonl", "link", "far"})

    def test_an_input_is_never_written_to(self):
        link, twin = self.folder / "link", self.folder / "twin"
        link.symlink_to("one.png")
        twin.hardlink_to(self.picture)
        config = self.write("config.json", {"detection": {}})
        before = tree(self.folder)
        for output in self.picture, link, twin, self.folder / "x" / ".." / "one.png":
            with self.subTest(output):
                (self.folder / "x").mkdir(exist_ok=True)
                self.assert_refused(self.detect(self.picture, "--json", output), output, "input of this run", "INPUT")
        self.assert_refused(self.detect(self.picture, "--config", config, "--json", config), "input of this run", "--config")
        drawn = self.folder / "drawn"
        drawn.mkdir()
        (drawn / "one.png").symlink_to(self.picture)
        self.assert_refused(self.detect(self.picture, "--draw", drawn), "--draw", "input of this run")
        (drawn / "one.png").unlink()
        self.assertEqual(tree(self.folder), before)


class OutputsOfRuns(AppTest):
    """A flight does not begin with an output that could not be written at its end."""

    def test_a_replay_writes_by_the_same_rule(self):
        recording = self.make_recording()
        before = tree(recording)
        self.assert_refused(run("geoloc_replay", recording, "--out", recording / "truth.geojson"), "input of this run")
        self.assert_refused(run("geoloc_replay", recording, "--jsonl", recording / "frames.jsonl"), "input of this run")
        self.assert_refused(run("geoloc_replay", recording, "--csv", self.folder / "a", "--kml", self.folder / "a"),
                            "--kml", "--csv too")
        self.assertEqual(tree(recording), before)

        target, link = self.folder / "objects.geojson", self.folder / "link"
        link.symlink_to(target)
        frames, frames_link = self.folder / "frames.jsonl", self.folder / "frames"
        frames_link.symlink_to(frames)
        result = run("geoloc_replay", recording, "--out", link, "--jsonl", frames_link)
        self.assertEqual(result.status, 0, result.err)
        self.assertTrue(link.is_symlink() and frames_link.is_symlink())
        self.assertIn("FeatureCollection", target.read_text())
        self.assertGreater(len(frames.read_text().splitlines()), 10)

    def test_a_report_does_not_go_into_a_recording(self):
        recording = self.make_recording()
        before = tree(recording)
        self.assert_refused(run("geoloc_eval", "--flights", "none", "--sweep", "latency", "--report", recording), "is a recording")
        self.assertEqual(tree(recording), before)

    def test_folders_that_are_not_there_are_named_before_anything_starts(self):
        nowhere = self.folder / "nowhere"
        for program, first in ("geoloc_app", World().inputs()), ("geoloc_replay", (self.make_recording(),)):
            with self.subTest(program):
                self.assert_refused(run(program, *first, "--out", nowhere / "a", "--jsonl", nowhere / "b",
                                        "--kml", self.folder), f"--out {nowhere / 'a'}", f"--jsonl {nowhere / 'b'}",
                                    "there is no folder", "is a folder")


if __name__ == "__main__":
    unittest.main()
