# SPDX-License-Identifier: Apache-2.0
"""The live page of a recording: readable, usable with gloves, and played as its reader wishes; its address for a telephone."""
import json
import os
import re
import signal
import subprocess
import time
import unittest

from browser import HOSTILE_NAME, SCREENS, BrowserTest, url_of
from support import BIN, PATIENCE_S, AppTest, Live, open_terminal, run

try:
    import numpy
    import zxingcpp
except ImportError:
    zxingcpp = None

# Whatever is smaller than a gloved finger can hit, or an eye can read in the sun: its text and size in pixels.
TOO_SMALL = """() => {
  const isShown = (element) => element.checkVisibility() && element.getClientRects().length > 0;
  const all = [...document.querySelectorAll("body *")].filter(isShown);
  const faults = [];
  for (const element of all) {
    const hasText = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
    const size = parseFloat(getComputedStyle(element).fontSize);
    if (hasText && size < 14) faults.push(`text of ${size}: ${element.textContent.trim().slice(0, 40)}`);
    if (!element.matches("a, button, select, summary, label, input:not([type=checkbox]), [data-meaning]")) continue;
    const { width, height } = element.getBoundingClientRect();
    if (width < 44 || height < 44)
      faults.push(`${element.tagName} of ${width} x ${height}: ${(element.id || element.textContent).slice(0, 40)}`);
  }
  return faults;
}"""


