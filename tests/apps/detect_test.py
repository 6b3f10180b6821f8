# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
import struct
import unittest
import zlib

from support import AppTest, run

SOURCE = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"])
# Finds cells of 8 px that are red; they are boxed as 12 x 6 px (tools/fixtures/make_onnx_fixtures.py).
CELLS = SOURCE / "tests/data/onnx/plain.onnx"
PICTURE = SOURCE / "tests/data/detection/targets.jpg"
WIDTH, HEIGHT = 192, 64  # px; scaled by a half for the network
RED, GREY = (255, 0, 0), (114, 114, 114)


def pixels(column, row):
    """Rows of RGB: a red cell of 16 px on grey."""
    return [[RED if (x // 16, y // 16) == (column, row) else GREY for x in range(WIDTH)] for y in range(HEIGHT)]


def png(rows, bits=8):
    """Written without any library, so that nothing is shared with the program."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    scale, form = (257, "H") if bits == 16 else (1, "B")
    lines = b"".join(b"\0" + struct.pack(f">{3 * len(row)}{form}", *(scale * value for pixel in row for value in pixel))
                     for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")


def box_of(column, row):
    return [16 * column + 8 - 12, 16 * row + 8 - 6, 24, 12]


def y4m(cells):
    """An uncompressed video (4:4:4) of ten frames per second."""
    video = b"YUV4MPEG2 W%d H%d F10:1 Ip A1:1 C444\n" % (WIDTH, HEIGHT)
    for cell in cells:
        flat = [pixel for row in pixels(*cell) for pixel in row]
        yuv = {RED: (81, 90, 240), GREY: (114, 128, 128)}
        video += b"FRAME\n" + b"".join(bytes(yuv[pixel][plane] for pixel in flat) for plane in range(3))
    return video


class DetectTest(AppTest):
    def detect(self, *arguments, model=CELLS):
        return run("geoloc_detect", "--model", model, *arguments)

    def put(self, name, content):
        file = self.folder / name
        file.parent.mkdir(exist_ok=True)
        file.write_bytes(content)
        return file

    def assert_boxes(self, line, *cells):
        found = sorted(detection["box"] for detection in line["detections"])
        self.assertEqual(len(found), len(cells), line)
        for box, cell in zip(found, sorted(cells)):
            for value, expected in zip(box, box_of(*cell)):
                self.assertAlmostEqual(value, expected, delta=0.01)


def lines(text):
    return [json.loads(line) for line in text.splitlines()]


class Detections(DetectTest):
    """What geoloc_detect finds and how it reports it."""

    def test_where_nothing_is_found_threshold_and_best_score_are_named(self):
        found_nothing = run("geoloc_detect", PICTURE, "--confidence", 0.999999)
        self.assertEqual(found_nothing.status, 0, found_nothing.err)
        self.assertRegex(found_nothing.err, r"; nothing reached detection.confidence \(0.999999\): the best score below it was (0.9|1.0)\d")
        grey = self.put("grey.png", png(pixels(100, 100)))
        self.assertIn("the best score below it was 0.00", self.detect(grey).err)
        self.assertNotIn("nothing reached", self.detect(self.put("red.png", png(pixels(3, 2)))).err)

    def test_settings_that_have_nothing_to_do_with_the_detector_are_named(self):
        picture = self.put("one.png", png(pixels(3, 2)))
        config = self.write("config.json", {"detection": {"confidence": 0.5}, "joint": {"gate": 9}})
        said = self.detect(picture, "--config", config).err
        self.assertIn("without effect here, since only detection and video are used: joint.gate", said)

    def test_a_picture_is_a_line_of_json(self):
        picture = self.put("one.png", png(pixels(3, 2)))
        result = self.detect(picture, "--json", "-")
        self.assertEqual(result.status, 0, result.err)
        [line] = lines(result.out)
        self.assertEqual(line["image"], str(picture))
        self.assert_boxes(line, (3, 2))
        self.assertEqual(line["detections"][0]["class_name"], "red")
        self.assertEqual(line["detections"][0]["class_id"], 0)
        self.assertIn("1 pictures, 1 with detections, 1 detections", result.err)

    def test_sixteen_bits_are_no_other_picture(self):
        files = [self.put(f"{bits}.png", png(pixels(4, 1), bits)) for bits in (8, 16)]
        eight, sixteen = lines(self.detect(*files, "--json", "-").out)
        self.assertEqual(eight["detections"], sixteen["detections"])

    def test_a_folder_is_its_pictures_by_name(self):
        for number in (2, 0, 1):
            self.put(f"set/{number}.png", png(pixels(2 + number, 1)))
        self.put("set/notes.txt", b"no picture")
        out = self.folder / "found.jsonl"
        result = self.detect(self.folder / "set", "--json", out)
        self.assertEqual((result.status, result.out), (0, ""), result.err)
        found = lines(out.read_text())
        self.assertEqual([pathlib.Path(line["image"]).name for line in found], ["0.png", "1.png", "2.png"])
        for number, line in enumerate(found):
            self.assert_boxes(line, (2 + number, 1))

    def test_a_video_is_a_line_a_frame(self):
        video = self.put("clip.y4m", y4m([(2, 1), (3, 1), (4, 1), (5, 1)]))
        result = self.detect(video, "--json", "-", "--draw", self.folder / "drawn")
        self.assertEqual(result.status, 0, result.err)
        found = lines(result.out)
        self.assertEqual([line["frame"] for line in found], [0, 1, 2, 3])
        for number, line in enumerate(found):
            self.assertAlmostEqual(line["time_s"], 0.1 * number, places=4)
            self.assert_boxes(line, (2 + number, 1))
        self.assertEqual([file.name for file in (self.folder / "drawn").iterdir()], ["clip.mkv"])
        drawn = lines(self.detect(self.folder / "drawn" / "clip.mkv", "--json", "-").out)
        self.assertEqual([line["time_s"] for line in drawn], [0.0, 0.1, 0.2, 0.3])

    def test_without_a_place_for_results_they_are_printed_for_a_person(self):
        result = self.detect(self.put("one.png", png(pixels(3, 2))))
        self.assertRegex(result.out, r"one\.png: 1 found: red \d\.\d\d at 56\.0 40\.0 \(24 x 12 px\)\n")

    def test_drawn_pictures_are_the_pictures_with_something_drawn(self):
        self.put("set/a.png", png(pixels(3, 2)))
        self.put("set/b.jpg", PICTURE.read_bytes())
        result = self.detect(self.folder / "set", "--draw", self.folder / "drawn")
        self.assertEqual((result.status, result.out), (0, ""), result.err)
        drawn = self.folder / "drawn"
        self.assertEqual(sorted(file.name for file in drawn.iterdir()), ["a.png", "b.jpg"])
        again = lines(self.detect(drawn / "a.png", "--json", "-").out)
        self.assertEqual(len(again), 1)
        self.assertNotEqual((drawn / "a.png").read_bytes(), (self.folder / "set/a.png").read_bytes())

    def test_the_default_model_finds_what_the_oracle_finds(self):
        result = run("geoloc_detect", PICTURE, "--confidence", 0.4, "--json", "-")
        self.assertEqual(result.status, 0, result.err)
        found = lines(result.out)[0]["detections"]
        oracle = json.loads(PICTURE.with_suffix(".json").read_text())["detections"]
        self.assertEqual(len(found), len(oracle))

    def test_each_back_end_finds_the_same(self):
        openvino = self.detect(self.put("one.png", png(pixels(3, 2))), "--json", "-", "--backend", "openvino")
        if openvino.status == 2:
            self.assertIn("scripts/openvino.sh", openvino.err)
        else:
            self.assert_boxes(*lines(openvino.out), (3, 2))

    def test_tiles_are_searched_as_well(self):
        # The tile is searched at another scale than the whole image, at which the network's boxes are
        # smaller.
        picture = self.put("one.png", png(pixels(3, 2)))
        result = self.detect(picture, "--json", "-", "--tiles", 2, 1)
        self.assertEqual(result.status, 0, result.err)
        self.assertLess(min(detection["box"][2] for detection in lines(result.out)[0]["detections"]), 20)


class UnusablePictures(DetectTest):
    """Wrong files end with status 2 and a reason."""

    def test_what_is_no_picture_is_named_and_nothing_is_written(self):
        whole = PICTURE.read_bytes()
        out = self.folder / "found.jsonl"
        for name, content in {"empty.jpg": b"", "cut.jpg": whole[:len(whole) // 2], "text.png": b"no picture",
                              "cut.png": png(pixels(3, 2))[:200], "text.mp4": b"no video" * 100}.items():
            with self.subTest(name):
                result = self.detect(self.put(name, content), "--json", out)
                self.assert_refused(result, name)
                self.assertEqual([file for file in self.folder.iterdir() if "jsonl" in file.name], [])

    def test_the_others_are_looked_at_all_the_same(self):
        self.put("set/a.png", png(pixels(3, 2)))
        self.put("set/b.jpg", b"")
        self.put("set/c.png", png(pixels(4, 2)))
        result = self.detect(self.folder / "set", "--json", "-")
        self.assert_refused(result, "b.jpg: is empty", "1 files could not be read")
        found = lines(result.out)
        self.assert_boxes(found[0], (3, 2))
        self.assert_boxes(found[1], (4, 2))

    def test_a_picture_bomb_is_refused_before_it_is_decoded(self):
        def chunk(kind, body):
            return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        side = 32000
        packer = zlib.compressobj()
        lines = b"".join(packer.compress(bytes(1 + 3 * side)) for _ in range(side)) + packer.flush()
        bomb = self.put("bomb.png", b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0))
                        + chunk(b"IDAT", lines) + chunk(b"IEND", b""))
        self.assertLess(bomb.stat().st_size, 4_000_000)
        self.assert_refused(self.detect(bomb), "bomb.png: has 32000 x 32000 pixels")

    def test_wrong_arguments(self):
        picture = self.put("one.png", png(pixels(3, 2)))
        self.put("other/one.png", png(pixels(3, 2)))
        (self.folder / "empty").mkdir()
        self.assert_refused(self.detect(), "INPUT")
        self.assert_refused(self.detect(self.folder / "none.png"), "none.png", "no such file")
        self.assert_refused(self.detect(self.folder / "empty"), "no picture in this folder")
        self.assert_refused(self.detect(picture, "--draw", self.folder), "--draw", "another folder")
        self.assert_refused(self.detect(picture, self.folder / "other", "--draw", self.folder / "drawn"), "one.png")
        self.assert_refused(self.detect(picture, "--tiles", 0, 2), "detection.tile_columns")
        self.assert_refused(self.detect(picture, "--confidence", 2), "detection.confidence")
        self.assert_refused(self.detect(picture, "--input-size", 128, 64), "not open to the 128 x 64 px")
        self.assert_refused(self.detect(picture, "--config", self.write("c.json", {"detection": {"tile": 2}})), "detection.tile")
        self.assert_refused(self.detect(picture, "--json", self.folder / "none" / "found.jsonl"), "none/found.jsonl")
        self.assert_refused(self.detect(picture, model=self.folder / "none.onnx"), "none.onnx")


if __name__ == "__main__":
    unittest.main()
