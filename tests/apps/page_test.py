# SPDX-License-Identifier: Apache-2.0
"""The live page, in a browser during a live run and with visitors of all kinds."""
import http.server
import json
import math
import os
import pty
import re
import shutil
import signal
import socket
import subprocess
import threading
import time
import unittest
import urllib.request

from support import BIN, PATIENCE_S, AppTest, Live, World, run

try:
    from playwright.sync_api import sync_playwright
except ImportError:
    sync_playwright = None
try:
    import numpy
    import zxingcpp
except ImportError:
    zxingcpp = None

CHROMIUM = shutil.which("chromium")
SCREENSHOTS = BIN.parent / "screenshots"  # for manual inspection
HOSTILE_NAME = "<img src=x onerror=document.title='run'>\"&"

SCREENS = {
    "desktop_light": {"viewport": {"width": 1360, "height": 820}, "color_scheme": "light"},
    "desktop_dark": {"viewport": {"width": 1360, "height": 820}, "color_scheme": "dark"},
    "phone_light": {"viewport": {"width": 390, "height": 844}, "color_scheme": "light", "device_scale_factor": 2,
                    "has_touch": True},
    "phone_dark": {"viewport": {"width": 390, "height": 844}, "color_scheme": "dark", "device_scale_factor": 2,
                   "has_touch": True},
}

# Where the map shows the first pixel of a colour, in the page's coordinates; null where there is none.
FIND_COLOUR = """([selector, colour]) => {
  const canvas = document.querySelector(selector), probe = document.createElement("canvas").getContext("2d");
  probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(colour).trim() || colour;
  probe.fillRect(0, 0, 1, 1);
  const [r, g, b] = probe.getImageData(0, 0, 1, 1).data, { width, height } = canvas;
  const pixels = canvas.getContext("2d").getImageData(0, 0, width, height).data, box = canvas.getBoundingClientRect();
  for (let y = Math.ceil(height * 0.3); y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const i = 4 * (y * width + x);
      if (Math.abs(pixels[i] - r) + Math.abs(pixels[i + 1] - g) + Math.abs(pixels[i + 2] - b) < 6)
        return [box.x + x * box.width / width, box.y + y * box.height / height];
    }
  }
  return null;
}"""


# A canvas cannot be read after an image from another server was drawn on it.
IS_TAINTED = """() => {
  try {
    document.querySelector("#map-canvas").getContext("2d").getImageData(0, 0, 1, 1);
    return false;
  } catch {
    return true;
  }
}"""


FOUR_NOTATIONS = (r"^-?\d+\.\d{8}, -?\d+\.\d{8} \| \d+°\d\d′\d\d\.\d{3}″[NS] \d+°\d\d′\d\d\.\d{3}″[EW] "
                  r"\| 23K \d+\.\d\d E \d+\.\d\d N \| 23KPQ\d{10}$")


def tile_of(feature, zoom):
    """The Web Mercator tile that holds a GeoJSON point."""
    longitude, latitude = map(math.radians, feature["geometry"]["coordinates"])
    turns = (longitude / math.tau + 0.5, 0.5 - math.asinh(math.tan(latitude)) / math.tau)
    return (zoom, *(int(2**zoom * turn) for turn in turns))


def url_of(program):
    return program.wait_for(r"^page: (http://127\.0\.0\.1:\d+/)")[1]


TILE = b'<svg xmlns="http://www.w3.org/2000/svg" width="256" height="256"><path d="M0 0h256v256H0z" fill="#d0e8c0"/></svg>'


class TileServer:
    """A tile server with a map of one colour; `asked` holds the (zoom, x, y) of its requests."""

    def __init__(self):
        self.asked = asked = set()

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                asked.add(tuple(map(int, re.findall(r"\d+", self.path))))
                self.send_response(200)
                self.send_header("Content-Type", "image/svg+xml")
                self.end_headers()
                self.wfile.write(TILE)

            def log_message(self, *_):
                pass

        self._server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self._thread = threading.Thread(target=self._server.serve_forever)
        self.url = f"http://127.0.0.1:{self._server.server_port}/{{z}}/{{x}}/{{y}}.svg"

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()


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


class BrowserTest(AppTest):
    """A test with a browser. `faults` holds what its pages complain of, `hosts` whom they asked."""

    def setUp(self):
        super().setUp()
        self.objects_file = self.folder / "objects.geojson"
        self.faults = []
        self.hosts = set()
        self.playwright = sync_playwright().start()
        self.addCleanup(self.playwright.stop)
        self.browser = self.playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        self.addCleanup(self.browser.close)

    def open_screen(self, name, url):
        context = self.browser.new_context(permissions=["clipboard-read", "clipboard-write"], **SCREENS[name])
        page = context.new_page()
        page.set_default_timeout(1000 * PATIENCE_S)
        page.on("pageerror", lambda error: self.faults.append(f"{name}: {error}"))
        page.on("console", lambda message: self.faults.append(f"{name}: {message.text}")
                if message.type == "error" else None)
        page.on("request", lambda request: self.hosts.add(request.url.split("/")[2]))
        page.goto(url)
        return page