class ReplayPage(BrowserTest):
    """What the page promises of a recording: readable, usable with gloves, and played as its reader wishes."""

    def setUp(self):
        super().setUp()
        self.recording = self.make_recording()

    def play(self, *arguments):
        return Live("geoloc_replay", self.recording, "--http", "0", "--out", self.objects_file, *arguments)

    def open_ended(self, replay, screen="desktop_light"):
        """The page of a replay, after its end."""
        replay.wait_for("the page stays at")
        page = self.open_screen(screen, url_of(replay))
        page.wait_for_selector("#objects li[data-id]")
        return page

    def test_nothing_is_too_small_to_read_or_to_hit(self):
        with self.play("--speed", "0") as replay:
            for screen in SCREENS:
                page = self.open_ended(replay, screen)
                for theme in "system", "light", "dark", "sun":
                    page.select_option("#theme", theme)
                    page.locator("#objects li button").first.click()
                    page.wait_for_selector("#selected .place")
                    page.evaluate("document.querySelector('#legend').open = true")
                    self.assertEqual(page.evaluate(TOO_SMALL), [], f"{screen} {theme}")
                    self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth - innerWidth"), 0)
        self.assertEqual(self.faults, [])

    def test_a_theme_is_kept_and_has_its_own_colours(self):
        with self.play("--speed", "0") as replay:
            page = self.open_ended(replay)
            colours = {}
            for theme in "light", "dark", "sun":
                page.select_option("#theme", theme)
                page.reload()
                page.wait_for_selector("#objects li[data-id]")
                self.assertEqual(page.locator("#theme").input_value(), theme)
                colours[theme] = page.evaluate("(({color, backgroundColor}) => color + backgroundColor)(getComputedStyle(document.body))")
            self.assertEqual(len(set(colours.values())), 3, colours)
            self.assertEqual(colours["sun"], "rgb(0, 0, 0)rgb(255, 255, 255)")

    def test_keys_work_at_once_and_numbers_are_explained_by_a_tap(self):
        with self.play("--speed", "0") as replay:
            page = self.open_ended(replay)
            page.keyboard.press("v")
            page.wait_for_selector("#follow[aria-pressed=true]")
            page.keyboard.press("f")
            page.wait_for_selector("#fit[aria-pressed=true]")
            unexplained = page.evaluate("""() => [...document.querySelectorAll(".figures > div, #calibration tr")]
              .filter((figure) => !figure.dataset.meaning).map((figure) => figure.textContent)""")
            self.assertEqual(unexplained, [])
            self.assertEqual(page.locator("#calibration tr").count(), 8)
            page.locator("#calibration tr:has-text(\"Error of the vehicle's height\")").click()
            self.assertIn("not an altitude", page.locator("dialog[open]").inner_text())
            page.locator("dialog button").click()
            self.assertEqual(page.locator("dialog[open]").count(), 0)

    def test_one_false_object_does_not_shrink_the_view(self):
        with self.play("--speed", "0") as replay:
            page = self.open_ended(replay)
            kept = page.evaluate("""async () => {
              const { typical } = await import("/projection.js");
              const field = [...Array(30).keys()].map((i) => [i % 6 * 10, Math.floor(i / 6) * 10]);
              const lone = typical([...field, [9000, -4000]]);
              return [lone.length, typical(field).length, typical([[0, 0], [500, 0]]).length];
            }""")
            self.assertEqual(kept, [30, 30, 2])

    def test_the_list_tells_all_without_a_click_the_newest_first(self):
        with self.play("--speed", "0") as replay:
            page = self.open_ended(replay)
            rows = page.locator("#objects li[data-id]:not(.tentative)")
            seen = [int(row.get_attribute("data-id")) for row in rows.all()]
            self.assertEqual(seen, sorted(seen, reverse=True))
            places = {feature["properties"]["id"]: feature["geometry"]["coordinates"][:2]
                      for feature in json.loads(self.objects_file.read_text())["features"]}
            self.assertEqual(set(seen), set(places))
            text = rows.first.inner_text()
            longitude, latitude = places[seen[0]]
            self.assertIn(f"{latitude:.7f}, {longitude:.7f}", text)
            self.assertRegex(text, r"\b[NSEW]{1,2} \d+°, [\d.]+ m from vehicle")
            self.assertRegex(page.locator("#more").inner_text(), r"\d+ more")
            page.select_option("#sigma-filter", "0.1")
            page.wait_for_function("() => document.querySelector('#object-count').textContent.includes(' of ')")

    def test_ways_lead_from_where_the_reader_stands(self):
        with self.play("--speed", "0") as replay:
            page = self.open_ended(replay)
            page.context.grant_permissions(["geolocation"])
            longitude, latitude = json.loads(self.objects_file.read_text())["features"][0]["geometry"]["coordinates"][:2]
            page.context.set_geolocation({"latitude": latitude, "longitude": longitude})
            self.assertNotIn("from you", page.locator("#objects").inner_text())  # nobody has asked
            page.locator("#own-place").click()
            page.wait_for_selector("#objects li:has-text('0.0 m from you')")

    def test_downloads_are_the_run_as_its_files_tell_it(self):
        with self.play("--speed", "0", "--kml", self.folder / "run.kml") as replay:
            page = self.open_ended(replay)
            for name in "GeoJSON", "KML", "GPX":
                with page.expect_download() as download:
                    page.locator(f"#downloads a:has-text('{name}')").click()
                content = download.value.path().read_text()
                if name == "GPX":
                    self.assertEqual(content.count("<wpt "), len(json.loads(self.objects_file.read_text())["features"]))
                else:
                    file = self.objects_file if name == "GeoJSON" else self.folder / "run.kml"
                    self.assertEqual(content, file.read_text(), name)

    def test_what_an_operator_says_is_kept_in_outputs_and_recording(self):
        with self.play("--speed", "0") as replay:
            page = self.open_ended(replay)
            row = page.locator("#objects li[data-id]:not(.tentative)").first
            chosen = int(row.get_attribute("data-id"))
            row.locator("button").click()
            page.fill("#selected .notes input", HOSTILE_NAME)
            page.keyboard.press("Enter")
            page.locator("#selected button:has-text('Confirm')").click()
            page.wait_for_selector(f"#objects li.confirmed[data-id='{chosen}']:has-text('onerror')")
            self.wait_for_note(chosen, HOSTILE_NAME, "confirmed")
            self.assertEqual(replay.interrupt(), 0)
        self.assertEqual(self.faults, [])
        noted = self.objects_file.read_bytes()
        self.assertEqual(run("geoloc_replay", self.recording, "--out", self.objects_file).status, 0)
        self.assertEqual(self.objects_file.read_bytes(), noted)  # the recording has kept it

    def wait_for_note(self, chosen, name, verdict):
        deadline = time.monotonic() + PATIENCE_S
        while True:
            features = json.loads(self.objects_file.read_text())["features"]
            properties = {feature["properties"]["id"]: feature["properties"] for feature in features}[chosen]
            if properties.get("operator_verdict") == verdict and properties.get("operator_name") == name:
                return
            self.assertLess(time.monotonic(), deadline, properties)
            time.sleep(0.1)

    def test_a_replay_is_paused_and_sought_and_its_results_stay_the_same(self):
        alone = self.folder / "alone.geojson"
        lines = self.folder / "alone.jsonl", self.folder / "watched.jsonl"
        self.assertEqual(run("geoloc_replay", self.recording, "--out", alone, "--jsonl", lines[0]).status, 0)
        with self.play("--speed", "4", "--jsonl", lines[1]) as replay:
            page = self.open_screen("desktop_light", url_of(replay))
            page.wait_for_selector("#objects li[data-id]:not(.tentative)")
            page.wait_for_selector("#layers:has-text('true target')")  # before the end
            page.locator("#pause").click()
            page.wait_for_selector("#pause[aria-label=Play]")
            page.evaluate("""() => {
              const place = document.querySelector("#place");
              place.value = 100;
              place.dispatchEvent(new Event("input"));
              place.dispatchEvent(new Event("change"));
            }""")
            page.wait_for_selector("#replay-time:has-text('0:01 / ')")
            page.select_option("#speed", "20")
            page.locator("#pause").click()
            replay.wait_for("the page stays at")
            self.assertEqual(self.objects_file.read_bytes(), alone.read_bytes())
            self.assertEqual(lines[1].read_bytes(), lines[0].read_bytes())
            page.wait_for_selector("#light-page:has-text('Run ended')")
            page.evaluate("fetch('playback?at=0', {method: 'POST'})")  # and again, after the end
            page.wait_for_selector("#light-page:has-text('Replay')")
            page.wait_for_selector("#light-page:has-text('Run ended')")
            self.assertEqual(self.objects_file.read_bytes(), alone.read_bytes())
            self.assertEqual(replay.interrupt(), 0)
        self.assertEqual(self.faults, [])

    def test_a_new_object_is_signalled_and_leads_to_itself(self):
        with self.play("--speed", "2") as replay:
            page = self.open_screen("phone_light", url_of(replay))
            page.wait_for_selector("#news:not([hidden]):has-text('New: ')")
            page.locator("#sound").click()
            self.assertEqual(page.locator("#sound").get_attribute("aria-pressed"), "true")
            page.locator("#news").click()
            page.wait_for_selector("#selected:not([hidden]) .place")
        self.assertEqual([fault for fault in self.faults if "CONNECTION" not in fault], [])


