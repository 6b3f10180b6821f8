# SPDX-License-Identifier: Apache-2.0
import fcntl
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

import geoloc
from geoloc import archive
from geoloc.archive import _maps, _workers
from support import PATIENCE_S, AppTest, run, tree


def heartbeats_of(log):
    """A log without anything that tells where the vehicle is."""
    kept, at = b"", 0
    while at < len(log):
        end = at + 8 + 12 + log[at + 9]  # the stamp, MAVLink 2's head and checksum, the content
        kept += log[at:end] if log[at + 15:at + 18] == b"\0\0\0" else b""
        at = end
    return kept


class ArchiveTest(AppTest):
    """A small archive of recordings, `self.archive`, whose results go to `self.out`."""

    FLIGHTS = 3

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="geoloc-test-")
        cls.addClassCleanup(holder.cleanup)
        cls.flown = pathlib.Path(holder.name)
        for path in range(1, 1 + cls.FLIGHTS):
            recording = cls.flown / f"2026/day{path}/flight"
            recording.parent.mkdir(parents=True)
            flown = run("geoloc_sim", "--record", recording, "--start-s", 80, "--end-s", 100, "--flight", f"gnss_path{path}", "--scenario", 2)
            assert flown.status == 0, flown.err
            (recording / "class_names.json").write_text('["mark"]')

    def setUp(self):
        super().setUp()
        self.archive, self.out = self.folder / "archive", self.folder / "out"
        shutil.copytree(self.flown, self.archive)

    def command(self, *options):
        return [sys.executable, "-m", "geoloc.archive", str(self.archive), "--out", str(self.out), *map(str, options)]

    def program(self, *options):
        return subprocess.run(self.command(*options), capture_output=True, text=True, timeout=PATIENCE_S, check=False)

    def run_archive(self, out="out", **options):
        return archive.run([self.archive], self.folder / out, **{"workers": 2, **options})

    def results(self, out="out"):
        """All that must be the same whatever happened on the way."""
        files = tree(self.folder / out)
        return {name: content for name, content in files.items() if name.startswith(("recordings/", "map"))}

    def entry(self, report, name):
        (entry,) = [entry for entry in report.recordings if entry.recording.endswith(name)]
        return entry