@unittest.skipUnless(sync_playwright, "no Playwright: scripts/test.sh installs it")
@unittest.skipUnless(CHROMIUM, "no Chromium: apt-get install chromium")
class LivePage(BrowserTest):
    """What an operator is promised, on a telephone and on a desk, by day and by night."""

    def test_shows_a_live_run_on_every_screen(self):
        names = self.write("names.txt", HOSTILE_NAME + "\n")
        world = World()
        recording = self.folder / "flight"
        with world.watch("--http", "0", "--class-names", names, "--out", self.objects_file, "--record", recording) as app:
            url = url_of(app)
            pages = {name: self.open_screen(name, url) for name in SCREENS}
            with world.fly("--start-s", 80, "--end-s", 98, "--speed", 3):
                pages["desktop_light"].wait_for_selector("#video:not([hidden])")
                self.assertTrue(self.finds_colour(pages["desktop_light"], "#video-canvas", "#ffd23f"))
                for page in pages.values():
                    page.wait_for_selector("#objects li[data-id]:not(.tentative)")
                self.check_state(pages["desktop_light"])
                for name, page in pages.items():
                    self.check_screen(name, page, url)
                self.check_copy(pages["desktop_light"])
            self.assertEqual(self.faults, [])
            self.assertEqual(self.hosts, {url.split("/")[2]})
            self.assertEqual(app.interrupt(), 0)  # with all pages open
            pages["phone_dark"].wait_for_selector("#notice:has-text('does not answer')")
        self.check_recorded_pictures(recording)

    def test_draws_the_tiles_of_a_server_where_one_is_configured(self):
        with TileServer() as tiles:
            config = self.write("config.json", {"live_page": {"tile_url": tiles.url, "tile_attribution": "<b>Maps</b>"}})
            with Live("geoloc_replay", self.make_recording(), "--config", config, "--http", "0", "--speed", "0",
                      "--out", self.objects_file) as replay:
                url = url_of(replay)
                replay.wait_for("the page stays at")
                page = self.open_screen("desktop_light", url)
                page.wait_for_function(IS_TAINTED)
                self.assertEqual(page.locator("#attribution").inner_text(), "<b>Maps</b>")
                self.assertEqual(replay.interrupt(), 0)
        self.assertEqual([fault for fault in self.faults if "CONNECTION" not in fault], [])
        for feature in json.loads(self.objects_file.read_text())["features"]:
            self.assertTrue(any(tile_of(feature, zoom) == (zoom, x, y) for zoom, x, y in tiles.asked), feature)

    def finds_colour(self, page, selector, colour):
        """Waits until it is drawn: the page follows the run."""
        page.wait_for_function(f"(what) => ({FIND_COLOUR})(what) !== null", arg=[selector, colour])
        return page.evaluate(FIND_COLOUR, [selector, colour])

    def check_state(self, page):
        page.wait_for_selector("#light-link:not(.bad)")
        page.wait_for_selector("#light-video:not(.bad)")
        page.wait_for_selector("#calibration tr:has-text('Image delay'):has-text('±')")
        page.wait_for_selector("#counters:has-text('Frames located')")
        self.assertIn(HOSTILE_NAME, page.locator("#objects").inner_text())
        self.assertEqual(page.locator("#objects img[src=x]").count(), 0)
        self.check_pictures(page)

    def check_recorded_pictures(self, recording):
        """The recording shows the same objects again."""
        found = {feature["properties"]["id"] for feature in json.loads(self.objects_file.read_text())["features"]}
        pictured = {int(file.stem) for file in (recording / "pictures").iterdir()}
        self.assertLessEqual(found, pictured)
        with Live("geoloc_replay", recording, "--http", "0", "--speed", "0") as replay:
            url = url_of(replay)
            replay.wait_for("the page stays at")
            for chosen in found:
                with urllib.request.urlopen(f"{url}objects/{chosen}/picture", timeout=PATIENCE_S) as answer:
                    self.assertEqual(answer.headers["Content-Type"], "image/jpeg")
                    self.assertEqual(answer.read(), (recording / "pictures" / f"{chosen}.jpg").read_bytes())

    def check_pictures(self, page):
        """Objects have a picture, cut from the video."""
        page.wait_for_function("""() => [...document.querySelectorAll("#objects img:not([hidden])")]
          .some((image) => image.complete && image.naturalWidth >= 40)""")

    def check_screen(self, name, page, url):
        """A click on an object shows its position; nothing overflows; a screenshot is kept."""
        page.bring_to_front()
        page.locator("#fit").click()  # the map stands still from here on
        page.wait_for_selector("#fit[aria-pressed=false]")
        page.mouse.click(*self.finds_colour(page, "#map-canvas", "--object"))
        page.wait_for_selector("#selected:not([hidden]) .place")
        coordinates = self.wait_for_coordinates(page, url)
        pointed = re.findall(r"-?\d+\.\d+", page.locator("#readout").inner_text())[:2]  # where the click was
        for read, told in zip(pointed, coordinates["degrees"].split(", ")):
            self.assertAlmostEqual(float(read), float(told), delta=2e-5)  # 2 m; a pixel is a few decimetres
        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth - innerWidth"), 0)
        page.locator("#fit").click()
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)
        page.screenshot(path=SCREENSHOTS / f"{name}.png", full_page=name.startswith("phone"))

    def wait_for_coordinates(self, page, url):
        """The server's data of the selected object, once the page shows the same: both follow the run."""
        chosen = int(re.match(r"\d+", page.locator("#selected h2").inner_text())[0])
        deadline = time.monotonic() + PATIENCE_S
        while True:
            with urllib.request.urlopen(f"{url}objects/{chosen}", timeout=PATIENCE_S) as answer:
                coordinates = json.load(answer)["coordinates"]
            shown = page.locator("#selected .place dd").all_inner_texts()
            self.assertRegex(" | ".join(shown), FOUR_NOTATIONS)
            places = [list(map(float, text.split(", "))) for text in (shown[0], coordinates["degrees"])]
            if math.dist(*places) < 1e-7:  # a centimetre: the page is not sent changes of less than a millimetre
                return coordinates
            self.assertLess(time.monotonic(), deadline, f"{shown} is not {coordinates}")
            page.wait_for_timeout(100)

    def check_copy(self, page):
        page.bring_to_front()
        page.locator("#selected .place button").first.click()
        page.wait_for_selector("#selected button:has-text('Copied')")
        copied = page.evaluate("navigator.clipboard.readText()")
        self.assertRegex(copied, r"^-22\.\d{8}, -43\.\d{8}$")