# A module of a QR code above another one, by the terminal's half blocks.
HALF_BLOCKS = {" ": (255, 255), "▀": (0, 255), "▄": (255, 0), "█": (0, 0)}


class Terminal:
    """A program whose messages go to a terminal; ends with the `with` block."""

    def __init__(self, program, *arguments):
        self._screen, keyboard = open_terminal()
        self._process = subprocess.Popen([BIN / program, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=keyboard)
        os.close(keyboard)
        self.text = ""

    def wait_for(self, words):
        shown = b""
        while words not in self.text:
            piece = os.read(self._screen, 65536)
            shown += piece
            self.text = shown.decode(errors="replace").replace("\r\n", "\n")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.send_signal(signal.SIGINT)
        self._process.wait(PATIENCE_S)
        os.close(self._screen)


@unittest.skipUnless(zxingcpp, "no zxing-cpp: scripts/test.sh installs it")
class Telephone(AppTest):
    """A page that is open to the network is opened by a telephone's camera."""

    def test_the_address_is_a_code_on_the_terminal(self):
        with Terminal("geoloc_replay", self.make_recording(), "--http", "0.0.0.0:0", "--speed", "0") as replay:
            replay.wait_for("the page stays at")
        address = re.search(r"from a telephone in the same network: (http://\S+/)", replay.text)
        if not address:
            self.skipTest("this computer is in no network")
        lines = re.findall(r"\x1b\[30;47m(.*)\x1b\[0m", replay.text)
        self.assertTrue(lines, "a build without libqrencode")
        modules = [[HALF_BLOCKS[block][row] for block in line] for line in lines for row in (0, 1)]
        image = numpy.kron(numpy.array(modules, dtype=numpy.uint8), numpy.ones((8, 8), dtype=numpy.uint8))
        self.assertEqual(zxingcpp.read_barcode(image).text, address[1])
        self.assertNotIn("127.0.0.1", address[1])

    def test_there_is_none_where_nobody_could_use_it(self):
        recording = self.make_recording()
        with Terminal("geoloc_replay", recording, "--http", "0", "--speed", "0") as replay:
            replay.wait_for("the page stays at")
        self.assertNotIn("telephone", replay.text)
        with Live("geoloc_replay", recording, "--http", "0.0.0.0:0", "--speed", "0") as replay:  # stderr is no terminal
            replay.wait_for("the page stays at")
            self.assertNotIn("▀", "".join(replay.lines))


if __name__ == "__main__":
    unittest.main()
