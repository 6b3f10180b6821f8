# SPDX-License-Identifier: Apache-2.0
"""What stands in the pages' code blocks works with the programs. Programs in them are run by tests of their languages: tests/install, tests/python."""
import functools
import json
import os
import pathlib
import re
import unittest

from support import AppTest, run

SOURCE = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"])
PAGES = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *sorted((SOURCE / "docs").glob("*.md"))]
CONFIGURATIONS = {"flying.md": 3, "mavlink.md": 1, "outputs.md": 1, "settings.md": 1}  # the JSON in these pages, and how much there is
TESTED_ELSEWHERE = {"cpp", "c", "python"}
CALIBRATION = """%YAML:1.0
image_width: 1280
image_height: 720
camera_matrix: !!opencv-matrix {rows: 3, cols: 3, dt: d, data: [900, 0, 639.5, 0, 900, 359.5, 0, 0, 1]}
distortion_coefficients: !!opencv-matrix {rows: 1, cols: 5, dt: d, data: [0, 0, 0, 0, 0]}
"""


def blocks(page):
    """The code blocks of a page as (language, text); the language is empty where none is named."""
    return re.findall(r"^```(\w*)\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


def json_of(page):
    return [json.loads(text) for language, text in blocks(SOURCE / "docs" / page) if language == "json"]


@functools.cache
def options(program):
    """Every option that the program's help names, and that of its commands."""
    commands = [["stills"], ["video"]] if program == "geoloc_import" else [[]]
    helped = "".join(run(program, *command, "--help").out for command in commands)
    return set(re.findall(r"(?<![\w-])--[a-z][\w-]*", helped))


class CodeBlocks(AppTest):
    def test_every_language_is_tested(self):
        for page in PAGES:
            for language, text in blocks(page):
                self.assertIn(language, {"", "sh", "json", *TESTED_ELSEWHERE}, f"{page}: {text}")

    def test_configurations_are_accepted(self):
        (self.folder / "calibration.yaml").write_text(CALIBRATION)
        for page, count in CONFIGURATIONS.items():
            found = json_of(page)
            self.assertEqual(len(found), count, page)
            for config in found:
                (self.folder / "config.json").write_text(json.dumps(config))
                printed = run("geoloc_app", "--config", "config.json", "--print-config", cwd=self.folder)
                self.assertEqual(printed.status, 0, f"{page}: {config}: {printed.err}")

    def test_what_the_page_on_formats_shows_can_be_replayed(self):
        frame, camera, seen = json_of("formats.md")
        self.assertEqual(set(seen), {"image", "detections"})
        flight = self.folder / "flight"
        self.assertEqual(run("geoloc_sim", "--record", flight, "--start-s", "60", "--end-s", "65").status, 0)
        first = json.loads((flight / "frames.jsonl").read_text().splitlines()[0])
        (flight / "frames.jsonl").write_text(json.dumps({**frame, "time_us": first["time_us"]}) + "\n")
        (flight / "camera.json").write_text(json.dumps(camera))
        replayed = run("geoloc_replay", flight)
        self.assertEqual(replayed.status, 0, replayed.err)

    def test_commands_have_options_and_scripts_that_there_are(self):
        seen = 0
        for page in PAGES:
            for language, text in blocks(page):
                if language not in ("", "sh"):
                    continue
                for program, arguments in re.findall(r"\b(geoloc_[a-z]+) ([^|#\n]*)", text.replace("\\\n", " ")):
                    if program not in ("geoloc_app", "geoloc_detect", "geoloc_eval", "geoloc_fuse", "geoloc_import", "geoloc_replay", "geoloc_sim"):
                        continue
                    for option in re.findall(r"(?<![\w-])--[a-z][\w-]*", arguments):
                        seen += 1
                        self.assertIn(option, options(program), f"{page}: {program} {arguments}")
                for script in re.findall(r"\b(?:scripts|tools|bench)/[\w/]+\.(?:sh|py)", text):
                    self.assertTrue((SOURCE / script).exists(), f"{page}: {script}")
        self.assertGreater(seen, 50)


if __name__ == "__main__":
    unittest.main()