@unittest.skipUnless(sync_playwright, "no Playwright: scripts/test.sh installs it")
@unittest.skipUnless(CHROMIUM, "no Chromium: apt-get install chromium")
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
            self.assertEqual(page.locator("#calibration tr").count(), 7)
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
            places = {feature["properties"]["id"]: feature["geometry"]["coordinates"]
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
            longitude, latitude = json.loads(self.objects_file.read_text())["features"][0]["geometry"]["coordinates"]
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
        self._screen, keyboard = pty.openpty()
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


class Visitor:
    """A client of the event stream that reads all of it, or nothing."""

    def __init__(self, url, reads):
        host, port = url.split("/")[2].split(":")
        self._socket = socket.socket()
        if not reads:
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
        self._socket.connect((host, int(port)))
        self._socket.sendall(f"GET /events HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
        self.received = 0
        self._thread = threading.Thread(target=self._read if reads else lambda: None)
        self._thread.start()

    def _read(self):
        while piece := self._socket.recv(65536):
            self.received += len(piece)

    def leave(self):
        self._thread.join()
        self._socket.close()


class Visitors(AppTest):
    """Whoever visits, and however: the results are the same, and the program ends when it is told to."""

    def test_fifty_pages_change_no_byte_and_delay_no_end(self):
        recording = self.make_recording()
        alone, watched = self.folder / "alone.geojson", self.folder / "watched.geojson"
        self.assertEqual(run("geoloc_replay", recording, "--out", alone).status, 0)
        with Live("geoloc_replay", recording, "--out", watched, "--http", "0", "--speed", "10") as replay:
            url = url_of(replay)
            visitors = [Visitor(url, reads=i % 10 != 0) for i in range(50)]
            replay.wait_for("the page stays at")
            self.assertEqual(alone.read_bytes(), watched.read_bytes())
            self.assertEqual(replay.interrupt(), 0)
        for visitor in visitors:
            visitor.leave()
        self.assertTrue(all(visitor.received > 1000 for i, visitor in enumerate(visitors) if i % 10 != 0))

    def test_ctrl_c_ends_a_replay_that_is_played(self):
        recording = self.make_recording()
        objects = self.folder / "objects.geojson"
        with Live("geoloc_replay", recording, "--out", objects, "--http", "0") as replay:
            url_of(replay)
            self.assertEqual(replay.interrupt(), 0)
        self.assertEqual(json.loads(objects.read_text())["type"], "FeatureCollection")

    def test_what_is_no_place_for_a_page_is_refused(self):
        recording = self.make_recording()
        for endpoint in "port", "1.2.3.4:80", ":80", "127.0.0.1:99999":
            self.assert_refused(run("geoloc_replay", recording, "--http", endpoint), "--http", endpoint)


if __name__ == "__main__":
    unittest.main()
