# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
import subprocess
import unittest
import urllib.request

from prometheus_client.parser import text_string_to_metric_families

from support import BIN, SOURCE, AppTest, free_port


class Metrics(AppTest):
    """/metrics is read by Prometheus' own client library, and tells what the replay tells at its end."""

    def test_a_replay_is_read_by_prometheus_own_parser(self):
        recording, port = self.make_recording(), free_port()
        command = [BIN / "geoloc_replay", recording, "--http", str(port), "--speed", "0"]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as replay:
            self.addCleanup(replay.kill)
            summary = next(line for line in replay.stderr if line.startswith("found "))
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=10) as answer:
                kind, text = answer.headers["Content-Type"], answer.read().decode()
            replay.kill()
        self.assertEqual(kind, "text/plain; version=0.0.4; charset=utf-8")
        families = {family.name: family for family in text_string_to_metric_families(text)}
        values = {name: family.samples[0].value for name, family in families.items()}
        found, extra, frames, unusable = map(int, re.search(
            r"found (\d+) .* extra (\d+),.* (\d+) frames \((\d+) without", summary).groups())
        self.assertEqual(values["geoloc_objects"], found + extra)
        self.assertEqual(values["geoloc_frames"], frames)
        self.assertEqual(values["geoloc_frames_located"], frames - unusable)
        self.assertAlmostEqual(values["geoloc_latency_seconds"], 0.12, delta=0.05)
        self.assertEqual(families["geoloc_frames"].type, "counter")
        self.assertNotIn("geoloc_video_up", values)  # of live inputs

    def test_every_figure_is_in_the_pages(self):
        source = (pathlib.Path(SOURCE) / "src/io/live_page/metrics.cpp").read_text()
        names = re.findall(r'metrics\.(?:gauge|counter)\("(\w+)"', source)
        page = (pathlib.Path(SOURCE) / "docs/live_page.md").read_text()
        self.assertGreater(len(names), 20)
        self.assertEqual([name for name in names if f"`geoloc_{name}`" not in page], [])


if __name__ == "__main__":
    unittest.main()