class Archives(ArchiveTest):
    """Recordings become objects, summaries and one map; what is done is not done again."""

    def test_results_are_those_of_the_programs(self):
        done = self.program("--workers", 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("3 recordings: 3 done", done.stdout)
        self.assertIn("3 of 3 recordings", done.stderr)
        report = json.loads((self.out / "report.json").read_text())
        summaries = []
        for entry in report["recordings"]:
            objects, summary = self.folder / "objects.geojson", self.folder / f"{entry['key']}.fs"
            replayed = run("geoloc_replay", entry["recording"], "--out", objects, "--summary", summary)
            self.assertEqual(replayed.status, 0, replayed.err)
            place = self.out / "recordings" / entry["key"]
            self.assertEqual((place / "objects.geojson").read_bytes(), objects.read_bytes())
            self.assertEqual((place / "summary.fs").read_bytes(), summary.read_bytes())
            self.assertIn(json.loads((place / "job.json").read_text())["said"], replayed.err)
            summaries.append(summary)
        fused = run("geoloc_fuse", *summaries, "--class-names", "mark", "--out", self.folder / "map.geojson")
        self.assertEqual(fused.status, 0, fused.err)
        self.assertEqual((self.out / "map.geojson").read_bytes(), (self.folder / "map.geojson").read_bytes())
        self.assertGreaterEqual([flight["verdict"] for flight in report["maps"][0]["flights"]].count("fused"), 2)

    def test_what_is_done_is_kept_wherever_it_lies_now(self):
        first = self.run_archive()
        self.assertEqual([entry.state for entry in first.recordings], ["done"] * 3)
        before = self.results()
        (self.archive / "2026").rename(self.archive / "last year")
        (self.archive / "last year/day1/flight/video.mkv").write_bytes(b"nothing reads it")
        again = self.run_archive()
        self.assertEqual([entry.state for entry in again.recordings], ["kept"] * 3)
        self.assertEqual(self.results(), before)
        other = self.run_archive(settings={"joint": {"gate": 5.0}})
        self.assertEqual([entry.state for entry in other.recordings], ["done"] * 3)
        with open(self.archive / "last year/day2/flight/frames.jsonl", "a") as frames:
            frames.write("\n")
        self.assertEqual([entry.state for entry in self.run_archive().recordings], ["kept", "done", "kept"])

    def test_a_result_that_was_damaged_is_made_anew(self):
        report = self.run_archive()
        before = self.results()
        places = [self.out / "recordings" / entry.key for entry in report.recordings]
        with open(places[0] / "summary.fs", "r+b") as file:
            file.truncate(100)
        (places[1] / "job.json").write_text("[3]")
        (places[2] / "objects.geojson").unlink()
        (self.out / "recordings/.partial-1").mkdir()  # of a worker that was killed
        self.assertEqual([entry.state for entry in self.run_archive().recordings], ["done"] * 3)
        self.assertEqual(self.results(), before)

    def test_recordings_of_one_flight_count_once(self):
        shutil.copytree(self.archive / "2026/day2/flight", self.archive / "copy")
        report = self.run_archive()
        self.assertEqual(report.count("done", "kept"), 4)
        self.assertEqual(len(report.maps[0].flights), 3)
        self.assertEqual(sum(entry.same_as is not None for entry in report.recordings), 1)

    def test_flights_of_different_places_make_a_map_each(self):
        self.run_archive(out="out")
        summaries = [geoloc.FlightSummary.read(file) for file in sorted(self.out.glob("recordings/*/summary.fs"))]
        far = summaries[0].to_json()
        far["origin"]["latitude_deg"] += 1.0
        moved = geoloc.FlightSummary.from_bytes(json.dumps(far).encode())
        near, other = _maps._maps_of(summaries[1:] + [moved], [])
        self.assertEqual({flight.flight for flight in near.flights} ^ {flight.flight for flight in other.flights},
                         {summary.flight for summary in summaries})
        self.assertEqual({flight.verdict for flight in near.flights + other.flights}, {"fused", "alone"})


class ArchiveFaults(ArchiveTest):
    """Whatever fails, fails alone, and whatever is killed changes nothing of the results."""

    def test_hostile_recordings_fail_with_their_reasons_and_the_rest_goes_on(self):
        good = self.run_archive(out="good")
        source = self.archive / "2026/day1/flight"
        spoil = {
            "line": lambda folder: (folder / "frames.jsonl").write_text('{"time_us": -5}\n'),
            "camera": lambda folder: (folder / "camera.json").unlink(),
            "pipe": lambda folder: ((folder / "frames.jsonl").unlink(), os.mkfifo(folder / "frames.jsonl")),
            "config": lambda folder: (folder / "config.json").write_text('{"joint": {"gate": -3}}'),
        }
        reasons = {"line": "frames.jsonl:1", "camera": "camera.json: missing", "pipe": "frames.jsonl: missing", "config": "joint.gate must lie"}
        for name, how in spoil.items():
            shutil.copytree(source, self.archive / name)
            how(self.archive / name)
        shutil.copytree(source, self.archive / "silent")
        (self.archive / "silent/telemetry.tlog").write_bytes(heartbeats_of((source / "telemetry.tlog").read_bytes()))
        (self.archive / os.fsdecode(b"\xff")).symlink_to(source)
        done = self.program("--workers", 2)
        self.assertEqual(done.returncode, 1, done.stderr)
        report = {pathlib.Path(entry["recording"]).name: entry for entry in json.loads((self.out / "report.json").read_text())["recordings"]}
        for name, reason in reasons.items():
            self.assertEqual((report[name]["state"], report[name]["tries"]), ("failed", 3))
            self.assertIn(reason, report[name]["reason"])
            self.assertIn(f"failed 3 times: {self.archive / name}: {report[name]['reason']}", done.stdout)
        self.assertIn("\\udcff: its name is not UTF-8", done.stdout)
        self.assertEqual((report["silent"]["state"], report["silent"]["flight"]), ("done", None))
        self.assertIn("no frame was located", report["silent"]["reason"])
        self.assertEqual((self.out / "map.geojson").read_bytes(), (self.folder / "good/map.geojson").read_bytes())
        self.assertEqual(good.count("done"), self.FLIGHTS)

    def test_workers_that_die_are_tried_again_and_leave_no_trace(self):
        self.run_archive(out="good")
        (self.archive / "deadly").symlink_to(self.archive / "2026/day1/flight")
        work, marks = _workers.work, self.folder / "marks"
        marks.mkdir()

        def die_at_times(task, recording):
            """Each recording's first try dies before its work, its second one after it; one recording's die always."""
            mark = marks / recording.replace("/", "_")
            with open(mark, "a") as file:
                file.write("x")
            tries = mark.stat().st_size
            if tries == 1 or recording.endswith("deadly"):
                (pathlib.Path(task.results) / f".partial-{os.getpid()}").mkdir()
                os.kill(os.getpid(), signal.SIGKILL)
            outcome = work(task, recording)
            if tries == 2:
                os.kill(os.getpid(), signal.SIGSEGV)
            return outcome

        with unittest.mock.patch.object(_workers, "work", die_at_times):
            report = self.run_archive()
        self.assertEqual([(entry.state, entry.tries) for entry in report.recordings], [("kept", 3)] * 3 + [("failed", 3)])
        self.assertIn("killed by SIGKILL", self.entry(report, "deadly").reason)
        self.assertEqual(self.results(), self.results("good"))

    def test_a_driver_that_is_killed_goes_on_when_started_again(self):
        self.run_archive(out="good")
        driver = subprocess.Popen(self.command("--workers", 1), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + PATIENCE_S
        while not list(self.out.glob("recordings/*/job.json")) and time.monotonic() < deadline:
            time.sleep(0.002)
        driver.kill()
        driver.wait()
        done = self.program("--workers", 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        states = [entry["state"] for entry in json.loads((self.out / "report.json").read_text())["recordings"]]
        self.assertIn("kept", states)
        self.assertEqual(self.results(), self.results("good"))

    def test_ctrl_c_leaves_a_report_of_what_is_done(self):
        with unittest.mock.patch.object(_workers, "work", lambda *_: time.sleep(PATIENCE_S)):
            signal.signal(signal.SIGALRM, signal.default_int_handler)
            self.addCleanup(signal.signal, signal.SIGALRM, signal.SIG_DFL)
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            with self.assertRaises(KeyboardInterrupt):
                self.run_archive()
        report = json.loads((self.out / "report.json").read_text())
        self.assertEqual([entry["state"] for entry in report["recordings"]], ["not done"] * 3)
        self.assertFalse((self.out / "map.geojson").exists())

    def test_a_recording_that_takes_too_long_fails(self):
        report = self.run_archive(limit_s=1e-4, tries=1)
        self.assertEqual({(entry.state, entry.tries, entry.reason) for entry in report.recordings}, {("failed", 1, "took longer than 0.0001 s")})

    def test_two_runs_do_not_work_on_the_same_results(self):
        self.out.mkdir()
        with open(self.out / ".lock", "w") as file:
            fcntl.lockf(file, fcntl.LOCK_EX)
            done = self.program()
        self.assertEqual(done.returncode, 2)
        self.assertIn("another run works on", done.stderr)

    def test_what_cannot_be_is_refused_before_anything_starts(self):
        config = self.write("config.json", {"joint": {"gate": -1.0}})
        for options, reason in ((("--config", config), "joint.gate must lie"), (("--config", self.write("list.json", [])), "JSON object"),
                                (("--config", self.write("paper.json", {"method": "paper"})), "method must be"), (("--workers", 0), "above 0"),
                                ((), "nowhere*: is not there")):
            if not options:
                self.archive = self.folder / "nowhere*"
            done = self.program(*options)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(reason, done.stderr)
            self.assertFalse((self.out / "map.geojson").exists())


if __name__ == "__main__":
    unittest.main()
